// SPDX-License-Identifier: MIT
//
// What batches of draws read on the GPU: where each instance stands, in a buffer texture, and the
// materials, side by side in one uniform buffer.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

#include "gl/buffer.h"
#include "gl/texture.h"
#include "scene/renderer.h"
#include "scene/scene.h"

namespace lodestar::scene {

/// One draw of a batch, as shaders/host/mesh.vert reads it.
struct Instance {
    glm::vec4 rows[3]; ///< of worldFromModel, an affine matrix
    glm::vec4 more;    ///< x: first texel of its joints; yzw: f0, f1 and open of its ProbeChoice
    bool operator==(const Instance&) const = default;
};

/// Instances in pages of as many as a buffer texture holds: at least 16,384.
class GpuInstances {
public:
    /// How many a page holds; plan::PlanInput::instancesPerPage of what is drawn from it.
    [[nodiscard]] static std::size_t pageSize(const gl::Device& device);
    /// Uploads what differs from the last call: in each page, from the first to the last of those
    /// instances.
    void upload(gl::Device& device, const std::vector<Instance>& instances);
    /// Binds the page of an instance. @return its place in the page
    [[nodiscard]] std::size_t bind(std::size_t instance);
    /// Something else may have been bound since.
    void forgetBound() { bound_ = kNone; }

private:
    struct Page {
        std::vector<Instance> uploaded;
        gl::Buffer buffer;
        gl::Texture texture;
    };
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    static void upload(gl::Device& device, std::span<const Instance> instances, Page& page);

    std::size_t pageSize_ = 1;
    std::size_t bound_ = kNone;
    std::vector<Page> pages_;
};

class GpuMaterials {
public:
    /// The materials have changed: the next prepare writes them.
    void forget() { stale_ = true; }
    /// Writes all materials of a scene, the default one last, if the override is another than the
    /// last call's or the materials have changed.
    void prepare(gl::Device& device, const Scene& scene,
                 const std::optional<MaterialOverride>& values);
    /// Binds one. @param material index into the scene's, kNone the default
    void bind(int material) const;

private:
    struct Written {
        std::optional<MaterialOverride> values;
    };
    std::optional<Written> written_;
    bool stale_ = false;
    std::size_t count_ = 0;  ///< of the scene's
    std::size_t stride_ = 0; ///< bytes from one to the next
    gl::Buffer buffer_;
};

} // namespace lodestar::scene

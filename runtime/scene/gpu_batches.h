// SPDX-License-Identifier: MIT
//
// What batches of draws read on the GPU: where each instance stands, in a buffer texture, and the
// materials, side by side in one uniform buffer.
#pragma once

#include <optional>
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
    glm::vec4 skin;    ///< x: first texel of its joints
    bool operator==(const Instance&) const = default;
};

class GpuInstances {
public:
    /// Uploads what differs from the last call, from the first to the last of those instances.
    /// @errors NoOpenGl if they are more than a buffer texture holds
    [[nodiscard]] core::Result<void> upload(gl::Device& device, std::vector<Instance> instances);
    void bind() const;

private:
    std::vector<Instance> uploaded_;
    gl::Buffer buffer_;
    gl::Texture texture_;
};

class GpuMaterials {
public:
    /// Writes all materials of a scene, the default one last, if the override is another than the
    /// last call's.
    void prepare(gl::Device& device, const Scene& scene,
                 const std::optional<MaterialOverride>& values);
    /// Binds one. @param material index into the scene's, kNone the default
    void bind(int material) const;

private:
    struct Written {
        std::optional<MaterialOverride> values;
    };
    std::optional<Written> written_;
    std::size_t count_ = 0;  ///< of the scene's
    std::size_t stride_ = 0; ///< bytes from one to the next
    gl::Buffer buffer_;
};

} // namespace lodestar::scene

// SPDX-License-Identifier: MIT
//
// Skins and morphs on the GPU: joint matrices in a buffer texture that the vertex shader reads,
// morphed vertices made on the CPU. Only what changed since the last upload is uploaded.
#pragma once

#include <optional>
#include <vector>

#include "gl/buffer.h"
#include "gl/texture.h"
#include "plan/effect_plan.h"
#include "scene/draw_list.h"
#include "scene/gpu_scene.h"
#include "scene/scene.h"

namespace lodestar::scene {

/// Positions, normals and tangents of a primitive with its targets added.
struct MorphedVertices {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  ///< unit, or empty
    std::vector<glm::vec4> tangents; ///< unit, w the handedness; empty if there are none
};

/// Adds a primitive's targets, each at its weight. Normals that the file left to be generated are
/// those of the morphed triangles. @pre as many weights as targets
[[nodiscard]] MorphedVertices morph(const io::GltfPrimitive& primitive,
                                    const std::vector<float>& weights);

class GpuDeformation {
public:
    /// @errors NoOpenGl if the skins have more joints than a buffer texture holds
    [[nodiscard]] static core::Result<GpuDeformation> make(gl::Device& device, const Scene& scene,
                                                           const std::vector<DrawItem>& items);

    /// Whether anything can move vertices but where nodes stand.
    [[nodiscard]] bool deforms() const;
    /// Tells the planner what has not changed since the last upload, and how skins wind.
    void describe(const Scene& scene, const std::vector<DrawItem>& items, plan::PlanInput& input);
    /// Uploads what the plan's draws need and has changed.
    void prepare(gl::Device& device, const Scene& scene, const std::vector<DrawItem>& items,
                 const GpuScene& gpu, const plan::EffectPlan& plan);

    /// Binds the joints for the draws of a frame.
    void bind() const;
    /// Where a skin's joints begin in the buffer texture; 0 for none.
    [[nodiscard]] float firstTexel(int skin) const;
    /// The vertices of a draw item that is morphed, from vertex 0 on; null for others.
    [[nodiscard]] const gl::VertexArray* vertices(std::size_t item) const;

private:
    /// Whether a skin's joints turn most of a draw item inside out, in the pose described.
    [[nodiscard]] bool mirrored(std::size_t item, int skin) const;

    struct Morph {
        std::vector<float> uploaded; ///< the weights that the buffers hold; empty: none yet
        gl::VertexArray vertices;
        gl::Buffer positions, normals, tangents;
    };

    static void uploadMorph(gl::Device& device, const io::GltfPrimitive& primitive,
                            const std::vector<float>& weights, const GpuGeometry& geometry,
                            const GpuPrimitive& shared, Morph& target);

    std::vector<std::size_t> firstTexels_; ///< by skin
    std::vector<glm::vec4> joints_;        ///< three rows a joint, in the pose described
    std::vector<glm::vec4> uploadedJoints_;
    std::optional<gl::Buffer> jointBuffer_;
    gl::Texture jointTexture_;
    std::vector<std::optional<Morph>> morphs_;   ///< by draw item
    std::vector<std::vector<double>> followers_; ///< by draw item and joint: how much follows it
};

} // namespace lodestar::scene

// SPDX-License-Identifier: MIT
//
// Depths of a scene as suns see it: one layer a sun, kept until the sun or what casts has moved.
#pragma once

#include <optional>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "gl/framebuffer.h"
#include "host/blocks.glsl"
#include "plan/effect_plan.h"
#include "scene/draw_list.h"
#include "scene/scene.h"

namespace lodestar::scene {

inline constexpr int kShadowSide = 2048; ///< texels

/// What a shadow map shows: an orthographic view along a sun's axis.
struct ShadowView {
    glm::mat4 clipFromWorld{1.0f};
    glm::mat4 mapFromWorld{1.0f}; ///< to texture coordinates and depth, [0, 1]
    float texel = 0.0f;           ///< metres of a texel's side
};

/// A square about the bounds' sphere, so that its size does not change as the sun turns, moved in
/// whole texels. @param axis unit, towards the sun
[[nodiscard]] ShadowView shadowView(const Bounds& bounds, const glm::dvec3& axis, int side);

class ShadowMaps {
public:
    /// Tells the planner whether what casts has moved since any map was drawn, and which suns have.
    void describe(const Scene& scene, const std::vector<DrawItem>& items,
                  const std::vector<glm::dvec3>& axes, plan::PlanInput& input);
    /// Binds the layer of a light to draw in. @errors NoOpenGl if the driver has no memory
    [[nodiscard]] core::Result<void> begin(gl::Device& device, const plan::LitLight& lit,
                                           int layers);
    [[nodiscard]] const ShadowView& view(int layer) const {
        return layers_[static_cast<std::size_t>(layer)].view;
    }
    void describe(const plan::EffectPlan& plan, blocks::LodestarRsrmLights& block) const;
    void bind() const;

private:
    struct Layer {
        std::optional<glm::dvec3> drawnAxis; ///< of the sun when it was drawn
        glm::dvec3 axis{0.0, 1.0, 0.0};      ///< of the sun now
        ShadowView view;                     ///< for that
    };
    std::vector<Layer> layers_;
    std::vector<glm::mat4> casters_; ///< where they were when last described
    Bounds bounds_;
    gl::DepthLayers target_;
};

} // namespace lodestar::scene

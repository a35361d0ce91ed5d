// SPDX-License-Identifier: MIT
//
// The drawables of a scene in a fixed order, and what their shaders must do.
#pragma once

#include <vector>

#include "lighting/error_forecast.h"
#include "plan/effect_plan.h"
#include "scene/renderer.h"
#include "scene/scene.h"

namespace lodestar::scene {

/// One primitive of a mesh at a node.
struct DrawItem {
    int node = 0;
    int mesh = 0;
    int primitive = 0;
    int component = 0; ///< the node's MeshComponent
};

/// Every drawable, in node order: the order of PlanInput::draws.
[[nodiscard]] std::vector<DrawItem> drawItems(const Scene& scene);

inline constexpr std::size_t kTexelsPerJoint = 3; ///< rows of an affine matrix

/// Which skins a node wears: the others' joints are not uploaded.
[[nodiscard]] std::vector<bool> wornSkins(const Scene& scene);

/// The lights of a scene, at most the blocks' maximum; the rest is counted in `left`.
struct PlacedLight {
    const Node* node;
    const io::GltfLight* light;
};
[[nodiscard]] std::vector<PlacedLight> placedLights(const Scene& scene);

/// The material of a primitive: the file's, or glTF's default.
[[nodiscard]] const io::GltfMaterial& materialOf(const Scene& scene,
                                                 const io::GltfPrimitive& primitive);

/// What a primitive's shader must do under the settings.
[[nodiscard]] plan::Features featuresOf(const Scene& scene, const io::GltfPrimitive& primitive,
                                        const RenderSettings& settings);

/// Whether some draw's estimator is still `auto`.
[[nodiscard]] bool hasChoices(const plan::PlanInput& input);
/// What `auto` stands for, draw by draw: the cheapest that is foreseen to be right enough over the
/// draw's exponents.
void chooseEstimators(const lighting::ErrorForecast& forecast, plan::PlanInput& input);

} // namespace lodestar::scene

// SPDX-License-Identifier: MIT
#include "scene/shadow_maps.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

#include "scene/gpu_scene.h"

namespace lodestar::scene {

ShadowView shadowView(const Bounds& bounds, const glm::dvec3& axis, int side) {
    // Two texels more on each side than the sphere: one for the snap, one for filtering.
    const double radius = std::max(static_cast<double>(bounds.radius()), 1e-3);
    const double half = radius * side / (side - 4.0);
    const double texel = 2.0 * half / side;
    const glm::dvec3 up =
        std::abs(axis.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dmat4 turned = glm::lookAt(glm::dvec3(0.0), -axis, up);
    glm::dvec3 center(turned * glm::dvec4(glm::dvec3(bounds.center()), 1.0));
    center.x = std::floor(center.x / texel) * texel;
    center.y = std::floor(center.y / texel) * texel;
    const glm::dmat4 box = glm::ortho(center.x - half, center.x + half, center.y - half,
                                      center.y + half, -center.z - half, -center.z + half);
    const glm::dmat4 clip = box * turned;
    const glm::dmat4 map = glm::translate(glm::dmat4(1.0), glm::dvec3(0.5)) *
                           glm::scale(glm::dmat4(1.0), glm::dvec3(0.5)) * clip;
    return {glm::mat4(clip), glm::mat4(map), static_cast<float>(texel)};
}

void ShadowMaps::describe(const Scene& scene, const std::vector<DrawItem>& items,
                          const std::vector<glm::dvec3>& axes, plan::PlanInput& input) {
    std::vector<glm::mat4> placed;
    bool moved = input.jointsMoved && input.jointBytes > 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
        placed.push_back(scene.nodes[static_cast<std::size_t>(items[i].node)].worldFromNode);
        moved = moved || (input.draws[i].morphBytes > 0 && input.draws[i].weightsChanged);
    }
    if (moved || placed != casters_) {
        for (Layer& layer : layers_) {
            layer.drawnAxis.reset();
        }
        casters_ = std::move(placed);
        bounds_ = scene.worldBounds();
    }
    for (std::size_t i = 0; i < input.rsrmLights.size(); ++i) {
        plan::RsrmLightView& light = input.rsrmLights[i];
        if (light.shadow < 0) {
            continue;
        }
        const auto index = static_cast<std::size_t>(light.shadow);
        layers_.resize(std::max(layers_.size(), index + 1));
        Layer& layer = layers_[index];
        layer.axis = axes[i];
        light.shadowChanged = layer.drawnAxis != layer.axis;
        if (light.shadowChanged && light.shines) {
            layer.view = shadowView(bounds_, layer.axis, kShadowSide);
        }
    }
    input.shadowTexels = std::uint64_t{kShadowSide} * kShadowSide;
}

core::Result<void> ShadowMaps::begin(gl::Device& device, const plan::LitLight& lit, int layers) {
    if (!target_) {
        auto made = gl::DepthLayers::make(device, kShadowSide, layers);
        if (!made) {
            return made.error();
        }
        target_ = std::move(*made);
    }
    Layer& layer = layers_[static_cast<std::size_t>(lit.shadow)];
    layer.drawnAxis = layer.axis;
    target_.begin(lit.shadow);
    return {};
}

void ShadowMaps::describe(const plan::EffectPlan& plan, blocks::LodestarRsrmLights& block) const {
    for (const plan::LitLight& lit : plan.rsrmLights) {
        if (lit.shadow >= 0) {
            block.shadowFromWorld[lit.shadow] = view(lit.shadow).mapFromWorld;
            block.shadowTexel[lit.shadow].x = view(lit.shadow).texel;
        }
    }
}

void ShadowMaps::bind() const {
    if (target_) {
        target_.depths().bind(kShadowUnit);
    }
}

} // namespace lodestar::scene

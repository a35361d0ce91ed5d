// SPDX-License-Identifier: MIT
#include "scene/frame_parts.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <glm/gtc/matrix_transform.hpp>

#include "scene/draw_list.h"

namespace lodestar::scene {

void setPunctualLights(const Scene& scene, blocks::LodestarFrame& block) {
    int count = 0;
    for (const PlacedLight& placed : placedLights(scene)) {
        if (count == LODESTAR_MAX_LIGHTS) {
            break;
        }
        const io::GltfLight& light = *placed.light;
        const glm::mat4& world = placed.node->worldFromNode;
        const glm::vec3 z(world[2]);
        const float length = glm::length(z);
        const glm::vec3 back = length > 0.0f ? z / length : glm::vec3(0.0f, 0.0f, 1.0f);
        const bool directional = light.kind == io::LightKind::Directional;
        block.lightPosition[count] =
            directional ? glm::vec4(back, 0.0f) : glm::vec4(glm::vec3(world[3]), 1.0f);
        const float inverseRange = std::isfinite(light.range) ? 1.0f / light.range : 0.0f;
        block.lightColor[count] = {light.color * light.intensity, inverseRange * inverseRange};
        block.lightDirection[count] = {-back, 0.0f};
        block.lightCone[count] = {0.0f, 1.0f, 0.0f, 0.0f};
        if (light.kind == io::LightKind::Spot) {
            const float outer = std::cos(light.outerConeAngle);
            const float scale = 1.0f / std::max(0.001f, std::cos(light.innerConeAngle) - outer);
            block.lightCone[count] = {scale, -outer * scale, 0.0f, 0.0f};
        }
        ++count;
    }
    block.lightCount = glm::vec4(static_cast<float>(count));
}

glm::mat4 tileFromClip(const glm::ivec4& tile, int width, int height) {
    const glm::vec2 size(static_cast<float>(width), static_cast<float>(height));
    const glm::vec2 extent(static_cast<float>(tile.z), static_cast<float>(tile.w));
    const glm::vec2 center =
        (glm::vec2(static_cast<float>(tile.x), static_cast<float>(tile.y)) + 0.5f * extent) / size;
    const glm::vec2 ndc(2.0f * center.x - 1.0f, 1.0f - 2.0f * center.y);
    return glm::scale(glm::mat4(1.0f), glm::vec3(size / extent, 1.0f)) *
           glm::translate(glm::mat4(1.0f), glm::vec3(-ndc, 0.0f));
}

std::uint64_t resolve(const core::Image& samples, int perSide, const glm::ivec2& at,
                      core::Image& out) {
    std::uint64_t repaired = 0;
    const float weight = 1.0f / static_cast<float>(perSide * perSide);
    for (int y = 0; y < samples.height() / perSide; ++y) {
        for (int x = 0; x < samples.width() / perSide; ++x) {
            glm::vec4 sum(0.0f);
            for (int j = 0; j < perSide; ++j) {
                for (int i = 0; i < perSide; ++i) {
                    const float* s = samples.at(x * perSide + i, y * perSide + j);
                    sum += glm::vec4(s[0], s[1], s[2], s[3]);
                }
            }
            sum *= weight;
            if (!std::isfinite(sum.x) || !std::isfinite(sum.y) || !std::isfinite(sum.z) ||
                !std::isfinite(sum.w)) {
                sum = glm::vec4(0.0f);
                ++repaired;
            }
            std::memcpy(out.at(at.x + x, at.y + y), &sum, sizeof sum);
        }
    }
    return repaired;
}

bool publishes(const plan::EffectPlan& plan, std::size_t probe) {
    return std::any_of(
        plan.probeWork.begin(), plan.probeWork.end(),
        [&](const plan::ProbeWork& work) { return work.probe == probe && work.publish; });
}

} // namespace lodestar::scene

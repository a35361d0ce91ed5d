// SPDX-License-Identifier: MIT
//
// A shading text for hosts that keep the lights' texels in three array textures, a layer a light.
#pragma once

#include <cstdint>
#include <string>

#include <lodestar/lodestar.h>

namespace lodestar::hosts {

/// Most lights of the text's uniform array; a host's further ones are left out.
inline constexpr int kMaxLights = 32;

/// GLSL 330 without a version line: the library's, answers to its hooks, and
/// `vec3 lodestar_lights(LodestarSurface)`, the radiance that leaves a surface under all lights. It
/// reads the samplers `lodestar_maps`, `lodestar_lamberts`, `lodestar_gradients` and the uniforms
/// `lodestar_count`, `lodestar_axes` (xyz unit; w: layer), `lodestar_mapSize`, `lodestar_mapRows`.
/// @param profile LODESTAR_PROFILE_*
[[nodiscard]] std::string shadingText(const LodestarApi& api, std::int32_t profile);

/// `lodestar_mapSize` and `lodestar_mapRows`.
struct MapUniforms {
    float size[4];
    float rows[4];
};
[[nodiscard]] MapUniforms mapUniforms(const LodestarMapLayout& layout);

} // namespace lodestar::hosts

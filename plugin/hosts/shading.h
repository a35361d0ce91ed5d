// SPDX-License-Identifier: MIT
//
// The library's shading text and the uniforms it reads, for hosts in C++.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <lodestar/lodestar.h>

namespace lodestar::hosts {

/// "plugin/lighting.glsl" with plain uniforms, and the filmic curve and sRGB as `lodestar render`
/// shows them: GLSL 330 without a version line. @param profile LODESTAR_PROFILE_*
[[nodiscard]] std::string shadingText(const LodestarApi& api, std::int32_t profile);

/// All that the text reads.
[[nodiscard]] std::vector<LodestarUniform> uniforms(const LodestarApi& api);

/// The data of a plan's uniforms, at their offsets; empty if there is no such plan.
[[nodiscard]] std::vector<unsigned char> uniformData(const LodestarApi& api,
                                                     LodestarContext* context, LodestarPlan plan);

} // namespace lodestar::hosts

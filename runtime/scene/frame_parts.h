// SPDX-License-Identifier: MIT
//
// Parts of drawing a frame that hold no state: the punctual lights' uniforms, and what turns tiles
// into a picture.
#pragma once

#include <cstdint>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "core/image.h"
#include "host/blocks.glsl"
#include "plan/effect_plan.h"
#include "scene/scene.h"

namespace lodestar::scene {

/// Fills the block's part of the scene's punctual lights, as many as it holds.
void setPunctualLights(const Scene& scene, blocks::LodestarFrame& block);

/// The part of clip space that a tile shows, stretched over the whole of it.
/// @param tile x, y, width, height in pixels from the top left of a picture of the size
[[nodiscard]] glm::mat4 tileFromClip(const glm::ivec4& tile, int width, int height);

/// Averages a tile's samples into the picture at a place; pixels that are not finite become 0.
/// @return how many those are
[[nodiscard]] std::uint64_t resolve(const core::Image& samples, int perSide, const glm::ivec2& at,
                                    core::Image& out);

/// Whether a plan has the faces drawn of a probe take the place of the captured ones.
[[nodiscard]] bool publishes(const plan::EffectPlan& plan, std::size_t probe);

} // namespace lodestar::scene

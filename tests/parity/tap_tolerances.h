// SPDX-License-Identifier: MIT
//
// Bounds of several taps' means, for those of a whole estimate.
#pragma once

#include <glm/vec3.hpp>

namespace lodestar::testing {

/// How far the mean of taps may be off when the lobe's direction is by `off` and its exponent plus
/// 1 by `strayed` of itself: of the tap's directions, and of their levels.
struct TapErrors {
    double direction = 0.0;
    double level = 0.0;
};

/// @param count 3 or 7: a ring; 16: a spiral  @param width of level 0  @param levels of the chain
[[nodiscard]] TapErrors tapErrors(const glm::dvec3& direction, double exponent, int count,
                                  double width, double levels, double off, double strayed);

} // namespace lodestar::testing

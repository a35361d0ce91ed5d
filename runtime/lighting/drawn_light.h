// SPDX-License-Identifier: MIT
//
// Points of a sky or a sun drawn by the light that they give, for references that must not miss a
// sun's disc.
#pragma once

#include <vector>

#include "lighting/day.h"
#include "lighting/drawn_texels.h"

namespace lodestar::lighting {

struct DrawnLight {
    /// In the world. Empty for a black light, and one that does not shine.
    std::vector<DrawnTexel> points;
    double sum = 0.0; ///< integral of r + g + b over the sphere
};

/// So many points, each as often as its share of the sum: evenly spaced along the sum over rings
/// about the axis, a golden angle from one to the next.
/// @param light as `repaired` leaves it  @param count >= 0
[[nodiscard]] DrawnLight drawnLight(const DayLight& light, const DayMoment& moment, int count);

} // namespace lodestar::lighting

// SPDX-License-Identifier: MIT
//
// What skies and suns shine into lobes, at directions that are chosen so that few say enough.
#pragma once

#include <functional>
#include <vector>

#include "lighting/accuracy.h"
#include "lighting/day.h"
#include "lighting/day_lookup.h"

namespace lodestar::app {

/// Directions and what lights shine into lobes about them.
struct Truth {
    std::vector<lighting::MeasuredDirection> directions;
    std::vector<glm::dvec3> radiance;
};

/// A light as it is drawn from.
struct Drawn {
    std::vector<glm::dvec3> points;
    double sum = 0.0;
};

/// The lights that shine at an hour. @param count points of each
[[nodiscard]] std::vector<Drawn> drawnLights(const std::vector<lighting::DayLight>& lights,
                                             double hour, int count);

/// Half of the directions even over the sphere, half drawn by what the lobes get: points of each
/// light moved by the lobe itself, whose density is the lobe's mean over that light's sum.
/// @param even directions of the first half  @param exponent Phong
/// @param advance called once a direction; false: stop, and nothing is known
[[nodiscard]] Truth truthOf(const lighting::ReferenceDay& reference,
                            const std::vector<Drawn>& drawn, int even, double exponent,
                            const std::function<bool()>& advance);

} // namespace lodestar::app

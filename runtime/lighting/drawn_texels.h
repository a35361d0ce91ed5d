// SPDX-License-Identifier: MIT
//
// Texels of a map drawn by the light that they give, for references that must not miss a lamp.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "lighting/cubemap.h"

namespace lodestar::lighting {

/// A point of a map and what it stands for.
struct DrawnTexel {
    glm::vec3 direction; ///< of the texel's centre, unit
    /// Radiance over the density by which it was drawn, (r + g + b) / lightSum per steradian.
    glm::vec3 radianceOverDensity;
};

/// Integral of r + g + b over the sphere, level 0, from exact solid angles.
[[nodiscard]] double lightSum(const Cubemap& base);

/// So many texels of level 0, each as often as its share of lightSum: evenly spaced along the sum
/// over all texels. @param count >= 0  @return empty for a black map
[[nodiscard]] std::vector<DrawnTexel> drawnTexels(const Cubemap& base, int count);

} // namespace lodestar::lighting

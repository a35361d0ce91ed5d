// SPDX-License-Identifier: MIT
//
// Lobe means of several environments at many directions and exponents at once, fast enough for a
// test, and the error norm of the ladder.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "numerics/ladder_environments.h"

namespace lodestar::testing {

/// A direction and the solid angle it stands for.
struct WeightedDirection {
    glm::dvec3 direction;
    double weight;
};

/// 1536 Fibonacci directions over the sphere and 384 in each 15 degree cap about the corner axis
/// and the centre axis; weights are the inverse of the local density.
[[nodiscard]] std::vector<WeightedDirection> ladderDirections();

/// The exponents whose truth is made: 0 and powers of two.
[[nodiscard]] const std::vector<int>& ladderExponents();

/// Means over (s+1)/(2 pi) max(r.l, 0)^s of each environment.
/// @return [direction][exponent][environment], flattened in that order
[[nodiscard]] std::vector<glm::dvec3> lobeMeans(const std::vector<NamedCube>& environments,
                                                const std::vector<WeightedDirection>& directions);

} // namespace lodestar::testing

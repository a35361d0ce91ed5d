// SPDX-License-Identifier: MIT
//
// Gauss-Legendre quadrature in double precision.
#pragma once

#include <vector>

namespace lodestar::core {

/// Nodes in (0, 1), ascending, and weights that sum to 1: exact for polynomials of degree
/// 2 n - 1.
struct GaussRule {
    std::vector<double> nodes;
    std::vector<double> weights;
};

/// The rule of n nodes by Newton's method on the Legendre polynomial; nodes to 1e-16.
/// @pre n in [1, 1024]
[[nodiscard]] GaussRule gaussLegendre(int n);

} // namespace lodestar::core

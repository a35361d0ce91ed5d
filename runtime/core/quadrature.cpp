// SPDX-License-Identifier: MIT
#include "core/quadrature.h"

#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/contract.h"

namespace lodestar::core {

GaussRule gaussLegendre(int n) {
    LODESTAR_EXPECT(n >= 1 && n <= 1024, "a Gauss rule has 1 to 1024 nodes");
    const auto size = static_cast<std::size_t>(n);
    GaussRule rule{std::vector<double>(size), std::vector<double>(size)};
    for (std::size_t i = 0; i < size; ++i) {
        double x = -std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (n + 0.5));
        double slope = 0.0;
        for (int step = 0; step < 100; ++step) {
            double before = 1.0;
            double value = x;
            for (int l = 1; l < n; ++l) {
                const double next = ((2 * l + 1) * x * value - l * before) / (l + 1);
                before = value;
                value = next;
            }
            slope = n * (before - x * value) / (1.0 - x * x);
            const double change = value / slope;
            x -= change;
            if (std::abs(change) < 1e-15) {
                break;
            }
        }
        rule.nodes[i] = 0.5 * (1.0 + x);
        rule.weights[i] = 1.0 / ((1.0 - x * x) * slope * slope);
    }
    return rule;
}

} // namespace lodestar::core

// SPDX-License-Identifier: MIT
//
// How wrong the estimators of a family will be on a map, exponent by exponent, measured once when
// it is loaded, and the cheapest that is right enough: `auto:ERROR`.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "lighting/cubemap.h"
#include "lighting/estimator.h"

namespace lodestar::lighting {

/// What `auto` chooses from, from the cheapest: each reads tent mips.
[[nodiscard]] std::span<const Estimator> autoLadder();

class ErrorForecast {
public:
    ErrorForecast() = default;
    /// Measures each rung at 768 directions, half spread evenly, half at what is bright, against
    /// sums over the map; on all processors. The figure is 1.3 times the relative RMSE found
    /// (docs/estimators.md says how well it foresees).
    /// @param base level 0  @param tentMips its full chain
    ErrorForecast(const Cubemap& base, const Cubemap& tentMips);

    [[nodiscard]] bool empty() const { return errors_.empty(); }
    /// Relative RMSE foreseen of a rung. @param exponent Phong, [0, 1e7] or infinite
    [[nodiscard]] double error(std::size_t rung, double exponent) const;

    struct Choice {
        Estimator estimator;
        double error = 0.0; ///< foreseen
        bool met = true;    ///< false: no rung is right enough, this is the best
    };
    /// The cheapest rung whose error is within a tolerance for every exponent of a range.
    /// @param tolerance relative RMSE, > 0  @param bluntest, sharpest Phong exponents
    [[nodiscard]] Choice choose(double tolerance, double bluntest, double sharpest) const;

private:
    [[nodiscard]] double worst(std::size_t rung, double bluntest, double sharpest) const;
    std::vector<std::vector<double>> errors_; ///< [rung][place of log2(s + 1)]
};

} // namespace lodestar::lighting

// SPDX-License-Identifier: MIT
//
// Lights whose filtered radiance has a closed form in F and Q, to judge maps by: a sun's disc, a
// glow, a sky with a step at its horizon.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "lighting/rsrm.h"
#include "lighting/rsrm_weights.h"

namespace lodestar::testing {

inline constexpr double kDegree = std::numbers::pi / 180.0;

struct RsrmSource {
    const char* name;
    lighting::LightKind kind;
    double disc; ///< angular radius in radians of radiance 1, 0 for the sky

    /// Filtered radiance. The sky: zenith .25 to 1 at the horizon, .15 below it to .05, linear in
    /// z.
    [[nodiscard]] double exact(double theta, double s) const {
        if (disc > 0.0) {
            return lighting::capMass(theta, disc, s);
        }
        const double mean = std::cos(theta) * (s + 1.0) / (s + 2.0);
        const double half = 0.5 * std::numbers::pi;
        // L = .15 + .1 z + step .85 + (slope -.75 - .1) max(z, 0)
        return 0.15 + 0.1 * mean + 0.85 * lighting::capMass(theta, half, s) -
               0.85 * lighting::capFirstExcess(theta, half, s);
    }

    /// Exact zone means.
    [[nodiscard]] lighting::ZonalRadiance zonal(const lighting::Zones& zones) const {
        lighting::ZonalRadiance result{zones, {}};
        const std::vector<double> edges = lighting::zoneEdges(zones);
        for (std::size_t j = 0; j + 1 < edges.size(); ++j) {
            const double a = edges[j];
            const double b = edges[j + 1];
            double mean = 0.0;
            if (disc > 0.0) {
                const double end = std::min(b, disc);
                mean = end <= a ? 0.0
                                : std::sin(0.5 * (end + a)) * std::sin(0.5 * (end - a)) /
                                      (std::sin(0.5 * (b + a)) * std::sin(0.5 * (b - a)));
            } else { // an even number of zones: none holds the horizon
                const double z = 0.5 * (std::cos(a) + std::cos(b));
                mean = z > 0.0 ? 1.0 - 0.75 * z : 0.15 + 0.1 * z;
            }
            result.means.emplace_back(mean);
        }
        return result;
    }
};

inline const std::vector<RsrmSource> kRsrmSources = {
    {"sun .27 deg", lighting::LightKind::Sun, 0.27 * kDegree},
    {"glow 5 deg", lighting::LightKind::Sun, 5.0 * kDegree},
    {"sky", lighting::LightKind::Sky, 0.0},
};

/// Exact values at angles and exponents between and on the columns and rows of any layout.
struct RsrmTruth {
    std::vector<double> thetas;
    std::vector<double> exponents;
    std::vector<double> values; ///< [exponent][theta]

    RsrmTruth(const RsrmSource& source, int angles, int exponentCount) {
        for (int i = 0; i < angles; ++i) {
            // Uniform in sqrt(theta) from the axis, which crowds them there, then about the
            // horizon.
            const double t = (i + 0.5) / angles;
            thetas.push_back(i % 3 == 2 ? (0.5 + 0.1 * (t - 0.5)) * std::numbers::pi
                                        : t * t * std::numbers::pi);
        }
        thetas.push_back(0.0);
        for (int i = 0; i < exponentCount; ++i) {
            exponents.push_back(
                std::pow(2049.0 / 2.0, static_cast<double>(i) / (exponentCount - 1)) * 2.0 - 1.0);
        }
        for (const double s : exponents) {
            for (const double theta : thetas) {
                values.push_back(source.exact(theta, s));
            }
        }
    }
};

/// How far a bake's values are from sums in double precision, over the row's peak.
/// @param rows, columns every how many are looked at
inline double worstOfPeak(const lighting::RsrmBake& bake, const lighting::ZonalRadiance& zonal,
                          std::size_t rows, std::size_t columns) {
    const std::vector<double> edges = lighting::zoneEdges(zonal.zones);
    const std::vector<double> thetas =
        lighting::columnAngles(lighting::RsrmColumns::Refined, static_cast<int>(bake.columns));
    double worst = 0.0;
    for (std::size_t e = 0; e < bake.exponents.size(); e += rows) {
        const float* row = bake.value(e, 1);
        const auto peak = static_cast<double>(*std::max_element(row, row + bake.columns));
        for (std::size_t i = 0; i < bake.columns; i += columns) {
            const auto weights = lighting::ringWeights(thetas[i], edges, bake.exponents[e]);
            double sum = 0.0;
            for (std::size_t j = 0; j < weights.size(); ++j) {
                sum += weights[j] * zonal.means[j].g;
            }
            worst = std::max(worst, std::abs(static_cast<double>(row[i]) - sum) / peak);
        }
    }
    return worst;
}

struct RsrmError {
    double ofPeak = 0.0;  ///< worst |error| over the exponent's peak
    double local = 0.0;   ///< worst |error| over the value, where that is at least 1 % of the peak
    double atTheta = 0.0; ///< where ofPeak is
    double atExponent = 0.0;
};

inline RsrmError measure(const lighting::RsrmTexels& texels, const RsrmTruth& truth) {
    RsrmError worst;
    const std::vector<glm::vec3> black(2); // no exponent is above the last row
    for (std::size_t e = 0; e < truth.exponents.size(); ++e) {
        const double s = truth.exponents[e];
        const double* row = truth.values.data() + e * truth.thetas.size();
        const double peak = *std::max_element(row, row + truth.thetas.size());
        for (std::size_t i = 0; i < truth.thetas.size(); ++i) {
            const double got =
                static_cast<double>(lighting::rsrmRadiance(texels, black, truth.thetas[i], s).g);
            const double error = std::abs(got - row[i]);
            if (error > worst.ofPeak * peak) {
                worst.ofPeak = error / peak;
                worst.atTheta = truth.thetas[i] / kDegree;
                worst.atExponent = s;
            }
            if (row[i] >= 0.01 * peak) {
                worst.local = std::max(worst.local, error / row[i]);
            }
        }
    }
    return worst;
}

} // namespace lodestar::testing

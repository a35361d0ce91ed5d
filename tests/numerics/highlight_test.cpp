// SPDX-License-Identifier: MIT
//
// The highlight of a small round lamp at a cube's corner, where tent mips drew a three-armed star
// with a tail. In truth it is the same all around the lamp's axis.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "lighting/lookup.h"
#include "numerics/ladder_environments.h"

namespace lodestar::testing {

namespace {

using lighting::EstimatorKind;

constexpr int kWidth = 128;
constexpr int kRings = 12;
constexpr int kAzimuths = 24;

/// How a highlight differs from the truth, in shares of the true peak.
struct Highlight {
    double rms = 0.0;     ///< of the difference, over rings that cover the lobe
    double unround = 0.0; ///< the largest spread around one ring, highest less lowest
    double wrong = 0.0;   ///< the largest difference
};

double radiance(const lighting::PreparedEnvironment& environment, double exponent,
                const glm::dvec3& direction, EstimatorKind kind) {
    return lighting::lookup(environment, {lighting::Lobe::Phong, exponent, direction, {kind, 0.0f}})
        .radiance.x;
}

/// Rings about the axis to where the true lobe has fallen to a tenth, cos^s = 0.1.
Highlight measure(const lighting::PreparedEnvironment& environment, const glm::dvec3& axis,
                  double exponent) {
    const glm::dvec3 side = glm::normalize(glm::cross(axis, glm::dvec3(0.6, -0.8, 0.0)));
    const glm::dvec3 up = glm::cross(axis, side);
    const double widest = std::acos(std::pow(0.1, 1.0 / exponent));
    const double peak = radiance(environment, exponent, axis, EstimatorKind::Reference);
    Highlight result;
    double squares = 0.0;
    double area = 0.0;
    for (int ring = 0; ring < kRings; ++ring) {
        const double angle = widest * (ring + 0.5) / kRings;
        const auto at = [&](int i) {
            const double azimuth = 2.0 * std::numbers::pi * i / kAzimuths;
            return std::cos(angle) * axis +
                   std::sin(angle) * (std::cos(azimuth) * side + std::sin(azimuth) * up);
        };
        // The truth is the same all around: three azimuths' mean takes out the map's own texels.
        const double truth = (radiance(environment, exponent, at(0), EstimatorKind::Reference) +
                              radiance(environment, exponent, at(8), EstimatorKind::Reference) +
                              radiance(environment, exponent, at(16), EstimatorKind::Reference)) /
                             3.0;
        double low = INFINITY;
        double high = 0.0;
        for (int i = 0; i < kAzimuths; ++i) {
            const double value = radiance(environment, exponent, at(i), EstimatorKind::Tent);
            low = std::min(low, value);
            high = std::max(high, value);
            result.wrong = std::max(result.wrong, std::abs(value - truth) / peak);
            squares += std::sin(angle) * (value - truth) * (value - truth);
            area += std::sin(angle);
        }
        result.unround = std::max(result.unround, (high - low) / peak);
    }
    result.rms = std::sqrt(squares / area) / peak;
    return result;
}

/// Means over exponents 2 to 128, whose highlights tents alone got wrong, and the worst difference
/// at 256 and at 512, where the last tents pass into round levels.
struct Highlights {
    Highlight mean;
    double wrongAt256 = 0.0;
    double wrongAt512 = 0.0;
};

Highlights measure(const glm::dvec3& axis) {
    const auto environment =
        lighting::prepare(lampCube(axis, 5.0, kWidth), {false, true, false, false});
    const std::vector<double> exponents{2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0, 256.0, 512.0};
    Highlights all;
    double count = 0.0;
    for (const double exponent : exponents) {
        const Highlight h = measure(environment, axis, exponent);
        std::printf("axis %.2f s %3.0f: rms %.3f, spread around a ring %.3f, worst %.3f\n", axis.x,
                    exponent, h.rms, h.unround, h.wrong);
        if (exponent <= 128.0) {
            all.mean.rms += h.rms;
            all.mean.unround += h.unround;
            count += 1.0;
        } else {
            (exponent == 256.0 ? all.wrongAt256 : all.wrongAt512) = h.wrong;
        }
    }
    all.mean.rms /= count;
    all.mean.unround /= count;
    return all;
}

} // namespace

/// A face's centre, where texels are square, is the measure. About a corner three faces meet in
/// rhombi of 120 degrees, sqrt 3 times as long as wide: the spread around a ring may be so much
/// larger. The texels are smaller there than at a centre, so that the difference from the truth
/// must not be larger. Tents alone: spread 0.44 and 0.10 rms near a corner, 0.10 and 0.08 at a
/// centre, where round levels must not do worse. At 256 and 512 a corner's highlight is too dim by
/// 0.33 and 0.41 of its peak, as docs/estimators.md says to two digits.
TEST(Highlight, IsAsRoundAtACornerAsTexelsAllow) {
    const Highlight centre = measure(kCentreAxis).mean;
    EXPECT_LE(centre.unround, 0.10);
    EXPECT_LE(centre.rms, 0.08);
    for (const glm::dvec3& axis : {kCornerAxis, glm::normalize(glm::dvec3(1.0, 1.0, 1.0))}) {
        const Highlights corner = measure(axis);
        EXPECT_LE(corner.mean.unround, std::sqrt(3.0) * centre.unround) << axis.x;
        EXPECT_LE(corner.mean.rms, centre.rms) << axis.x;
        EXPECT_LE(corner.wrongAt256, 0.335) << axis.x;
        EXPECT_LE(corner.wrongAt512, 0.415) << axis.x;
    }
}

} // namespace lodestar::testing

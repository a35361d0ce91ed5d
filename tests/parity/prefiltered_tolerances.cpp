// SPDX-License-Identifier: MIT
#include "parity/prefiltered_tolerances.h"

#include <algorithm>
#include <cmath>

#define LODESTAR_DOUBLE_PRECISION
#include "lodestar/cube.glsl"

#include "parity/tolerances.h"

namespace lodestar::testing {
namespace {

constexpr double u = 0x1p-23;

/// Of a level's exponent plus 1, relative: exp2 by 3 + 2 level units and a product, squared; two
/// products.
double levelExponentError(double level) {
    return (2.0 * (3.0 + 2.0 * level + 1.0) + 2.0) * u;
}

/// The fraction between two levels, as in the text.
double fraction(double q, double r) {
    return r * (q - 1.0) * (q + r + 2.0) / ((r - 1.0) * (q + r) * (q + 1.0));
}

double log2Error(double x) {
    return x >= 0.5 && x <= 2.0 ? 0x1p-21 : 3.0 * u * std::abs(std::log2(x));
}

} // namespace

double prefilteredLevelError(double exponent, double width, double maxLevel, double off) {
    const double level = shader_double::lodestar_prefilteredLevel(exponent, width, maxLevel);
    // Where the level below is told wrongly, the level is continuous: as if the exponent were off.
    const double own = std::abs(std::log2(width)) + 1.21 + 0.5 * std::log2(exponent + 1.0);
    const double strayed =
        off + 2.0 * std::log(2.0) *
                  (log2Error(width) + 0.5 * log2Error(exponent + 1.0) + 2.0 * u + 2.0 * u * own);
    double worst = 0.0;
    for (const double sign : {-1.0, 1.0}) {
        const double other = (exponent + 1.0) * (1.0 + sign * strayed) - 1.0;
        worst = std::max(worst, std::abs(shader_double::lodestar_prefilteredLevel(
                                             std::max(other, 0.0), width, maxLevel) -
                                         level));
    }
    // q and r: spreads are 1 / (exponent + 2) by 5 units beside the exponents' own; q and r are the
    // quotient of two.
    const double below = std::clamp(std::floor(level), 0.0, std::max(maxLevel - 1.0, 0.0));
    const double fine =
        below > 0.0 ? 1.0 / (shader_double::lodestar_prefilteredExponent(below, width) + 2.0)
                    : 2.0 / (3.0 * width * width);
    const double r = std::max(
        1.0 / ((shader_double::lodestar_prefilteredExponent(below + 1.0, width) + 2.0) * fine),
        1.0);
    const double q = std::clamp(1.0 / ((exponent + 2.0) * fine), 1.0, r);
    const double offQ = levelExponentError(below) + 8.0 * u;
    const double offR = levelExponentError(below) + levelExponentError(below + 1.0) + 11.0 * u;
    if (r * (1.0 - offR) <= 1.0) {
        return 1.0; // two levels alike, either of which is right
    }
    double within = 0.0;
    for (const double signQ : {-1.0, 1.0}) {
        for (const double signR : {-1.0, 1.0}) {
            const double otherR = r * (1.0 + signR * offR);
            const double otherQ = std::clamp(q * (1.0 + signQ * offQ), 1.0, otherR);
            within = std::max(within, std::abs(fraction(otherQ, otherR) - fraction(q, r)));
        }
    }
    // Ten operations of the fraction, a quotient among them, and the sum. q - 1 and r - 1 are
    // exact.
    return worst + within + 13.0 * u + level * u;
}

Tolerance prefilteredExponentTolerance(const GlslCase& p, const glm::dvec4& v, int) {
    const double tolerance =
        (v.x + 1.0) * levelExponentError(std::abs(static_cast<double>(p[0].z))) + u * v.x;
    return {tolerance, 0.0, 0.0, 0.0};
}

Tolerance prefilteredLevelTolerance(const GlslCase& p, const glm::dvec4&, int) {
    const double s = shader_double::lodestar_repairExponent(static_cast<double>(p[0].x));
    return {prefilteredLevelError(s, static_cast<double>(p[0].y), static_cast<double>(p[0].z), 0.0),
            0.0, 0.0, 0.0};
}

Tolerance specularPrefilteredTolerance(const GlslCase& p, const glm::dvec4&, int) {
    const double s = shader_double::lodestar_repairExponent(static_cast<double>(p[1].w));
    return {2.0 * u, 2.0 * u,
            prefilteredLevelError(s, static_cast<double>(p[0].x), static_cast<double>(p[0].y), 0.0),
            0.0};
}

} // namespace lodestar::testing

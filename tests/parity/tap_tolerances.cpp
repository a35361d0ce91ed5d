// SPDX-License-Identifier: MIT
#include "parity/tap_tolerances.h"

#include <algorithm>
#include <cmath>

#define LODESTAR_DOUBLE_PRECISION
#include "lodestar/power.glsl"

#include "parity/tolerances.h"

namespace lodestar::testing {
namespace {

constexpr double u = 0x1p-23;

/// The series is off by 10 roundings of itself; 1 - exp(-x) by exp's 3 + 2 x units and one more.
double oneMinusExpError(double x) {
    return std::max(10.0 * -std::expm1(-x), (3.0 + 2.0 * x) * std::exp(-x) + 1.0) * u;
}

/// The exponent plus 1 of a tap, relative: three products, exp2 of y with three roundings and a
/// quotient of y.
double ownExponentError(double y) {
    return (3.0 + std::log(2.0) * 6.0 * std::abs(y) + 3.0 + 2.0 * std::abs(y)) * u;
}

/// Where a tap lies, sine and cosine together. The fall from the axis is off by 7 units of itself,
/// so that x = 2 fall moves 1 - exp(-x) by at most 7 units of itself.
double directionError(double fall) {
    const double square = -std::expm1(-2.0 * fall);
    const double sine =
        square > 0.0
            ? 0.5 * (7.0 * u * square + oneMinusExpError(2.0 * fall)) / std::sqrt(square) + 3.0 * u
            : 0.0;
    const double cosine = 7.0 * u * -std::expm1(-fall) + oneMinusExpError(fall) + u;
    return sine + cosine + 8.0 * u; // two products each, a cross product, three sums
}

} // namespace

Tolerance oneMinusExpTolerance(const GlslCase& p, const glm::dvec4&, int) {
    const double x = static_cast<double>(p[0].x);
    return {oneMinusExpError(x) + 1.2e-38, 0.0, 0.0, 0.0};
}

Tolerance lobeTapTolerance(const GlslCase& p, const glm::dvec4& v, int) {
    const double s = static_cast<double>(p[1].w) + 1.0;
    const double logShare = static_cast<double>(p[2].z);
    const double direction =
        directionError(-std::log(2.0) * logShare / (static_cast<double>(p[3].x) * s));
    const double y = static_cast<double>(p[3].z) * logShare * (s - 1.0) / s;
    return {direction, direction, direction, (v.w + 1.0) * ownExponentError(y) + u * v.w};
}

TapErrors tapErrors(const glm::dvec3& d, double exponent, int count, double width, double levels,
                    double off, double strayed) {
    const double s = exponent + 1.0;
    const bool spiral = count > 7;
    // The frame turns twice about -Y: it moves by 2 / sine of the angle from there, and by 2
    // elsewhere. Its own roundings are 20.
    const double pole = d.y < 0.0 ? std::max(std::hypot(d.x, d.z), 1e-3) : 1.0;
    const double frame = 20.0 * u + (2.0 + 2.0 / pole) * off;
    // An azimuth is turned by two products and a sum of rounded constants: 3 units a turn.
    const double turned = 3.0 * u * count;
    // log2 of a share may be off by four units: of the share nearest to 1, at 1 / (2 count) from
    // it, where the sine is 1 / sqrt(count reach s). A lobe that has strayed moves a sine by half
    // of it.
    const double share = spiral ? 4.0 * u * std::log(2.0) * std::sqrt(count / s) : 0.0;
    TapErrors errors;
    errors.direction = off + frame + turned + share + 0.5 * strayed + 62.0 * u + count * u;
    // The level moves by at most 4 with the direction, through the texel's size; by half of the
    // logarithm of the exponent, whose own error has |y| <= 0.6 log2(2 count); tentLevel's
    // logarithms are of numbers up to 1e7 and the width, its sums of numbers up to 18; the mean
    // adds as many roundings of the last level as there are taps.
    const double y = spiral ? 0.6 * std::log2(2.0 * count) : 0.0;
    const double logarithms = 3.0 * u * (24.0 + std::log2(2.0 * width)) + 3.0 * 0x1p-21 + 8.0 * u;
    errors.level = 4.0 * errors.direction + 0.73 * (strayed + ownExponentError(y) + 3.0 * u) +
                   logarithms + 7.0 * 18.0 * u + (count + 3.0) * u * levels;
    return errors;
}

namespace {

Tolerance meanOfTaps(const GlslCase& p, int count) {
    const double s = shader_double::lodestar_repairExponent(static_cast<double>(p[1].w));
    const TapErrors errors = tapErrors(glm::dvec3(p[1]), s, count, static_cast<double>(p[0].x),
                                       static_cast<double>(p[0].y), 0.0, 0.0);
    // Red is x + y / 4.
    return {1.25 * errors.direction + 2.0 * u, errors.direction + 2.0 * u, errors.level, 0.0};
}

} // namespace

Tolerance specularRingTolerance(const GlslCase& p, const glm::dvec4&, int) {
    return meanOfTaps(p, p[0].y > 6.0f ? 7 : (p[0].y > 5.0f ? 2 : 3));
}

Tolerance specularOfTentsTolerance(const GlslCase& p, const glm::dvec4& v, int specular) {
    return specular > 3 && specular < 7 ? meanOfTaps(p, specular == 4   ? 3
                                                        : specular == 5 ? 7
                                                                        : 16)
                                        : specularTentTolerance(p, v, specular);
}

Tolerance specularTapsTolerance(const GlslCase& p, const glm::dvec4&, int) {
    return meanOfTaps(p, 16);
}

} // namespace lodestar::testing

// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "parity/tolerances.h"

#define LODESTAR_DOUBLE_PRECISION
#include "lodestar/rsrm.glsl"

namespace lodestar::testing {
namespace {

constexpr double u = 0x1p-23;

double log2Error(double x) {
    return x >= 0.5 && x <= 2.0 ? 0x1p-21 : 3.0 * u * std::abs(std::log2(x));
}

/// z = 1 - 2 h^2 by u (two products of at most 2, a difference) and by 4 h of h's own error dh; its
/// root by that over 2 sqrt |z|, near 0 by the root of it, on either side of 0; sqrt(h) by 4.5 u
/// and dh / (2 sqrt h); products and sums of numbers up to 1.
double refinedColumnError(double h, double dh) {
    const double z = std::abs(1.0 - 2.0 * h * h);
    const double dz = 2.0 * u + 4.0 * h * dh;
    const double root = z > 4.0 * dz ? dz / std::sqrt(z) : 2.0 * std::sqrt(5.0 * dz);
    const double first = h > 0.0 ? 4.5 * u * std::sqrt(h) + 0.5 * dh / std::sqrt(h) : 0.0;
    return 0.5 * first + 0.25 * (root + 4.5 * u * std::sqrt(z)) + 2.0 * u * std::sqrt(h) +
           (z < 1.0 ? 2.0 * u : 0.0);
}

double columnError(double layout, double h, double dh, double columns) {
    if (layout > 0.5) {
        return columns * (2.0 * h * dh + 1.5 * u * h * h) + u * std::abs(columns * h * h - 0.5);
    }
    return (columns - 1.0) *
           (refinedColumnError(h, dh) + u * shader_double::lodestar_rsrmRefinedColumn(h));
}

/// The argument by u of itself, a difference, two products; a share added to a row of at most
/// `rows`.
double rowError(const GlslCase& p) {
    const double shift = 1.0 - static_cast<double>(p[1].w);
    const double s = shader_double::lodestar_repairExponent(static_cast<double>(p[0].w));
    const double argument =
        std::clamp(s, static_cast<double>(p[2].z), static_cast<double>(p[2].w)) + shift;
    const double octave = std::log2(argument) - static_cast<double>(p[5].y);
    return static_cast<double>(p[5].z) *
               (log2Error(argument) + u / std::log(2.0) + 3.0 * u * std::abs(octave)) +
           u * static_cast<double>(p[2].y);
}

/// y = (s - s1) c by 2 u of itself, exp2 by 3 + 2 |y|, a difference.
double shareError(double s, double greatest) {
    if (!(s > greatest)) {
        return 0.0;
    }
    const double y = (s - greatest) * 1.60186e-5;
    return std::exp2(-y) * ((3.0 + 2.0 * y) * u + std::log(2.0) * y * 2.0 * u) + u;
}

} // namespace

Tolerance rsrmRefinedColumnTolerance(const GlslCase& p, const glm::dvec4&, int) {
    return {refinedColumnError(static_cast<double>(p[3].w), 0.0), 0.0, 0.0, 0.0};
}

Tolerance rsrmColumnTolerance(const GlslCase& p, const glm::dvec4&, int) {
    return {columnError(static_cast<double>(p[1].w), static_cast<double>(p[3].w), 0.0,
                        static_cast<double>(p[2].x)),
            0.0, 0.0, 0.0};
}

Tolerance rsrmRowTolerance(const GlslCase& p, const glm::dvec4&, int) {
    const double s = shader_double::lodestar_repairExponent(static_cast<double>(p[0].w));
    const double mirror = p[1].w > 0.5f ? 0.0 : shareError(s, static_cast<double>(p[2].w));
    return {rowError(p) + mirror, 0.0, 0.0, 0.0};
}

// s + 1 by u of itself and its logarithm, over the step from row to row, of which at a row the one
// below may be meant; differences and a quotient in [0, 1] by 5 u; two sums of at most `rows`.
Tolerance rsrmOwnRowTolerance(const GlslCase& p, const glm::dvec4& v, int) {
    const double s = shader_double::lodestar_repairExponent(static_cast<double>(p[0].w));
    const double argument =
        std::clamp(s, static_cast<double>(p[2].z), static_cast<double>(p[2].w)) + 1.0;
    const double below = std::max(std::floor(v.x) - 1.0, 0.0);
    const double step = 0.25 + (2.0 * below + 1.0) / 128.0; // of rsrm_helpers.glsl's octaves
    const double octave = log2Error(argument) + u / std::log(2.0);
    return {octave / step + 5.0 * u + 2.0 * u * static_cast<double>(p[2].y) +
                shareError(s, static_cast<double>(p[2].w)),
            0.0, 0.0, 0.0};
}

Tolerance rsrmMirrorShareTolerance(const GlslCase& p, const glm::dvec4&, int) {
    return {shareError(static_cast<double>(p[5].x), static_cast<double>(p[2].w)), 0.0, 0.0, 0.0};
}

namespace {

// The hook answers column, row and layer 3; refined maps square them, with 2 products, and mix with
// the gradient's answer, 100 u2, 50 and 3, by the share: 1 - t, two products and a sum of each.
Tolerance lookupError(const GlslCase& p, const glm::dvec4& v, double h, double dh) {
    const double layout = static_cast<double>(p[1].w);
    const double columns = static_cast<double>(p[2].x);
    const double last = static_cast<double>(p[2].y) - 1.0;
    const double dc = columnError(layout, h, dh, columns);
    const double dr = rowError(p);
    if (layout > 0.5) {
        return {dc + u * v.x, dr + u * v.y, 3.0 * u, 0.0};
    }
    const double column = shader_double::lodestar_rsrmColumn(0, h, columns);
    const double u2 = shader_double::lodestar_rsrmRefinedColumn(h);
    const double s = shader_double::lodestar_repairExponent(static_cast<double>(p[0].w));
    const double dShare =
        s > static_cast<double>(p[2].w) ? shareError(s, static_cast<double>(p[2].w)) + dr : 0.0;
    const auto mixed = [&](double filtered, double dFiltered, double gradient, double dGradient) {
        return dFiltered + dGradient + dShare * std::abs(gradient - filtered) +
               6.0 * u * std::max(filtered, gradient);
    };
    return {mixed(column * column, 2.0 * column * dc + dc * dc, 100.0 * u2,
                  100.0 * refinedColumnError(h, dh)),
            mixed(last * last, 2.0 * last * dr + dr * dr, 50.0, 0.0), mixed(9.0, 0.0, 3.0, 0.0),
            0.0};
}

} // namespace

Tolerance rsrmAtTolerance(const GlslCase& p, const glm::dvec4& v, int) {
    return lookupError(p, v, static_cast<double>(p[3].w), 0.0);
}

Tolerance rsrmTolerance(const GlslCase& p, const glm::dvec4& v, int) {
    const double h = shader_double::lodestar_rsrmHalfChord(glm::dvec3(p[0]), glm::dvec3(p[1]));
    return lookupError(p, v, h, 8.0 * u * h);
}

// A dot product of unit vectors by 3 u, halved; a difference from 1/2, another from 1.
Tolerance rsrmLambertTolerance(const GlslCase&, const glm::dvec4&, int) {
    return {3.0 * u, 4.0 * u, 0.0, 0.0};
}

// The hook answers 100 u2, 50 and 3.
Tolerance rsrmGradientTolerance(const GlslCase& p, const glm::dvec4& v, int) {
    const double h = shader_double::lodestar_rsrmHalfChord(glm::dvec3(p[0]), glm::dvec3(p[1]));
    return {100.0 * refinedColumnError(h, 8.0 * u * h) + u * v.x, 0.0, 0.0, 0.0};
}

} // namespace lodestar::testing

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

/// Both arguments by 3.5 u of themselves (two sums, a division); a quotient and two products.
double rowError(double s, double rows, double least, double greatest, double shift) {
    const double argument = (std::clamp(s, least, greatest) + shift) / (least + shift);
    const double whole = std::log2((greatest + shift) / (least + shift));
    const double part = std::log2(argument);
    const double each = 3.5 * u / std::log(2.0);
    const double numerator = part > 0.0 ? log2Error(argument) + each : 0.0;
    const double denominator = log2Error((greatest + shift) / (least + shift)) + each;
    return (rows - 1.0) *
           (numerator / whole + part / (whole * whole) * denominator + 4.0 * u * part / whole);
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
    return {rowError(static_cast<double>(p[5].x), static_cast<double>(p[2].y),
                     static_cast<double>(p[2].z), static_cast<double>(p[2].w),
                     static_cast<double>(1.0f - p[1].w)),
            0.0, 0.0, 0.0};
}

// mix of two logarithms: 1 - t, two products and a sum, 2 u of each; exp2 by 3 + 2 |y|.
Tolerance rsrmRowScaleTolerance(const GlslCase& p, const glm::dvec4& v, int) {
    const double sum =
        std::abs(static_cast<double>(p[3].x)) + std::abs(static_cast<double>(p[3].y));
    return {v.x * (std::log(2.0) * 2.0 * u * sum + (3.0 + 2.0 * sum) * u), 0.0, 0.0, 0.0};
}

Tolerance rsrmMirrorShareTolerance(const GlslCase& p, const glm::dvec4&, int) {
    return {shareError(static_cast<double>(p[5].x), static_cast<double>(p[2].w)), 0.0, 0.0, 0.0};
}

// The hook answers column, row and layer 3; refined maps square them, with 2 products, and mix with
// the row past the last by the share.
Tolerance rsrmTolerance(const GlslCase& p, const glm::dvec4& v, int) {
    const double layout = static_cast<double>(p[1].w);
    const double columns = static_cast<double>(p[2].x);
    const double rows = static_cast<double>(p[2].y);
    const double least = static_cast<double>(p[2].z);
    const double greatest = static_cast<double>(p[2].w);
    const double s = shader_double::lodestar_repairExponent(static_cast<double>(p[0].w));
    const double h = shader_double::lodestar_rsrmHalfChord(glm::dvec3(p[0]), glm::dvec3(p[1]));
    const double dc = columnError(layout, h, 8.0 * u * h, columns);
    const double dr = rowError(s, rows, least, greatest, 1.0 - layout);
    if (layout > 0.5) {
        return {dc + u * v.x, dr + u * v.y, 3.0 * u, 0.0};
    }
    const double column = shader_double::lodestar_rsrmColumn(0, h, columns);
    const double row = shader_double::lodestar_rsrmRow(s, rows, least, greatest, 1.0);
    const double share = shareError(s, greatest);
    return {2.0 * column * dc + dc * dc + 5.0 * u * column * column,
            2.0 * row * dr + dr * dr + 5.0 * u * rows * rows + share * rows * rows, 5.0 * 9.0 * u,
            0.0};
}

// The same without rows between: the hook answers column, rows and 3, squared with 2 products.
Tolerance rsrmGradientTolerance(const GlslCase& p, const glm::dvec4&, int) {
    const double columns = static_cast<double>(p[2].x);
    const double rows = static_cast<double>(p[2].y);
    const double h = shader_double::lodestar_rsrmHalfChord(glm::dvec3(p[0]), glm::dvec3(p[1]));
    const double dc = columnError(0.0, h, 8.0 * u * h, columns);
    const double column = shader_double::lodestar_rsrmColumn(0, h, columns);
    return {2.0 * column * dc + dc * dc + 2.0 * u * column * column, 2.0 * u * rows * rows,
            2.0 * 9.0 * u, 0.0};
}

} // namespace lodestar::testing

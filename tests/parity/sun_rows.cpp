// SPDX-License-Identifier: MIT
//
// Inputs and bounds of the rows of lodestar/sun.glsl and of what it is made of.
#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "parity/cases.h"
#include "parity/draw.h"
#include "parity/tolerances.h"

#define LODESTAR_DOUBLE_PRECISION
#include "lodestar/sun.glsl"

namespace lodestar::testing {
namespace {

constexpr double u = 0x1p-23;
constexpr double kLog2 = 0.6931471805599453;

double log2Error(double x) {
    return x >= 0.5 && x <= 2.0 ? 0x1p-21 : 3.0 * u * std::abs(std::log2(x));
}

/// The series adds 8 roundings; the logarithm log2Error and a rounding of 1 - d.
double logCosineError(double d, double dd) {
    const double own =
        d < 0.01 ? 8.0 * u * std::abs(std::log1p(-d)) : kLog2 * log2Error(1.0 - d) + u / (1.0 - d);
    return own + dd / (1.0 - d);
}

/// All terms are positive: 16 roundings, exp2's (3 + s) 2^(-s/2) <= 4.1 u beside a sum of 1/2 at
/// least, and what an error of n.v changes.
double gatheredError(double s, double c, double dc) {
    const auto at = [&](double x) { return shader_double::lodestar_blinnPhongGathered(s, x); };
    return 25.0 * u * at(c) + std::abs(at(c + dc) - at(c - dc));
}

struct Sun {
    glm::dvec3 n, v, axis, direction;
    double s, round, spread;
    explicit Sun(const GlslCase& p)
        : n(p[0]), v(p[1]), axis(p[2]), direction(p[3]),
          s(shader_double::lodestar_repairExponent(static_cast<double>(p[0].w))),
          round(static_cast<double>(p[3].w)), spread(static_cast<double>(p[2].w)) {}
};

/// Of the density's log2. v + l rounds by 2 u over its length, its normalisation by 5 u, the chord
/// by u, squares 4 u; the scale by 6 u and what is gathered; dot products of unit vectors by 4 u.
double logDensityError(const Sun& sun) {
    const double nDotL = glm::dot(sun.n, sun.axis);
    if (nDotL <= 0.0) {
        return 0.0;
    }
    const double length = glm::length(sun.v + sun.axis);
    const glm::dvec3 chord = sun.n - (sun.v + sun.axis) / length;
    const double d = 0.5 * glm::dot(chord, chord);
    const double dh = 2.0 * u / length + 6.0 * u;
    const double dd = (glm::length(chord) + dh) * dh + 4.0 * u * d;
    const double c = glm::dot(sun.n, sun.v);
    const double gathered = shader_double::lodestar_blinnPhongGathered(sun.s, c);
    const double density = 0.25 * (sun.s + 2.0) * (sun.s + 4.0) * nDotL / gathered;
    const double scaleError = 10.0 * u + gatheredError(sun.s, c, 4.0 * u) / gathered -
                              std::log1p(-std::min(4.0 * u / nDotL, 0.999));
    const double powers = sun.s * (logCosineError(d, dd) + 3.0 * u * std::abs(std::log1p(-d)));
    return (powers + scaleError) / kLog2 + log2Error(density) + u * std::abs(std::log2(density)) +
           100.0 * u;
}

} // namespace

std::vector<GlslCase> logChordCases() {
    std::vector<GlslCase> cases;
    DrawnDirections draw(41u);
    for (const float d : {0.0f, 1e-30f, 1e-7f, 0.00999f, 0.01f, 0.0101f, 0.5f, 0.999f}) {
        cases.push_back({glm::vec4(d, 0.0f, 0.0f, 0.0f)});
    }
    for (int i = 0; i < 200; ++i) {
        cases.push_back({glm::vec4(draw.logarithmic(1e-9f, 0.999f), 0.0f, 0.0f, 0.0f)});
    }
    return cases;
}

Tolerance logChordTolerance(const GlslCase& p, const glm::dvec4&, int) {
    return {logCosineError(static_cast<double>(p[0].x), 0.0) + 1.2e-38, 0.0, 0.0, 0.0};
}

Tolerance gatheredTolerance(const GlslCase& p, const glm::dvec4&, int) {
    const double s = shader_double::lodestar_repairExponent(static_cast<double>(p[0].x));
    return {gatheredError(s, static_cast<double>(p[0].y), 0.0), 0.0, 0.0, 0.0};
}

// The divisor by 3 u of itself and exp2's error beside a sum of 1 at least, the quotient 2.5 u.
Tolerance albedoTolerance(const GlslCase& p, const glm::dvec4& v, int) {
    const double s = shader_double::lodestar_repairExponent(static_cast<double>(p[0].x));
    const double whole = s + std::exp2(-0.5 * s);
    return {gatheredError(s, static_cast<double>(p[0].y), 0.0) / whole + 12.0 * u * v.x, 0.0, 0.0,
            0.0};
}

// The axis stands above the horizon by 1e-3 at least, or below it: at it the driver may choose.
std::vector<GlslCase> sunCases() {
    constexpr std::array<float, 9> kExponents{0.0f, 1e-3f, 1.0f,  8.0f, 256.0f,
                                              1e4f, 1e7f,  -2.0f, 3e38f};
    std::vector<GlslCase> cases;
    DrawnDirections draw(42u);
    while (cases.size() < 400) {
        const std::size_t i = cases.size();
        const glm::vec3 n = draw.unit();
        glm::vec3 v = draw.unit();
        v = glm::dot(n, v) < 0.0f ? -v : v;
        const float s = i < 5 * kExponents.size() ? kExponents[i % kExponents.size()]
                                                  : draw.logarithmic(1e-2f, 1e7f);
        const glm::vec3 r = 2.0f * glm::dot(n, v) * n - v;
        const glm::vec3 axis =
            i % 4 == 0 ? draw.unit()
                       : glm::normalize(r + draw.logarithmic(1e-4f, 1.0f) * draw.unit());
        if (std::abs(glm::dot(n, axis)) < 1e-3f || glm::dot(n, v) < 1e-3f) {
            continue;
        }
        const float nDotV = glm::dot(n, v);
        GlslCase inputs{};
        inputs[0] = glm::vec4(n, s);
        inputs[1] = glm::vec4(v, 0.0f);
        inputs[2] = glm::vec4(axis, i % 7 == 0 ? 0.0f : draw.logarithmic(1e-7f, 4.0f));
        const auto blend = static_cast<float>(shader_double::lodestar_lookupBlend(
            static_cast<double>(s), static_cast<double>(nDotV)));
        inputs[3] = glm::vec4(glm::normalize(n + blend * (r - n)),
                              static_cast<float>(shader_double::lodestar_lookupExponent(
                                  static_cast<double>(s), static_cast<double>(nDotV))));
        cases.push_back(inputs);
    }
    return cases;
}

Tolerance logDensityTolerance(const GlslCase& p, const glm::dvec4&, int) {
    return {logDensityError(Sun(p)), 0.0, 0.0, 0.0};
}

// First-order steps through the function, each with its own roundings.
Tolerance sunLookupTolerance(const GlslCase& p, const glm::dvec4& v, int) {
    const Sun sun(p);
    const double density = shader_double::lodestar_blinnPhongLogDensity(
        sun.n, sun.v, sun.axis, static_cast<double>(p[0].w));
    const double dDensity = logDensityError(sun);
    const double sharp = v.y;
    const double least = std::log2(sun.round + 1.0);
    const double dLeast = log2Error(sun.round + 1.0) + u / kLog2;
    // 2^24 by its argument's error and 3 + 2 |y| units, unless the round lobe is the sharper.
    const bool byDensity = density + dDensity > least - dLeast;
    const double dSharp =
        byDensity ? (std::expm1(kLog2 * (dDensity + dLeast)) + 53.0 * u) * (sharp + 1.0) / sharp
                  : 0.0;
    const double fall = std::max(least - density, 0.0);
    const double dFall = dDensity + dLeast + u * (least + std::abs(density));
    const double x = kLog2 * fall / sharp;
    const double narrow = -std::expm1(-x);
    const double dNarrow =
        std::exp(-x) * (kLog2 * dFall / sharp + x * (dSharp + 3.0 * u)) + 10.0 * u * narrow;
    const glm::dvec3 chord = sun.direction - sun.axis;
    const double wide = 0.5 * glm::dot(chord, chord);
    const double width = std::max(0.5 * sun.spread * sharp, 1e-12);
    const double share = width / (width + std::exp2(-0.5 * std::min(fall, 35.0)));
    const double dShare =
        share * (1.0 - share) * (dSharp + 5.0 * u + 0.5 * kLog2 * dFall + (3.0 + fall) * u) +
        3.0 * u * share;
    const double mixed = narrow + share * (wide - narrow);
    const double dMixed = (1.0 - share) * dNarrow + share * 5.0 * u * wide +
                          dShare * std::abs(wide - narrow) + 3.0 * u * std::max(narrow, wide);
    const double dHalf =
        std::max(std::sqrt(0.5 * (mixed + dMixed)) - std::sqrt(0.5 * mixed),
                 std::sqrt(0.5 * mixed) - std::sqrt(0.5 * std::max(mixed - dMixed, 0.0)));
    return {dHalf + 4.0 * u * v.x, dSharp * sharp + 2.0 * u * sharp, 0.0, 0.0};
}

} // namespace lodestar::testing

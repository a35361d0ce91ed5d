// SPDX-License-Identifier: MIT
//
// Inputs and bounds of the rows of lodestar/sg.glsl.
#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "parity/cases.h"
#include "parity/draw.h"
#include "parity/tolerances.h"

#define LODESTAR_DOUBLE_PRECISION
#include "lodestar/sg.glsl"

namespace lodestar::testing {
namespace {

constexpr double u = 0x1p-23;
/// Below this a driver may flush a number to zero.
constexpr double kTiny = 1.2e-38;

/// e^-y where y is off by dy.
double decayError(double value, double y, double dy) {
    return value * (std::expm1(std::min(dy, 600.0)) + (3.0 + 2.0 * std::abs(y)) * u) + kTiny;
}

/// The series has three roundings and a constant of one; 1 - e^-2l is off as oneMinusExp, then
/// three products and a quotient.
double integralError(double sharpness) {
    const double l = std::max(sharpness, 0.0);
    const double value = shader_double::lodestar_sgIntegral(l);
    if (l < 0.0011) {
        return 5.0 * u * value;
    }
    const double share = -std::expm1(-2.0 * l);
    const double shareError =
        std::max(10.0 * share, (3.0 + 4.0 * l) * std::exp(-2.0 * l) + 1.0) * u;
    return value * (shareError / share + 5.0 * u) + kTiny;
}

struct ProductErrors {
    double sharpness, amplitude, axis;
};

/// Squares of sum and chord by 4 u, products 1 u; the first square by 2 u and the difference's
/// rounding: at most 6 u under the root, which halves it and adds 4.5 u. The exponent: 4 u, two
/// products, the sum with the sharpness, a quotient.
ProductErrors productErrors(const GlslCase& p) {
    const glm::dvec3 a(p[0]), b(p[1]);
    const double la = shader_double::lodestar_repairExponent(static_cast<double>(p[0].w));
    const double lb = shader_double::lodestar_repairExponent(static_cast<double>(p[1].w));
    const shader_double::LodestarSg exact = shader_double::lodestar_sgProduct(a, la, b, lb);
    const double y = exact.amplitude > 0.0 ? -std::log(exact.amplitude) : 745.0;
    // la a + lb b rounds by 1.5 u of its terms, of whatever is left of them.
    const double left = glm::length(la * a + lb * b);
    return {8.0 * u * exact.sharpness + kTiny, decayError(exact.amplitude, y, 17.0 * u * y),
            std::min(3.0 * u * (la + lb) / std::max(left, kTiny) + 5.0 * u, 2.0)};
}

} // namespace

std::vector<GlslCase> sgCases() {
    constexpr int kDrawn = 300;
    constexpr std::array<float, 12> kSharpness{0.0f,  1e-8f, 1e-3f, 0.00099f, 0.05f, 1.0f,
                                               90.0f, 1e4f,  1e7f,  1e30f,    -3.0f, 3e38f};
    std::vector<GlslCase> cases;
    DrawnDirections draw(31u);
    for (std::size_t i = 0; i < kDrawn; ++i) {
        GlslCase inputs{};
        const glm::vec3 a = draw.unit();
        const glm::vec3 b = i % 3 == 0
                                ? draw.unit()
                                : glm::normalize(a + draw.logarithmic(1e-5f, 1.0f) * draw.unit());
        const float first = i < 12 * 12 ? kSharpness[i / 12] : draw.logarithmic(1e-4f, 1e7f);
        const float second = i < 12 * 12 ? kSharpness[i % 12] : draw.logarithmic(1e-4f, 1e7f);
        inputs[0] = glm::vec4(a, first);
        inputs[1] = glm::vec4(i % 11 == 0 ? -a : (i % 13 == 0 ? a : b), second);
        inputs[2] = glm::vec4(i % 2 == 0 ? draw.logarithmic(1e-9f, 2.0f) : 0.0f,
                              draw.logarithmic(1e-2f, 1e7f), 0.0f, 0.0f);
        cases.push_back(inputs);
    }
    return cases;
}

Tolerance sgTolerance(const GlslCase& p, const glm::dvec4& v, int) {
    const double y = std::max(static_cast<double>(p[0].w) * static_cast<double>(p[2].x), 0.0);
    return {decayError(v.x, y, u * y), 0.0, 0.0, 0.0};
}

// The chord's components by u/2 of themselves, squares and sums 3 u, the product half.
Tolerance sgBetweenTolerance(const GlslCase& p, const glm::dvec4& v, int) {
    const glm::dvec3 chord = glm::dvec3(p[0]) - glm::dvec3(p[1]);
    const double y = std::max(static_cast<double>(p[0].w) * 0.5 * glm::dot(chord, chord), 0.0);
    return {decayError(v.x, y, 5.0 * u * y), 0.0, 0.0, 0.0};
}

Tolerance sgIntegralTolerance(const GlslCase& p, const glm::dvec4&, int) {
    return {integralError(static_cast<double>(p[0].w)), 0.0, 0.0, 0.0};
}

Tolerance vonMisesFisherTolerance(const GlslCase& p, const glm::dvec4& v, int) {
    const double k = shader_double::lodestar_repairExponent(static_cast<double>(p[0].w));
    const double y = k * static_cast<double>(p[2].x);
    const double whole = shader_double::lodestar_sgIntegral(k);
    const double lobe = v.x * whole;
    return {decayError(lobe, y, u * y) / whole + v.x * (integralError(k) / whole + 2.5 * u) +
                kTiny / whole,
            0.0, 0.0, 0.0};
}

Tolerance sgProductTolerance(const GlslCase& p, const glm::dvec4&, int) {
    const ProductErrors errors = productErrors(p);
    return {errors.sharpness, errors.amplitude, errors.axis, errors.axis};
}

// The integral falls no faster than 1 / sharpness.
Tolerance sgProductIntegralTolerance(const GlslCase& p, const glm::dvec4& v, int) {
    const ProductErrors errors = productErrors(p);
    const shader_double::LodestarSg exact =
        shader_double::lodestar_sgProduct(glm::dvec3(p[0]), static_cast<double>(p[0].w),
                                          glm::dvec3(p[1]), static_cast<double>(p[1].w));
    const double whole = shader_double::lodestar_sgIntegral(exact.sharpness);
    return {errors.amplitude * whole + v.x * (integralError(exact.sharpness) / whole + 9.0 * u) +
                kTiny,
            0.0, 0.0, 0.0};
}

} // namespace lodestar::testing

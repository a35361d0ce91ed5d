// SPDX-License-Identifier: MIT
#include "lighting/cube_rows.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#define LODESTAR_DOUBLE_PRECISION
#include "lodestar/cube.glsl"

namespace lodestar::lighting {

namespace {

/// Texels whose place t has (c + a t)^2 > q (b + t^2): between two roots where a^2 < q; elsewhere,
/// and where the roots lose their digits, all.
TexelRange between(double c, double a, double q, double b, std::size_t width) {
    constexpr double kLeastCurvature = 1e-3;
    constexpr double kRounding = 1e-12;
    const double curvature = q - a * a;
    if (curvature < kLeastCurvature) {
        return {0, width};
    }
    const double middle = c * a / curvature;
    const double squared = middle * middle + (c * c - q * b) / curvature;
    if (squared < -kRounding / curvature) {
        return {0, 0};
    }
    const double reach = std::sqrt(std::max(squared, 0.0));
    const auto texels = static_cast<double>(width);
    const auto texel = [&](double t) { return std::clamp((t + 1.0) * 0.5 * texels, 0.0, texels); };
    const double begin = std::floor(texel(middle - reach)) - 1.0;
    const double end = std::ceil(texel(middle + reach)) + 1.0;
    return {static_cast<std::size_t>(std::max(begin, 0.0)),
            static_cast<std::size_t>(std::min(end, texels))};
}

} // namespace

FaceLinear onFace(int face, const glm::dvec3& axis) {
    const auto at = [&](double u, double v) {
        return glm::dot(axis, shader_double::lodestar_cubeDirection(face, u, v));
    };
    const double centre = at(0.0, 0.0);
    return {centre, at(1.0, 0.0) - centre, at(0.0, 1.0) - centre};
}

TexelRange columnsWithin(const FaceLinear& axis, double v, double least, std::size_t width) {
    return between(axis.constant + axis.alongV * v, axis.alongU, least * least, 1.0 + v * v, width);
}

TexelRange rowsWithin(const FaceLinear& axis, double least, std::size_t width) {
    // Of a row the greatest of (c + a_u u)^2 - least^2 (1 + v^2 + u^2) over u is
    // c^2 least^2 / (least^2 - a_u^2) - least^2 (1 + v^2), c with v in it: the same form in v.
    const double q = least * least - axis.alongU * axis.alongU;
    return between(axis.constant, axis.alongV, q, 1.0, width);
}

} // namespace lodestar::lighting

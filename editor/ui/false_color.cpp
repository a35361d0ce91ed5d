// SPDX-License-Identifier: MIT
#include "ui/false_color.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "lodestar/display.glsl"

namespace lodestar::ui {
namespace {

/// A curve in Oklab: lightness rises evenly, the hue turns from violet (290 degrees) through red to
/// yellow (100). The chroma stays within what sRGB holds of that lightness and hue, by 0.005 at
/// least.
glm::dvec3 curve(double t) {
    const double hue = glm::radians(290.0 + 170.0 * t);
    const double chroma = 0.06 + 0.48 * t * (1.0 - t);
    return {0.14 + 0.82 * t, chroma * std::cos(hue), chroma * std::sin(hue)};
}

/// Linear Rec.709 of Oklab. [Ottosson20]
glm::dvec3 linearFromOklab(const glm::dvec3& lab) {
    const glm::dvec3 roots(lab.x + 0.3963377774 * lab.y + 0.2158037573 * lab.z,
                           lab.x - 0.1055613458 * lab.y - 0.0638541728 * lab.z,
                           lab.x - 0.0894841775 * lab.y - 1.2914855480 * lab.z);
    const glm::dvec3 cones = roots * roots * roots;
    return {glm::dot(cones, glm::dvec3(4.0767416621, -3.3077115913, 0.2309699292)),
            glm::dot(cones, glm::dvec3(-1.2684380046, 2.6097574011, -0.3413193965)),
            glm::dot(cones, glm::dvec3(-0.0041960863, -0.7034186147, 1.7076147010))};
}

constexpr int kSteps = 1024;

/// How far along the curve its k-th of kSteps parts begins, over its whole length.
const std::array<double, kSteps + 1>& lengths() {
    static const std::array<double, kSteps + 1> made = [] {
        std::array<double, kSteps + 1> along{};
        for (std::size_t k = 1; k <= kSteps; ++k) {
            const double t = static_cast<double>(k) / kSteps;
            along[k] = along[k - 1] + glm::distance(curve(t), curve(t - 1.0 / kSteps));
        }
        for (double& length : along) {
            length /= along[kSteps];
        }
        return along;
    }();
    return made;
}

} // namespace

glm::vec3 falseColor(double x) {
    const double length = x > 0.0 ? std::min(x, 1.0) : 0.0;
    const auto above = std::lower_bound(lengths().begin() + 1, lengths().end() - 1, length);
    const double part = (length - *(above - 1)) / (*above - *(above - 1));
    const double t = (static_cast<double>(above - 1 - lengths().begin()) + part) / kSteps;
    const glm::vec3 linear(glm::clamp(linearFromOklab(curve(t)), 0.0, 1.0));
    return {shader::lodestar_srgbFromLinear(linear.r), shader::lodestar_srgbFromLinear(linear.g),
            shader::lodestar_srgbFromLinear(linear.b)};
}

} // namespace lodestar::ui

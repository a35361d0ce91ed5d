// SPDX-License-Identifier: MIT
//
// Pixels of the unit sphere by testing::frontView, and the lobes that the renderer looks up there.
#pragma once

#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#define LODESTAR_DOUBLE_PRECISION
#include "lodestar/lobes.glsl"

namespace lodestar::testing {

/// A pixel of a picture by frontView that shows the unit sphere, but for its silhouette, where the
/// mesh's chords, 1e-4 inside the sphere, turn the normal.
struct SpherePixel {
    int x, y;
    glm::dvec3 normal, view;
};

inline std::vector<SpherePixel> spherePixels(int side) {
    std::vector<SpherePixel> pixels;
    const double half = std::tan(0.35);
    const glm::dvec3 eye(0.0, 0.0, 3.5);
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const glm::dvec3 ray =
                glm::normalize(glm::dvec3(half * (2.0 * (x + 0.5) / side - 1.0),
                                          half * (1.0 - 2.0 * (y + 0.5) / side), -1.0));
            const double b = glm::dot(eye, ray);
            const double root = b * b - glm::dot(eye, eye) + 1.0;
            if (root >= 0.02) {
                pixels.push_back({x, y, eye + (-b - std::sqrt(root)) * ray, -ray});
            }
        }
    }
    return pixels;
}

/// The lobe that the renderer's lookup asks for, in double precision.
struct Lobe {
    glm::dvec3 direction;
    double exponent;
};

inline Lobe lobeOf(const SpherePixel& pixel, double exponent) {
    const double nDotV = glm::dot(pixel.normal, pixel.view);
    const glm::dvec3 r = 2.0 * nDotV * pixel.normal - pixel.view;
    if (std::isinf(exponent)) {
        return {r, exponent};
    }
    return {glm::normalize(
                glm::mix(pixel.normal, r, shader_double::lodestar_lookupBlend(exponent, nDotV))),
            shader_double::lodestar_lookupExponent(exponent, nDotV)};
}

} // namespace lodestar::testing

// SPDX-License-Identifier: MIT
//
// The highlight of one small light: as a direct light's, and as what an environment lookup gives of
// a lamp of the same power (docs/derivations/highlight-match.md). n = +Z, the view in the plane y =
// 0.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#define LODESTAR_DOUBLE_PRECISION
#include "lodestar/lobes.glsl"
#undef LODESTAR_DOUBLE_PRECISION

namespace lodestar::testing {

/// Radiance by the light's direction, at an irradiance of 1 on a surface that faces it, Fresnel 1.
using Highlight = std::function<double(const glm::dvec3&)>;

inline glm::dvec3 viewAt(double degrees) {
    const double theta = degrees * std::numbers::pi / 180.0;
    return {std::sin(theta), 0.0, std::cos(theta)};
}

/// `lodestar_directReflectance`'s highlight: the normaliser that is exact at n = v, (n.h)^s, n.l.
inline Highlight directHighlight(double exponent, double degrees) {
    const glm::dvec3 v = viewAt(degrees);
    return [=](const glm::dvec3& l) {
        return shader_double::lodestar_directReflectance({0, 0, 1}, v, l, glm::dvec3(0.0),
                                                         glm::dvec3(1.0), exponent)
            .x;
    };
}

/// A round lobe about a direction, its integral 1.
inline Highlight phongHighlight(const glm::dvec3& direction, double exponent) {
    return [=](const glm::dvec3& l) {
        return shader_double::lodestar_phongNormaliser(exponent) *
               (glm::dot(direction, l) > 0.0
                    ? shader_double::lodestar_cosinePowerBetween(direction, l, exponent)
                    : 0.0);
    };
}

/// As published: about the reflection, the Blinn-Phong exponent for Phong's.
inline Highlight publishedHighlight(double exponent, double degrees) {
    const glm::dvec3 v = viewAt(degrees);
    return phongHighlight({-v.x, 0.0, v.z}, exponent);
}

/// About the reflection by the exponent of n = v (LOOK-5).
inline Highlight normalHighlight(double exponent, double degrees) {
    const glm::dvec3 v = viewAt(degrees);
    return phongHighlight({-v.x, 0.0, v.z}, shader_double::lodestar_phongFromBlinnPhong(exponent));
}

/// The direction that lodestar_lookup gives (LOOK-7).
inline glm::dvec3 lookupDirection(double exponent, double degrees) {
    const glm::dvec3 v = viewAt(degrees);
    return glm::normalize(glm::mix(glm::dvec3(0, 0, 1), glm::dvec3(-v.x, 0.0, v.z),
                                   shader_double::lodestar_lookupBlend(exponent, v.z)));
}

/// What lodestar_lookup asks for (LOOK-7, LOOK-8).
inline Highlight lookupHighlight(double exponent, double degrees) {
    return phongHighlight(lookupDirection(exponent, degrees),
                          shader_double::lodestar_lookupExponent(exponent, viewAt(degrees).z));
}

/// Peak and widths of a highlight.
struct HighlightShape {
    double peak = 0.0;    ///< per steradian
    double inPlane = 0.0; ///< half the width at half of the peak in the plane of incidence, radians
    double across = 0.0;  ///< the same across it, through the peak; both end at the horizon
};

/// A light's direction at an angle in the plane of incidence from the normal away from the view.
inline glm::dvec3 inPlane(double angle) {
    return {-std::sin(angle), 0.0, std::cos(angle)};
}

/// The angle from `from` towards `to` at which f falls below a level; `to` where it never does. f
/// is at least the level at `from` and falls once.
inline double fallsAt(const std::function<double(double)>& f, double level, double from,
                      double to) {
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (from + to);
        (f(middle) >= level ? from : to) = middle;
    }
    return 0.5 * (from + to);
}

inline HighlightShape shapeOf(const Highlight& highlight) {
    constexpr double kHorizon = 0.5 * std::numbers::pi;
    const auto along = [&](double angle) { return highlight(inPlane(angle)); };
    double low = -kHorizon;
    double high = kHorizon;
    const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
    // Sharp ones are 0 nearly everywhere: the best of a fine grid, then golden section about it.
    double best = low;
    constexpr int kGrid = 20000;
    for (int i = 0; i <= kGrid; ++i) {
        const double angle = low + (high - low) * i / kGrid;
        best = along(angle) > along(best) ? angle : best;
    }
    const double step = (high - low) / kGrid;
    low = best - step;
    high = std::min(best + step, kHorizon);
    while (high - low > 1e-10) {
        const double a = high - golden * (high - low);
        const double b = low + golden * (high - low);
        (along(a) < along(b) ? low : high) = along(a) < along(b) ? a : b;
    }
    HighlightShape shape;
    const double at = 0.5 * (low + high);
    shape.peak = along(at);
    const double half = 0.5 * shape.peak;
    shape.inPlane =
        0.5 * (fallsAt(along, half, at, kHorizon) - fallsAt(along, half, at, -kHorizon));
    const glm::dvec3 centre = inPlane(at);
    shape.across = fallsAt(
        [&](double angle) {
            return highlight(std::cos(angle) * centre + glm::dvec3(0.0, std::sin(angle), 0.0));
        },
        half, 0.0, std::numbers::pi);
    return shape;
}

/// What a direct light's highlight reflects of a white sphere of light, [0, 1]; a lamp's in a map
/// is 1.
inline double directAlbedo(double exponent, double degrees) {
    const glm::dvec3 v = viewAt(degrees);
    constexpr int kRadial = 2000;
    constexpr int kAzimuth = 200;
    double sum = 0.0;
    for (int i = 0; i < kRadial; ++i) {
        // Half vectors by y = (n.h)^(s + 1), as LOOK-2 substitutes.
        const double logarithm = std::log((i + 0.5) / kRadial) / (exponent + 1.0);
        const double cosine = std::exp(logarithm);
        const double sine = std::sqrt(-std::expm1(2.0 * logarithm));
        for (int j = 0; j < kAzimuth; ++j) {
            const double azimuth = std::numbers::pi * (j + 0.5) / kAzimuth;
            const glm::dvec3 h(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine);
            const double hDotV = glm::dot(h, v);
            sum += std::max(hDotV, 0.0) * std::max(2.0 * hDotV * cosine - v.z, 0.0);
        }
    }
    return shader_double::lodestar_blinnPhongNormaliser(exponent) * 8.0 * std::numbers::pi /
           (exponent + 1.0) * sum / (kRadial * kAzimuth);
}

/// The highlight of several round lobes side by side in the plane of incidence about the reflection
/// (HIGH-3, HIGH-4, HIGH-5); those beneath the horizon have no weight.
/// @param taps 3, 5 or 7
inline Highlight stretchedHighlight(int taps, double exponent, double degrees) {
    const double spacing = taps == 3 ? 1.2 : taps == 5 ? 0.9 : 0.8;
    const double least = taps == 3 ? 0.2 : 0.14;
    const double atNormal = shader_double::lodestar_phongFromBlinnPhong(exponent);
    const double cosine = viewAt(degrees).z;
    const double narrow = std::max(cosine * cosine, least);
    const double deviation = std::sqrt((1.0 - narrow) / atNormal);
    std::vector<Highlight> lobes;
    std::vector<double> weights;
    double sum = 0.0;
    for (int k = 0; k < taps; ++k) {
        const double steps = spacing * (k - 0.5 * (taps - 1));
        const double at = degrees * std::numbers::pi / 180.0 + steps * deviation;
        lobes.push_back(phongHighlight(inPlane(at), atNormal / narrow));
        weights.push_back(std::exp(-0.5 * steps * steps) * std::max(std::cos(at), 0.0));
        sum += weights.back();
    }
    return [=](const glm::dvec3& l) {
        double value = 0.0;
        for (std::size_t k = 0; k < lobes.size(); ++k) {
            value += weights[k] / sum * lobes[k](l);
        }
        return value;
    };
}

/// ||P - T|| / ||T|| (LOOK-4) of a highlight from the direct one made a density, over the
/// directions above the horizon and beneath, by a grid of angles in the plane of incidence and
/// across it.
inline double highlightError(const Highlight& highlight, double exponent, double degrees) {
    const Highlight direct = directHighlight(exponent, degrees);
    const double albedo = directAlbedo(exponent, degrees);
    const double reach = std::min(8.0 * std::sqrt(1.0 / (0.25 * exponent + 1.0)), 1.5);
    const double middle = degrees * std::numbers::pi / 180.0;
    constexpr int kGrid = 250;
    double difference = 0.0;
    double truth = 0.0;
    for (int i = 0; i < kGrid; ++i) {
        const double along = middle + reach * (2.0 * (i + 0.5) / kGrid - 1.0);
        for (int j = 0; j < kGrid; ++j) {
            const double across = reach * (j + 0.5) / kGrid; // even
            const glm::dvec3 l =
                std::cos(across) * inPlane(along) + glm::dvec3(0.0, std::sin(across), 0.0);
            const double t = direct(l) / albedo;
            const double p = highlight(l);
            difference += (p - t) * (p - t) * std::cos(across);
            truth += t * t * std::cos(across);
        }
    }
    return std::sqrt(difference / truth);
}

} // namespace lodestar::testing

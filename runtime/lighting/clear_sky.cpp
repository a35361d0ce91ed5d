// SPDX-License-Identifier: MIT
//
// The numbers are chosen by eye and by energy, not measured. On a horizontal surface the sky gives
// an irradiance of 0.6, 0.8, 1.4 (r, g, b) and the sun, at normal incidence, 3.2, 3.0, 2.5: a white
// surface in the sun has a radiance near 0.9, which exposure 0 shows just below the shoulder of the
// filmic curve. The zenith is at 0.04, 0.12, 0.37, the horizon near 1, the ground near 0.17.
#include "lighting/clear_sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace lodestar::lighting {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSunElevation = 40.0 * kPi / 180.0;
constexpr double kSunRadius = 0.27 * kPi / 180.0;

// Irradiance of the sun at normal incidence: luminance 3, warm.
const glm::dvec3 kSunIrradiance{3.22, 2.99, 2.50};
const glm::dvec3 kZenith{0.040, 0.115, 0.370};
const glm::dvec3 kHorizonNearSun{1.15, 1.05, 0.87};
const glm::dvec3 kHorizonAway{0.78, 0.86, 0.92};
const glm::dvec3 kGroundReflectance{0.215, 0.188, 0.150};

glm::dvec3 horizonColour(double cosineToSun) {
    const double t = 0.5 + 0.5 * cosineToSun;
    return kHorizonAway * (1.0 - t) + kHorizonNearSun * t;
}

/// Light scattered forward about the sun: cosine powers 6, 60, 900 and 12000 for a wide warm glow,
/// a halo, and the aureole next to the disc. Multiplied out, since this is most of the sky's cost.
glm::dvec3 glow(double cosineToSun) {
    if (cosineToSun <= 0.0) {
        return glm::dvec3(0.0);
    }
    const double c2 = cosineToSun * cosineToSun;
    const double c6 = c2 * c2 * c2;
    const double c12 = c6 * c6;
    const double c24 = c12 * c12;
    const double c60 = c24 * c24 * c12;
    glm::dvec3 sum = glm::dvec3(0.40, 0.36, 0.28) * c6 + glm::dvec3(0.80, 0.72, 0.58) * c60;
    if (c60 > 0.25) { // below, the narrow ones are under 1e-9 of their peaks
        sum += glm::dvec3(3.2, 3.0, 2.5) * std::pow(c60, 15.0) +
               glm::dvec3(40.0, 37.0, 31.0) * std::pow(c60, 200.0);
    }
    return sum;
}

glm::dvec3 skyRadiance(double height, double cosineToSun) {
    // A deep zenith that lightens towards the horizon, where the path through the air is longest;
    // molecules scatter as 1 + cos^2: darkest at right angles to the sun.
    const double low = 1.0 - height;
    const double haze = 0.55 * low * low * low + 0.45 * std::exp(-8.0 * height);
    const double molecules = 0.85 + 0.30 * cosineToSun * cosineToSun;
    return kZenith * (molecules * (1.0 - haze)) + horizonColour(cosineToSun) * haze +
           glow(cosineToSun);
}

/// Irradiance of the sky on the ground, by the midpoint rule in cos^2 of the polar angle and
/// azimuth.
glm::dvec3 skyIrradiance() {
    constexpr int kRows = 256;
    constexpr int kColumns = 512;
    const glm::dvec3 sun = clearSkySunDirection();
    glm::dvec3 sum(0.0);
    for (int i = 0; i < kRows; ++i) {
        const double height = std::sqrt((i + 0.5) / kRows);
        const double horizontal = std::sqrt(1.0 - height * height);
        for (int k = 0; k < kColumns; ++k) {
            const double azimuth = 2.0 * kPi * (k + 0.5) / kColumns;
            const glm::dvec3 d(horizontal * std::cos(azimuth), height,
                               horizontal * std::sin(azimuth));
            sum += skyRadiance(height, glm::dot(d, sun));
        }
    }
    return sum * (kPi / (kRows * kColumns));
}

/// Radiance of the ground: lit by the sun and the sky above, reflecting evenly.
const glm::dvec3& groundRadiance() {
    static const glm::dvec3 radiance =
        kGroundReflectance * (kSunIrradiance * std::sin(kSunElevation) + skyIrradiance()) / kPi;
    return radiance;
}

} // namespace

glm::dvec3 clearSkySunDirection() {
    const double side = std::cos(kSunElevation) / std::numbers::sqrt2;
    return {-side, std::sin(kSunElevation),
            side}; // north -Z, east +X: the south-west is (-1, ., +1)
}

double clearSkySunRadius() {
    return kSunRadius;
}

glm::dvec3 clearSkySunRadiance() {
    const double s = std::sin(kSunRadius);
    return kSunIrradiance / (kPi * s * s); // E = pi sin^2 r L for a disc at normal incidence
}

glm::dvec3 clearSkyRadiance(const glm::dvec3& direction) {
    const double cosineToSun = glm::dot(direction, clearSkySunDirection());
    const glm::dvec3 sky = skyRadiance(std::max(direction.y, 0.0), cosineToSun);
    if (direction.y >= 0.0) {
        return sky;
    }
    // Below, the ground fades into the haze of the horizon within about five degrees.
    const double haze = std::exp(direction.y / 0.06);
    return groundRadiance() * (1.0 - haze) + sky * haze;
}

} // namespace lodestar::lighting

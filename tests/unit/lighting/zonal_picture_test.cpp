// SPDX-License-Identifier: MIT
#include "lighting/zonal_picture.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace lodestar::lighting {
namespace {

constexpr double kPi = std::numbers::pi;

/// A panorama of a function of direction, sampled at texel centres.
template <class Function>
core::Image panoramaOf(int height, Function&& radiance) {
    core::Image image(2 * height, height, 3);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < 2 * height; ++x) {
            const double theta = kPi * (y + 0.5) / height;
            const double phi = kPi * (x + 0.5) / height - kPi; // from -Z towards +X
            const glm::dvec3 d(std::sin(theta) * std::sin(phi), std::cos(theta),
                               -std::sin(theta) * std::cos(phi));
            const glm::dvec3 value = radiance(d);
            for (int c = 0; c < 3; ++c) {
                image.at(x, y)[c] = static_cast<float>(value[c]);
            }
        }
    }
    return image;
}

} // namespace

TEST(ZonalPicture, AStripKeepsItsEnergy) {
    std::vector<glm::dvec3> texels;
    glm::dvec3 energy(0.0);
    for (int i = 0; i < 7; ++i) {
        texels.emplace_back(1.0 + i, i % 2, 3.0);
        energy += texels.back() * ringArea(kPi * i / 7.0, kPi * (i + 1) / 7.0);
    }
    for (const Zones& zones : {zonesFor(LightKind::Sky), zonesFor(LightKind::Sun), Zones{{}, 1}}) {
        const ZonalRadiance zonal = zonalFromStrip(texels, zones);
        ASSERT_EQ(zonal.means.size(), static_cast<std::size_t>(zones.count));
        const glm::dvec3 got = sphereMean(zonal);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(got[c], energy[c], 1e-13 * energy[c]) << zones.count;
        }
        for (const glm::dvec3& mean : zonal.means) {
            EXPECT_NEAR(mean.b, 3.0, 1e-12);
        }
    }
    // The outermost zones lie within the outermost texels.
    EXPECT_NEAR(zonalFromStrip(texels, zonesFor(LightKind::Sky)).means.front().r, 1.0, 1e-12);
    EXPECT_NEAR(zonalFromStrip(texels, zonesFor(LightKind::Sky)).means.back().r, 7.0, 1e-12);
}

// Radiance 2 + z about any axis: a zone's mean is 2 + its middle height. Between texel centres, d =
// pi / 128 apart, bilinear interpolation of a function whose curvature is at most 1 along either
// coordinate is off by d^2 / 4. Half a texel about the panorama's poles it is off by up to d / 2:
// all of it in zones about such a pole, and for the d / 2 pi of a circle that crosses one, another
// d^2 / 4 pi.
TEST(ZonalPicture, APanoramaAboutAnyAxis) {
    for (const glm::dvec3& axis :
         {glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0), glm::normalize(glm::dvec3(0.3, -0.5, 0.8))}) {
        const core::Image image = panoramaOf(
            128, [&](const glm::dvec3& d) { return glm::dvec3(2.0 + glm::dot(d, axis), 1, 0); });
        const PanoramaZones zonal = zonalFromPanorama(image, axis, zonesFor(LightKind::Sky));
        const std::vector<double> edges = zoneEdges(zonal.radiance.zones);
        const double d = kPi / 128.0;
        for (std::size_t j = 0; j < 256; ++j) {
            const double middle = 0.5 * (std::cos(edges[j]) + std::cos(edges[j + 1]));
            const glm::dvec3& mean = zonal.radiance.means[j];
            ASSERT_NEAR(mean.r, 2.0 + middle, j < 3 || j > 252 ? 0.5 * d : 0.34 * d * d) << j;
            ASSERT_NEAR(mean.g, 1.0, 1e-6);
            ASSERT_EQ(mean.b, 0.0);
        }
        EXPECT_LT(zonal.residual, 1e-3);
    }
}

// About +Y the same is no longer symmetric: 2 + x, whose circles deviate by sin(theta) |cos(phi)|:
// half the mean over the sphere, 1/4, of a mean of 2.
TEST(ZonalPicture, TheResidualSaysHowSymmetricASkyIs) {
    const core::Image tilted =
        panoramaOf(128, [](const glm::dvec3& d) { return glm::dvec3(2.0 + d.x); });
    EXPECT_NEAR(zonalFromPanorama(tilted, {0, 1, 0}, zonesFor(LightKind::Sky)).residual, 0.125,
                1e-3);
    // A lamp of 3 degrees on the horizon lights 6 of 360 degrees of its circles, and less.
    const glm::dvec3 lamp(1, 0, 0);
    const core::Image one = panoramaOf(256, [&](const glm::dvec3& d) {
        return glm::dvec3(glm::dot(d, lamp) > std::cos(3.0 * kPi / 180.0) ? 100.0 : 0.0);
    });
    const double aside = zonalFromPanorama(one, {0, 1, 0}, zonesFor(LightKind::Sky)).residual;
    EXPECT_GT(aside, 0.98);
    EXPECT_LT(aside, 1.0);
    // About itself what is left is the staircase of its edge: its 54 degrees of texels' length.
    EXPECT_LT(zonalFromPanorama(one, lamp, zonesFor(LightKind::Sun)).residual, 0.1);
    const core::Image black = panoramaOf(16, [](const glm::dvec3&) { return glm::dvec3(0.0); });
    EXPECT_EQ(zonalFromPanorama(black, lamp, zonesFor(LightKind::Sun)).residual, 0.0);
}

} // namespace lodestar::lighting

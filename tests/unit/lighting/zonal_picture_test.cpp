// SPDX-License-Identifier: MIT
#include "lighting/zonal_picture.h"

#include <algorithm>
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

/// Some radiance that is not smooth.
core::Image roughPanorama(int height) {
    core::Image image(2 * height, height, 3);
    for (std::size_t i = 0; i < image.pixels().size(); ++i) {
        image.pixels()[i] = static_cast<float>((i * 2654435761u) % 1000u) * 0.01f;
    }
    return image;
}

/// Shares that zones of equal angles have of a texel's cell, counted.
std::vector<double> countedShares(int height, int x, int y, const glm::dvec3& axis, int parts) {
    std::vector<double> shares(256);
    const double top = std::cos(kPi * y / height);
    const double bottom = std::cos(kPi * (y + 1) / height);
    for (int i = 0; i < parts * parts; ++i) {
        const int line = i / parts;
        const double z = top + (bottom - top) * (line + 0.5) / parts;
        const double phi = kPi * (x + (i % parts + 0.5) / parts) / height - kPi;
        const double r = std::sqrt(1.0 - z * z);
        const glm::dvec3 d(r * std::sin(phi), z, -r * std::cos(phi));
        const double theta = std::acos(glm::dot(d, axis));
        shares[static_cast<std::size_t>(theta / kPi * 256.0)] += 1.0 / parts / parts;
    }
    return shares;
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

// Radiance 2 + z about any axis: a zone's mean is 2 + its middle height. A texel that touches the
// zone stands with the value at its centre, half a diagonal away at most, d / sqrt 2.
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
            ASSERT_NEAR(mean.r, 2.0 + middle, std::sqrt(0.5) * d) << j;
            ASSERT_NEAR(mean.g, 1.0, 1e-12);
            ASSERT_EQ(mean.b, 0.0);
        }
        // Half of what radiance changes over a texel and a zone, of a mean of 2.
        EXPECT_LT(zonal.residual, 0.25 * (std::sqrt(0.5) * d + kPi / 256.0));
    }
}

// Rows about the zenith are a strip's texels; from the nadir they are the strip backwards.
TEST(ZonalPicture, APanoramaAboutItsPolesIsItsStrip) {
    const core::Image image = roughPanorama(48);
    std::vector<glm::dvec3> rows(48, glm::dvec3(0.0));
    for (int y = 0; y < 48; ++y) {
        for (int x = 0; x < 96; ++x) {
            const float* p = image.at(x, y);
            rows[static_cast<std::size_t>(y)] += glm::dvec3(p[0], p[1], p[2]) / 96.0;
        }
    }
    for (const LightKind kind : {LightKind::Sky, LightKind::Sun}) {
        for (const double up : {1.0, -1.0}) {
            const Zones zones = zonesFor(kind);
            const ZonalRadiance strip = zonalFromStrip(rows, zones);
            const ZonalRadiance zonal = zonalFromPanorama(image, {0, up, 0}, zones).radiance;
            for (std::size_t j = 0; j < zonal.means.size(); ++j) {
                ASSERT_NEAR(zonal.means[j].g, strip.means[j].g, 1e-9 * strip.means[j].g) << j;
            }
            std::reverse(rows.begin(), rows.end());
        }
    }
}

// A turn by whole columns moves values and nothing else.
TEST(ZonalPicture, ATurnedAxisIsATurnedPanorama) {
    const core::Image image = roughPanorama(32);
    core::Image turned(64, 32, 3);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 64; ++x) {
            std::copy_n(image.at(x, y), 3, turned.at((x + 11) % 64, y));
        }
    }
    const double angle = 11.0 * 2.0 * kPi / 64.0; // from -Z towards +X
    const glm::dvec3 axis = glm::normalize(glm::dvec3(0.3, -0.5, 0.8));
    const glm::dvec3 other(std::cos(angle) * axis.x - std::sin(angle) * axis.z, axis.y,
                           std::sin(angle) * axis.x + std::cos(angle) * axis.z);
    const PanoramaZones a = zonalFromPanorama(image, axis, zonesFor(LightKind::Sun));
    const PanoramaZones b = zonalFromPanorama(turned, other, zonesFor(LightKind::Sun));
    for (std::size_t j = 0; j < 256; ++j) {
        ASSERT_NEAR(a.radiance.means[j].r, b.radiance.means[j].r, 1e-7) << j;
    }
    EXPECT_NEAR(a.residual, b.residual, 1e-9);
}

// One bright texel, a small sun. Its share of each zone against 1000 x 1000 points of its cell, of
// which a zone's edges, together no longer than four sides of the cell, misjudge at most 4000. Ten
// nodes a piece leave areas, and so the energy, within 1e-6 where a cell is 22 degrees.
TEST(ZonalPicture, ATexelKeepsItsEnergyAboutAnyAxis) {
    constexpr int kParts = 1000;
    const Zones zones = zonesFor(LightKind::Sky);
    const std::vector<double> edges = zoneEdges(zones);
    for (const glm::dvec3& axis : {glm::dvec3(0.3, 0.6, -0.7), glm::dvec3(-0.7, -0.3, 0.2),
                                   glm::dvec3(-0.02, 1.0, 0.01), glm::dvec3(1, 0, 0)}) {
        for (const int height : {8, 128}) {
            for (const int eighths : {0, 3, 6}) {
                const int y = eighths * height / 8 + height / 64;
                const int x = 11 * height / 8;
                const glm::dvec3 about = glm::normalize(axis);
                core::Image image(2 * height, height, 3);
                image.at(x, y)[0] = 1e5f;
                const ZonalRadiance zonal = zonalFromPanorama(image, about, zones).radiance;
                const double energy =
                    1e5 * ringArea(kPi * y / height, kPi * (y + 1) / height) / (2 * height);
                EXPECT_NEAR(sphereMean(zonal).r, energy, 1e-6 * energy);
                const std::vector<double> counted = countedShares(height, x, y, about, kParts);
                for (std::size_t j = 0; j < counted.size(); ++j) {
                    EXPECT_NEAR(zonal.means[j].r * ringArea(edges[j], edges[j + 1]) / energy,
                                counted[j], 4.0 / kParts)
                        << "height " << height << ", row " << y << ", zone " << j;
                }
            }
        }
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

// SPDX-License-Identifier: MIT
//
// Lights of a photographed sky: the sun found where it stands, nothing of the light lost, and what
// is no sun left alone.
#include "lighting/photographed_lights.h"

#include <cmath>
#include <functional>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "lighting/zonal.h"
#include "lighting/zonal_picture.h"

namespace lodestar::testing {
namespace {

using lighting::LightKind;
constexpr double kPi = std::numbers::pi;
const glm::dvec3 kUp(0.0, 1.0, 0.0);
const glm::dvec3 kSun = glm::normalize(glm::dvec3(0.5, 0.6, -0.3));

core::Image panoramaOf(int height, const std::function<glm::dvec3(const glm::dvec3&)>& radiance) {
    core::Image image(2 * height, height, 3);
    for (int y = 0; y < height; ++y) {
        const double theta = (y + 0.5) / height * kPi;
        for (int x = 0; x < 2 * height; ++x) {
            const double phi = ((x + 0.5) / (2.0 * height) - 0.5) * 2.0 * kPi;
            const glm::dvec3 value = radiance({std::sin(theta) * std::sin(phi), std::cos(theta),
                                               -std::sin(theta) * std::cos(phi)});
            for (int c = 0; c < 3; ++c) {
                image.at(x, y)[c] = static_cast<float>(value[c]);
            }
        }
    }
    return image;
}

glm::dvec3 plainSky(const glm::dvec3& d) {
    return d.y > 0.0 ? glm::mix(glm::dvec3(1.0, 0.9, 0.8), glm::dvec3(0.1, 0.3, 0.8), d.y)
                     : glm::dvec3(0.2, 0.15, 0.1);
}

glm::dvec3 skyWithSun(const glm::dvec3& d) {
    const double angle = std::acos(std::clamp(glm::dot(d, kSun), -1.0, 1.0));
    return plainSky(d) +
           (angle < 1.5 * kPi / 180.0 ? glm::dvec3(900.0, 700.0, 400.0) : glm::dvec3(0.0)) +
           glm::dvec3(4.0, 3.0, 2.0) * std::exp(-angle * 60.0);
}

glm::dvec3 meanOf(const core::Image& panorama) {
    return sphereMean(lighting::zonalFromPanorama(panorama, kUp, lighting::Zones{}).radiance);
}

glm::dvec3 meanOf(const lighting::Gradient& gradient, LightKind kind) {
    return sphereMean(lighting::zonalRadiance(lighting::RadianceProfile(gradient, kind),
                                              {lighting::ZoneSpacing::EqualAngle, 4096}));
}

void expectSame(const glm::dvec3& found, const glm::dvec3& expected, double relative) {
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(found[c], expected[c], relative * expected[c]) << c;
    }
}

} // namespace

TEST(PhotographedLights, TheSunIsFoundAndNothingIsLost) {
    const core::Image panorama = panoramaOf(256, skyWithSun);
    const auto lights = lighting::lightsFromPanorama(panorama, kUp);
    ASSERT_TRUE(lights.sun);
    // Within half of a texel of 0.7 degrees.
    EXPECT_GT(glm::dot(lights.sun->axis, kSun), std::cos(0.35 * kPi / 180.0));
    EXPECT_GT(lights.sun->radius, (1.5 - 180.0 / 256.0) * kPi / 180.0); // less a ring of a texel
    EXPECT_LT(lights.sun->radius, 8.0 * kPi / 180.0);
    // The sky takes the mean of what is left, the sun the difference. The sun's gradient is scaled
    // to the irradiance that was taken; over 4 pi of the sphere that is its mean but for the cosine
    // of a few degrees, whose half square is 1e-2 at 8 degrees.
    const glm::dvec3 taken = meanOf(panorama) - meanOf(lights.rest);
    expectSame(meanOf(lights.sun->gradient, LightKind::Sun), taken, 1e-2);
    expectSame(lights.sun->irradiance, 4.0 * kPi * taken, 1e-2);
    expectSame(meanOf(lights.sky, LightKind::Sky), meanOf(lights.rest), 1e-4);
    EXPECT_LT(lights.residual, 0.1 * lights.residualBefore);
    // What is left is the sky without a sun: within what glows beyond the radius.
    expectSame(meanOf(lights.sky, LightKind::Sky), meanOf(panoramaOf(256, plainSky)), 2e-2);
    EXPECT_LE(lights.sky.stops.size(), 16u);
    EXPECT_EQ(lights.sky.stops.front().at, 90.0);
    EXPECT_EQ(lights.sky.stops.back().at, -90.0);
}

TEST(PhotographedLights, WithoutASunTheSkyIsKept) {
    const core::Image panorama = panoramaOf(128, plainSky);
    const auto lights = lighting::lightsFromPanorama(panorama, kUp);
    EXPECT_FALSE(lights.sun);
    EXPECT_EQ(lights.residual, lights.residualBefore);
    EXPECT_LT(lights.residual, 0.01);
    const lighting::RadianceProfile profile(lights.sky, LightKind::Sky);
    for (double elevation = -85.0; elevation <= 85.0; elevation += 5.0) {
        if (elevation == 0.0) {
            continue; // the horizon steps within a zone
        }
        const glm::dvec3 expected = plainSky({0.0, std::sin(elevation * kPi / 180.0), 0.0});
        // The stops' tolerance, a twentieth of the place's radiance and of a tenth of the mean.
        const glm::dvec3 found = profile.radiance((90.0 - elevation) * kPi / 180.0);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(found[c], expected[c], 0.05 * (expected[c] + 0.1)) << elevation;
        }
    }
}

TEST(PhotographedLights, WideLampsAndKeptSunsStayInTheSky) {
    const auto lamp = [](const glm::dvec3& d) {
        return glm::dvec3(glm::dot(d, kSun) > std::cos(20.0 * kPi / 180.0) ? 50.0 : 0.5);
    };
    EXPECT_FALSE(lighting::lightsFromPanorama(panoramaOf(128, lamp), kUp).sun);
    const core::Image panorama = panoramaOf(128, skyWithSun);
    const auto kept = lighting::lightsFromPanorama(panorama, kUp, false);
    EXPECT_FALSE(kept.sun);
    expectSame(meanOf(kept.sky, LightKind::Sky), meanOf(panorama), 1e-4);
}

TEST(PhotographedLights, BlackAndTinyPicturesAreDefined) {
    for (const int height : {1, 2, 5}) {
        const auto lights = lighting::lightsFromPanorama(
            panoramaOf(height, [](const glm::dvec3&) { return glm::dvec3(0.0); }), kUp);
        EXPECT_FALSE(lights.sun);
        EXPECT_EQ(meanOf(lights.sky, LightKind::Sky), glm::dvec3(0.0));
    }
    core::Image one(4, 2, 3);
    one.at(1, 0)[0] = 1e9f;
    const auto lights = lighting::lightsFromPanorama(one, kUp);
    EXPECT_TRUE(std::isfinite(meanOf(lights.sky, LightKind::Sky).r));
}

} // namespace lodestar::testing

// SPDX-License-Identifier: MIT
//
// Gradients out of pictures.
#include <cmath>
#include <numbers>

#include "model/picture_gradient.h"
#include "model_support.h"

namespace lodestar::model {
namespace {

using lighting::LightKind;

/// A panorama whose radiance depends on its elevation alone, but for a wave around that has no
/// mean.
core::Image panoramaOf(int height, double (*red)(double elevation)) {
    core::Image image(2 * height, height, 3);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < 2 * height; ++x) {
            const double elevation = 90.0 - 180.0 * (y + 0.5) / height;
            const double around = std::sin(2 * std::numbers::pi * (x + 0.5) / (2 * height));
            float* const p = image.at(x, y);
            p[0] = static_cast<float>(red(elevation));
            p[1] = static_cast<float>(red(elevation) * (1 + 0.5 * around));
            p[2] = 0.25f;
        }
    }
    return image;
}

double corner(double elevation) {
    return elevation > 0 ? 1 + elevation / 90 : 0.2;
}

TEST(PictureGradients, APanoramaGivesItsMeanOverAzimuth) {
    const core::Image image = panoramaOf(256, corner);
    const auto gradient = gradientOfPanorama(image, {0, 1, 0}, LightKind::Sky, 6);
    ASSERT_TRUE(gradient);
    EXPECT_EQ(gradient->stops.size(), 6U);
    for (double at = -89; at <= 89; at += 1) {
        const glm::dvec3 found = radianceAt(*gradient, LightKind::Sky, {&at, 1}).front();
        if (std::abs(at) > 1.5) { // a zone and a texel are 0.7 degrees each
            // A texel's height of the slope 1/90.
            EXPECT_NEAR(found.r, corner(at), 0.71 / 90) << at;
        }
        EXPECT_NEAR(found.g, found.r, 1e-5) << "the wave has no mean; floats";
        EXPECT_NEAR(found.b, 0.25, 1e-12);
    }
    Model model = sampleModel();
    did(model, SetGradient{keyId(model), *gradient});
    EXPECT_EQ(documentOf(textOf(model)), model.document());
}

TEST(PictureGradients, ASunsAxisIsItsOwn) {
    core::Image image(512, 256, 3);
    for (int y = 0; y < 256; ++y) { // a lamp about +X: half way from -Z, which is the middle
        for (int x = 0; x < 512; ++x) {
            const double azimuth = 2 * std::numbers::pi * ((x + 0.5) / 512 - 0.5);
            const double elevation = std::numbers::pi * (0.5 - (y + 0.5) / 256);
            const double cosine = std::cos(elevation) * std::sin(azimuth);
            const bool inside = cosine > std::cos(20 * std::numbers::pi / 180);
            std::fill_n(image.at(x, y), 3, inside ? 50.0f : 0.0f);
        }
    }
    const auto gradient = gradientOfPanorama(image, {3, 0, 0}, LightKind::Sun, 8);
    ASSERT_TRUE(gradient);
    const auto red = [&](double at) {
        return radianceAt(*gradient, LightKind::Sun, {&at, 1}).front().r;
    };
    // Eight stops for an edge that a zone of 0.4 and a texel of 0.7 degrees blur.
    EXPECT_NEAR(red(5), 50, 0.5);
    EXPECT_NEAR(red(18), 50, 5);
    EXPECT_NEAR(red(24), 0, 5);
    EXPECT_NEAR(red(120), 0, 0.5);
}

TEST(PictureGradients, ALineOverAPhotographGivesWhatItCrosses) {
    core::Image image(64, 100, 3);
    for (int y = 0; y < 100; ++y) {
        for (int x = 0; x < 64; ++x) {
            std::fill_n(image.at(x, y), 3, static_cast<float>(0.01 * (y + 0.5)));
        }
    }
    const PictureLine down{{10, 0.5}, {50, 99.5}, 60, -10};
    const auto gradient = gradientAlongLine(image, down, LightKind::Sky, 16);
    ASSERT_TRUE(gradient);
    for (double t = 0; t <= 1; t += 0.125) {
        const double at = 60 - 70 * t;
        // Linear in linear pixels, whose values floats hold.
        EXPECT_NEAR(radianceAt(*gradient, LightKind::Sky, {&at, 1}).front().r, 0.005 + 0.99 * t,
                    1e-7);
    }
    const PictureLine up{{50, 99.5}, {10, 0.5}, -10, 60};
    const auto other = gradientAlongLine(image, up, LightKind::Sky, 2);
    ASSERT_TRUE(other);
    ASSERT_EQ(other->stops.size(), 2U);
    EXPECT_EQ(other->stops.front().stop.at, 60.0) << "in order whichever way it is drawn";
    EXPECT_NEAR(lighting::radianceOf(other->stops.front().stop).r, 0.005, 1e-7);
    const auto outside =
        gradientAlongLine(image, {{-500, -7}, {900, -3}, 90, 0}, LightKind::Sky, 4);
    ASSERT_TRUE(outside);
    EXPECT_NEAR(lighting::radianceOf(outside->stops.back().stop).r, 0.005, 1e-7);
}

TEST(PictureGradients, WhatIsNoneIsRefused) {
    const core::Image image = panoramaOf(8, corner);
    const double nan = std::nan("");
    EXPECT_FALSE(gradientOfPanorama(core::Image(), {0, 1, 0}, LightKind::Sky, 8));
    EXPECT_FALSE(gradientOfPanorama(core::Image(8, 8, 3), {0, 1, 0}, LightKind::Sky, 8));
    EXPECT_FALSE(gradientOfPanorama(image, {0, 0, 0}, LightKind::Sky, 8));
    EXPECT_FALSE(gradientOfPanorama(image, {0, nan, 0}, LightKind::Sky, 8));
    EXPECT_FALSE(gradientOfPanorama(image, {0, 1, 0}, LightKind::Sky, 1));
    EXPECT_FALSE(gradientOfPanorama(image, {0, 1, 0}, LightKind::Sky, kMostStops + 1));
    const PictureLine line{{1, 1}, {5, 5}, 90, 0};
    EXPECT_TRUE(gradientAlongLine(image, line, LightKind::Sky, 8));
    EXPECT_FALSE(gradientAlongLine(core::Image(), line, LightKind::Sky, 8));
    EXPECT_FALSE(gradientAlongLine(image, line, LightKind::Sky, 0));
    for (const PictureLine& bad :
         {PictureLine{{1, nan}, {5, 5}, 90, 0}, PictureLine{{1, 1}, {5, 1 / 0.0}, 90, 0},
          PictureLine{{1, 1}, {5, 5}, nan, 0}, PictureLine{{1, 1}, {5, 5}, 30, 30}}) {
        EXPECT_FALSE(gradientAlongLine(image, bad, LightKind::Sky, 8));
    }
}

} // namespace
} // namespace lodestar::model

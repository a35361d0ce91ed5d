// SPDX-License-Identifier: MIT
//
// One zonal panorama lit two ways: as a cube map by the reference, texel by texel, and as the map
// that its mean over azimuth makes, about the zenith or a tilted axis. They share no step after the
// panorama.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "lighting/lookup.h"
#include "lighting/rsrm.h"
#include "lighting/zonal_picture.h"

namespace lodestar::lighting {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

const glm::dvec3 kZenith(0.0, 1.0, 0.0);
const glm::dvec3 kTilted = glm::normalize(glm::dvec3(0.5, 0.6, -0.7));

/// A panorama of a gradient about an axis: a texel holds the mean of 16 points of its cell, of
/// equal areas.
core::Image panoramaOf(const RadianceProfile& profile, const glm::dvec3& axis, int height) {
    constexpr int kParts = 4;
    core::Image image(2 * height, height, 3);
    for (int y = 0; y < height; ++y) {
        const double top = std::cos(std::numbers::pi * y / height);
        const double bottom = std::cos(std::numbers::pi * (y + 1) / height);
        for (int x = 0; x < 2 * height; ++x) {
            glm::dvec3 sum(0.0);
            for (int i = 0; i < kParts * kParts; ++i) {
                const int line = i / kParts;
                const double z = top + (bottom - top) * (line + 0.5) / kParts;
                const double column = x + (i % kParts + 0.5) / kParts;
                const double phi = std::numbers::pi * (column / height - 1.0);
                const double r = std::sqrt(1.0 - z * z);
                const glm::dvec3 d(r * std::sin(phi), z, -r * std::cos(phi));
                sum += profile.radiance(std::acos(std::clamp(glm::dot(d, axis), -1.0, 1.0)));
            }
            for (int c = 0; c < 3; ++c) {
                image.at(x, y)[c] = static_cast<float>(sum[c] / (kParts * kParts));
            }
        }
    }
    return image;
}

/// Worst relative difference over exponents from 1 to 1024 and angles from pole to pole.
double worstDifference(const char* name, const Gradient& gradient, const glm::dvec3& axis) {
    const RadianceProfile profile(gradient, LightKind::Sky);
    const core::Image panorama = panoramaOf(profile, axis, 512);
    const PreparedEnvironment cube{cubeFromLatLong(panorama, 256), {}, {}, {}, {}, {}};
    RsrmKernels kernels;
    const auto kernel = kernels.get(kRsrm, LightKind::Sky);
    const RsrmTexels map =
        encode(kRsrm, kernel->bake(zonalFromPanorama(panorama, axis, kernel->zones()).radiance));
    const std::vector<glm::vec3> mirror = unfiltered(profile);
    // Off the cube's planes of symmetry.
    const glm::dvec3 across = glm::normalize(glm::cross(axis, glm::dvec3(0.8, 0.0, 0.6)));
    double worst = 0.0;
    for (const double exponent : {1.0, 3.0, 10.0, 32.0, 100.0, 316.0, 1024.0}) {
        for (const double degrees : {0.0, 5.0, 20.0, 45.0, 70.0, 85.0, 89.0, 91.0, 97.0, 140.0}) {
            LookupRequest request;
            request.lobe = Lobe::Phong;
            request.exponent = exponent;
            request.estimator = {EstimatorKind::Reference};
            request.direction =
                std::cos(degrees * kDegree) * axis + std::sin(degrees * kDegree) * across;
            const glm::dvec3 summed = lookup(cube, request).radiance;
            const glm::dvec3 read(rsrmRadiance(map, mirror, degrees * kDegree, exponent));
            for (int c = 0; c < 3; ++c) {
                const double off = std::abs(read[c] - summed[c]) / summed[c];
                EXPECT_LE(off, 0.02) << name << ", s " << exponent << ", " << degrees << " degrees";
                worst = std::max(worst, off);
            }
        }
    }
    std::printf("%s, axis at %.2f: worst %.4f of the value\n", name, axis.y, worst);
    return worst;
}

TEST(RsrmAndCube, AgreeOnASmoothSky) {
    const Gradient smooth{
        {{90, {0.1, 0.2, 0.6}, 0}, {0, {1.0, 0.9, 0.7}, 0}, {-90, {0.2, 0.2, 0.2}, 0}},
        GradientInterpolation::Smooth};
    EXPECT_GT(worstDifference("smooth", smooth, kZenith), 0.0);
    EXPECT_GT(worstDifference("smooth", smooth, kTilted), 0.0);
}

TEST(RsrmAndCube, AgreeAcrossAHorizonsStep) {
    const Gradient step{{{90, {0.1, 0.2, 0.6}, 0},
                         {0, {1.0, 0.9, 0.7}, 0},
                         {0, {0.15, 0.13, 0.1}, 0},
                         {-90, {0.05, 0.05, 0.05}, 0}}};
    EXPECT_GT(worstDifference("step", step, kZenith), 0.0);
    EXPECT_GT(worstDifference("step", step, kTilted), 0.0);
}

TEST(RsrmAndCube, AgreeOnAGlowAboutTheZenith) {
    const Gradient glow{{{90, {8.0, 6.0, 4.0}, 0},
                         {75, {1.0, 0.8, 0.6}, 0},
                         {20, {0.3, 0.3, 0.4}, 0},
                         {-90, {0.1, 0.1, 0.1}, 0}}};
    EXPECT_GT(worstDifference("glow", glow, kZenith), 0.0);
    EXPECT_GT(worstDifference("glow", glow, kTilted), 0.0);
}

} // namespace
} // namespace lodestar::lighting

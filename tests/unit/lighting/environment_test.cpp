// SPDX-License-Identifier: MIT
#include "lighting/environment.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "lighting/mips.h"
#include "support/cubes.h"

namespace lodestar::lighting {
namespace {

constexpr double kPi = std::numbers::pi;

core::Image randomPanorama(int width, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> exponent(-2.0f, 2.0f);
    core::Image image(width, width / 2, 3);
    for (float& value : image.pixels()) {
        value = std::pow(10.0f, exponent(random));
    }
    return image;
}

/// A texel as the mean of per x per bilinear lookups, every angle by its own arc functions.
glm::dvec3 definedTexel(const core::Image& image, int face, int i, int j, int width, int per) {
    const int w = image.width();
    const int h = image.height();
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    const auto pixel = [&](int x, int y) {
        const float* p = image.at(((x % w) + w) % w, std::clamp(y, 0, h - 1));
        return glm::dvec3(p[0], p[1], p[2]);
    };
    for (int s = 0; s < per * per; ++s) {
        const double u = (2.0 * (i * per + s % per) + 1.0) / (width * per) - 1.0;
        const double v = (2.0 * (j * per + s / per) + 1.0) / (width * per) - 1.0;
        const glm::dvec3 directions[6] = {{1, -v, -u}, {-1, -v, u}, {u, 1, v},
                                          {u, -1, -v}, {u, -v, 1},  {-u, -v, -1}};
        const glm::dvec3 d = glm::normalize(directions[face]);
        const double x = (std::atan2(d.x, -d.z) / (2.0 * kPi) + 0.5) * w - 0.5;
        const double y = std::acos(d.y) / kPi * h - 0.5;
        const int x0 = static_cast<int>(std::floor(x));
        const int y0 = static_cast<int>(std::floor(y));
        const double weight = std::pow(1.0 + u * u + v * v, -1.5);
        sum +=
            weight * glm::mix(glm::mix(pixel(x0, y0), pixel(x0 + 1, y0), x - x0),
                              glm::mix(pixel(x0, y0 + 1), pixel(x0 + 1, y0 + 1), x - x0), y - y0);
        weights += weight;
    }
    return sum / weights;
}

/// 1024x512 at w = 256 in small: the panorama's pixels are about a texel, so 4x4 lookups are asked
/// for. Fractions are stored in float: 6e-8 of a difference between pixels that may be 1e4 times
/// the texel, but the texel then holds a part of the larger pixel; 1e-5 leaves room for both.
TEST(CubeFromLatLong, FollowsItsDefinition) {
    for (const int width : {16, 15, 1, 2}) {
        const core::Image image = randomPanorama(4 * width, 3);
        const Cubemap cube = cubeFromLatLong(image, width);
        for (int face = 0; face < 6; ++face) {
            for (int k = 0; k < width * width; ++k) {
                const glm::dvec3 expected =
                    definedTexel(image, face, k % width, k / width, width, 4);
                const glm::vec4& texel = cube.texel(face, k % width, k / width);
                for (int c = 0; c < 3; ++c) {
                    ASSERT_NEAR(static_cast<double>(texel[c]), expected[c], 1e-5 * expected[c])
                        << "width " << width << " face " << face << " texel " << k;
                }
                ASSERT_EQ(texel.a, 1.0f);
            }
        }
    }
}

/// Orientation: the panorama's six marked places land on their faces. Centre column -Z, rightwards
/// to +X, top +Y.
TEST(CubeFromLatLong, PlacesDirections) {
    core::Image image(256, 128, 3);
    const auto mark = [&](double azimuth, double polar, int channel, float value) {
        for (int y = 0; y < 128; ++y) {
            for (int x = 0; x < 256; ++x) {
                const double a = ((x + 0.5) / 256.0 - 0.5) * 2.0 * kPi;
                const double p = (y + 0.5) / 128.0 * kPi;
                const glm::dvec3 d(std::sin(p) * std::sin(a), std::cos(p),
                                   -std::sin(p) * std::cos(a));
                const glm::dvec3 m(std::sin(polar) * std::sin(azimuth), std::cos(polar),
                                   -std::sin(polar) * std::cos(azimuth));
                if (glm::dot(d, m) > 0.95) {
                    image.at(x, y)[channel] = value;
                }
            }
        }
    };
    mark(0.5 * kPi, 0.5 * kPi, 0, 1.0f);  // +X
    mark(-0.5 * kPi, 0.5 * kPi, 0, 2.0f); // -X
    mark(0.0, 0.0, 1, 1.0f);              // +Y
    mark(0.0, kPi, 1, 2.0f);              // -Y
    mark(kPi, 0.5 * kPi, 2, 1.0f);        // +Z
    mark(0.0, 0.5 * kPi, 2, 2.0f);        // -Z
    const Cubemap cube = cubeFromLatLong(image, 32);
    EXPECT_NEAR(cube.sampleLevel({1, 0, 0}, 0).r, 1.0f, 1e-6f);
    EXPECT_NEAR(cube.sampleLevel({-1, 0, 0}, 0).r, 2.0f, 1e-6f);
    EXPECT_NEAR(cube.sampleLevel({0, 1, 0}, 0).g, 1.0f, 1e-6f);
    EXPECT_NEAR(cube.sampleLevel({0, -1, 0}, 0).g, 2.0f, 1e-6f);
    EXPECT_NEAR(cube.sampleLevel({0, 0, 1}, 0).b, 1.0f, 1e-6f);
    EXPECT_NEAR(cube.sampleLevel({0, 0, -1}, 0).b, 2.0f, 1e-6f);
    EXPECT_EQ(cube.sampleLevel({0, 0, -1}, 0).r, 0.0f);
}

/// A panorama 64 times finer than the cube is halved first; one bright pixel keeps its energy: its
/// pixel's solid angle times its radiance. A bilinear footprint is the pixel's own area away from
/// the poles to sin(band) differences of (pi / h)^2 / 12; the samples are half a pixel apart, where
/// the hat function's sum is exact along each axis but for the texel's curved grid: 2 %.
TEST(CubeFromLatLong, FinePanoramasKeepTheEnergyOfAPixel) {
    for (const int panoramaWidth : {512, 1024, 2048}) {
        core::Image image(panoramaWidth, panoramaWidth / 2, 3);
        const int y = panoramaWidth / 6;
        image.at(panoramaWidth / 3, y)[0] = 1e6f;
        const double h = panoramaWidth / 2;
        const double omega =
            2.0 * kPi / panoramaWidth * (std::cos(kPi * y / h) - std::cos(kPi * (y + 1) / h));
        const Cubemap cube = cubeFromLatLong(image, 32);
        const double expected = 1e6 * omega / (4.0 * kPi);
        EXPECT_NEAR(sphereMean(cube, 0).x, expected, 0.02 * expected) << panoramaWidth;
        EXPECT_EQ(sphereMean(cube, 0).y, 0.0);
    }
}

/// Far coarser than the cube: no steps, that is, neighbouring texels differ by no more than the
/// slope of the bilinear function: 1 a pixel of 2 pi / 16 in azimuth, and on the equator a texel of
/// +Z is at most 2 / 64 wide.
TEST(CubeFromLatLong, CoarsePanoramasShowNoSteps) {
    core::Image image(16, 8, 3);
    for (int i = 0; i < 16 * 8; ++i) {
        image.at(i % 16, i / 16)[0] = static_cast<float>(i % 2);
    }
    const Cubemap cube = cubeFromLatLong(image, 64);
    const float slope = static_cast<float>(16.0 / (2.0 * kPi) * 2.0 / 64.0);
    float largest = 0.0f;
    for (int x = 1; x < 64; ++x) {
        largest = std::max(largest, std::abs(cube.texel(4, x, 32).r - cube.texel(4, x - 1, 32).r));
    }
    EXPECT_LE(largest, slope * 1.001f);
    EXPECT_GT(largest, 0.0f);
}

TEST(CubeFromLatLong, OnePixelAndConstant) {
    core::Image image(1, 1, 3);
    image.at(0, 0)[1] = 5.0f;
    const Cubemap cube = cubeFromLatLong(image, 4);
    for (const glm::vec4& texel : cube.level(0)) {
        EXPECT_FLOAT_EQ(texel.g, 5.0f);
        EXPECT_EQ(texel.r, 0.0f);
    }
}

std::array<core::Image, 6> faceImages(int n) {
    std::array<core::Image, 6> faces;
    for (std::size_t f = 0; f < 6; ++f) {
        faces[f] = core::Image(n, n, 3);
        for (std::size_t i = 0; i < faces[f].pixels().size(); ++i) {
            faces[f].pixels()[i] = static_cast<float>(1 + (i * 7 + f * 13) % 29);
        }
    }
    return faces;
}

TEST(CubeFromFaces, SameWidthIsACopy) {
    const auto faces = faceImages(5);
    const Cubemap cube = cubeFromFaces(faces, 5);
    for (std::size_t f = 0; f < 6; ++f) {
        for (int i = 0; i < 25; ++i) {
            const float* p = faces[f].at(i % 5, i / 5);
            EXPECT_EQ(cube.texel(static_cast<int>(f), i % 5, i / 5),
                      glm::vec4(p[0], p[1], p[2], 1));
        }
    }
}

/// Finer faces: the sphere's mean is kept, since overlaps are weighted by their solid angles (exact
/// below 64 texels, to 5e-5 above).
TEST(CubeFromFaces, ReducingKeepsTheMean) {
    for (const auto& [n, width, tolerance] :
         {std::tuple{8, 4, 1e-6}, std::tuple{48, 9, 1e-6}, std::tuple{100, 32, 5e-5}}) {
        const auto faces = faceImages(n);
        const double mean = sphereMean(cubeFromFaces(faces, n), 0).y;
        EXPECT_NEAR(sphereMean(cubeFromFaces(faces, width), 0).y, mean, tolerance * mean) << n;
    }
}

TEST(CubeFromFaces, MagnifyingIsSmoothAndWithinRange) {
    const auto faces = faceImages(4);
    const Cubemap cube = cubeFromFaces(faces, 64);
    float largest = 0.0f;
    for (int x = 1; x < 64; ++x) {
        const float a = cube.texel(2, x, 30).r;
        const float b = cube.texel(2, x - 1, 30).r;
        EXPECT_GE(a, 1.0f);
        EXPECT_LE(a, 29.0f);
        largest = std::max(largest, std::abs(a - b));
    }
    EXPECT_LE(largest, 28.0f / 16.0f * 1.001f); // 28 a coarse texel, 16 fine ones to it
}

TEST(RepairRadiance, RepairsAndCounts) {
    core::Image image(3, 2, 1);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    image.pixels() = {
        std::numeric_limits<float>::quiet_NaN(), -0.5f, kInfinity, -kInfinity, 2e9f, 3.5f};
    core::Tally warnings;
    repairRadiance(image, warnings);
    EXPECT_EQ(image.pixels(), (std::vector<float>{0.0f, 0.0f, 1e9f, 0.0f, 1e9f, 3.5f}));
    std::uint64_t total = 0;
    for (const auto& [rule, count] : warnings.counts()) {
        total += count;
    }
    EXPECT_EQ(total, 5U);
    EXPECT_EQ(warnings.counts().size(), 3U);
}

TEST(RepairRadiance, LeavesValidRadianceAlone) {
    core::Image image(2, 1, 1);
    image.pixels() = {0.0f, 1e9f};
    core::Tally warnings;
    repairRadiance(image, warnings);
    EXPECT_TRUE(warnings.empty());
    EXPECT_EQ(image.pixels(), (std::vector<float>{0.0f, 1e9f}));
}

TEST(Prepare, FillsOnlyWhatIsAskedFor) {
    const Cubemap base = testing::randomCube(16, 1);
    const PreparedEnvironment nothing = prepare(base, {});
    EXPECT_FALSE(nothing.base.empty());
    EXPECT_TRUE(nothing.boxMips.empty());
    EXPECT_TRUE(nothing.tentMips.empty());
    EXPECT_TRUE(nothing.irradiance.empty());
    const PreparedEnvironment all = prepare(base, {true, true, true, true});
    EXPECT_EQ(all.boxMips.levelCount(), 5);
    EXPECT_EQ(all.tentMips.levelCount(), 5);
    EXPECT_EQ(all.irradiance.width(), kIrradianceWidth);
    EXPECT_GT(all.sh9[0].x, 0.0f);
}

} // namespace
} // namespace lodestar::lighting

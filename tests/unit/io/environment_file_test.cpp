// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <random>

#include <glm/geometric.hpp>

#include <OpenImageIO/imageio.h>

#include "io/environment_file.h"
#include "io/image_file.h"
#include "lighting/mips.h"
#include "lodestar/cube.glsl"
#include "support/shared.h"
#include "unit/io/io_support.h"

namespace lodestar {
namespace {

using testing::TemporaryFolder;

constexpr int kWidth = 5; // odd: a middle row that must not move

/// A different colour in every direction, so that a turned or mirrored face shows. Positive.
glm::vec3 colorOf(glm::dvec3 d) {
    d /= std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    return glm::vec3(d * 0.25 + glm::dvec3(0.5, 0.6, 0.7));
}

/// Where a cell of an unfolded cube looks: s runs rightwards, t downwards, both in [-1, 1]. Written
/// from the picture in cube.glsl: the middle column is one band over +Y, +Z, -Y, -Z; the middle row
/// one band over -X, +Z, +X, -Z.
glm::dvec3 crossDirection(int column, int row, bool vertical, double s, double t) {
    if (column == 1) {
        switch (row) {
        case 0:
            return {s, 1.0, t};
        case 1:
            return {s, -t, 1.0};
        case 2:
            return {s, -1.0, -t};
        default:
            return {s, t, -1.0};
        }
    }
    if (column == 0) {
        return {-1.0, -t, s};
    }
    EXPECT_TRUE(column == 2 || !vertical);
    return column == 2 ? glm::dvec3(1.0, -t, -s) : glm::dvec3(-s, -t, -1.0);
}

bool inCross(int column, int row, bool vertical) {
    return column == 1 || row == 1 ? column < (vertical ? 3 : 4) && row < (vertical ? 4 : 3)
                                   : false;
}

core::Image crossImage(bool vertical) {
    core::Image image((vertical ? 3 : 4) * kWidth, (vertical ? 4 : 3) * kWidth, 3);
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            if (!inCross(x / kWidth, y / kWidth, vertical)) {
                continue;
            }
            const double s = (2.0 * (x % kWidth) + 1.0) / kWidth - 1.0;
            const double t = (2.0 * (y % kWidth) + 1.0) / kWidth - 1.0;
            const glm::vec3 color = colorOf(crossDirection(x / kWidth, y / kWidth, vertical, s, t));
            std::copy_n(&color.x, 3, image.at(x, y));
        }
    }
    return image;
}

glm::vec3 faceColor(int face, int x, int y, int width = kWidth) {
    const auto u = static_cast<float>((2.0 * x + 1.0) / width - 1.0);
    const auto v = static_cast<float>((2.0 * y + 1.0) / width - 1.0);
    return colorOf(glm::dvec3(shader::lodestar_cubeDirection(face, u, v)));
}

core::Image faceImage(int face) {
    core::Image image(kWidth, kWidth, 3);
    for (int y = 0; y < kWidth; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const glm::vec3 color = faceColor(face, x, y);
            std::copy_n(&color.x, 3, image.at(x, y));
        }
    }
    return image;
}

core::Image stripImage(bool wide) {
    core::Image image(wide ? 6 * kWidth : kWidth, wide ? kWidth : 6 * kWidth, 3);
    for (int face = 0; face < 6; ++face) {
        for (int y = 0; y < kWidth; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                const glm::vec3 color = faceColor(face, x, y);
                std::copy_n(&color.x, 3,
                            wide ? image.at(face * kWidth + x, y) : image.at(x, face * kWidth + y));
            }
        }
    }
    return image;
}

void expectTheCube(const core::Result<io::LoadedEnvironment>& loaded,
                   io::EnvironmentLayout layout) {
    ASSERT_TRUE(loaded.ok()) << loaded.error().message();
    EXPECT_EQ(loaded->layout, layout);
    EXPECT_TRUE(loaded->warnings.empty());
    ASSERT_EQ(loaded->base.width(), kWidth);
    for (int face = 0; face < 6; ++face) {
        for (int y = 0; y < kWidth; ++y) {
            for (int x = 0; x < kWidth; ++x) {
                const glm::vec4 texel = loaded->base.texel(face, x, y);
                const glm::vec3 wanted = faceColor(face, x, y);
                // Both sides are the same numbers up to float rounding of a direction of size 1.
                EXPECT_LT(glm::distance(glm::vec3(texel), wanted), 1e-6f)
                    << face << " " << x << " " << y;
                EXPECT_EQ(texel.a, 1.0f);
            }
        }
    }
}

TEST(EnvironmentFile, EveryLayoutGivesTheSameCube) {
    const TemporaryFolder folder;
    const auto write = [&](const std::string& name, const core::Image& image) {
        ASSERT_TRUE(io::writeImage(folder / name, image).ok()) << name;
    };
    const auto load = [&](const std::string& name) {
        return io::loadEnvironment((folder / name).string(), kWidth);
    };
    write("vertical.exr", crossImage(true));
    expectTheCube(load("vertical.exr"), io::EnvironmentLayout::Cross);
    write("horizontal.exr", crossImage(false));
    expectTheCube(load("horizontal.exr"), io::EnvironmentLayout::Cross);
    write("wide.exr", stripImage(true));
    expectTheCube(load("wide.exr"), io::EnvironmentLayout::Strip);
    write("tall.exr", stripImage(false));
    expectTheCube(load("tall.exr"), io::EnvironmentLayout::Strip);
    const char* names[] = {"px", "nx", "py", "ny", "pz", "nz"};
    for (int face = 0; face < 6; ++face) {
        write(std::string("sky_") + names[face] + ".exr", faceImage(face));
    }
    for (const char* name : {"sky_px.exr", "sky_.exr", "sky_{px,nx,py,ny,pz,nz}.exr"}) {
        expectTheCube(load(name), io::EnvironmentLayout::SixFiles);
    }
    std::filesystem::remove(folder / "sky_nz.exr");
    const core::Result<io::LoadedEnvironment> lacking = load("sky_.exr");
    ASSERT_FALSE(lacking.ok());
    testing::expectOneLine(lacking.error(), (folder / "sky_nz.exr").string());
}

TEST(EnvironmentFile, LatLongLooksNorthAtItsCentre) {
    const TemporaryFolder folder;
    core::Image image(64, 32, 3);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 64; ++x) {
            const double longitude = ((x + 0.5) / 64 - 0.5) * 2.0 * M_PI;
            const double polar = (y + 0.5) / 32 * M_PI;
            const glm::dvec3 d{std::sin(polar) * std::sin(longitude), std::cos(polar),
                               -std::sin(polar) * std::cos(longitude)};
            const glm::vec3 color(d * 0.25 + 0.5);
            std::copy_n(&color.x, 3, image.at(x, y));
        }
    }
    ASSERT_TRUE(io::writeImage(folder / "p.exr", image).ok());
    const auto loaded = io::loadEnvironment((folder / "p.exr").string(), 16);
    ASSERT_TRUE(loaded.ok());
    EXPECT_EQ(loaded->layout, io::EnvironmentLayout::LatLong);
    for (const glm::vec3 d : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1),
                              glm::vec3(-1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0, -1)}) {
        // A quarter of the half width of a cube texel, 1/16, plus that of a panorama's, bounds the
        // blur.
        EXPECT_LT(glm::distance(glm::vec3(loaded->base.sampleLevel(d, 0)), d * 0.25f + 0.5f),
                  0.02f);
    }
}

TEST(EnvironmentFile, LdrPicturesAreLinearised) {
    const TemporaryFolder folder;
    core::Image image(8, 4, 3);
    std::fill(image.pixels().begin(), image.pixels().end(), 128.0f / 255.0f);
    ASSERT_TRUE(io::writeImage(folder / "p.png", image).ok());
    const auto loaded = io::loadEnvironment((folder / "p.png").string(), 4);
    ASSERT_TRUE(loaded.ok());
    // IEC 61966-2-1 at 128/255 is 0.215860...
    EXPECT_NEAR(loaded->base.texel(2, 1, 1).r, 0.2158605f, 1e-6f);
}

TEST(EnvironmentFile, AnalyticAndItsErrors) {
    const auto constant = io::loadEnvironment("constant:1,2,3", 8);
    ASSERT_TRUE(constant.ok());
    EXPECT_EQ(constant->layout, io::EnvironmentLayout::Analytic);
    EXPECT_EQ(glm::vec3(constant->base.texel(3, 7, 0)), glm::vec3(1, 2, 3));
    for (const char* text : {"constant:1,2", "constant:a,b,c", "gradient:", "faces:1;2"}) {
        const auto refused = io::loadEnvironment(text, 8);
        ASSERT_FALSE(refused.ok()) << text;
        EXPECT_EQ(refused.error().code, core::ErrorCode::Usage) << text;
    }
}

TEST(EnvironmentFile, ShapesThatFitNothingAreRefused) {
    const TemporaryFolder folder;
    const std::pair<int, int> sizes[] = {{1, 1},  {3, 3}, {7, 3}, {1, 2},  {4, 1},
                                         {16, 9}, {5, 1}, {1, 7}, {64, 33}};
    for (const auto& [width, height] : sizes) {
        core::Image image(width, height, 3);
        ASSERT_TRUE(io::writeImage(folder / "x.exr", image).ok());
        const auto loaded = io::loadEnvironment((folder / "x.exr").string(), 8);
        ASSERT_FALSE(loaded.ok()) << width << " x " << height;
        testing::expectOneLine(loaded.error(), (folder / "x.exr").string());
        EXPECT_NE(loaded.error().what.find("2:1"), std::string::npos);
    }
    for (const auto& [width, height] : {std::pair{2, 1}, {6, 1}, {1, 6}, {4, 3}, {3, 4}}) {
        ASSERT_TRUE(io::writeImage(folder / "x.exr", core::Image(width, height, 1)).ok());
        EXPECT_TRUE(io::loadEnvironment((folder / "x.exr").string(), 8).ok())
            << width << " x " << height;
    }
    EXPECT_FALSE(io::loadEnvironment((folder / "missing.hdr").string()).ok());
    EXPECT_FALSE(io::loadEnvironment("").ok());
    EXPECT_FALSE(io::loadEnvironment(folder.path().string()).ok());
}

TEST(EnvironmentFile, NonFiniteRadianceIsRepairedAndCounted) {
    const TemporaryFolder folder;
    std::vector<float> pixels(8 * 4 * 3, 1.0f);
    pixels[0] = std::numeric_limits<float>::quiet_NaN();
    pixels[4] = std::numeric_limits<float>::infinity();
    pixels[8] = -1.0f;
    const auto output = OIIO::ImageOutput::create("x.exr");
    ASSERT_TRUE(
        output->open((folder / "x.exr").string(), OIIO::ImageSpec(8, 4, 3, OIIO::TypeDesc::FLOAT)));
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, pixels.data()) && output->close());
    const auto loaded = io::loadEnvironment((folder / "x.exr").string(), 8);
    ASSERT_TRUE(loaded.ok());
    EXPECT_EQ(loaded->warnings.counts().size(), 3U);
    for (const auto& [rule, count] : loaded->warnings.counts()) {
        EXPECT_EQ(count, 1U) << rule;
    }
    for (const glm::vec4& texel : loaded->base.level(0)) {
        ASSERT_TRUE(std::isfinite(texel.r) && std::isfinite(texel.g) && std::isfinite(texel.b));
    }
}

/// The same place as a lat-long and as an OpenEXR cube.
struct Pair {
    const char* latLong;
    const char* cube;
    bool halfTurnsAlike; ///< the picture does not change by half turns about the axes; mirrored it
                         ///< does
};

constexpr int kLevel = 2;

/// Root mean square difference of log radiance at one level over random directions, where `b` is
/// looked up along `other(direction)`.
template <class Other>
double difference(const lighting::Cubemap& a, const lighting::Cubemap& b, Other other) {
    std::mt19937 random(7);
    std::normal_distribution<float> normal;
    double sum = 0.0;
    constexpr int kCount = 20000;
    for (int i = 0; i < kCount; ++i) {
        const glm::vec3 d =
            glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
        const double x = std::log(a.sampleLevel(d, kLevel).g);
        const double y = std::log(b.sampleLevel(other(d), kLevel).g);
        sum += (x - y) * (x - y);
    }
    return std::sqrt(sum / kCount);
}

/// A direction moved by an angle, to a side that differs from place to place.
glm::vec3 moved(const glm::vec3& d, float radians) {
    const glm::vec3 side =
        glm::normalize(glm::cross(d, glm::vec3(d.y, d.z, d.x) + glm::vec3(0.3f, 0.1f, 0.7f)));
    return d * std::cos(radians) + side * std::sin(radians);
}

TEST(EnvironmentFile, OpenExrCubeAgreesWithItsLatLong) {
    LODESTAR_NEEDS_SHARED();
    for (const Pair& pair : {Pair{"KernerEnvLatLong.exr", "KernerEnvCube.exr", false},
                             Pair{"WavyLinesLatLong.exr", "WavyLinesCube.exr", true}}) {
        const std::string folder = testing::sharedPath("assets/hdr/openexr-images/").string();
        auto latLong = io::loadEnvironment(folder + pair.latLong, 256);
        auto cube = io::loadEnvironment(folder + pair.cube, 256);
        ASSERT_TRUE(latLong.ok() && cube.ok());
        EXPECT_EQ(latLong->layout, io::EnvironmentLayout::LatLong);
        EXPECT_EQ(cube->layout, io::EnvironmentLayout::Strip);
        const lighting::Cubemap a = lighting::solidAngleMips(latLong->base);
        const lighting::Cubemap b = lighting::solidAngleMips(cube->base);
        // The conventions put texel centres up to half a panorama's texel (0.18 degrees) and half a
        // face's (0.18) apart: together a quarter of a texel at level 2 (1.41 degrees). So the two
        // may differ by a quarter of what one texel at that level makes, and as much for the blur
        // of resampling.
        const float texel = 2.0f * std::atan(1.0f) / static_cast<float>(a.width(kLevel));
        const double oneTexel =
            difference(a, a, [&](const glm::vec3& d) { return moved(d, texel); });
        const double straight = difference(a, b, [](const glm::vec3& d) { return d; });
        EXPECT_LT(straight, 0.5 * oneTexel) << pair.cube;
        for (int turn = 1; turn < 8; ++turn) {
            const glm::vec3 scale((turn & 1) != 0 ? -1 : 1, (turn & 2) != 0 ? -1 : 1,
                                  (turn & 4) != 0 ? -1 : 1);
            if (pair.halfTurnsAlike && scale.x * scale.y * scale.z > 0.0f) {
                continue;
            }
            const double turned = difference(a, b, [&](const glm::vec3& d) { return d * scale; });
            EXPECT_GT(turned, 2.0 * straight) << pair.cube << " turned " << turn;
        }
        const glm::dvec4 meanA = lighting::sphereMean(latLong->base, 0);
        const glm::dvec4 meanB = lighting::sphereMean(cube->base, 0);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(meanA[c] / meanB[c], 1.0, 0.01) << pair.cube;
        }
    }
}

} // namespace
} // namespace lodestar

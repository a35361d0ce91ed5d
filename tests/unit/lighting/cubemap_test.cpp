// SPDX-License-Identifier: MIT
#include "lighting/cubemap.h"

#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "support/cubes.h"

namespace lodestar::lighting {
namespace {

using testing::constantCube;
using testing::randomCube;
using testing::randomDirection;

Cubemap sixColours(int width) {
    Cubemap cube(width);
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < width * width; ++i) {
            cube.texel(face, i % width, i / width) = glm::vec4(static_cast<float>(face + 1));
        }
    }
    return cube;
}

TEST(Cubemap, WidthsAndLevelsOfAChain) {
    EXPECT_EQ(fullLevelCount(1), 1);
    EXPECT_EQ(fullLevelCount(2), 2);
    EXPECT_EQ(fullLevelCount(255), 8);
    EXPECT_EQ(fullLevelCount(256), 9);
    const Cubemap cube(7, 3);
    EXPECT_EQ(cube.levelCount(), 3);
    EXPECT_EQ(cube.width(0), 7);
    EXPECT_EQ(cube.width(1), 3);
    EXPECT_EQ(cube.width(2), 1);
    EXPECT_EQ(cube.level(1).size(), 6U * 9U);
    EXPECT_TRUE(Cubemap().empty());
}

TEST(Cubemap, RefusesSizesOutsideItsRange) {
    const testing::ThrowingContracts contracts;
    EXPECT_THROW(Cubemap(0), testing::ThrowingContracts::Violation);
    EXPECT_THROW(Cubemap(16385), testing::ThrowingContracts::Violation);
    EXPECT_THROW(Cubemap(4, 4), testing::ThrowingContracts::Violation);
    EXPECT_THROW(static_cast<void>(Cubemap(4).sampleLevel({1, 0, 0}, 1)),
                 testing::ThrowingContracts::Violation);
}

/// Six colours, looked up along the axes, and each face's own four quarters against the drawing in
/// cube.glsl: which way its columns and rows run in the world.
TEST(Cubemap, FacesLieWhereTheDrawingSays) {
    const Cubemap cube = sixColours(4);
    const glm::vec3 axes[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (int face = 0; face < 6; ++face) {
        EXPECT_EQ(cube.sampleLevel(axes[face], 0).x, static_cast<float>(face + 1));
    }
    // Columns run towards, rows run towards (row 0 is at the opposite end).
    const glm::vec3 columns[6] = {{0, 0, -1}, {0, 0, 1}, {1, 0, 0},
                                  {1, 0, 0},  {1, 0, 0}, {-1, 0, 0}};
    const glm::vec3 rows[6] = {{0, -1, 0}, {0, -1, 0}, {0, 0, 1},
                               {0, 0, -1}, {0, -1, 0}, {0, -1, 0}};
    Cubemap counted(2);
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < 4; ++i) {
            counted.texel(face, i % 2, i / 2) = glm::vec4(static_cast<float>(10 * face + i));
        }
    }
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < 4; ++i) {
            const float u = i % 2 == 0 ? -0.5f : 0.5f;
            const float v = i / 2 == 0 ? -0.5f : 0.5f;
            const glm::vec3 d = axes[face] + u * columns[face] + v * rows[face];
            EXPECT_EQ(counted.sampleLevel(d, 0).x, static_cast<float>(10 * face + i))
                << "face " << face << " quarter " << i;
        }
    }
}

/// The other way: the direction of every texel's centre finds that texel. The weights of its
/// neighbours are rounding, at most a few ulp of the texel coordinate (8 texels: 1e-6).
TEST(Cubemap, TexelCentresReadTheirTexel) {
    const int n = 8;
    const Cubemap cube = randomCube(n, 1);
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < n * n; ++i) {
            const glm::vec3 d(testing::texelDirection(face, i % n, i / n, n));
            const glm::vec4 read = cube.sampleLevel(d * 3.7f, 0);
            const glm::vec4 texel = cube.texel(face, i % n, i / n);
            // Neighbours are at most 1e2.
            EXPECT_NEAR(read.x, texel.x, 4e-6f * 1e2f);
            EXPECT_NEAR(read.z, texel.z, 4e-6f * 1e2f);
        }
    }
}

/// Across each of the 12 edges the lookup is continuous: with texels in [0.01, 100] its slope is at
/// most 2 * 100 a texel along u and v together, n / 2 texels a unit of u; a step of e in the
/// direction moves (u, v) by at most 3 e on each face. Bound: 200 * n / 2 * 3 e.
TEST(Cubemap, ContinuousAcrossAllEdges) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> along(-1.0f, 1.0f);
    for (const int n : {1, 2, 5, 16}) {
        const Cubemap cube = randomCube(n, static_cast<unsigned>(n));
        int edges = 0;
        for (int first = 0; first < 3; ++first) {
            for (int signs = 0; signs < 4; ++signs) {
                ++edges;
                const int second = (first + 1) % 3;
                const int free = (first + 2) % 3;
                for (int k = 0; k < 100; ++k) {
                    constexpr float kStep = 1e-5f;
                    glm::vec3 a(0.0f);
                    a[first] = (signs & 1) != 0 ? 1.0f : -1.0f;
                    a[second] = (signs & 2) != 0 ? 1.0f : -1.0f;
                    a[free] = along(random);
                    glm::vec3 b = a;
                    a[first] *= 1.0f + kStep;
                    b[second] *= 1.0f + kStep;
                    const float bound = 200.0f * static_cast<float>(n) / 2.0f * 3.0f * kStep;
                    EXPECT_NEAR(cube.sampleLevel(a, 0).x, cube.sampleLevel(b, 0).x, bound);
                }
            }
        }
        EXPECT_EQ(edges, 12);
    }
}

TEST(Cubemap, LookupsStayWithinTheTexelsRange) {
    std::mt19937 random(3);
    for (const int n : {1, 3, 8}) {
        const Cubemap cube = randomCube(n, 9);
        for (int k = 0; k < 2000; ++k) {
            const glm::vec4 read = cube.sampleLevel(randomDirection(random), 0);
            EXPECT_GE(read.y, 0.01f * 0.999f);
            EXPECT_LE(read.y, 100.0f * 1.001f);
        }
    }
}

TEST(Cubemap, DegenerateDirectionsReadTheCentreOfPlusX) {
    const Cubemap cube = sixColours(4);
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (const glm::vec3& d : {glm::vec3(0.0f), glm::vec3(kNaN, 0, 0), glm::vec3(0, kNaN, 1),
                               glm::vec3(0, kInfinity, 0), glm::vec3(1, 2, kNaN)}) {
        EXPECT_EQ(cube.sampleLevel(d, 0).x, 1.0f);
    }
    EXPECT_EQ(cube.sampleLevel({0, 0, -1e-42f}, 0).x, 6.0f);
    EXPECT_EQ(cube.sampleLevel({0, -3e38f, 0}, 0).x, 4.0f);
}

TEST(Cubemap, TrilinearBlendsAndClampsLevels) {
    Cubemap cube(4, 3);
    for (int k = 0; k < 3; ++k) {
        for (glm::vec4& texel : cube.level(k)) {
            texel = glm::vec4(static_cast<float>(k));
        }
    }
    const glm::vec3 d(0.3f, -0.4f, 0.5f);
    EXPECT_FLOAT_EQ(cube.sample(d, 0.25f).x, 0.25f);
    EXPECT_FLOAT_EQ(cube.sample(d, 1.75f).x, 1.75f);
    EXPECT_EQ(cube.sample(d, -3.0f).x, 0.0f);
    EXPECT_EQ(cube.sample(d, 2.0f).x, 2.0f);
    EXPECT_EQ(cube.sample(d, 99.0f).x, 2.0f);
    EXPECT_EQ(cube.sample(d, std::numeric_limits<float>::infinity()).x, 2.0f);
    EXPECT_EQ(cube.sample(d, std::numeric_limits<float>::quiet_NaN()).x, 0.0f);
}

TEST(Cubemap, SolidAnglesFillTheSphere) {
    for (const int n : {1, 2, 3, 8, 255, 1024}) {
        double sum = 0.0;
        for (const double omega : texelSolidAngles(n)) {
            EXPECT_GT(omega, 0.0);
            sum += omega;
        }
        // Four arc tangents below 1.05 a texel, each to 2e-16, of which most cancel in the sum.
        EXPECT_NEAR(6.0 * sum, 4.0 * std::numbers::pi, 1e-11) << n;
    }
}

} // namespace
} // namespace lodestar::lighting

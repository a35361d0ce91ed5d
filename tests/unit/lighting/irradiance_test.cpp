// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "lighting/environment.h"
#include "lodestar/sh9.glsl"
#include "support/cubes.h"
#include "support/full_irradiance.h"

namespace lodestar::lighting {
namespace {

constexpr double kPi = std::numbers::pi;

using testing::relativeIrradianceError;

TEST(IrradianceCube, ConstantMapIsOne) {
    for (const int n : {1, 2, 16, 33, 100, 256}) {
        const Cubemap cube = irradianceCube(testing::constantCube(n, {1, 0.5f, 3, 1}));
        ASSERT_EQ(cube.width(), kIrradianceWidth);
        ASSERT_EQ(cube.levelCount(), 1);
        for (const glm::vec4& texel : cube.level(0)) {
            // Runs of 64 float terms and 48 of such runs, errors of either sign: (8 + 7) * 6e-8.
            EXPECT_NEAR(texel.r, 1.0f, 1e-6f) << n;
            EXPECT_NEAR(texel.b / 3.0f, 1.0f, 1e-6f);
            EXPECT_NEAR(texel.a, 1.0f, 1e-6f);
        }
    }
}

/// Up to 32 texels a side each texel is a block: the full sum itself, in float.
TEST(IrradianceCube, SmallMapsAreTheFullSum) {
    EXPECT_LT(relativeIrradianceError(testing::randomCube(20, 3)), 1e-5);
    EXPECT_LT(relativeIrradianceError(testing::randomCube(1, 3)), 1e-5);
}

/// Larger maps act by blocks. A block that a normal's horizon crosses gives max(n.m, 0) of its mean
/// instead of the mean of max(n.d, 0): over the horizon's length that is short by half the variance
/// of its texels across it, d^2 / 3 of a constant map with blocks of half width d = 1/32 (3.3e-4).
/// Noise has more, by the share of a block's light that lies off its mean: bounded by half a per
/// cent.
TEST(IrradianceCube, NoiseIsWithinHalfAPercent) {
    EXPECT_LT(relativeIrradianceError(testing::randomCube(128, 4)), 0.005);
}

/// One texel lit: a block's light acts along its own mean direction, so a lamp is exact but for the
/// weights' sum, the d^2 / 3 above.
TEST(IrradianceCube, OneLampActsFromItsPlace) {
    for (const glm::ivec3& at :
         {glm::ivec3(2, 3, 77), glm::ivec3(4, 0, 0), glm::ivec3(1, 127, 64)}) {
        Cubemap base(128);
        base.texel(at.x, at.y, at.z) = glm::vec4(1e6f, 1e6f, 1e6f, 1.0f);
        EXPECT_LT(relativeIrradianceError(base), 1.0 / (3.0 * 32.0 * 32.0));
    }
}

/// A gradient a + b y has irradiance over pi a + 2/3 b n.y (Funk-Hecke, l = 1).
TEST(IrradianceCube, GradientMeetsItsClosedForm) {
    const Cubemap base = cubeFromAnalytic(*parseAnalytic("gradient:0,2"), 256);
    const Cubemap cube = irradianceCube(base);
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < 256; i += 5) {
            const glm::dvec3 n = testing::texelDirection(face, i % 16, i / 16, 16);
            EXPECT_NEAR(static_cast<double>(cube.texel(face, i % 16, i / 16).g),
                        1.0 + n.y * 2.0 / 3.0, 2e-4);
        }
    }
}

glm::vec3 evaluate(const Sh9Coefficients& c, const glm::vec3& n) {
    return shader::lodestar_sh9(c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8], n);
}

TEST(Sh9, ConstantAndGradientAreExact) {
    std::mt19937 random(2);
    const Sh9Coefficients one = sh9FromCube(testing::constantCube(64, glm::vec4(2.0f)));
    const Sh9Coefficients gradient =
        sh9FromCube(cubeFromAnalytic(*parseAnalytic("gradient:0,2"), 256));
    for (int k = 0; k < 500; ++k) {
        const glm::vec3 n = testing::randomDirection(random);
        // Order 2 of a constant: the texel centres' quadrature error at 64, (2/64)^2 / 6.
        EXPECT_NEAR(evaluate(one, n).x, 2.0f, 2.0f * 2e-4f);
        EXPECT_NEAR(evaluate(gradient, n).y, 1.0f + n.y * 2.0f / 3.0f, 5e-5f);
    }
}

/// A lamp about each axis in turn, against the expansion written out with Legendre polynomials:
/// sum of (2l + 1) / (4 pi) a_l P_l(x), a = 1, 2/3, 1/4, here times the lamp's solid angle. That
/// the nine terms belong to the right axes shows for lamps and normals off the axes.
TEST(Sh9, OneLampFollowsLegendre) {
    const int n = 64;
    const std::vector<double> omega = texelSolidAngles(n);
    std::mt19937 random(8);
    for (int k = 0; k < 50; ++k) {
        const int face = k % 6;
        const int x = (k * 37) % n;
        const int y = (k * 23) % n;
        Cubemap base(n);
        base.texel(face, x, y) = glm::vec4(1e4f);
        const glm::dvec3 lamp = testing::texelDirection(face, x, y, n);
        const Sh9Coefficients c = sh9FromCube(base);
        const double strength = 1e4 * omega[static_cast<std::size_t>(y * n + x)] / (4.0 * kPi);
        for (int s = 0; s < 20; ++s) {
            const glm::vec3 normal = testing::randomDirection(random);
            const double t = glm::dot(lamp, glm::dvec3(normal));
            const double expected =
                strength * (1.0 + 2.0 * t + 5.0 / 4.0 * 0.5 * (3.0 * t * t - 1.0));
            EXPECT_NEAR(static_cast<double>(evaluate(c, normal).x), std::max(expected, 0.0),
                        2e-6 * strength * 5.0);
        }
    }
}

/// Sums by rows in the faces' own axes against the plain sum in double.
TEST(Sh9, AgreesWithThePlainSum) {
    const Cubemap base = testing::randomCube(40, 12);
    const std::vector<double> omega = texelSolidAngles(40);
    std::array<double, 9> plain{};
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < 1600; ++i) {
            const glm::dvec3 d = testing::texelDirection(face, i % 40, i / 40, 40);
            const double light = omega[static_cast<std::size_t>(i)] *
                                 static_cast<double>(base.texel(face, i % 40, i / 40).g) /
                                 (4.0 * kPi);
            const double basis[9] = {1.0,
                                     2.0 * d.y,
                                     2.0 * d.z,
                                     2.0 * d.x,
                                     15.0 / 4.0 * d.x * d.y,
                                     15.0 / 4.0 * d.y * d.z,
                                     5.0 / 16.0 * (3.0 * d.z * d.z - 1.0),
                                     15.0 / 4.0 * d.x * d.z,
                                     15.0 / 16.0 * (d.x * d.x - d.y * d.y)};
            for (std::size_t k = 0; k < 9; ++k) {
                plain[k] += light * basis[k];
            }
        }
    }
    const Sh9Coefficients c = sh9FromCube(base);
    for (std::size_t k = 0; k < 9; ++k) {
        EXPECT_NEAR(static_cast<double>(c[k].g), plain[k], 2e-6 * plain[0]) << k;
    }
}

} // namespace
} // namespace lodestar::lighting

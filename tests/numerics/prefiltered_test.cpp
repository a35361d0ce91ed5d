// SPDX-License-Identifier: MIT
//
// Prefiltered mips: each texel the mean over its lobe, against plain sums in double precision, and
// the level that is read for an exponent. What the estimator errs by is in ladder_test.cpp.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "lighting/prefiltered.h"
#include "lodestar/cube.glsl"

namespace lodestar::testing {

namespace {

using lighting::Cubemap;

Cubemap randomCube(int width) {
    Cubemap cube(width);
    std::mt19937 random(7);
    std::uniform_real_distribution<float> radiance(0.0f, 1.0f);
    for (glm::vec4& texel : cube.level(0)) {
        texel = {radiance(random), radiance(random), radiance(random), radiance(random)};
    }
    return cube;
}

double coordinate(int i, int width) {
    return (2.0 * i + 1.0) / width - 1.0;
}

glm::dvec3 centreOf(int face, int x, int y, int width) {
    return glm::normalize(glm::dvec3(shader::lodestar_cubeDirection(
        face, static_cast<float>(coordinate(x, width)), static_cast<float>(coordinate(y, width)))));
}

/// The mean over max(cos^s - 1e-4, 0) about a direction.
glm::dvec4 lobeMean(const Cubemap& base, const glm::dvec3& axis, double exponent) {
    const int n = base.width();
    const std::vector<double> solidAngles = lighting::texelSolidAngles(n);
    glm::dvec4 sum(0.0);
    double weights = 0.0;
    for (int i = 0; i < 6 * n * n; ++i) {
        const double cosine = glm::dot(axis, centreOf(i / (n * n), i % n, i / n % n, n));
        const double weight = cosine > 0.0 ? std::max(std::pow(cosine, exponent) - 1e-4, 0.0) : 0.0;
        const auto t = static_cast<std::size_t>(i);
        sum += weight * solidAngles[t % solidAngles.size()] * glm::dvec4(base.level(0)[t]);
        weights += weight * solidAngles[t % solidAngles.size()];
    }
    return sum / weights;
}

} // namespace

TEST(Prefiltered, TexelsAreMeansOverTheirLobes) {
    constexpr int kWidth = 12; // an odd level of 3 among them
    const Cubemap base = randomCube(kWidth);
    const Cubemap mips = lighting::prefilteredMips(base); // summed over the map itself
    ASSERT_EQ(mips.levelCount(), 4);
    EXPECT_TRUE(mips.level(0) == base.level(0));
    for (int level = 1; level < mips.levelCount(); ++level) {
        const int n = mips.width(level);
        // The level's own lobe, less a sixth of the texel's solid angle (PRE-2).
        const double own =
            std::max(3.0 / 16.0 * std::pow(kWidth * std::exp2(-level), 2.0), 1.0) - 1.0;
        for (int i = 0; i < 6 * n * n; ++i) {
            const int x = i % n;
            const int y = i / n % n;
            const double r2 = 1.0 + std::pow(coordinate(x, n), 2) + std::pow(coordinate(y, n), 2);
            const double spread = 1.0 / (own + 2.0) - 4.0 / (6.0 * n * n) / std::pow(r2, 1.5);
            const double exponent = n == 1 ? own : std::max(1.0 / spread - 2.0, 0.0);
            const glm::dvec4 expected = lobeMean(base, centreOf(i / (n * n), x, y, n), exponent);
            const glm::dvec4 found(mips.level(level)[static_cast<std::size_t>(i)]);
            // Weights are within 1e-6 of themselves (an exponent below 10 times a logarithm good to
            // 3e-8, exp2 to 2e-7, a cosine of 1e-7 times the exponent), sums of 432 in rows of 12.
            for (int c = 0; c < 4; ++c) {
                EXPECT_NEAR(found[c], expected[c], 5e-6) << level << " texel " << i;
            }
        }
    }
}

TEST(Prefiltered, TheSameOnAnyNumberOfThreads) {
    const Cubemap base = randomCube(64);
    const Cubemap one = lighting::prefilteredMips(base, {.threads = 1});
    std::atomic<double> told = 0.0;
    const Cubemap three =
        lighting::prefilteredMips(base, {.threads = 3, .progress = [&](double share) {
                                             EXPECT_GE(share, told);
                                             EXPECT_LE(share, 1.0);
                                             told = share;
                                         }});
    EXPECT_GT(told, 0.0);
    for (int level = 0; level < one.levelCount(); ++level) {
        EXPECT_TRUE(one.level(level) == three.level(level)) << level;
    }
}

TEST(Prefiltered, AnyWidthKeepsAConstant) {
    for (const int width : {1, 2, 3, 5, 64, 100}) {
        Cubemap base(width);
        std::fill(base.level(0).begin(), base.level(0).end(), glm::vec4(3.0f, 0.5f, 1e-20f, 1e9f));
        const Cubemap mips = lighting::prefilteredMips(base);
        for (int level = 0; level < mips.levelCount(); ++level) {
            for (const glm::vec4& texel : mips.level(level)) {
                for (int c = 0; c < 4; ++c) { // sums of products and of weights round alike
                    const float expected = base.level(0)[0][c];
                    EXPECT_NEAR(texel[c], expected, 1e-5f * expected) << width << " " << level;
                }
            }
        }
    }
}

// The fraction between two levels is the least-squares one of three Gaussians: moving it either way
// makes the distance greater.
TEST(Prefiltered, TheLevelIsTheNearestInTheMeanSquare) {
    constexpr double kWidth = 256.0;
    for (const double s : {3.0, 10.0, 40.0, 200.0, 900.0, 2500.0, 8000.0, 50000.0}) {
        const double level = static_cast<double>(
            shader::lodestar_prefilteredLevel(static_cast<float>(s), 256.0f, 8.0f));
        const double below = std::floor(level);
        const auto spread = [&](double of) {
            return of > 0.0 ? 1.0 / (static_cast<double>(shader::lodestar_prefilteredExponent(
                                         static_cast<float>(of), 256.0f)) +
                                     2.0)
                            : 2.0 / (3.0 * kWidth * kWidth);
        };
        const double a = spread(below);
        const double b = spread(below + 1.0);
        const double v = 1.0 / (s + 2.0);
        // <g_p, g_q> = 1 / (2 pi (p + q)) over the plane.
        const auto inner = [](double p, double q) { return 1.0 / (p + q); };
        const auto distance = [&](double f) {
            return inner(v, v) + (1 - f) * (1 - f) * inner(a, a) + f * f * inner(b, b) -
                   2 * (1 - f) * inner(v, a) - 2 * f * inner(v, b) + 2 * f * (1 - f) * inner(a, b);
        };
        const double f = level - below;
        EXPECT_LT(distance(f), distance(f + 0.01)) << s;
        EXPECT_LT(distance(f), distance(f - 0.01)) << s;
    }
    EXPECT_EQ(shader::lodestar_prefilteredLevel(1e7f, 256.0f, 8.0f), 0.0f);
    // A white map has levels for every exponent.
    EXPECT_EQ(shader::lodestar_prefilteredLevel(0.0f, 256.0f, 8.0f), 7.0f);
    EXPECT_EQ(shader::lodestar_prefilteredLevel(5.0f, 1.0f, 0.0f), 0.0f);
}

} // namespace lodestar::testing

// SPDX-License-Identifier: MIT
#include "lighting/mips.h"

#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "lighting/cube_seams.h"
#include "lighting/environment.h"
#include "lighting/round_levels.h"
#include "lighting/solid_angle.h"
#include "support/cubes.h"

namespace lodestar::lighting {
namespace {

using testing::constantCube;
using testing::randomCube;

constexpr int kWidths[] = {1, 2, 3, 4, 5, 6, 7, 12, 31, 64, 100, 129};

/// Mean over the sphere in double with exact solid angles: not the code under test.
double exactMean(const Cubemap& map, int level, int channel) {
    const int n = map.width(level);
    const std::vector<double> omega = texelSolidAngles(n);
    double sum = 0.0;
    double weight = 0.0;
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < n * n; ++i) {
            const double w = omega[static_cast<std::size_t>(i)];
            sum += w * static_cast<double>(map.texel(face, i % n, i / n, level)[channel]);
            weight += w;
        }
    }
    return sum / weight;
}

/// A constant stays constant to a few ulp: 16 taps and one division, then the mean's correction. A
/// round level adds float weights along runs of up to n texels and over up to 6 n runs, for n
/// texels of the level that it reads, at most 32 here: 7 x 32 roundings of 6e-8.
TEST(Mips, ConstantStaysConstant) {
    const glm::vec4 value(0.3f, 7.7f, 1234.5f, 1.0f);
    for (const int n : kWidths) {
        const Cubemap base = constantCube(n, value);
        for (const Cubemap& chain : {boxMips(base), solidAngleMips(base), tentMips(base)}) {
            ASSERT_EQ(chain.levelCount(), fullLevelCount(n));
            for (int k = 0; k < chain.levelCount(); ++k) {
                for (const glm::vec4& texel : chain.level(k)) {
                    for (int c = 0; c < 4; ++c) {
                        const bool round = k > 0 && chain.width(k) <= kWidestRound;
                        ASSERT_NEAR(texel[c], value[c], (round ? 1.4e-5f : 1e-6f) * value[c])
                            << n << " level " << k;
                    }
                }
            }
        }
    }
}

TEST(Mips, SolidAngleAndTentKeepTheSpheresMean) {
    for (const int n : kWidths) {
        const Cubemap base = randomCube(n, static_cast<unsigned>(n));
        for (const Cubemap& chain : {solidAngleMips(base), tentMips(base)}) {
            for (int k = 0; k < chain.levelCount(); ++k) {
                for (int c = 0; c < 4; ++c) {
                    const double mean = exactMean(base, 0, c);
                    EXPECT_NEAR(exactMean(chain, k, c), mean, 1e-5 * mean) << n << " level " << k;
                }
            }
        }
    }
}

/// One lamp of 1e9 in an otherwise dark map, in every corner texel in turn, must not lose its
/// energy either: float sums beside such a texel are worst.
TEST(Mips, KeepTheMeanOfOneTexel) {
    for (const glm::ivec3& at :
         {glm::ivec3(0, 0, 0), glm::ivec3(3, 31, 16), glm::ivec3(5, 17, 13)}) {
        Cubemap base(32);
        base.texel(at.x, at.y, at.z) = glm::vec4(1e9f, 0.0f, 1e-3f, 1.0f);
        const double mean = exactMean(base, 0, 0);
        for (const Cubemap& chain : {solidAngleMips(base), tentMips(base)}) {
            for (int k = 0; k < chain.levelCount(); ++k) {
                EXPECT_NEAR(exactMean(chain, k, 0), mean, 1e-5 * mean);
                EXPECT_EQ(exactMean(chain, k, 1), 0.0);
            }
        }
    }
}

TEST(Mips, BlackStaysBlack) {
    const Cubemap chain = tentMips(Cubemap(16));
    for (int k = 0; k < chain.levelCount(); ++k) {
        for (const glm::vec4& texel : chain.level(k)) {
            ASSERT_EQ(texel, glm::vec4(0.0f));
        }
    }
}

TEST(Mips, SphereMeanIsTheExactMean) {
    const Cubemap base = randomCube(20, 5);
    // Solid angles in float: 6e-8 each.
    EXPECT_NEAR(sphereMean(base, 0).y, exactMean(base, 0, 1), 1e-6 * exactMean(base, 0, 1));
}

TEST(Mips, BoxMeansAreOfTwoByTwoWithinAFace) {
    const Cubemap base = randomCube(8, 2);
    const Cubemap chain = boxMips(base);
    const glm::vec4 mean = 0.25f * (base.texel(3, 2, 6) + base.texel(3, 3, 6) +
                                    base.texel(3, 2, 7) + base.texel(3, 3, 7));
    EXPECT_NEAR(chain.texel(3, 1, 3, 1).x, mean.x, 1e-6f * mean.x);
}

/// The tent's definition, texel by texel in double: (1 3 3 1) x (1 3 3 1) over the 4x4 finer
/// texels, reached across edges by direction, the corner's missing texel the mean of the three
/// others; an outer texel weighs what its neighbour in the face weighs; then one factor a level and
/// channel.
glm::dvec4 definedTent(const Cubemap& fine, int face, int i, int j) {
    const int n = fine.width();
    const std::vector<double> omega = texelSolidAngles(n);
    constexpr double kTaps[4] = {1.0, 3.0, 3.0, 1.0};
    const auto byDirection = [&](int x, int y) {
        // Just outside an edge, the direction of a point as far out as the next texel's centre
        // finds the neighbour: the texel that a nearest lookup hits.
        const float scale = 2.0f / static_cast<float>(n);
        const auto outside = [&](int k) {
            return k < 0 ? -1.0001f
                         : (k >= n ? 1.0001f : (static_cast<float>(k) + 0.5f) * scale - 1.0f);
        };
        const shader::vec3 d = shader::lodestar_cubeDirection(face, outside(x), outside(y));
        const shader::vec2 uv = shader::lodestar_cubeCoordinates(d);
        const auto index = [&](float c) {
            return std::clamp(static_cast<int>((c + 1.0f) / scale), 0, n - 1);
        };
        return glm::dvec4(fine.texel(shader::lodestar_cubeFace(d), index(uv.x), index(uv.y)));
    };
    glm::dvec4 sum(0.0);
    double weights = 0.0;
    for (int b = 0; b < 4; ++b) {
        for (int a = 0; a < 4; ++a) {
            const int x = 2 * i - 1 + a;
            const int y = 2 * j - 1 + b;
            const int ix = std::clamp(x, 0, n - 1);
            const int iy = std::clamp(y, 0, n - 1);
            const bool corner = ix != x && iy != y;
            const glm::dvec4 texel =
                corner ? (byDirection(ix, iy) + byDirection(x, iy) + byDirection(ix, y)) / 3.0
                       : byDirection(x, y);
            const double w = kTaps[a] * kTaps[b] * omega[static_cast<std::size_t>(iy * n + ix)];
            sum += w * texel;
            weights += w;
        }
    }
    return sum / weights;
}

TEST(Mips, TentFollowsItsDefinition) {
    for (const int n : {36, 64}) { // level 1 has more than 16 texels a side and is no round level
        const Cubemap base = randomCube(n, 11);
        const Cubemap chain = tentMips(base);
        Cubemap defined(n / 2);
        for (int face = 0; face < 6; ++face) {
            for (int i = 0; i < n / 2 * (n / 2); ++i) {
                defined.texel(face, i % (n / 2), i / (n / 2)) =
                    glm::vec4(definedTent(base, face, i % (n / 2), i / (n / 2)));
            }
        }
        const double scale = exactMean(base, 0, 0) / exactMean(defined, 0, 0);
        for (std::size_t i = 0; i < defined.level(0).size(); ++i) {
            const double expected = static_cast<double>(defined.level(0)[i].x) * scale;
            // 16 products and sums in float: 16 * 6e-8, and the tables' rounding.
            EXPECT_NEAR(static_cast<double>(chain.level(1)[i].x), expected, 3e-6 * expected);
        }
    }
}

/// A round level's texel by its definition, in double (MIP-12): the mean over the cosine lobe about
/// its centre of the level that is read, less what lies below 1e-4 of the lobe's peak.
glm::dvec4 definedRound(const Cubemap& source, const glm::dvec3& r, double exponent) {
    const int n = source.width();
    const std::vector<double> omega = texelSolidAngles(n);
    glm::dvec4 sum(0.0);
    double weights = 0.0;
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < n * n; ++i) {
            const double x = glm::dot(testing::texelDirection(face, i % n, i / n, n), r);
            const double lobe = x > 0.0 ? std::max(std::pow(x, exponent) - 1e-4, 0.0) : 0.0;
            const double w = lobe * omega[static_cast<std::size_t>(i)];
            sum += w * glm::dvec4(source.texel(face, i % n, i / n));
            weights += w;
        }
    }
    return sum / weights;
}

/// The level of 16 texels is made from tents twice as wide, the smaller ones from tents of 16,
/// which the chain no longer holds; narrow maps from level 0.
TEST(Mips, RoundLevelsFollowTheirDefinition) {
    for (const int n : {4, 16, 17, 64}) {
        const Cubemap base = randomCube(n, 21);
        const Cubemap chain = tentMips(base);
        std::vector<Cubemap> tents{base}; // their scale cancels in the round levels' own
        while (tents.back().width() % 2 == 0 && tents.back().width() > 16) {
            const Cubemap& fine = tents.back();
            const int m = fine.width() / 2;
            Cubemap defined(m);
            for (int i = 0; i < 6 * m * m; ++i) {
                const int face = i / (m * m);
                defined.texel(face, i % m, i / m % m) =
                    glm::vec4(definedTent(fine, face, i % m, i / m % m));
            }
            tents.push_back(std::move(defined));
        }
        for (int k = 1; k < chain.levelCount(); ++k) {
            const int m = chain.width(k);
            if (m > 16) {
                continue;
            }
            const Cubemap& source = m == 16 ? tents[tents.size() - 2] : tents.back();
            const double s = exponentOfTentLevel(std::ldexp(n, -k));
            const double ratio = static_cast<double>(m) / source.width();
            const std::vector<double> omega = texelSolidAngles(m);
            Cubemap defined(m);
            for (int i = 0; i < 6 * m * m; ++i) {
                const int face = i / (m * m);
                const double hat = 0.6 * omega[static_cast<std::size_t>(i % (m * m))] *
                                   (1.0 / 6.0 + 0.25 * ratio * ratio);
                const double exponent =
                    m == 1 ? 0.0 : std::max(1.0 / (1.0 / (s + 2.0) - hat) - 2.0, 0.0);
                defined.texel(face, i % m, i / m % m) = glm::vec4(definedRound(
                    source, testing::texelDirection(face, i % m, i / m % m, m), exponent));
            }
            const double scale = exactMean(base, 0, 0) / exactMean(defined, 0, 0);
            for (std::size_t i = 0; i < defined.level(0).size(); ++i) {
                const double expected = static_cast<double>(defined.level(0)[i].x) * scale;
                // Sums in float along runs of up to 32 texels and over up to 6 x 32 runs, 6e-8
                // each, of tents that are right to 3e-6 a level.
                EXPECT_NEAR(static_cast<double>(chain.level(k)[i].x), expected, 2e-5 * expected)
                    << n << " level " << k << " texel " << i;
            }
        }
    }
}

/// A level is made for the lobe for which it is read. Up to 16 texels the level is that of round
/// ones, log2(w sqrt 3) - log2(s + 1) / 2 - 1.15, which is 0 at s + 1 = 3 w^2 2^-2.3 (MIP-5).
TEST(Mips, ALevelsExponentIsTheOneThatReadsIt) {
    for (const double width : {1.0, 1.5, 2.0, 3.0, 4.25, 8.0, 12.5, 16.0, 16.5, 16.9}) {
        const double s = exponentOfTentLevel(width);
        if (width <= 16.5) { // beyond it the transition from tents begins
            const double exact = std::max(3.0 * width * width * std::exp2(-2.3) - 1.0, 0.0);
            // A level near 12 in float, 1e-6 a rounding, is 1.4e-6 of s + 1.
            EXPECT_NEAR(s, exact, 1e-5 * (exact + 1.0)) << width;
        }
        if (s > 1e-6) { // below, the level read lies before the lobe's widest
            // Where texels have the mean size, in the middle of a long chain.
            const float y = std::sqrt(std::exp2(0.467f / 0.75f) - 1.0f);
            EXPECT_NEAR(shader::lodestar_tentLevel({1.0f, y, 0.0f}, static_cast<float>(s),
                                                   static_cast<float>(std::ldexp(width, 4)), 8.0f),
                        4.0f, 1e-5f)
                << width;
        }
    }
}

/// The same light on either side of a seam: the chain of a map that is turned is the turned chain.
/// The quarter turn about +Y carries faces +X to -Z and so on.
TEST(Mips, TentIsTheSameOnEveryFace) {
    const int n = 16;
    const Cubemap base = randomCube(n, 4);
    const auto turned = [](const glm::dvec3& d) { return glm::dvec3(d.z, d.y, -d.x); };
    const auto turn = [&](const Cubemap& map, int level) {
        const int m = map.width(level);
        Cubemap result(m);
        for (int face = 0; face < 6; ++face) {
            for (int i = 0; i < m * m; ++i) {
                const glm::vec3 d(turned(testing::texelDirection(face, i % m, i / m, m)));
                const shader::vec2 uv = shader::lodestar_cubeCoordinates(d);
                const auto index = [m](float c) {
                    return std::clamp(static_cast<int>((c + 1.0f) * 0.5f * static_cast<float>(m)),
                                      0, m - 1);
                };
                result.texel(face, i % m, i / m) =
                    map.texel(shader::lodestar_cubeFace(d), index(uv.x), index(uv.y), level);
            }
        }
        return result;
    };
    const Cubemap chain = tentMips(base);
    const Cubemap chainOfTurned = tentMips(turn(base, 0));
    for (int k = 1; k < chain.levelCount(); ++k) {
        const Cubemap expected = turn(chain, k);
        for (std::size_t i = 0; i < expected.level(0).size(); ++i) {
            const float e = expected.level(0)[i].x;
            // The order of sums differs: a few ulp a level.
            EXPECT_NEAR(chainOfTurned.level(k)[i].x, e, 5e-6f * e) << k;
        }
    }
}

TEST(Mips, InPlaceIsTheSameAndAgain) {
    Cubemap chain = tentMips(randomCube(64, 8));
    const Cubemap before = chain;
    fillTentMips(chain);
    for (int k = 0; k < chain.levelCount(); ++k) {
        EXPECT_EQ(chain.level(k), before.level(k));
    }
}

/// Tables are shared between threads and made on demand.
TEST(Mips, ThreadsMakeTheSameChain) {
    const Cubemap base = randomCube(48, 6);
    std::vector<Cubemap> chains(4);
    std::vector<std::thread> threads;
    for (Cubemap& chain : chains) {
        threads.emplace_back([&] { chain = tentMips(base); });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    for (const Cubemap& chain : chains) {
        for (int k = 0; k < chain.levelCount(); ++k) {
            EXPECT_EQ(chain.level(k), chains[0].level(k));
        }
    }
}

} // namespace
} // namespace lodestar::lighting

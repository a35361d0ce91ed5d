// SPDX-License-Identifier: MIT
//
// A probe's mips and irradiance as passes make them, against the CPU's.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include <epoxy/gl.h>
#include <glm/geometric.hpp>

#include "gl/probe_filter.h"
#include "lighting/environment.h"
#include "lighting/mips.h"
#include "lodestar/cube.glsl"
#include "lodestar/sh9.glsl"
#include "support/probe_chain.h"

namespace lodestar {
namespace {

using lighting::Cubemap;

using testing::ProbeChainTest;
class ProbeFilterTest : public ProbeChainTest {};

Cubemap constant(const glm::vec3& radiance, int width) {
    return lighting::cubeFromAnalytic(lighting::ConstantEnvironment{glm::dvec3(radiance)}, width);
}

/// A lamp about a direction, of 5 degrees' radius, 100 times the rest.
Cubemap lamp(const glm::dvec3& axis, int width) {
    return lighting::cubeFromAnalytic(lighting::DiscEnvironment{glm::normalize(axis), 0.0873,
                                                                glm::dvec3(100.0),
                                                                glm::dvec3(0.05)},
                                      width);
}

// Half floats hold 11 bits: a texel that is rounded once is 2^-11 off at most, and a value that is
// made of equal ones is rounded once more.
TEST_F(ProbeFilterTest, AConstantStaysConstant) {
    for (const int width : {1, 2, 3, 8, 16, 32, 100, 128}) {
        const Cubemap map = filtered(constant(glm::vec3(0.7f, 1.0f, 40.0f), width));
        for (int level = 0; level < map.levelCount(); ++level) {
            for (const glm::vec4& texel : map.level(level)) {
                ASSERT_NEAR(texel.r, 0.7f, 0.7f * 0.001f) << width << " level " << level;
                ASSERT_NEAR(texel.g, 1.0f, 0.001f) << width << " level " << level;
                ASSERT_NEAR(texel.b, 40.0f, 40.0f * 0.001f) << width << " level " << level;
            }
        }
    }
}

// Tents keep the mean but for the kink of the solid angle at edges, round levels because their
// weights are balanced; half floats round 5e-4. A lamp at a corner is the worst: 6e-4 were
// measured. The one texel of a last level is the mean over a hemisphere by fetches of four texels,
// which weigh those of a corner of the level of 8 by 1.3 % too much or too little: products cannot
// follow solid angles there.
TEST_F(ProbeFilterTest, EveryLevelKeepsTheMean) {
    for (const int width : {128, 64, 256}) {
        for (const glm::dvec3& axis : {glm::dvec3(1, 1, 1), glm::dvec3(1, 0, 0),
                                       glm::dvec3(1, 0.9, 0.1), glm::dvec3(0.3, -1, 0.4)}) {
            const Cubemap map = filtered(lamp(axis, width));
            const glm::dvec4 truth = lighting::sphereMean(map, 0);
            for (int level = 1; level < map.levelCount(); ++level) {
                const glm::dvec4 mean = lighting::sphereMean(map, level);
                const double most = map.width(level) > 1 ? 1e-3 : 2e-3;
                EXPECT_NEAR(mean.g, truth.g, most * truth.g) << width << " level " << level;
                EXPECT_NEAR(mean.a, truth.a, most * truth.a) << width << " level " << level;
            }
        }
    }
}

// Odd widths and tiny ones too. A triangle of r = n / m finer texels to both sides, sampled at
// their centres, sums to r^2 but for f (1 - f) of it, f = r - 2, along each axis, by where it lies;
// what is left at the kinks is of second order, and tents may be as narrow as 17 texels, not 32 or
// more.
TEST_F(ProbeFilterTest, OddWidthsKeepTheMeanToo) {
    for (const int width : {1, 2, 3, 5, 6, 7, 17, 31, 65, 80, 100, 127}) {
        for (const glm::dvec3& axis : {glm::dvec3(1, 1, 1), glm::dvec3(1, 0, 0),
                                       glm::dvec3(1, 0.9, 0.1), glm::dvec3(0.3, -1, 0.4)}) {
            const Cubemap map = filtered(lamp(axis, width));
            const glm::dvec4 truth = lighting::sphereMean(map, 0);
            double kinks = 1e-3, odd = 0.0;
            for (int level = 1; level < map.levelCount(); ++level) {
                if (map.width(level) > 16) {
                    const double ratio =
                        static_cast<double>(map.width(level - 1)) / map.width(level);
                    const double narrow = std::max(32.0 / map.width(level), 1.0);
                    kinks = 1e-3 * narrow * narrow;
                    odd += 2.0 * (ratio - 2.0) * (3.0 - ratio) / (ratio * ratio);
                }
                const double most = kinks + odd + (map.width(level) > 1 ? 0.0 : 1.5e-3);
                EXPECT_NEAR(lighting::sphereMean(map, level).g, truth.g, most * truth.g)
                    << width << " level " << level;
            }
        }
    }
}

// A lookup through the passes' chain against the CPU's, relative RMS over the sphere: weights are
// the CPU's but for balance, and products within four texels. .034 were measured where both are
// .12 to .2 wrong against the truth (gl-probe-ladder).
TEST_F(ProbeFilterTest, LooksLikeTheCpusChain) {
    std::mt19937 random(3);
    struct Case {
        const char* name;
        Cubemap base;
        double bound;
    };
    const Case cases[] = {
        {"lamp at a corner", lamp({1, 1, 1}, 128), 0.04},
        {"lamp at a face's middle", lamp({0, 0, 1}, 128), 0.04},
        {"sky", lighting::cubeFromAnalytic(lighting::ClearSkyEnvironment{}, 128), 0.04},
        {"faces",
         lighting::cubeFromAnalytic(
             lighting::FacesEnvironment{{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 1),
                                         glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 1),
                                         glm::dvec3(0, 0, 1), glm::dvec3(1, 1, 0)}},
             128),
         0.01},
    };
    for (const Case& each : cases) {
        const Cubemap ours = filtered(each.base);
        const Cubemap theirs = lighting::tentMips(each.base);
        for (const float exponent : {1.0f, 4.0f, 16.0f, 64.0f, 256.0f, 1024.0f, 4096.0f}) {
            double off = 0.0, sum = 0.0;
            for (int i = 0; i < 4000; ++i) {
                const glm::vec3 d = testing::randomDirection(random);
                const float level = shader::lodestar_tentLevel(d, exponent, 128.0f, 7.0f);
                const glm::dvec3 a(ours.sample(d, level)), b(theirs.sample(d, level));
                off += glm::dot(a - b, a - b);
                sum += glm::dot(b, b);
            }
            const double rms = std::sqrt(off / sum);
            EXPECT_LT(rms, each.bound) << each.name << ", exponent " << exponent;
        }
    }
}

// The tile against the nine coefficients of level 0, most of all along the octahedron's folds,
// where a bilinear fetch would miss the turn of the slope. Of a lamp of one point, the worst there
// is, 1.8 % of the brightest are left in the middle of texels that the diagonals' folds cross,
// where 24 texels with a border, beside the folds, had 4.2 %; tents of 32 texels take .3 % of the
// second order.
TEST_F(ProbeFilterTest, IrradianceIsThatOfNineCoefficients) {
    std::mt19937 random(5);
    std::vector<Cubemap> bases;
    for (const int width : {1, 2, 3, 5, 12, 65, 100, 127, 128}) {
        for (const glm::dvec3& axis :
             {glm::dvec3(1, 1, 1), glm::dvec3(0.1, 1, 0.2), glm::dvec3(1, 0, 0)}) {
            bases.push_back(lamp(axis, width));
        }
        bases.push_back(lighting::cubeFromAnalytic(lighting::ClearSkyEnvironment{}, width));
    }
    for (const Cubemap& base : bases) {
        const testing::Tile tile = irradianceOf(base);
        const lighting::Sh9Coefficients c = lighting::sh9FromCube(base);
        double worst = 0.0, brightest = 0.0;
        for (int i = 0; i < 4000; ++i) {
            glm::vec3 n = testing::randomDirection(random);
            if (i % 4 < 3) {
                n[i % 4] = 0.0f; // a fold
                n = glm::normalize(n);
            }
            const glm::vec3 truth =
                shader::lodestar_sh9(c[0], c[1], c[2], c[3], c[4], c[5], c[6], c[7], c[8], n);
            worst = std::max(worst, static_cast<double>(std::abs(tile.read(n).g - truth.g)));
            brightest = std::max(brightest, static_cast<double>(truth.g));
        }
        EXPECT_LT(worst, 0.018 * brightest) << base.width();
    }
}

} // namespace
} // namespace lodestar

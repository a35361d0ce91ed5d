// SPDX-License-Identifier: MIT
//
// The ladder of a light probe: what a lookup of the estimator `tent` is wrong by, as relative RMSE
// over the sphere and RGB against sums over all texels, from the chain that passes make and from
// the CPU's of the same cube.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <random>
#include <vector>

#include <glm/geometric.hpp>

#include "lighting/lookup.h"
#include "lighting/mips.h"
#include "lodestar/cube.glsl"
#include "lodestar/sh9.glsl"
#include "numerics/ladder_truth.h"
#include "support/probe_chain.h"

namespace lodestar::testing {
namespace {

using lighting::Cubemap;

/// A bare sun: one texel on a dim sky.
NamedCube sun(const char* name, int width, int face, int x, int y) {
    Cubemap cube = constantCube(width, glm::vec4(0.05f, 0.05f, 0.05f, 1.0f));
    cube.texel(face, x, y) = glm::vec4(1e4f, 0.95e4f, 0.85e4f, 1.0f);
    return {name, std::move(cube)};
}

std::vector<NamedCube> panoramasAndShapes(int width) {
    std::vector<NamedCube> all = analyticSet(width);
    if (std::filesystem::exists(panoramaPath("sunset"))) {
        for (NamedCube& cube : panoramaSet({"sunset", "interior", "courtyard", "forest"}, width)) {
            all.push_back(std::move(cube));
        }
    } else {
        std::printf("without the panoramas of blender-data, which this machine lacks\n");
    }
    return all;
}

/// At a face's middle, at a corner of the cube, at an edge, and at no such place.
std::vector<NamedCube> suns(int width) {
    return {sun("middle", width, 4, width / 2, width / 2),
            sun("corner", width, 4, width - 1, width - 1), sun("edge", width, 0, 0, width / 3),
            sun("any", width, 2, width * 5 / 7, width / 5)};
}

/// Relative mean squares, of the passes' chain and of the CPU's.
struct Squares {
    double ours = 0.0;
    double theirs = 0.0;

    void add(const Squares& other) {
        ours += other.ours;
        theirs += other.theirs;
    }
    [[nodiscard]] double ratio() const { return std::sqrt(ours / theirs); }
};

class ProbeLadderTest : public ProbeChainTest {
protected:
    /// [environment][exponent]
    std::vector<std::vector<Squares>> measure(const std::vector<NamedCube>& environments) {
        const int width = environments.front().base.width();
        const std::vector<WeightedDirection> directions = ladderDirections();
        const std::vector<glm::dvec3> truth = lobeMeans(environments, directions);
        std::vector<std::vector<Squares>> result;
        for (std::size_t k = 0; k < environments.size(); ++k) {
            const Cubemap ours = filtered(environments[k].base);
            const Cubemap theirs = lighting::tentMips(environments[k].base);
            const auto last = static_cast<float>(ours.levelCount() - 1);
            std::printf("%4d %-10s", width, environments[k].name.c_str());
            std::vector<Squares>& row = result.emplace_back();
            for (std::size_t e = 0; e < exponentCount(width); ++e) {
                const auto exponent = static_cast<float>(ladderExponents()[e]);
                Squares off;
                double norm = 0.0;
                for (std::size_t i = 0; i < directions.size(); ++i) {
                    const glm::vec3 d(directions[i].direction);
                    const float level =
                        shader::lodestar_tentLevel(d, exponent, static_cast<float>(width), last);
                    const glm::dvec3 t =
                        truth[(i * ladderExponents().size() + e) * environments.size() + k];
                    const glm::dvec3 a = glm::dvec3(ours.sample(d, level)) - t;
                    const glm::dvec3 b = glm::dvec3(theirs.sample(d, level)) - t;
                    off.add({directions[i].weight * glm::dot(a, a),
                             directions[i].weight * glm::dot(b, b)});
                    norm += directions[i].weight * glm::dot(t, t);
                }
                row.push_back({off.ours / norm, off.theirs / norm});
                std::printf(" %.4f/%.4f", std::sqrt(row.back().ours), std::sqrt(row.back().theirs));
            }
            std::printf("\n");
        }
        return result;
    }
    /// Lobes whose means a cube so wide tells: at most 3 w^2 / 16 of them on the sphere.
    static std::size_t exponentCount(int width) {
        std::size_t count = 0;
        while (count < ladderExponents().size() &&
               ladderExponents()[count] + 1 <= 3 * width * width / 16) {
            ++count;
        }
        return count;
    }
    /// As the ladder is reported: by environment over the exponents, by exponent over the
    /// environments.
    void compare(const std::vector<NamedCube>& environments) {
        const int width = environments.front().base.width();
        Squares all;
        std::vector<Squares> byExponent(exponentCount(width));
        const std::vector<std::vector<Squares>> squares = measure(environments);
        for (std::size_t k = 0; k < environments.size(); ++k) {
            Squares sum;
            for (std::size_t e = 0; e < byExponent.size(); ++e) {
                sum.add(squares[k][e]);
                byExponent[e].add(squares[k][e]);
            }
            EXPECT_LE(sum.ratio(), 1.1) << width << ", " << environments[k].name;
            all.add(sum);
        }
        for (std::size_t e = 0; e < byExponent.size(); ++e) {
            EXPECT_LE(byExponent[e].ratio(), 1.1) << width << ", " << ladderExponents()[e];
        }
        std::printf("%4d: %.3f of the CPU's\n", width, all.ratio());
    }
};

TEST_F(ProbeLadderTest, IsAsGoodAsTheCpusChain) {
    for (const int width : {64, 128, 256}) {
        compare(panoramasAndShapes(width));
    }
}

TEST_F(ProbeLadderTest, OfOddCubesToo) {
    for (const int width : {12, 17, 31, 65, 100, 127}) {
        compare(panoramasAndShapes(width));
    }
}

// Cubes so narrow that every round level is read from level 0, some lobes wider than a face: means
// over 54 and 150 texels, balanced here so that each counts by its solid angle, scaled as a whole
// on the CPU. Neither is nearer for each of them; 1.17 and 1.13 were measured for all together.
TEST_F(ProbeLadderTest, OfTinyCubesWithinAFifth) {
    for (const int width : {3, 5}) {
        Squares all;
        for (const std::vector<Squares>& row : measure(panoramasAndShapes(width))) {
            for (const Squares& one : row) {
                all.add(one);
            }
        }
        EXPECT_LE(all.ratio(), 1.2) << width;
    }
}

// Where one texel holds the light, it shows most by which weights a level is summed.
TEST_F(ProbeLadderTest, OfABareSunToo) {
    for (const int width : {64, 128, 256}) {
        compare(suns(width));
    }
}

// Irradiance against cosine means, summed in double precision over all texels: as wrong as nine
// coefficients are, and by the triangle's inequality at most so much more as the tile differs from
// them. That is .008 of a lamp of one point, the sharpest there is.
TEST_F(ProbeLadderTest, IrradianceToo) {
    for (const NamedCube& environment : panoramasAndShapes(128)) {
        const Tile tile = irradianceOf(environment.base);
        const lighting::Sh9Coefficients c = lighting::sh9FromCube(environment.base);
        Squares off;
        double norm = 0.0;
        std::mt19937 random(11);
        for (int i = 0; i < 400; ++i) {
            const glm::vec3 n = randomDirection(random);
            const glm::dvec3 truth = lighting::referencePhong(environment.base, glm::dvec3(n), 1.0);
            const glm::dvec3 a = glm::dvec3(tile.read(n)) - truth;
            const glm::dvec3 b = glm::dvec3(shader::lodestar_sh9(c[0], c[1], c[2], c[3], c[4], c[5],
                                                                 c[6], c[7], c[8], n)) -
                                 truth;
            off.add({glm::dot(a, a), glm::dot(b, b)});
            norm += glm::dot(truth, truth);
        }
        const double ours = std::sqrt(off.ours / norm);
        const double theirs = std::sqrt(off.theirs / norm);
        std::printf("%-10s %.4f/%.4f\n", environment.name.c_str(), ours, theirs);
        EXPECT_LE(ours, theirs + 0.008) << environment.name;
        EXPECT_LE(ours, 0.09) << environment.name; // a lamp alone; .04 on panoramas
    }
}

} // namespace
} // namespace lodestar::testing

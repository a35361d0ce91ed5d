// SPDX-License-Identifier: MIT
//
// What the driver fetches of a light probe on walks over the sphere: across the cube's edges and
// corners and the octahedron's folds and sides nothing jumps.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <epoxy/gl.h>
#include <glm/geometric.hpp>

#include "gl/shader_source.h"
#include "lighting/cube_seams.h"
#include "lighting/environment.h"
#include "support/glsl_function.h"
#include "support/probe_chain.h"

namespace lodestar::testing {
namespace {

using lighting::Cubemap;
using Path = std::vector<glm::vec3>;

/// The unit that is read from; 0 holds the evaluation's inputs.
constexpr int kUnit = 1;

/// Unit directions a step apart on the great circle through one, along a tangent, as far to both
/// sides.
Path arc(const glm::vec3& middle, const glm::vec3& towards, float step, int steps) {
    const glm::vec3 n = glm::normalize(middle);
    const glm::vec3 t = glm::normalize(towards - glm::dot(towards, n) * n);
    Path path;
    for (int i = -steps; i <= steps; ++i) {
        const float angle = step * static_cast<float>(i);
        path.push_back(std::cos(angle) * n + std::sin(angle) * t);
    }
    return path;
}

/// Once about a direction, at an angle from it.
Path circle(const glm::vec3& about, float angle, float step) {
    const glm::vec3 n = glm::normalize(about);
    const glm::vec3 s = glm::normalize(glm::cross(n, glm::vec3(0.3f, 0.5f, -0.8f)));
    const glm::vec3 t = glm::cross(n, s);
    const int steps =
        static_cast<int>(std::ceil(2.0f * std::numbers::pi_v<float> * std::sin(angle) / step));
    Path path;
    for (int i = 0; i <= steps; ++i) {
        const float turn =
            2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(steps);
        path.push_back(std::cos(angle) * n +
                       std::sin(angle) * (std::cos(turn) * s + std::sin(turn) * t));
    }
    return path;
}

float angleBetween(const glm::vec3& a, const glm::vec3& b) {
    return 2.0f * std::asin(std::min(0.5f * glm::length(a - b), 1.0f));
}

/// Paths over the edges and corners of a cube: across them, along them, about the corners.
std::vector<Path> cubePaths(float step, std::mt19937& random) {
    std::uniform_real_distribution<float> along(-0.97f, 0.97f);
    std::vector<Path> paths;
    for (int axis = 0; axis < 3; ++axis) {
        for (int signs = 0; signs < 4; ++signs) {
            glm::vec3 d(0.0f), edge(0.0f);
            d[(axis + 1) % 3] = (signs & 1) != 0 ? 1.0f : -1.0f;
            d[(axis + 2) % 3] = (signs & 2) != 0 ? 1.0f : -1.0f;
            edge[axis] = 1.0f;
            paths.push_back(arc(d, edge, step, static_cast<int>(0.65f / step))); // beyond corners
            for (int i = 0; i < 3; ++i) {
                d[axis] = along(random);
                paths.push_back(arc(d, glm::cross(d, edge), step, 48));
            }
        }
    }
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 d((corner & 1) != 0 ? 1.0f : -1.0f, (corner & 2) != 0 ? 1.0f : -1.0f,
                          (corner & 4) != 0 ? 1.0f : -1.0f);
        for (int i = 0; i < 3; ++i) {
            paths.push_back(arc(d, randomDirection(random), step, 48));
        }
        paths.push_back(circle(d, 4.0f * step, step));
        paths.push_back(circle(d, 24.0f * step, step));
    }
    return paths;
}

/// Paths over the folds and sides of the tile's octahedron, and over its corners.
std::vector<Path> octahedronPaths(float step, std::mt19937& random) {
    std::vector<Path> paths;
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 across(0.0f);
        across[axis] = 1.0f;
        for (int i = 0; i < 12; ++i) {
            glm::vec3 d = randomDirection(random);
            d[axis] = 0.0f;
            paths.push_back(arc(d, across, step, 48));
        }
        for (const glm::vec3& corner : {across, -across}) {
            for (int i = 0; i < 4; ++i) {
                paths.push_back(arc(corner, randomDirection(random), step, 48));
            }
            paths.push_back(circle(corner, 3.0f * step, step));
            glm::vec3 other(0.0f);
            other[(axis + 1) % 3] = 1.0f;
            paths.push_back(arc(corner, other, step, static_cast<int>(1.6f / step))); // a fold
        }
    }
    return paths;
}

/// The least and the greatest of some texels, by channel.
struct Range {
    glm::vec3 low{1e30f}, high{-1e30f};

    void add(const glm::vec3& value) {
        low = glm::min(low, value);
        high = glm::max(high, value);
    }
    void add(const Range& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
};

/// Of the sixteen texels about a direction, as many as the face and those beside it have.
Range texelsAbout(const Cubemap& map, int level, const glm::vec3& d) {
    const int n = map.width(level);
    const int face = shader::lodestar_cubeFace(d);
    const glm::vec2 at =
        (shader::lodestar_cubeCoordinates(d) * 0.5f + 0.5f) * static_cast<float>(n) - 0.5f;
    const glm::ivec2 low(glm::floor(at));
    Range range;
    for (int y = low.y - 1; y <= low.y + 2; ++y) {
        for (int x = low.x - 1; x <= low.x + 2; ++x) {
            range.add(glm::vec3(lighting::seamlessTexel(map, level, face, std::clamp(x, -1, n),
                                                        std::clamp(y, -1, n))));
        }
    }
    return range;
}

Range texelsAbout(const Tile& tile, const glm::vec3& d) {
    const glm::ivec2 low(glm::floor(shader::lodestar_irradianceTexel(d) - 0.5f));
    Range range;
    for (int y = low.y - 1; y <= low.y + 2; ++y) {
        for (int x = low.x - 1; x <= low.x + 2; ++x) {
            range.add(glm::vec3(tile.texels[static_cast<std::size_t>(
                std::clamp(y, 0, gl::kTileWidth - 1) * gl::kTileWidth +
                std::clamp(x, 0, gl::kTileWidth - 1))]));
        }
    }
    return range;
}

/// What two fetches a step apart may differ by: a part of the range of the texels about them, and
/// a part of the greatest of these.
struct Allowed {
    Range texels;
    float part = 0.0f;
    float rounding = 1e-6f;
};
using Allowance = std::function<Allowed(const glm::vec3&, const glm::vec3&)>;

class ProbeWalk : public ProbeChainTest {
protected:
    GlslFunction functionOf(const std::string& samplers, const std::string& expression) {
        auto text = gl::assembleShader("lodestar/cube.glsl", 330, {});
        EXPECT_TRUE(text.ok());
        auto made = GlslFunction::make(device(), 330, *text + samplers, expression);
        EXPECT_TRUE(made.ok()) << made.error().message();
        for (const char* name : {"uCube", "uTile"}) {
            made->setSampler(name, kUnit);
        }
        return std::move(*made);
    }
    /// Binds what is read; other textures are made on another unit.
    static void show(const gl::Texture& texture) {
        texture.bind(kUnit);
        glActiveTexture(GL_TEXTURE0);
    }
    /// @param more p1 of every case  @return the largest step, in what is allowed of it
    static double worstStep(GlslFunction& function, const std::vector<Path>& paths,
                            const glm::vec4& more, const Allowance& allowance) {
        double worst = 0.0;
        for (const Path& path : paths) {
            std::vector<glm::vec4> values;
            for (std::size_t first = 0; first < path.size(); first += 4096) {
                std::vector<GlslCase> cases;
                for (std::size_t i = first; i < std::min(path.size(), first + 4096); ++i) {
                    cases.push_back({glm::vec4(path[i], 0.0f), more});
                }
                const std::vector<glm::vec4> some = function.evaluate(cases);
                values.insert(values.end(), some.begin(), some.end());
            }
            for (std::size_t i = 1; i < values.size(); ++i) {
                const Allowed allowed = allowance(path[i - 1], path[i]);
                for (int c = 0; c < 3; ++c) {
                    const float most =
                        allowed.part * (allowed.texels.high[c] - allowed.texels.low[c]) +
                        allowed.rounding * allowed.texels.high[c];
                    const float step = std::abs(values[i][c] - values[i - 1][c]);
                    worst = std::max(worst, static_cast<double>(step / most));
                }
            }
        }
        return worst;
    }
    /// Rough, with lamps a thousand times as bright on an edge and a corner of the cube.
    static Cubemap rough(int width) {
        Cubemap cube = randomCube(width, 17);
        for (glm::vec4& texel : cube.level(0)) {
            texel = glm::vec4(0.1f * glm::vec3(texel), 1.0f);
        }
        cube.texel(0, 0, width / 3) = glm::vec4(1e4f, 0.9e4f, 0.5e4f, 1.0f);
        cube.texel(3, width - 1, width - 1) = glm::vec4(0.5e4f, 1e4f, 0.9e4f, 1.0f);
        return cube;
    }
};

// Bilinear fetches change by at most the range of the texels about them times the steps along
// columns and rows. An angle is stretched 1 + u^2 + v^2 times on a face, 3 at most, a face is 2
// wide, and the sum of two steps is sqrt(2) times their length at most. A driver holds the weights
// of each axis in 8 bits at least.
constexpr float kStretch = 1.41421356f * 3.0f / 2.0f;
constexpr float kWeight = 1.0f / 256.0f;
constexpr float kTexelStep = 1.0f / 48.0f; // texels a step, as wide as they are at a face's middle

TEST_F(ProbeWalk, NoLevelJumpsAcrossEdgesAndCorners) {
    for (const int width : {64, 27}) {
        const gl::Texture cube = targetOf(rough(width));
        filter_->fillMips(cube, cube.levelCount() - 1);
        const Cubemap map = read(cube, cube.levelCount());
        GlslFunction fetch = functionOf("uniform samplerCube uCube;",
                                        "vec4(textureLod(uCube, p0.xyz, p1.x).rgb, 1.0)");
        for (int level = 0; level < cube.levelCount(); ++level) {
            std::mt19937 random(29);
            const auto texels = static_cast<float>(map.width(level));
            const std::vector<Path> paths = cubePaths(kTexelStep * 2.0f / texels, random);
            const Allowance allowance = [&](const glm::vec3& a, const glm::vec3& b) {
                Allowed allowed{texelsAbout(map, level, a)};
                allowed.texels.add(texelsAbout(map, level, b));
                allowed.part = kStretch * texels * angleBetween(a, b) + 2.0f * kWeight;
                return allowed;
            };
            show(cube);
            const auto at = glm::vec4(static_cast<float>(level), 0.0f, 0.0f, 0.0f);
            const double seamless = worstStep(fetch, paths, at, allowance);
            glDisable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
            const double apart = worstStep(fetch, paths, at, allowance);
            glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
            std::printf("%d, level %d: %.2f of what a step explains, faces apart %.2f\n", width,
                        level, seamless, apart);
            EXPECT_LE(seamless, 1.0) << width << " level " << level;
            EXPECT_GT(apart, 2.0) << "faces that do not know of each other must fail";
        }
    }
}

// What shading reads: the level follows the texels' size, which has a kink at edges and no jump.
// Between two levels the fetch changes by at most the range of both's texels times the step of the
// level; drivers may mix levels over half of the way (llvmpipe does), twice as fast.
TEST_F(ProbeWalk, NoLookupJumps) {
    constexpr int kWidth = 64;
    const gl::Texture cube = targetOf(rough(kWidth));
    filter_->fillMips(cube, cube.levelCount() - 1);
    const Cubemap map = read(cube, cube.levelCount());
    const auto last = static_cast<float>(cube.levelCount() - 1);
    GlslFunction fetch = functionOf(
        "uniform samplerCube uCube;",
        "vec4(textureLod(uCube, p0.xyz, lodestar_tentLevel(p0.xyz, p1.x, p1.y, p1.z)).rgb, 1.0)");
    for (const float exponent : {1.0f, 8.0f, 30.0f, 60.0f, 250.0f, 1000.0f}) {
        const auto levelAt = [&](const glm::vec3& d) {
            return shader::lodestar_tentLevel(d, exponent, kWidth, last);
        };
        const int finest = std::max(static_cast<int>(levelAt(glm::vec3(0.577f)) - 1.5f), 0);
        const auto texels = static_cast<float>(map.width(finest));
        std::mt19937 random(31);
        const std::vector<Path> paths = cubePaths(kTexelStep * 2.0f / texels, random);
        const Allowance allowance = [&](const glm::vec3& a, const glm::vec3& b) {
            const float one = levelAt(a), other = levelAt(b);
            const int low = static_cast<int>(std::min(one, other));
            const int high =
                std::min(static_cast<int>(std::max(one, other)) + 1, map.levelCount() - 1);
            Allowed allowed;
            for (int level = low; level <= high; ++level) {
                allowed.texels.add(texelsAbout(map, level, a));
                allowed.texels.add(texelsAbout(map, level, b));
            }
            allowed.part = kStretch * static_cast<float>(map.width(low)) * angleBetween(a, b) +
                           2.0f * std::abs(one - other) + 3.0f * kWeight;
            return allowed;
        };
        show(cube);
        const double worst =
            worstStep(fetch, paths, glm::vec4(exponent, kWidth, last, 0.0f), allowance);
        std::printf("exponent %g: %.2f of what a step explains\n", static_cast<double>(exponent),
                    worst);
        EXPECT_LE(worst, 1.0) << exponent;
    }
}

// An angle is stretched sqrt(3) times on the octahedron at most (a plane 1 / sqrt(3) away, seen at
// most as far as 1) and flattened; half of the tile's 24 pitches are 1. At its sides fetches stay
// 1/400 of a texel short of the outermost texels' centres, which hold the same direction's value
// as the texel that the side is glued to, both rounded to half floats, each of a sum of nine terms.
TEST_F(ProbeWalk, NoIrradianceJumpsAcrossFoldsAndSides) {
    constexpr float kPitches = 0.5f * (gl::kTileWidth - 1);
    constexpr float kShort = 2.0f * 2.0f * 0.0002f * kPitches;
    const Cubemap lamps[] = {
        rough(64),
        lighting::cubeFromAnalytic(lighting::DiscEnvironment{glm::normalize(glm::dvec3(1, -1, 0)),
                                                             0.0873, glm::dvec3(100.0),
                                                             glm::dvec3(0.05)},
                                   64),
        lighting::cubeFromAnalytic(lighting::DiscEnvironment{glm::dvec3(0, -1, 0), 0.0873,
                                                             glm::dvec3(100.0), glm::dvec3(0.05)},
                                   64)};
    std::mt19937 random(37);
    const std::vector<Path> paths = octahedronPaths(kTexelStep / kPitches, random);
    for (const Cubemap& base : lamps) {
        const gl::Texture cube = targetOf(base);
        (void)*atlas_.add(); // another's lies beside it
        const int number = *atlas_.add();
        filter_->fill(cube, cube.levelCount() - 1, atlas_, number);
        const Tile tile = read(number);
        const glm::ivec2 first = atlas_.tile(number);
        const Allowance allowance = [&](const glm::vec3& a, const glm::vec3& b) {
            Allowed allowed{texelsAbout(tile, a)};
            allowed.texels.add(texelsAbout(tile, b));
            allowed.part =
                1.41421356f * 1.7320508f * kPitches * angleBetween(a, b) + 2.0f * kWeight + kShort;
            allowed.rounding = 1.0f / 1024.0f;
            return allowed;
        };
        const std::string read = "vec4(textureLod(uTile, (p1.xy + lodestar_irradianceTexel(p0.xyz)"
                                 ") / vec2(textureSize(uTile, 0)), 0.0).rgb, 1.0)";
        const glm::vec4 at(static_cast<float>(first.x), static_cast<float>(first.y), 0.0f, 0.0f);
        GlslFunction fetch = functionOf("uniform sampler2D uTile;", read);
        show(atlas_.texture());
        const double worst = worstStep(fetch, paths, at, allowance);
        // Half a texel aside, sides read what lies beside the tile.
        const double aside = worstStep(fetch, paths, at + glm::vec4(0.5f), allowance);
        std::printf("irradiance: %.2f of what a step explains, half a texel aside %.2f\n", worst,
                    aside);
        EXPECT_LE(worst, 1.0);
        EXPECT_GT(aside, 2.0) << "a tile that is read beyond its sides must fail";
    }
}

} // namespace
} // namespace lodestar::testing

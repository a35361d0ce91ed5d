// SPDX-License-Identifier: MIT
#include "lighting/cubemap.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/contract.h"
#include "lodestar/cube.glsl"

#include "lighting/cube_seams.h"
#include "lighting/solid_angle.h"

namespace lodestar::lighting {

namespace {

constexpr int kFaces = 6;
constexpr int kMaxWidth = 16384;

/// The seams of a cube of 2x2 faces; those of any width follow by scaling.
struct SeamOfTwo {
    int face = 0;
    int x[2] = {0, 0}; ///< column, 0 or 1, of the texels across from t = 0 and t = 1
    int y[2] = {0, 0};
};

SeamOfTwo makeSeam(int face, Edge edge) {
    SeamOfTwo seam;
    for (int t = 0; t < 2; ++t) {
        const float along = t == 0 ? -0.5f : 0.5f;
        const float out = 1.001f; // just over the edge; any amount below 1 finds the same texel
        const bool vertical = edge == Edge::Left || edge == Edge::Right;
        const float side = edge == Edge::Left || edge == Edge::Top ? -out : out;
        const shader::vec3 d =
            shader::lodestar_cubeDirection(face, vertical ? side : along, vertical ? along : side);
        const shader::vec2 uv = shader::lodestar_cubeCoordinates(d);
        seam.face = shader::lodestar_cubeFace(d);
        seam.x[t] = uv.x > 0.0f ? 1 : 0;
        seam.y[t] = uv.y > 0.0f ? 1 : 0;
    }
    return seam;
}

using SeamTable = std::array<std::array<SeamOfTwo, 4>, kFaces>;

SeamTable makeSeams() {
    SeamTable table;
    for (int face = 0; face < kFaces; ++face) {
        for (int edge = 0; edge < 4; ++edge) {
            table[static_cast<std::size_t>(face)][static_cast<std::size_t>(edge)] =
                makeSeam(face, static_cast<Edge>(edge));
        }
    }
    return table;
}

glm::vec4 mix(const glm::vec4& a, const glm::vec4& b, float t) {
    return a * (1.0f - t) + b * t;
}

} // namespace

int fullLevelCount(int width) {
    LODESTAR_EXPECT(width >= 1, "a cube map's width is at least 1");
    return static_cast<int>(std::bit_width(static_cast<unsigned>(width)));
}

Cubemap::Cubemap(int width, int levelCount) : width_(width) {
    LODESTAR_EXPECT(width >= 1 && width <= kMaxWidth, "a cube map's width is in [1, 16384]");
    LODESTAR_EXPECT(levelCount >= 1 && levelCount <= fullLevelCount(width),
                    "a cube map has between one level and the full chain");
    levels_.resize(static_cast<std::size_t>(levelCount));
    for (int k = 0; k < levelCount; ++k) {
        const auto n = static_cast<std::size_t>(this->width(k));
        level(k).resize(kFaces * n * n);
    }
}

int Cubemap::width(int level) const {
    return std::max(1, width_ >> level);
}

glm::vec4& Cubemap::texel(int face, int x, int y, int level) {
    const int n = width(level);
    return this->level(
        level)[static_cast<std::size_t>((face * n + y)) * static_cast<std::size_t>(n) +
               static_cast<std::size_t>(x)];
}

const glm::vec4& Cubemap::texel(int face, int x, int y, int level) const {
    const int n = width(level);
    return this->level(
        level)[static_cast<std::size_t>((face * n + y)) * static_cast<std::size_t>(n) +
               static_cast<std::size_t>(x)];
}

SeamWalk seamWalk(int face, Edge edge, int width) {
    static const SeamTable seams = makeSeams();
    const SeamOfTwo& seam = seams[static_cast<std::size_t>(face)][static_cast<std::size_t>(edge)];
    return {seam.face, seam.x[0] * (width - 1), seam.y[0] * (width - 1), seam.x[1] - seam.x[0],
            seam.y[1] - seam.y[0]};
}

glm::vec4 seamlessTexel(const Cubemap& map, int level, int face, int x, int y) {
    const int n = map.width(level);
    const bool outX = x < 0 || x >= n;
    const bool outY = y < 0 || y >= n;
    if (!outX && !outY) {
        return map.texel(face, x, y, level);
    }
    const auto across = [&](Edge edge, int t) {
        const TexelIndex i = seamWalk(face, edge, n).at(t);
        return map.texel(i.face, i.x, i.y, level);
    };
    const Edge edgeX = x < 0 ? Edge::Left : Edge::Right;
    const Edge edgeY = y < 0 ? Edge::Top : Edge::Bottom;
    if (!outY) {
        return across(edgeX, y);
    }
    if (!outX) {
        return across(edgeY, x);
    }
    const int cornerX = std::clamp(x, 0, n - 1);
    const int cornerY = std::clamp(y, 0, n - 1);
    return (map.texel(face, cornerX, cornerY, level) + across(edgeX, cornerY) +
            across(edgeY, cornerX)) *
           (1.0f / 3.0f);
}

glm::vec4 Cubemap::sampleLevel(const glm::vec3& direction, int level) const {
    LODESTAR_EXPECT(level >= 0 && level < levelCount(), "the level exists");
    const float longest =
        std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
    const bool usable = longest > 0.0f && std::isfinite(longest) && std::isfinite(direction.x) &&
                        std::isfinite(direction.y) && std::isfinite(direction.z);
    // Divided by its longest component first, so that a denormal or huge vector loses nothing.
    const glm::vec3 d = usable ? direction / longest : glm::vec3(1.0f, 0.0f, 0.0f);
    const int face = shader::lodestar_cubeFace(d);
    const shader::vec2 uv = shader::lodestar_cubeCoordinates(d);
    const int n = width(level);
    const auto size = static_cast<float>(n);
    const float x = (uv.x + 1.0f) * 0.5f * size - 0.5f;
    const float y = (uv.y + 1.0f) * 0.5f * size - 0.5f;
    const int x0 = std::clamp(static_cast<int>(std::floor(x)), -1, n - 1);
    const int y0 = std::clamp(static_cast<int>(std::floor(y)), -1, n - 1);
    const float tx = x - static_cast<float>(x0);
    const float ty = y - static_cast<float>(y0);
    return mix(mix(seamlessTexel(*this, level, face, x0, y0),
                   seamlessTexel(*this, level, face, x0 + 1, y0), tx),
               mix(seamlessTexel(*this, level, face, x0, y0 + 1),
                   seamlessTexel(*this, level, face, x0 + 1, y0 + 1), tx),
               ty);
}

glm::vec4 Cubemap::sample(const glm::vec3& direction, float level) const {
    const auto last = static_cast<float>(levelCount() - 1);
    const float clamped = level > 0.0f ? std::min(level, last) : 0.0f; // NaN fails the comparison
    const int fine = static_cast<int>(clamped);
    const float t = clamped - static_cast<float>(fine);
    const glm::vec4 a = sampleLevel(direction, fine);
    return t > 0.0f ? mix(a, sampleLevel(direction, fine + 1), t) : a;
}

std::vector<double> texelSolidAngles(int width) {
    LODESTAR_EXPECT(width >= 1 && width <= kMaxWidth, "a face's width is in [1, 16384]");
    const auto n = static_cast<std::size_t>(width);
    const std::size_t half = (n + 1) / 2; // the table is symmetric in both axes
    std::vector<double> omega(n * n);
    std::vector<double> above(half + 1);
    std::vector<double> below(half + 1);
    const auto edge = [n](std::size_t i) {
        return 2.0 * static_cast<double>(i) / static_cast<double>(n) - 1.0;
    };
    const auto fillCorners = [&](std::vector<double>& row, std::size_t j) {
        for (std::size_t i = 0; i <= half; ++i) {
            row[i] = cornerSolidAngle(edge(i), edge(j));
        }
    };
    fillCorners(below, 0);
    for (std::size_t j = 0; j < half; ++j) {
        std::swap(above, below);
        fillCorners(below, j + 1);
        double* row = &omega[j * n];
        for (std::size_t i = 0; i < half; ++i) {
            row[i] = above[i] - above[i + 1] - below[i] + below[i + 1];
            row[n - 1 - i] = row[i];
        }
        std::copy(row, row + n, &omega[(n - 1 - j) * n]);
    }
    return omega;
}

} // namespace lodestar::lighting

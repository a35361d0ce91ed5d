// SPDX-License-Identifier: MIT
//
// Diffuse light: irradiance over pi, as nine coefficients and as a small cube.
//
// Both rest on moments of the map: with the solid angle w of a texel and its unit direction d, sums
// of w L, w L d and w L d d^T, accumulated face by face in the face's own coordinates d = (u, v, 1)
// / r.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/contract.h"
#include "lighting/environment.h"
#include "lighting/solid_angle.h"
#include "lodestar/cube.glsl"

namespace lodestar::lighting {

namespace {

constexpr int kFaces = 6;
constexpr double kPi = std::numbers::pi;

/// The map in at most this many blocks along a face's side when irradiance is summed (IRR-2).
constexpr int kBlocks = 32;

double coordinate(int i, int n) {
    return (2.0 * i + 1.0) / n - 1.0;
}

/// A face's axes in the world: d = u * columns + v * rows + out, not unit.
struct FaceAxes {
    glm::dvec3 columns;
    glm::dvec3 rows;
    glm::dvec3 out;

    explicit FaceAxes(int face)
        : columns(glm::dvec3(shader::lodestar_cubeDirection(face, 1.0f, 0.0f) -
                             shader::lodestar_cubeDirection(face, 0.0f, 0.0f))),
          rows(glm::dvec3(shader::lodestar_cubeDirection(face, 0.0f, 1.0f) -
                          shader::lodestar_cubeDirection(face, 0.0f, 0.0f))),
          out(glm::dvec3(shader::lodestar_cubeDirection(face, 0.0f, 0.0f))) {}
};

/// Sum of w L d over a block, one vector a channel: x, y, z hold r, g, b, a.
struct BlockMoment {
    glm::vec4 x{0.0f};
    glm::vec4 y{0.0f};
    glm::vec4 z{0.0f};
};

/// First moments of the blocks of a map; block b of a side holds the texels i with i * blocks / n
/// == b.
std::vector<BlockMoment> blockMoments(const Cubemap& base, int blocks) {
    const int n = base.width();
    const auto side = static_cast<std::size_t>(blocks);
    std::vector<BlockMoment> moments(kFaces * side * side);
    const auto table = texelTable(n);
    std::vector<float> weight(static_cast<std::size_t>(n));  // w / r
    std::vector<float> weightU(static_cast<std::size_t>(n)); // w u / r
    for (int y = 0; y < n; ++y) {
        const double v = coordinate(y, n);
        for (int x = 0; x < n; ++x) {
            const double u = coordinate(x, n);
            const double w =
                static_cast<double>(table->solidAngles(y)[x]) / std::sqrt(1.0 + u * u + v * v);
            weight[static_cast<std::size_t>(x)] = static_cast<float>(w);
            weightU[static_cast<std::size_t>(x)] = static_cast<float>(w * u);
        }
        for (int face = 0; face < kFaces; ++face) {
            const FaceAxes axes(face);
            const glm::vec3 columns(axes.columns);
            const glm::vec3 along(axes.out + v * axes.rows);
            const glm::vec4* row = &base.texel(face, 0, y);
            BlockMoment* out = &moments[(static_cast<std::size_t>(face) * side +
                                         static_cast<std::size_t>(y * blocks / n)) *
                                        side];
            for (int b = 0, x = 0; b < blocks; ++b) {
                glm::vec4 sum(0.0f);
                glm::vec4 sumU(0.0f);
                for (; x < n && x * blocks / n == b; ++x) {
                    sum += row[x] * weight[static_cast<std::size_t>(x)];
                    sumU += row[x] * weightU[static_cast<std::size_t>(x)];
                }
                out[b].x += sumU * columns.x + sum * along.x;
                out[b].y += sumU * columns.y + sum * along.y;
                out[b].z += sumU * columns.z + sum * along.z;
            }
        }
    }
    return moments;
}

Cubemap constantOne(int width) {
    Cubemap cube(width);
    std::fill(cube.level(0).begin(), cube.level(0).end(), glm::vec4(1.0f));
    return cube;
}

glm::vec4 clampedSum(const std::vector<BlockMoment>& moments, const glm::vec3& n) {
    glm::vec4 sum(0.0f);
    for (const BlockMoment& m : moments) {
        sum += glm::max(m.x * n.x + m.y * n.y + m.z * n.z, glm::vec4(0.0f));
    }
    return sum;
}

} // namespace

Sh9Coefficients sh9FromCube(const Cubemap& base) {
    LODESTAR_EXPECT(!base.empty(), "spherical harmonics are made from a map");
    const int n = base.width();
    const auto table = texelTable(n);
    std::array<glm::dvec3, 9> sums{};
    for (int y = 0; y < n; ++y) {
        for (int face = 0; face < kFaces; ++face) {
            const FaceAxes axes(face);
            for (int x = 0; x < n; ++x) {
                const glm::dvec3 d = glm::normalize(axes.columns * coordinate(x, n) +
                                                    axes.rows * coordinate(y, n) + axes.out);
                const glm::dvec3 light = static_cast<double>(table->solidAngles(y)[x]) *
                                         glm::dvec3(base.texel(face, x, y));
                const double basis[9] = {1.0,
                                         d.y,
                                         d.z,
                                         d.x,
                                         d.x * d.y,
                                         d.y * d.z,
                                         3.0 * d.z * d.z - 1.0,
                                         d.x * d.z,
                                         d.x * d.x - d.y * d.y};
                for (std::size_t k = 0; k < 9; ++k) {
                    sums[k] += light * basis[k];
                }
            }
        }
    }
    // Y_k(n) Y_k(d) summed with the cosine lobe's eigenvalues 1, 2/3, 1/4: the squares of the basis
    // constants are 1, 3 (order 1), 15, 15, 5/4, 15, 15/4 (order 2), all over 4 pi.
    constexpr double kFactors[9] = {1.0,        2.0,        2.0,        2.0,        15.0 / 4.0,
                                    15.0 / 4.0, 5.0 / 16.0, 15.0 / 4.0, 15.0 / 16.0};
    Sh9Coefficients result;
    for (std::size_t k = 0; k < 9; ++k) {
        result[k] = glm::vec3(sums[k] * (kFactors[k] / (4.0 * kPi)));
    }
    return result;
}

Cubemap irradianceCube(const Cubemap& base) {
    LODESTAR_EXPECT(!base.empty(), "irradiance is made from a map");
    const int blocks = std::min(base.width(), kBlocks);
    const std::vector<BlockMoment> moments = blockMoments(base, blocks);
    const std::vector<BlockMoment> ones = blockMoments(constantOne(base.width()), blocks);
    Cubemap cube(kIrradianceWidth);
    for (int face = 0; face < kFaces; ++face) {
        const FaceAxes axes(face);
        for (int y = 0; y < kIrradianceWidth; ++y) {
            for (int x = 0; x < kIrradianceWidth; ++x) {
                const glm::vec3 n(glm::normalize(axes.columns * coordinate(x, kIrradianceWidth) +
                                                 axes.rows * coordinate(y, kIrradianceWidth) +
                                                 axes.out));
                cube.texel(face, x, y) = clampedSum(moments, n) / clampedSum(ones, n);
            }
        }
    }
    return cube;
}

} // namespace lodestar::lighting

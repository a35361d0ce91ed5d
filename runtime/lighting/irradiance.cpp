// SPDX-License-Identifier: MIT
//
// Diffuse light: irradiance over pi, as nine coefficients and as a small cube.
//
// Both rest on moments of the map: with the solid angle w of a texel and its unit direction d, the
// sums of w L, w L d and w L d d^T. On a face d = (u, v, 1) / r in the face's own axes, so that a
// row of texels (v constant) needs only sums of L with scalar weights; the axes come in once a row.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/contract.h"
#include "lighting/environment.h"
#include "lighting/float4.h"
#include "lighting/solid_angle.h"
#include "lighting/vector_clones.h"
#include "lodestar/cube.glsl"

namespace lodestar::lighting {

namespace {

constexpr int kFaces = 6;
constexpr double kPi = std::numbers::pi;

/// A map is summed in at most this many blocks along a face's side. A block acts as one light along
/// the mean direction of its own light: exact for every normal whose horizon does not cross it,
/// since the cosine is linear there, and for a single lamp in it.
constexpr int kBlocks = 32;

double coordinate(int i, int n) {
    return (2.0 * i + 1.0) / n - 1.0;
}

/// A face's axes in the world: its texels lie along u columns + v rows + out (not unit).
struct FaceAxes {
    glm::dvec3 columns;
    glm::dvec3 rows;
    glm::dvec3 out;

    explicit FaceAxes(int face)
        : columns(shader::lodestar_cubeDirection(face, 1.0f, 0.0f) -
                  shader::lodestar_cubeDirection(face, 0.0f, 0.0f)),
          rows(shader::lodestar_cubeDirection(face, 0.0f, 1.0f) -
               shader::lodestar_cubeDirection(face, 0.0f, 0.0f)),
          out(shader::lodestar_cubeDirection(face, 0.0f, 0.0f)) {}
};

/// The weights of one row of texels: w r^-k u^j, for the sums of order k in d.
struct RowWeights {
    std::vector<float> w0, w1, w1u, w2, w2u, w2uu;

    RowWeights(const TexelTable& table, int y) {
        const int n = table.width();
        const double v = coordinate(y, n);
        for (std::vector<float>* weights : {&w0, &w1, &w1u, &w2, &w2u, &w2uu}) {
            weights->resize(static_cast<std::size_t>(n));
        }
        for (int x = 0; x < n; ++x) {
            const auto i = static_cast<std::size_t>(x);
            const double u = coordinate(x, n);
            const double rSquared = 1.0 + u * u + v * v;
            const double w = static_cast<double>(table.solidAngles(y)[x]);
            w0[i] = table.solidAngles(y)[x];
            w1[i] = static_cast<float>(w / std::sqrt(rSquared));
            w1u[i] = static_cast<float>(w / std::sqrt(rSquared) * u);
            w2[i] = static_cast<float>(w / rSquared);
            w2u[i] = static_cast<float>(w / rSquared * u);
            w2uu[i] = static_cast<float>(w / rSquared * u * u);
        }
    }
};

/// sums[k] += sum over texels of weights[k][x] texel[x], for a fixed count of weightings.
template <std::size_t kCount>
[[gnu::always_inline]] inline void addWeighted(const Float4* texels, const float* const* weights,
                                               int begin, int end, Float4* sums) {
    Float4 local[kCount] = {};
    for (int x = begin; x < end; ++x) {
        for (std::size_t k = 0; k < kCount; ++k) {
            local[k] += texels[x] * weights[k][x];
        }
    }
    for (std::size_t k = 0; k < kCount; ++k) {
        sums[k] += local[k];
    }
}

LODESTAR_VECTOR_CLONES
void addFirstOrder(const Float4* texels, const float* const* weights, int begin, int end,
                   Float4* sums) {
    addWeighted<2>(texels, weights, begin, end, sums);
}

LODESTAR_VECTOR_CLONES
void addSecondOrder(const Float4* texels, const float* const* weights, int begin, int end,
                    Float4* sums) {
    addWeighted<6>(texels, weights, begin, end, sums);
}

/// The sums of w L, w L d and w L d d^T over the sphere, a channel each.
struct Moments {
    glm::dvec3 zero{0.0};
    std::array<glm::dvec3, 3> first{};                 ///< by axis
    std::array<std::array<glm::dvec3, 3>, 3> second{}; ///< by axis and axis, symmetric
};

/// Adds one face's row, from its six sums and the directions e = v rows + out.
void addRow(Moments& moments, const glm::vec4* sums, const glm::dvec3& c, const glm::dvec3& e) {
    const auto rgb = [&](int k) { return glm::dvec3(glm::vec3(sums[k])); };
    moments.zero += rgb(0);
    for (int a = 0; a < 3; ++a) {
        const auto i = static_cast<std::size_t>(a);
        moments.first[i] += rgb(2) * c[a] + rgb(1) * e[a];
        for (int b = 0; b < 3; ++b) {
            moments.second[i][static_cast<std::size_t>(b)] += rgb(5) * (c[a] * c[b]) +
                                                              rgb(4) * (c[a] * e[b] + e[a] * c[b]) +
                                                              rgb(3) * (e[a] * e[b]);
        }
    }
}

Moments momentsOf(const Cubemap& base) {
    const int n = base.width();
    const auto table = texelTable(n);
    Moments moments;
    for (int y = 0; y < n; ++y) {
        const RowWeights weights(*table, y);
        const float* rows[6] = {weights.w0.data(), weights.w1.data(),  weights.w1u.data(),
                                weights.w2.data(), weights.w2u.data(), weights.w2uu.data()};
        for (int face = 0; face < kFaces; ++face) {
            const FaceAxes axes(face);
            glm::vec4 sums[6] = {};
            addSecondOrder(asFloat4(&base.texel(face, 0, y)), rows, 0, n, asFloat4(sums));
            addRow(moments, sums, axes.columns, axes.rows * coordinate(y, n) + axes.out);
        }
    }
    return moments;
}

/// Sums of w L d over pairs of blocks, side by side: eight numbers an axis, r, g, b, a of either.
struct PairMoment {
    glm::vec4 x[2] = {};
    glm::vec4 y[2] = {};
    glm::vec4 z[2] = {};
};

/// Blocks along a side: each texel one, or kBlocks; one less where an odd width needs a middle one.
int blockCount(int width) {
    return width <= kBlocks ? width : kBlocks - width % 2;
}

/// The first column of block b; mirror images of one another about the middle of the face.
int blockBegin(int b, int width, int blocks) {
    return 2 * b <= blocks ? (2 * b * width + blocks) / (2 * blocks)
                           : width - blockBegin(blocks - b, width, blocks);
}

/// First moments of a map's blocks.
std::vector<PairMoment> blockMoments(const Cubemap& base, int blocks) {
    const int n = base.width();
    const auto side = static_cast<std::size_t>(blocks);
    std::vector<PairMoment> moments((kFaces * side * side + 1) / 2);
    const auto table = texelTable(n);
    std::vector<int> begins;
    for (int b = 0; b <= blocks; ++b) {
        begins.push_back(blockBegin(b, n, blocks));
    }
    for (int y = 0, row = 0; y < n; ++y) {
        row += y == begins[static_cast<std::size_t>(row) + 1] ? 1 : 0;
        const RowWeights weights(*table, y);
        const float* rows[2] = {weights.w1.data(), weights.w1u.data()};
        for (int face = 0; face < kFaces; ++face) {
            const FaceAxes axes(face);
            const glm::vec3 columns(axes.columns);
            const glm::vec3 along(axes.out + coordinate(y, n) * axes.rows);
            const std::size_t first =
                (static_cast<std::size_t>(face) * side + static_cast<std::size_t>(row)) * side;
            for (int b = 0; b < blocks; ++b) {
                glm::vec4 sums[2] = {};
                addFirstOrder(asFloat4(&base.texel(face, 0, y)), rows,
                              begins[static_cast<std::size_t>(b)],
                              begins[static_cast<std::size_t>(b) + 1], asFloat4(sums));
                const std::size_t block = first + static_cast<std::size_t>(b);
                PairMoment& out = moments[block / 2];
                out.x[block % 2] += sums[1] * columns.x + sums[0] * along.x;
                out.y[block % 2] += sums[1] * columns.y + sums[0] * along.y;
                out.z[block % 2] += sums[1] * columns.z + sums[0] * along.z;
            }
        }
    }
    return moments;
}

/// Sum over all blocks of max(n.m, 0), a channel each, about two normals. Summed in runs, whose
/// sums are then added: rounding grows with the run's length and their number, not with the
/// product.
LODESTAR_VECTOR_CLONES
void clampedSums(const PairMoment* moments, std::size_t count, const glm::vec3* normals,
                 glm::vec4* sums) {
    constexpr std::size_t kRun = 64;
    const glm::vec3 p = normals[0];
    const glm::vec3 q = normals[1];
    Float8 totalP = {};
    Float8 totalQ = {};
    const Float8 zero = {};
    for (std::size_t begin = 0; begin < count; begin += kRun) {
        Float8 sumP = {};
        Float8 sumQ = {};
        const std::size_t end = std::min(begin + kRun, count);
        for (std::size_t i = begin; i < end; ++i) {
            const Float8 x = *asFloat8(moments[i].x);
            const Float8 y = *asFloat8(moments[i].y);
            const Float8 z = *asFloat8(moments[i].z);
            const Float8 cosineP = x * p.x + y * p.y + z * p.z;
            const Float8 cosineQ = x * q.x + y * q.y + z * q.z;
            sumP += cosineP > zero ? cosineP : zero;
            sumQ += cosineQ > zero ? cosineQ : zero;
        }
        totalP += sumP;
        totalQ += sumQ;
    }
    for (int c = 0; c < 4; ++c) {
        sums[0][c] = totalP[c] + totalP[c + 4];
        sums[1][c] = totalQ[c] + totalQ[c + 4];
    }
}

/// The normal of a texel. @param side of the cube of irradiance, texels
glm::vec3 irradianceNormal(int face, int x, int y, int side) {
    const FaceAxes axes(face);
    return glm::vec3(glm::normalize(axes.columns * coordinate(x, side) +
                                    axes.rows * coordinate(y, side) + axes.out));
}

/// The same sums for radiance 1, by which irradiance is divided so that a constant map is exact.
/// All faces and the four quadrants of a face have the same ones.
std::vector<float> irradianceWeights(int width, int blocks, int side) {
    Cubemap one(width);
    std::fill(one.level(0).begin(), one.level(0).end(), glm::vec4(1.0f));
    const std::vector<PairMoment> moments = blockMoments(one, blocks);
    std::vector<float> weights(static_cast<std::size_t>(side * side));
    const int half = side / 2;
    for (int y = 0; y < half; ++y) {
        for (int x = 0; x < half; ++x) {
            const glm::vec3 n = irradianceNormal(0, x, y, side);
            const glm::vec3 normals[2] = {n, n};
            glm::vec4 sums[2];
            clampedSums(moments.data(), moments.size(), normals, sums);
            for (const int row : {y, side - 1 - y}) {
                for (const int column : {x, side - 1 - x}) {
                    weights[static_cast<std::size_t>(row * side + column)] = sums[0].x;
                }
            }
        }
    }
    return weights;
}

} // namespace

Sh9Coefficients sh9FromCube(const Cubemap& base) {
    LODESTAR_EXPECT(!base.empty(), "spherical harmonics are made from a map");
    const Moments m = momentsOf(base);
    const std::array<glm::dvec3, 9> sums = {m.zero,
                                            m.first[1],
                                            m.first[2],
                                            m.first[0],
                                            m.second[0][1],
                                            m.second[1][2],
                                            3.0 * m.second[2][2] - m.zero,
                                            m.second[0][2],
                                            m.second[0][0] - m.second[1][1]};
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

Cubemap irradianceCube(const Cubemap& base, int side) {
    LODESTAR_EXPECT(!base.empty(), "irradiance is made from a map");
    LODESTAR_EXPECT(side > 0 && side % 2 == 0, "a cube of irradiance has an even width");
    const int blocks = blockCount(base.width());
    const std::vector<PairMoment> moments = blockMoments(base, blocks);
    const std::vector<float> weights = irradianceWeights(base.width(), blocks, side);
    Cubemap cube(side);
    for (int face = 0; face < kFaces; ++face) {
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; x += 2) {
                const glm::vec3 normals[2] = {irradianceNormal(face, x, y, side),
                                              irradianceNormal(face, x + 1, y, side)};
                glm::vec4 sums[2];
                clampedSums(moments.data(), moments.size(), normals, sums);
                const std::size_t i = static_cast<std::size_t>(y * side + x);
                cube.texel(face, x, y) = sums[0] / weights[i];
                cube.texel(face, x + 1, y) = sums[1] / weights[i + 1];
            }
        }
    }
    return cube;
}

} // namespace lodestar::lighting

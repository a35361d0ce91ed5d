// SPDX-License-Identifier: MIT
//
// The reference: sums over all texels in double precision. Texel k has centre c_k, exact solid
// angle W_k and radiance L_k; a lobe K gives sum K(c_k) W_k L_k / sum K(c_k) W_k
// (docs/derivations/mip.md, MIP-9 to MIP-11).
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#define LODESTAR_DOUBLE_PRECISION
#include "lodestar/cube.glsl"
#include "lodestar/power.glsl"

#include "core/parallel.h"
#include "lighting/cube_rows.h"
#include "lighting/lookup.h"

namespace lodestar::lighting {

namespace {

using glm::dvec3;

/// Weights below this share of the lobe's peak are skipped. The mass of the lobe below a cosine x
/// is x^(s+1), so what is skipped is at most this share of the whole.
constexpr double kLeastWeight = 1e-12;

/// What depends on a face's width alone, the same for all six faces, row by row.
struct FaceGrid {
    std::vector<double> coordinates;  ///< u of each column (and v of each row) in (-1, 1)
    std::vector<double> inverseNorms; ///< 1 / |(u, v, 1)|
    std::vector<double> solidAngles;  ///< steradians, exact
};

std::shared_ptr<const FaceGrid> makeGrid(int width) {
    auto grid = std::make_shared<FaceGrid>();
    for (int i = 0; i < width; ++i) {
        grid->coordinates.push_back((2.0 * i + 1.0) / width - 1.0);
    }
    for (const double v : grid->coordinates) {
        for (const double u : grid->coordinates) {
            grid->inverseNorms.push_back(1.0 / std::sqrt(u * u + v * v + 1.0));
        }
    }
    grid->solidAngles = texelSolidAngles(width);
    return grid;
}

/// The grid of a width, made once; immutable, so threads may share it.
std::shared_ptr<const FaceGrid> gridFor(int width) {
    static std::mutex mutex;
    static std::map<int, std::shared_ptr<const FaceGrid>> grids;
    const std::scoped_lock lock(mutex);
    auto& grid = grids[width];
    if (!grid) {
        grid = makeGrid(width);
    }
    return grid;
}

struct WeightedSum {
    dvec3 radiance{0.0};
    double weight = 0.0;
};

/// Rows that one thread sums at a time; below two such pieces a thread more does not pay.
constexpr std::size_t kRowsAtOnce = 32;

/// Adds all texels by `weigh(cosines...)`, a weight per steradian from the dot products of the
/// texel's unit direction with the axes. Each row has its sum, and these are added in their order,
/// whichever thread made them: rounding grows with the row, not with the map.
/// @param columns of a row, from the axes on its face and v: all others have no weight
template <std::size_t Axes, class Within, class Weigh>
WeightedSum sumOverTexels(const Cubemap& base, const std::array<dvec3, Axes>& axes,
                          const ReferenceRun& run, const Within& columns, const Weigh& weigh) {
    const auto width = static_cast<std::size_t>(base.width());
    const auto grid = gridFor(base.width());
    const std::vector<glm::vec4>& texels = base.level(0);
    std::array<std::array<FaceLinear, Axes>, 6> linear{};
    for (int face = 0; face < 6; ++face) {
        for (std::size_t a = 0; a < Axes; ++a) {
            linear[static_cast<std::size_t>(face)][a] = onFace(face, axes[a]);
        }
    }
    std::vector<WeightedSum> rows(6 * width);
    const auto sumRow = [&](std::size_t row) {
        const std::array<FaceLinear, Axes>& onThis = linear[row / width];
        const double v = grid->coordinates[row % width];
        const TexelRange kept = columns(onThis, v);
        WeightedSum sum;
        for (std::size_t x = kept.begin; x < kept.end; ++x) {
            const std::size_t inFace = row % width * width + x;
            std::array<double, Axes> cosines{};
            for (std::size_t a = 0; a < Axes; ++a) {
                cosines[a] = (onThis[a].constant + onThis[a].alongU * grid->coordinates[x] +
                              onThis[a].alongV * v) *
                             grid->inverseNorms[inFace];
            }
            const double weight = weigh(cosines) * grid->solidAngles[inFace];
            if (weight > 0.0) {
                sum.radiance += weight * dvec3(texels[row * width + x]);
                sum.weight += weight;
            }
        }
        rows[row] = sum;
    };
    const std::size_t pieces = (rows.size() + kRowsAtOnce - 1) / kRowsAtOnce;
    core::inParallel(
        pieces,
        [&](std::size_t piece) {
            const std::size_t end = std::min((piece + 1) * kRowsAtOnce, rows.size());
            for (std::size_t row = piece * kRowsAtOnce; row < end; ++row) {
                sumRow(row);
            }
        },
        run.progress ? [&](std::size_t done) {
            run.progress(static_cast<double>(done) / static_cast<double>(pieces));
        } : std::function<void(std::size_t)>(),
        run.threads);
    WeightedSum total;
    for (const WeightedSum& row : rows) {
        total.radiance += row.radiance;
        total.weight += row.weight;
    }
    return total;
}

/// A texel that may lie one step over an edge: the neighbour's, found by where its centre points.
/// The extended centre is less than half a texel from the neighbour's own row, so it is that texel.
dvec3 texelOverEdge(const Cubemap& base, int face, int x, int y) {
    const int width = base.width();
    const auto inside = [&](int i) { return i >= 0 && i < width; };
    if (inside(x) && inside(y)) {
        return dvec3(base.texel(face, x, y));
    }
    if (!inside(x) && !inside(y)) { // a corner of the cube: the mean of the three that meet there
        const int nearX = std::clamp(x, 0, width - 1);
        const int nearY = std::clamp(y, 0, width - 1);
        return (texelOverEdge(base, face, nearX, nearY) + texelOverEdge(base, face, x, nearY) +
                texelOverEdge(base, face, nearX, y)) /
               3.0;
    }
    const dvec3 direction = shader_double::lodestar_cubeDirection(
        face, (2.0 * x + 1.0) / width - 1.0, (2.0 * y + 1.0) / width - 1.0);
    const glm::dvec2 uv = shader_double::lodestar_cubeCoordinates(direction);
    const auto index = [&](double c) {
        return std::clamp(static_cast<int>(std::floor((c + 1.0) * 0.5 * width)), 0, width - 1);
    };
    return dvec3(base.texel(shader_double::lodestar_cubeFace(direction), index(uv.x), index(uv.y)));
}

/// Seamless bilinear lookup at level 0 in double precision: what a mirror sees.
dvec3 sampleBilinear(const Cubemap& base, const dvec3& direction) {
    const int width = base.width();
    const int face = shader_double::lodestar_cubeFace(direction);
    const glm::dvec2 uv = shader_double::lodestar_cubeCoordinates(direction);
    const glm::dvec2 position = (uv + 1.0) * 0.5 * static_cast<double>(width) - 0.5;
    const glm::dvec2 corner = glm::floor(position);
    const glm::dvec2 t = position - corner;
    const int x = static_cast<int>(corner.x);
    const int y = static_cast<int>(corner.y);
    const dvec3 upper =
        texelOverEdge(base, face, x, y) * (1.0 - t.x) + texelOverEdge(base, face, x + 1, y) * t.x;
    const dvec3 lower = texelOverEdge(base, face, x, y + 1) * (1.0 - t.x) +
                        texelOverEdge(base, face, x + 1, y + 1) * t.x;
    return upper * (1.0 - t.y) + lower * t.y;
}

/// How far a lobe has gone over to the bilinear lookup, [0, 1]: by the share p = (s + 1) W / (2 pi)
/// of its mass that the texel about its peak would get (MIP-11). At p = 1 / pi the sum over centres
/// is still exact to 1e-4; at p = 3 / pi the lobe is as narrow as the bilinear hat itself.
double narrowness(const Cubemap& base, const dvec3& direction, double exponent) {
    const double width = base.width();
    const dvec3 a = glm::abs(direction);
    const double m = std::max({a.x, a.y, a.z});
    const double solidAngle = 4.0 / (width * width) * m * m * m;
    const double share = (exponent + 1.0) * solidAngle / (2.0 * std::numbers::pi);
    const double x = std::clamp(std::log(share * std::numbers::pi) / std::log(3.0), 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x);
}

/// The least cosine whose power is not skipped.
double leastCosine(double exponent) {
    return exponent > 0.0 ? std::exp(std::log(kLeastWeight) / exponent) : 0.0;
}

/// x^s for x in (0, 1]; 1 - x from the dot product is good to 2e-16, so x^s to 2e-16 s.
double power(double x, double exponent) {
    return std::exp(exponent * std::log(x));
}

dvec3 unitOr(const dvec3& direction, const dvec3& fallback) {
    return shader_double::lodestar_safeNormalize(direction, fallback);
}

/// The sum, gone over to the bilinear lookup about the peak as far as `narrow` says.
dvec3 blendNarrow(const Cubemap& base, const WeightedSum& sum, const dvec3& peak, double narrow) {
    if (narrow >= 1.0 || !(sum.weight > 0.0)) {
        return sampleBilinear(base, peak);
    }
    const dvec3 wide = sum.radiance / sum.weight;
    return narrow > 0.0 ? wide * (1.0 - narrow) + sampleBilinear(base, peak) * narrow : wide;
}

} // namespace

glm::dvec3 referencePhong(const Cubemap& base, const glm::dvec3& direction, double exponent,
                          const ReferenceRun& run) {
    LODESTAR_EXPECT(!base.empty(), "the map has texels");
    const double s = shader_double::lodestar_repairExponent(exponent);
    const dvec3 axis = unitOr(direction, dvec3(0.0, 0.0, 1.0));
    const double narrow = narrowness(base, axis, s);
    WeightedSum sum;
    if (narrow < 1.0) {
        const double least = leastCosine(s);
        const auto width = static_cast<std::size_t>(base.width());
        sum = sumOverTexels<1>(
            base, {axis}, run,
            [&](const std::array<FaceLinear, 1>& on, double v) {
                return columnsWithin(on[0], v, least, width);
            },
            [&](const std::array<double, 1>& cosine) {
                return cosine[0] > least ? power(cosine[0], s) : 0.0;
            });
    }
    return blendNarrow(base, sum, axis, narrow);
}

glm::dvec3 referenceBlinnPhong(const Cubemap& base, const glm::dvec3& normal,
                               const glm::dvec3& view, double exponent, const ReferenceRun& run) {
    LODESTAR_EXPECT(!base.empty(), "the map has texels");
    const double s = shader_double::lodestar_repairExponent(exponent);
    const dvec3 n = unitOr(normal, dvec3(0.0, 0.0, 1.0));
    const dvec3 v = unitOr(view, n);
    const double nDotV = glm::dot(n, v);
    const dvec3 reflection = 2.0 * nDotV * n - v;
    // About the reflection the lobe is 4 n.v times as wide (in solid angle) as the half vector's.
    const double narrow = narrowness(base, reflection, s / std::max(4.0 * std::abs(nDotV), 1e-3));
    WeightedSum sum;
    if (narrow < 1.0) {
        const double least = leastCosine(s);
        const TexelRange all{0, static_cast<std::size_t>(base.width())};
        const auto everywhere = [&](const auto&, double) { return all; };
        sum = sumOverTexels<2>(
            base, {n, v}, run, everywhere, [&](const std::array<double, 2>& cosines) {
                // n.h = (n.l + n.v) / |l + v|, |l + v|^2 = 2 + 2 l.v
                const double squared = 2.0 + 2.0 * cosines[1];
                if (cosines[0] <= 0.0 || squared <= 0.0) {
                    return 0.0;
                }
                const double nDotH = std::min((cosines[0] + nDotV) / std::sqrt(squared), 1.0);
                return nDotH > least ? power(nDotH, s) * cosines[0] : 0.0;
            });
    }
    return blendNarrow(base, sum, reflection, narrow);
}

} // namespace lodestar::lighting

// SPDX-License-Identifier: MIT
#include "lighting/mips.h"

#include <algorithm>
#include <cmath>

#include "core/contract.h"
#include "lighting/float4.h"
#include "lighting/solid_angle.h"

namespace lodestar::lighting {

namespace {

constexpr int kFaces = 6;

Cubemap withFullChain(const Cubemap& base) {
    LODESTAR_EXPECT(!base.empty(), "a mip chain starts from a level 0");
    Cubemap chain(base.width(), fullLevelCount(base.width()));
    chain.level(0) = base.level(0);
    return chain;
}

/// Plain 2x2 means within each face. @pre an even fine width
void reduceBoxEven(Cubemap& map, int coarseLevel) {
    const int n = map.width(coarseLevel - 1);
    const int rows = kFaces * (n / 2);
    const Float4* upper = asFloat4(map.level(coarseLevel - 1).data());
    Float4* out = asFloat4(map.level(coarseLevel).data());
    for (int j = 0; j < rows; ++j, upper += 2 * n, out += n / 2) {
        const Float4* lower = upper + n;
        for (int i = 0; i < n / 2; ++i) {
            out[i] =
                ((upper[2 * i] + upper[2 * i + 1]) + (lower[2 * i] + lower[2 * i + 1])) * 0.25f;
        }
    }
}

/// Plain means of the fine texels that a coarse one overlaps, within each face, for any width.
void reduceBox(Cubemap& map, int coarseLevel) {
    const int n = map.width(coarseLevel - 1);
    const int m = map.width(coarseLevel);
    const std::vector<AxisTaps> taps = boxTaps(n, m);
    const float scale = static_cast<float>(m) * static_cast<float>(m) /
                        (static_cast<float>(n) * static_cast<float>(n));
    for (int face = 0; face < kFaces; ++face) {
        for (int j = 0; j < m; ++j) {
            const AxisTaps& ty = taps[static_cast<std::size_t>(j)];
            for (int i = 0; i < m; ++i) {
                const AxisTaps& tx = taps[static_cast<std::size_t>(i)];
                glm::vec4 sum(0.0f);
                for (int b = 0; b < ty.count; ++b) {
                    const glm::vec4* row =
                        &map.texel(face, tx.first, ty.first + b, coarseLevel - 1);
                    for (int a = 0; a < tx.count; ++a) {
                        sum += row[a] * (ty.weights[b] * tx.weights[a]);
                    }
                }
                map.texel(face, i, j, coarseLevel) = sum * scale;
            }
        }
    }
}

/// 2x2 means weighted by solid angle, within each face; four fine solid angles are a coarse one's.
/// @pre an even fine width
void reduceSolidAngleEven(Cubemap& map, int coarseLevel) {
    const int n = map.width(coarseLevel - 1);
    const int m = n / 2;
    const auto fine = texelTable(n);
    const auto coarse = texelTable(m);
    for (int j = 0; j < m; ++j) {
        const float* upperOmega = fine->solidAngles(2 * j);
        const float* lowerOmega = fine->solidAngles(2 * j + 1);
        const float* omega = coarse->solidAngles(j);
        for (int face = 0; face < kFaces; ++face) {
            const Float4* upper = asFloat4(&map.texel(face, 0, 2 * j, coarseLevel - 1));
            const Float4* lower = upper + n;
            Float4* out = asFloat4(&map.texel(face, 0, j, coarseLevel));
            for (int i = 0; i < m; ++i) {
                const int x = 2 * i;
                out[i] = ((upper[x] * upperOmega[x] + upper[x + 1] * upperOmega[x + 1]) +
                          (lower[x] * lowerOmega[x] + lower[x + 1] * lowerOmega[x + 1])) /
                         omega[i];
            }
        }
    }
}

/// Solid angles of the overlaps of one coarse texel with its (at most 3x3) fine ones.
struct OverlapSolidAngles {
    float weights[3][3] = {};
    float reciprocal = 0.0f;
};

OverlapSolidAngles overlapSolidAngles(const AxisTaps& tx, const AxisTaps& ty, int i, int j, int n,
                                      int m) {
    const auto ends = [n, m](const AxisTaps& t, int coarse, int k) {
        const double begin = std::max(2.0 * (t.first + k) / n, 2.0 * coarse / m) - 1.0;
        const double end = std::min(2.0 * (t.first + k + 1) / n, 2.0 * (coarse + 1) / m) - 1.0;
        return std::pair{begin, end};
    };
    OverlapSolidAngles overlap;
    double sum = 0.0;
    for (int b = 0; b < ty.count; ++b) {
        const auto [y0, y1] = ends(ty, j, b);
        for (int a = 0; a < tx.count; ++a) {
            const auto [x0, x1] = ends(tx, i, a);
            const double omega = rectangleSolidAngle(x0, y0, x1, y1);
            overlap.weights[b][a] = static_cast<float>(omega);
            sum += omega;
        }
    }
    overlap.reciprocal = static_cast<float>(1.0 / sum);
    return overlap;
}

/// Means weighted by solid angle, within each face, for any width.
void reduceSolidAngle(Cubemap& map, int coarseLevel) {
    const int n = map.width(coarseLevel - 1);
    const int m = map.width(coarseLevel);
    const std::vector<AxisTaps> taps = boxTaps(n, m);
    for (int j = 0; j < m; ++j) {
        const AxisTaps& ty = taps[static_cast<std::size_t>(j)];
        for (int i = 0; i < m; ++i) {
            const AxisTaps& tx = taps[static_cast<std::size_t>(i)];
            const OverlapSolidAngles overlap = overlapSolidAngles(tx, ty, i, j, n, m);
            for (int face = 0; face < kFaces; ++face) {
                glm::vec4 sum(0.0f);
                for (int b = 0; b < ty.count; ++b) {
                    const glm::vec4* row =
                        &map.texel(face, tx.first, ty.first + b, coarseLevel - 1);
                    for (int a = 0; a < tx.count; ++a) {
                        sum += row[a] * overlap.weights[b][a];
                    }
                }
                map.texel(face, i, j, coarseLevel) = sum * overlap.reciprocal;
            }
        }
    }
}

} // namespace

glm::dvec4 sphereMean(const Cubemap& map, int level) {
    const int n = map.width(level);
    const auto table = texelTable(n);
    glm::dvec4 sum(0.0);
    double solidAngle = 0.0;
    for (int y = 0; y < n; ++y) {
        const float* omega = table->solidAngles(y);
        for (int x = 0; x < n; ++x) {
            solidAngle += kFaces * static_cast<double>(omega[x]);
        }
        for (int face = 0; face < kFaces; ++face) {
            const glm::vec4* row = &map.texel(face, 0, y, level);
            glm::dvec4 rowSum(0.0);
            for (int x = 0; x < n; ++x) {
                rowSum += glm::dvec4(row[x]) * static_cast<double>(omega[x]);
            }
            sum += rowSum;
        }
    }
    return sum / solidAngle;
}

Cubemap boxMips(const Cubemap& base) {
    Cubemap chain = withFullChain(base);
    for (int k = 1; k < chain.levelCount(); ++k) {
        if (chain.width(k - 1) % 2 == 0) {
            reduceBoxEven(chain, k);
        } else {
            reduceBox(chain, k);
        }
    }
    return chain;
}

Cubemap solidAngleMips(const Cubemap& base) {
    Cubemap chain = withFullChain(base);
    for (int k = 1; k < chain.levelCount(); ++k) {
        if (chain.width(k - 1) % 2 == 0) {
            reduceSolidAngleEven(chain, k);
        } else {
            reduceSolidAngle(chain, k);
        }
    }
    return chain;
}

} // namespace lodestar::lighting

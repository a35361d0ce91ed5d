// SPDX-License-Identifier: MIT
//
// Tent mips of even widths, fast: each fine row is weighted by solid angle once, the (1 3 3 1) sums
// run down four such rows and then along them, and the weights' own sums come from a table. A
// level's sum over the sphere falls out when its rows are weighted for the level below, so that the
// correction of the mean costs one multiplication a texel at the end: a level's scale cancels in
// the next one's.
#include <algorithm>
#include <numbers>
#include <vector>

#include "core/contract.h"
#include "lighting/cube_seams.h"
#include "lighting/float4.h"
#include "lighting/mips.h"
#include "lighting/round_levels.h"
#include "lighting/solid_angle.h"
#include "lighting/vector_clones.h"

namespace lodestar::lighting {

namespace {

constexpr int kFaces = 6;

/// Two weights, each four times: what multiplies two texels. A macro, because a function that
/// returns eight floats has another calling convention where the processor lacks them.
#define LODESTAR_PAIR(w)                                                                           \
    __builtin_shufflevector(Float4{(w)[0], (w)[0], (w)[0], (w)[0]},                                \
                            Float4{(w)[1], (w)[1], (w)[1], (w)[1]}, 0, 1, 2, 3, 4, 5, 6, 7)
const Float8* asFloat8(const Float4* texels) {
    return reinterpret_cast<const Float8*>(texels);
}
Float8* asFloat8(Float4* texels) {
    return reinterpret_cast<Float8*>(texels);
}

/// A row of texels and what weighs it: the solid angles of its texels.
struct Row {
    const Float4* texels;
    const float* weights;
    Float4 left;  ///< the texel across the left edge
    Float4 right; ///< and across the right one
};

/// What the upper two of a coarse texel's four fine rows have added so far, a + 3 b, by fine
/// column.
struct Carry {
    Float4* inside;
    Float4 left;
    Float4 right;
};

/// Starts a face: a lies above it, b is its first row.
LODESTAR_VECTOR_CLONES
void startTent(const Row& a, const Row& b, Carry& carry, int columns, Float4* sumOfB) {
    Float4 sum = {};
    for (int x = 0; x < columns; ++x) {
        const Float4 weighted = b.texels[x] * b.weights[x];
        sum += weighted;
        carry.inside[x] = a.texels[x] * a.weights[x] + 3.0f * weighted;
    }
    carry.left = a.left * a.weights[0] + 3.0f * (b.left * b.weights[0]);
    carry.right = (a.right * a.weights[columns - 1]) + 3.0f * (b.right * b.weights[columns - 1]);
    *sumOfB += sum;
}

/// Reads the next two fine rows, which end one coarse row (3 a + b) and start the next one (a + 3
/// b), and writes the coarse row that ends: the (1 3 3 1) sum along the columns, over the weights'
/// sum. Two columns at a time. Adds the sums of the weighted rows to sums[0] and sums[1].
LODESTAR_VECTOR_CLONES
void stepTent(const Row& a, const Row& b, Carry& carry, const float* reciprocals, Float4* out,
              int count, Float4* sums) {
    const Float4* texelsA = a.texels; // copies: a store to a texel might change what a and b say
    const Float4* texelsB = b.texels;
    const float* weightsA = a.weights;
    const float* weightsB = b.weights;
    Float4* carriedTexels = carry.inside;
    const float wl = weightsA[0];
    const float wr = weightsA[2 * count - 1];
    const float vl = weightsB[0];
    const float vr = weightsB[2 * count - 1];
    Float4 before = carry.left + 3.0f * (a.left * wl) + b.left * vl;
    Float8 sumA = {};
    Float8 sumB = {};
    Float4 low = {};
    Float4 high = {};
    for (int i = 0; i < count; ++i) {
        __builtin_prefetch(texelsA + 2 * i + 4 * count); // two rows on: a row may end a page, where
        __builtin_prefetch(texelsB + 2 * i + 4 * count); // the processor's own prefetch stops
        const Float8 fineA = *asFloat8(texelsA + 2 * i) * LODESTAR_PAIR(weightsA + 2 * i);
        const Float8 fineB = *asFloat8(texelsB + 2 * i) * LODESTAR_PAIR(weightsB + 2 * i);
        Float8& carried = *asFloat8(carriedTexels + 2 * i);
        const Float8 column = carried + 3.0f * fineA + fineB;
        carried = fineA + 3.0f * fineB;
        sumA += fineA;
        sumB += fineB;
        const Float4 first = __builtin_shufflevector(column, column, 0, 1, 2, 3);
        const Float4 second = __builtin_shufflevector(column, column, 4, 5, 6, 7);
        if (i > 0) {
            out[i - 1] = ((before + first) + 3.0f * (low + high)) * reciprocals[i - 1];
            before = high;
        }
        low = first;
        high = second;
    }
    const Float4 after = carry.right + 3.0f * (a.right * wr) + b.right * vr;
    out[count - 1] = ((before + after) + 3.0f * (low + high)) * reciprocals[count - 1];
    carry.left = a.left * wl + 3.0f * (b.left * vl);
    carry.right = a.right * wr + 3.0f * (b.right * vr);
    sums[0] += __builtin_shufflevector(sumA, sumA, 0, 1, 2, 3) +
               __builtin_shufflevector(sumA, sumA, 4, 5, 6, 7);
    sums[1] += __builtin_shufflevector(sumB, sumB, 0, 1, 2, 3) +
               __builtin_shufflevector(sumB, sumB, 4, 5, 6, 7);
}

LODESTAR_VECTOR_CLONES
void scaleTexels(Float4* texels, std::size_t count, const Float4* scale) {
    const Float4 s = *scale;
    for (std::size_t i = 0; i < count; ++i) {
        texels[i] *= s;
    }
}

/// Reduces one level after another; its buffers serve all of them.
class TentReducer {
public:
    explicit TentReducer(Cubemap& chain)
        : chain_(chain), carried_(static_cast<std::size_t>(chain.width())),
          outer_(static_cast<std::size_t>(4 * chain.width())) {}

    /// Makes a level, not yet scaled, from the one above. @return the sum over the sphere of solid
    /// angle times radiance of the one above. @pre its width is even
    glm::dvec4 reduce(int coarseLevel) {
        level_ = coarseLevel - 1;
        n_ = chain_.width(level_);
        table_ = texelTable(n_);
        sum_ = glm::dvec4(0.0);
        for (int face = 0; face < kFaces; ++face) {
            reduceFace(face, coarseLevel);
        }
        return sum_;
    }

private:
    void reduceFace(int face, int coarseLevel) {
        gatherOuter(face);
        const int m = n_ / 2;
        Carry carry{asFloat4(carried_.data()), {}, {}};
        glm::vec4 sums[2] = {};
        startTent(outerRow(Edge::Top), insideRow(0), carry, n_, asFloat4(sums));
        sum_ += glm::dvec4(sums[0]);
        for (int j = 0; j < m; ++j) {
            const int y = 2 * j + 1;
            const bool last = y + 1 == n_;
            sums[0] = sums[1] = glm::vec4(0.0f);
            stepTent(insideRow(y), last ? outerRow(Edge::Bottom) : insideRow(y + 1), carry,
                     table_->tentReciprocals(j), asFloat4(&chain_.texel(face, 0, j, coarseLevel)),
                     m, asFloat4(sums));
            sum_ += glm::dvec4(sums[0]);
            if (!last) {
                sum_ += glm::dvec4(sums[1]);
            }
        }
    }

    [[nodiscard]] const glm::vec4* outer(Edge edge) const {
        return outer_.data() + static_cast<int>(edge) * n_;
    }

    /// Copies the texels across the four edges of a face.
    void gatherOuter(int face) {
        inside_ = &chain_.texel(face, 0, 0, level_);
        for (const Edge edge : {Edge::Left, Edge::Right, Edge::Top, Edge::Bottom}) {
            const SeamWalk walk = seamWalk(face, edge, n_);
            const glm::vec4* source = &chain_.texel(walk.face, walk.x, walk.y, level_);
            const std::ptrdiff_t step = walk.stepX + static_cast<std::ptrdiff_t>(walk.stepY) * n_;
            glm::vec4* out = outer_.data() + static_cast<int>(edge) * n_;
            for (int t = 0; t < n_; ++t) {
                out[t] = source[t * step];
            }
        }
    }

    /// A row of the face. The solid angle of an outer texel is its neighbour's: the cube's
    /// symmetry.
    [[nodiscard]] Row insideRow(int y) const {
        return {asFloat4(inside_ + static_cast<std::ptrdiff_t>(y) * n_), table_->solidAngles(y),
                *asFloat4(&outer(Edge::Left)[y]), *asFloat4(&outer(Edge::Right)[y])};
    }

    /// The row above or below the face; at its ends the mean of the three texels that meet at the
    /// cube's corner.
    [[nodiscard]] Row outerRow(Edge edge) const {
        const int y = edge == Edge::Top ? 0 : n_ - 1;
        const Float4* row = asFloat4(outer(edge));
        const Row inside = insideRow(y);
        constexpr float kThird = 1.0f / 3.0f;
        return {row, inside.weights, (inside.texels[0] + row[0] + inside.left) * kThird,
                (inside.texels[n_ - 1] + row[n_ - 1] + inside.right) * kThird};
    }

    Cubemap& chain_;
    std::vector<glm::vec4> carried_; ///< Carry::inside
    std::vector<glm::vec4> outer_;   ///< the texels across the four edges
    std::shared_ptr<const TexelTable> table_;
    const glm::vec4* inside_ = nullptr; ///< texels of the face
    glm::dvec4 sum_{0.0};
    int level_ = 0;
    int n_ = 0;
};

/// The tent for any width, texel by texel: 4x4 taps for even ones, up to 5x5 for odd ones.
void reduceTent(Cubemap& map, int coarseLevel) {
    const int fine = coarseLevel - 1;
    const int n = map.width(fine);
    const int m = map.width(coarseLevel);
    const std::vector<AxisTaps> taps = tentTaps(n, m);
    const auto table = texelTable(n);
    for (int face = 0; face < kFaces; ++face) {
        for (int j = 0; j < m; ++j) {
            const AxisTaps& ty = taps[static_cast<std::size_t>(j)];
            for (int i = 0; i < m; ++i) {
                const AxisTaps& tx = taps[static_cast<std::size_t>(i)];
                glm::vec4 sum(0.0f);
                for (int b = 0; b < ty.count; ++b) {
                    const int y = ty.first + b;
                    const float* omega = table->solidAngles(std::clamp(y, 0, n - 1));
                    for (int a = 0; a < tx.count; ++a) {
                        const int x = tx.first + a;
                        sum += seamlessTexel(map, fine, face, x, y) *
                               (omega[std::clamp(x, 0, n - 1)] * ty.weights[b] * tx.weights[a]);
                    }
                }
                map.texel(face, i, j, coarseLevel) = sum * table->tentReciprocals(j)[i];
            }
        }
    }
}

/// Scales a level, channel by channel, so that its sum becomes the wanted one.
void scaleLevel(Cubemap& chain, int level, const glm::dvec4& wanted, const glm::dvec4& sum) {
    glm::vec4 scale(1.0f);
    for (int c = 0; c < 4; ++c) {
        scale[c] = sum[c] > 0.0 ? static_cast<float>(wanted[c] / sum[c]) : 1.0f;
    }
    scaleTexels(asFloat4(chain.level(level).data()), chain.level(level).size(), asFloat4(&scale));
}

} // namespace

void fillTentMips(Cubemap& chain) {
    LODESTAR_EXPECT(!chain.empty(), "a mip chain starts from a level 0");
    const int levels = chain.levelCount();
    TentReducer reducer(chain);
    glm::dvec4 wanted(0.0);
    bool more = true; // round levels read no tents of fewer than kWidestRound texels
    for (int k = 0; more; ++k) {
        more = k + 1 < levels && chain.width(k + 1) >= kWidestRound;
        // The sum of level k is known once it has been read for level k + 1; only then is it
        // scaled.
        glm::dvec4 sum;
        if (more && chain.width(k) % 2 == 0) {
            sum = reducer.reduce(k + 1);
        } else {
            sum = sphereMean(chain, k) * (4.0 * std::numbers::pi);
            if (more) {
                reduceTent(chain, k + 1);
            }
        }
        if (k == 0) {
            wanted = sum;
        } else {
            scaleLevel(chain, k, wanted, sum);
        }
    }
    roundCoarseLevels(chain);
    for (int k = levels - 1; k > 0 && chain.width(k) <= kWidestRound; --k) {
        scaleLevel(chain, k, wanted, sphereMean(chain, k) * (4.0 * std::numbers::pi));
    }
}

Cubemap tentMips(const Cubemap& base) {
    LODESTAR_EXPECT(!base.empty(), "a mip chain starts from a level 0");
    Cubemap chain(base.width(), fullLevelCount(base.width()));
    chain.level(0) = base.level(0);
    fillTentMips(chain);
    return chain;
}

} // namespace lodestar::lighting

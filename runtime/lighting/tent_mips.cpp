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
#include "lighting/solid_angle.h"

// The inner loops are compiled twice and chosen by the processor when the program starts.
#if defined(__x86_64__) && defined(__ELF__)
#define LODESTAR_VECTOR_CLONES __attribute__((target_clones("arch=haswell", "default")))
#else
#define LODESTAR_VECTOR_CLONES
#endif

namespace lodestar::lighting {

namespace {

constexpr int kFaces = 6;

/// out[x] = in[x] * weight[x], and adds their sum to *total. Eight sums, because one alone would
/// wait for each addition. @param count > 0
LODESTAR_VECTOR_CLONES
void weightRow(const Float4* in, const float* weight, Float4* out, int count, Float4* total) {
    Float4 sums[8] = {};
    int x = 0;
    for (; x + 8 <= count; x += 8) {
        for (int k = 0; k < 8; ++k) {
            const Float4 weighted = in[x + k] * weight[x + k];
            out[x + k] = weighted;
            sums[k] += weighted;
        }
    }
    for (; x < count; ++x) {
        out[x] = in[x] * weight[x];
        sums[0] += out[x];
    }
    *total +=
        ((sums[0] + sums[1]) + (sums[2] + sums[3])) + ((sums[4] + sums[5]) + (sums[6] + sums[7]));
}

/// One coarse row from four weighted fine rows. Element x + 1 of a fine row is its column x.
LODESTAR_VECTOR_CLONES
void tentRow(const Float4* const* rows, const float* reciprocals, Float4* out, int count) {
    const Float4* a = rows[0];
    const Float4* b = rows[1];
    const Float4* c = rows[2];
    const Float4* d = rows[3];
    const auto down = [&](int x) { return (a[x] + d[x]) + 3.0f * (b[x] + c[x]); };
    Float4 first = down(0);
    Float4 second = down(1);
    for (int i = 0; i < count; ++i) {
        const Float4 third = down(2 * i + 2);
        const Float4 fourth = down(2 * i + 3);
        out[i] = ((first + fourth) + 3.0f * (second + third)) * reciprocals[i];
        first = third;
        second = fourth;
    }
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
        : chain_(chain), buffers_(static_cast<std::size_t>(4 * (chain.width() + 2))),
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
        const Float4* rows[4] = {outerRow(0, Edge::Top), insideRow(1, face, 0), nullptr, nullptr};
        for (int j = 0; j < m; ++j) {
            const int y = 2 * j + 1;
            rows[2] = insideRow((y + 1) % 4, face, y);
            rows[3] = y + 1 < n_ ? insideRow((y + 2) % 4, face, y + 1)
                                 : outerRow((y + 2) % 4, Edge::Bottom);
            tentRow(rows, table_->tentReciprocals(j),
                    asFloat4(&chain_.texel(face, 0, j, coarseLevel)), m);
            rows[0] = rows[2];
            rows[1] = rows[3];
        }
    }

    [[nodiscard]] Float4* buffer(int slot) { return asFloat4(buffers_.data()) + slot * (n_ + 2); }
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

    /// A row of the face, weighted, with one texel from across the edge at either end. The solid
    /// angle of an outer texel is its neighbour's: the cube's symmetry.
    const Float4* insideRow(int slot, int face, int y) {
        const float* omega = table_->solidAngles(y);
        Float4* out = buffer(slot);
        glm::vec4 total(0.0f);
        weightRow(asFloat4(&chain_.texel(face, 0, y, level_)), omega, out + 1, n_,
                  asFloat4(&total));
        sum_ += glm::dvec4(total);
        out[0] = *asFloat4(&outer(Edge::Left)[y]) * omega[0];
        out[n_ + 1] = *asFloat4(&outer(Edge::Right)[y]) * omega[n_ - 1];
        return out;
    }

    /// The row above or below the face, weighted; at its ends the mean of the three texels that
    /// meet at the cube's corner.
    const Float4* outerRow(int slot, Edge edge) {
        const int y = edge == Edge::Top ? 0 : n_ - 1;
        const float* omega = table_->solidAngles(y);
        const glm::vec4* row = outer(edge);
        Float4* out = buffer(slot);
        glm::vec4 unused(0.0f);
        weightRow(asFloat4(row), omega, out + 1, n_, asFloat4(&unused));
        return outerCorners(out, edge, y, omega[0]);
    }

    const Float4* outerCorners(Float4* out, Edge edge, int y, float omega) {
        const glm::vec4* row = outer(edge);
        const glm::vec4* inside = inside_ + static_cast<std::ptrdiff_t>(y) * n_;
        const float third = omega / 3.0f;
        const glm::vec4 left = (inside[0] + row[0] + outer(Edge::Left)[y]) * third;
        const glm::vec4 right = (inside[n_ - 1] + row[n_ - 1] + outer(Edge::Right)[y]) * third;
        out[0] = *asFloat4(&left);
        out[n_ + 1] = *asFloat4(&right);
        return out;
    }

    Cubemap& chain_;
    std::vector<glm::vec4> buffers_; ///< four weighted rows
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

/// A scale a channel that makes the sum of a level the wanted one.
glm::vec4 scaleTo(const glm::dvec4& wanted, const glm::dvec4& sum) {
    glm::vec4 scale(1.0f);
    for (int c = 0; c < 4; ++c) {
        scale[c] = sum[c] > 0.0 ? static_cast<float>(wanted[c] / sum[c]) : 1.0f;
    }
    return scale;
}

} // namespace

void fillTentMips(Cubemap& chain) {
    LODESTAR_EXPECT(!chain.empty(), "a mip chain starts from a level 0");
    const int levels = chain.levelCount();
    TentReducer reducer(chain);
    glm::dvec4 wanted(0.0);
    for (int k = 0; k < levels; ++k) {
        // The sum of level k is known once it has been read for level k + 1; only then is it
        // scaled.
        glm::dvec4 sum;
        if (k + 1 < levels && chain.width(k) % 2 == 0) {
            sum = reducer.reduce(k + 1);
        } else {
            sum = sphereMean(chain, k) * (4.0 * std::numbers::pi);
            if (k + 1 < levels) {
                reduceTent(chain, k + 1);
            }
        }
        if (k == 0) {
            wanted = sum;
            continue;
        }
        const glm::vec4 scale = scaleTo(wanted, sum);
        scaleTexels(asFloat4(chain.level(k).data()), chain.level(k).size(), asFloat4(&scale));
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

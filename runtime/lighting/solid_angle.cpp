// SPDX-License-Identifier: MIT
#include "lighting/solid_angle.h"

#include <algorithm>

#include "core/contract.h"
#include "lighting/cubemap.h"
#include "lighting/table_cache.h"

namespace lodestar::lighting {

namespace {

/// Tables kept at a time: the chains of two widths. Wider than kWidestCached none is kept, so that
/// the cache stays below 2 x 3 MiB.
constexpr std::size_t kCachedTables = 24;
constexpr int kWidestCached = 1024;

} // namespace

std::vector<AxisTaps> boxTaps(int fine, int coarse) {
    std::vector<AxisTaps> taps(static_cast<std::size_t>(coarse));
    for (int i = 0; i < coarse; ++i) {
        // In units of 1 / coarse of a fine texel all ends are integers: exact.
        const int begin = i * fine;
        const int end = begin + fine;
        AxisTaps& t = taps[static_cast<std::size_t>(i)];
        t.first = begin / coarse;
        for (int k = t.first; k * coarse < end; ++k) {
            const int overlap = std::min(end, (k + 1) * coarse) - std::max(begin, k * coarse);
            t.weights[t.count++] = static_cast<float>(overlap) / static_cast<float>(coarse);
        }
    }
    return taps;
}

std::vector<AxisTaps> tentTaps(int fine, int coarse) {
    std::vector<AxisTaps> taps(static_cast<std::size_t>(coarse));
    const double reach = static_cast<double>(fine) / coarse;
    for (int i = 0; i < coarse; ++i) {
        const double centre = (i + 0.5) * reach;
        AxisTaps& t = taps[static_cast<std::size_t>(i)];
        t.first = static_cast<int>(std::floor(centre - reach - 0.5)) + 1;
        for (int k = t.first; k + 0.5 < centre + reach; ++k) {
            t.weights[t.count++] = static_cast<float>(reach - std::abs(k + 0.5 - centre));
        }
    }
    return taps;
}

TexelTable::TexelTable(int width) : width_(width) {
    const std::vector<double> omega = texelSolidAngles(width);
    const auto n = static_cast<std::size_t>(width);
    const std::size_t storedRows = (n + 1) / 2;
    solidAngles_.assign(omega.begin(), omega.begin() + static_cast<std::ptrdiff_t>(storedRows * n));
    const int coarse = width / 2;
    if (coarse == 0) {
        return;
    }
    // Outside the face a texel's solid angle is its neighbour's: the cube's symmetry.
    const auto inside = [width](int i) { return std::clamp(i, 0, width - 1); };
    const std::vector<AxisTaps> taps = tentTaps(width, coarse);
    const int coarseRows = (coarse + 1) / 2;
    for (int j = 0; j < coarseRows; ++j) {
        for (int i = 0; i < coarse; ++i) {
            const AxisTaps& tx = taps[static_cast<std::size_t>(i)];
            const AxisTaps& ty = taps[static_cast<std::size_t>(j)];
            double sum = 0.0;
            for (int b = 0; b < ty.count; ++b) {
                const double* row = &omega[static_cast<std::size_t>(inside(ty.first + b)) * n];
                for (int a = 0; a < tx.count; ++a) {
                    sum += static_cast<double>(ty.weights[b]) * static_cast<double>(tx.weights[a]) *
                           row[inside(tx.first + a)];
                }
            }
            tentReciprocals_.push_back(static_cast<float>(1.0 / sum));
        }
    }
}

std::shared_ptr<const TexelTable> texelTable(int width) {
    static TableCache<TexelTable> cache(kCachedTables);
    return cache.get([width](const TexelTable& kept) { return kept.width() == width; },
                     [width] { return TexelTable(width); }, width <= kWidestCached);
}

} // namespace lodestar::lighting

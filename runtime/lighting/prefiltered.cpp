// SPDX-License-Identifier: MIT
#include "lighting/prefiltered.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "core/contract.h"
#include "core/parallel.h"
#include "lighting/lobe_sums.h"
#include "lighting/mips.h"
#include "lodestar/cube.glsl"

namespace lodestar::lighting {

namespace {

constexpr int kFaces = 6;
constexpr int kUpright = 4; ///< +Z, whose frame the cube's own is

double coordinate(int i, int width) {
    return (2.0 * i + 1.0) / width - 1.0;
}

/// The means that a level is summed over: the coarsest twice as fine as it, and so wide at least.
LobeSource sourceFor(const Cubemap& chain, int level, int leastWidth) {
    const int wanted = std::max(2 * chain.width(level), leastWidth);
    while (level > 0 && chain.width(level) < wanted) {
        --level;
    }
    return lobeSource(chain, level);
}

/// The exponent of a texel's lobe: its spread is that of the lobe wanted less what reading the
/// level bilinearly adds, a sixth of a texel's solid angle, and what means of the map's texels do,
/// a twelfth of theirs (PRE-2).
double exponentOfTexel(double wanted, double density, int width, int sourceWidth, int mapWidth) {
    if (width == 1) {
        return wanted; // the hemisphere: what is read bilinearly between six of them is no lobe
    }
    const auto area = [](int n) { return 4.0 / (static_cast<double>(n) * n); };
    const double added =
        density * (area(width) / 6.0 + (area(sourceWidth) - area(mapWidth)) / 12.0);
    return std::max(1.0 / (1.0 / (wanted + 2.0) - added) - 2.0, 0.0);
}

/// A row of a level, of all faces.
void makeRow(const LobeSource& source, Cubemap& mips, int level, int y) {
    const int n = mips.width(level);
    const auto wanted = static_cast<double>(shader::lodestar_prefilteredExponent(
        static_cast<float>(level), static_cast<float>(mips.width())));
    std::vector<float> scratch;
    for (int x = 0; x < n; ++x) {
        const double u = coordinate(x, n);
        const double v = coordinate(y, n);
        const glm::dvec3 r = glm::normalize(glm::dvec3(shader::lodestar_cubeDirection(
            kUpright, static_cast<float>(u), static_cast<float>(v))));
        const double density = std::pow(1.0 + u * u + v * v, -1.5);
        const auto means = sixLobeMeans(
            source, r, exponentOfTexel(wanted, density, n, source.width, mips.width()), scratch);
        for (int face = 0; face < kFaces; ++face) {
            mips.texel(face, x, y, level) = means[static_cast<std::size_t>(face)];
        }
    }
}

} // namespace

Cubemap prefilteredMips(const Cubemap& base, const PrefilterRun& run) {
    LODESTAR_EXPECT(!base.empty(), "a mip chain starts from a level 0");
    const Cubemap chain = solidAngleMips(base);
    Cubemap mips(base.width(), chain.levelCount());
    mips.level(0) = base.level(0);
    struct Row {
        int level;
        int y;
    };
    std::vector<Row> rows;
    std::vector<LobeSource> sources;
    for (int level = 0; level < mips.levelCount(); ++level) {
        sources.push_back(level == 0 ? LobeSource{}
                                     : sourceFor(chain, level, run.leastSourceWidth));
        for (int y = 0; level > 0 && y < mips.width(level); ++y) {
            rows.push_back({level, y});
        }
    }
    const auto progress = [&](std::size_t done) {
        run.progress(static_cast<double>(done) / static_cast<double>(rows.size()));
    };
    core::inParallel(
        rows.size(),
        [&](std::size_t i) {
            makeRow(sources[static_cast<std::size_t>(rows[i].level)], mips, rows[i].level,
                    rows[i].y);
        },
        run.progress ? std::function<void(std::size_t)>(progress) : nullptr, run.threads);
    return mips;
}

} // namespace lodestar::lighting

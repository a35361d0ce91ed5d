// SPDX-License-Identifier: MIT
//
// A texel's weights depend on widths alone. They are kept, face by face, as runs along the rows of
// the level that is read; a chain of 256 needs 1.5 MB of them.
#include "lighting/round_levels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/geometric.hpp>

#include "core/contract.h"
#include "lighting/float4.h"
#include "lighting/table_cache.h"
#include "lighting/vector_clones.h"
#include "lodestar/cube.glsl"

namespace lodestar::lighting {

namespace {

constexpr int kFaces = 6;

/// Weights below this share of the peak are left out; what is kept is lowered by it, so that a
/// weight does not depend on which side of the limit rounding puts it.
constexpr double kLeastWeight = 1e-4;

/// Consecutive texels of the level that is read.
struct Run {
    std::uint32_t first;
    std::uint32_t count;
};

/// The weights of all texels of one level, which sum to 1 for each texel.
struct LobeTable {
    double effectiveWidth;                  ///< w 2^-k of the level that is made
    int width;                              ///< its faces'
    int sourceWidth;                        ///< of the level that is read
    std::vector<std::uint32_t> runsOfTexel; ///< first run of each texel, and the end
    std::vector<Run> runs;
    std::vector<float> weights; ///< run after run
};

glm::dvec3 texelDirection(int face, int x, int y, int width) {
    const auto coordinate = [width](int i) {
        return static_cast<float>(2 * i + 1) / static_cast<float>(width) - 1.0f;
    };
    return glm::normalize(
        glm::dvec3(shader::lodestar_cubeDirection(face, coordinate(x), coordinate(y))));
}

/// The exponent of one texel's lobe. Spreads add: half the mean square of the angle is 1 / (s + 2)
/// for a cosine lobe, a sixth of the texel's solid angle for the bilinear hat through which it is
/// read, a quarter of a finer texel's for the tents that it is made of. Of the latter two
/// kHatShare is subtracted.
double exponentOfTexel(double exponent, double solidAngle, double widthRatio) {
    constexpr double kHatShare = 0.6;
    const double hat = solidAngle * (1.0 / 6.0 + 0.25 * widthRatio * widthRatio);
    return std::max(1.0 / (1.0 / (exponent + 2.0) - kHatShare * hat) - 2.0, 0.0);
}

/// The directions and solid angles of a level that is read.
struct SourceTexels {
    explicit SourceTexels(int n) : width(n), solidAngles(texelSolidAngles(n)) {
        for (int i = 0; i < kFaces * n * n; ++i) {
            directions.push_back(texelDirection(i / (n * n), i % n, i / n % n, n));
        }
    }
    int width;
    std::vector<double> solidAngles;
    std::vector<glm::dvec3> directions;
};

void addTexel(LobeTable& table, const SourceTexels& source, const glm::dvec3& r, double exponent) {
    const std::size_t firstWeight = table.weights.size();
    const double leastCosine = exponent > 0.0 ? std::pow(kLeastWeight, 1.0 / exponent) : 0.0;
    const auto width = static_cast<std::size_t>(source.width);
    bool inRun = false;
    double sum = 0.0;
    for (std::size_t t = 0; t < source.directions.size(); ++t) {
        const double x = glm::dot(source.directions[t], r);
        const bool kept = x > leastCosine;
        if (kept && (!inRun || t % width == 0)) {
            table.runs.push_back({static_cast<std::uint32_t>(t), 0});
        }
        inRun = kept;
        if (kept) {
            const double w = (std::pow(x, exponent) - kLeastWeight) *
                             source.solidAngles[t % source.solidAngles.size()];
            table.runs.back().count += 1;
            table.weights.push_back(static_cast<float>(w));
            sum += w;
        }
    }
    for (std::size_t i = firstWeight; i < table.weights.size(); ++i) {
        table.weights[i] = static_cast<float>(static_cast<double>(table.weights[i]) / sum);
    }
    table.runsOfTexel.push_back(static_cast<std::uint32_t>(table.runs.size()));
}

LobeTable makeTable(double effectiveWidth, int width, int sourceWidth) {
    LobeTable table{effectiveWidth, width, sourceWidth, {0}, {}, {}};
    const SourceTexels source(sourceWidth);
    const std::vector<double> solidAngles = texelSolidAngles(width);
    const double exponent = exponentOfTentLevel(effectiveWidth);
    const double ratio = static_cast<double>(width) / sourceWidth;
    for (int face = 0; face < kFaces; ++face) {
        for (int i = 0; i < width * width; ++i) {
            addTexel(table, source, texelDirection(face, i % width, i / width, width),
                     width == 1 ? 0.0
                                : exponentOfTexel(exponent,
                                                  solidAngles[static_cast<std::size_t>(i)], ratio));
        }
    }
    return table;
}

/// The table of a level, from a cache of a few chains' that any number of threads may use.
std::shared_ptr<const LobeTable> lobeTable(double effectiveWidth, int width, int sourceWidth) {
    constexpr std::size_t kCachedTables = 16;
    static TableCache<LobeTable> cache(kCachedTables);
    return cache.get(
        [&](const LobeTable& kept) {
            return kept.effectiveWidth == effectiveWidth && kept.sourceWidth == sourceWidth;
        },
        [&] { return makeTable(effectiveWidth, width, sourceWidth); });
}

/// Sums run by run: rounding grows with their length and their number, not with the product.
LODESTAR_VECTOR_CLONES
void weighTexels(const LobeTable& table, const Float4* source, Float4* out) {
    const float* weight = table.weights.data();
    for (std::size_t t = 0; t + 1 < table.runsOfTexel.size(); ++t) {
        Float4 total = {};
        for (std::uint32_t r = table.runsOfTexel[t]; r < table.runsOfTexel[t + 1]; ++r) {
            const Run run = table.runs[r];
            Float4 sum = {};
            for (std::uint32_t i = 0; i < run.count; ++i) {
                sum += source[run.first + i] * *weight++;
            }
            total += sum;
        }
        out[t] = total;
    }
}

/// The level read for one that is made: the coarsest that has faces of twice its width and of
/// kWidestRound, or level 0.
int sourceLevel(const Cubemap& chain, int level) {
    int source = level - 1;
    while (source > 0 && chain.width(source) < std::max(2 * chain.width(level), kWidestRound)) {
        --source;
    }
    return source;
}

} // namespace

double exponentOfTentLevel(double width) {
    // Bisection on the shading text's own function, which falls with the exponent; about a
    // direction where texels have the mean size: 0.75 log2(1 + y^2) = 0.467. A level that is read
    // lies anywhere in a chain, so it is sought in the middle of a long one.
    constexpr int kMiddle = 12;
    const glm::vec3 direction(1.0f, std::sqrt(std::exp2(0.467f / 0.75f) - 1.0f), 0.0f);
    const auto longWidth = static_cast<float>(std::ldexp(width, kMiddle));
    double low = 0.0; // log2(s + 1)
    double high = 23.0;
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        const auto exponent = static_cast<float>(std::exp2(middle) - 1.0);
        const float level =
            shader::lodestar_tentLevel(direction, exponent, longWidth, 2.0f * kMiddle);
        (level > kMiddle ? low : high) = middle;
    }
    return std::exp2(0.5 * (low + high)) - 1.0;
}

void roundCoarseLevels(Cubemap& chain) {
    LODESTAR_EXPECT(!chain.empty(), "a mip chain starts from a level 0");
    // From the coarsest on, so that each reads tents.
    for (int k = chain.levelCount() - 1; k > 0 && chain.width(k) <= kWidestRound; --k) {
        const int source = sourceLevel(chain, k);
        const auto table = lobeTable(std::ldexp(static_cast<double>(chain.width()), -k),
                                     chain.width(k), chain.width(source));
        weighTexels(*table, asFloat4(chain.level(source).data()), asFloat4(chain.level(k).data()));
    }
}

} // namespace lodestar::lighting

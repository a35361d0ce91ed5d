// SPDX-License-Identifier: MIT
//
// The six faces are alike: what a texel of one weighs the cube by, seen from that face, the texel
// at the same place of the others does. So weights are made once, row by row of the faces as +Z
// sees them, in single precision by vector code, and six sums read the map, each from its own face.
// Rows and columns that a lobe does not reach are not visited.
#include "lighting/prefiltered.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "core/contract.h"
#include "core/parallel.h"
#include "lighting/cube_rows.h"
#include "lighting/float4.h"
#include "lighting/mips.h"
#include "lighting/vector_clones.h"
#include "lodestar/cube.glsl"

namespace lodestar::lighting {

namespace {

constexpr int kFaces = 6;
constexpr int kSeenFrom = 4; ///< the face whose frame the cube's own is, +Z

/// Weights below this share of the peak are left out; what is kept is lowered by it, so that a
/// weight does not depend on which side of the limit rounding puts it. The lobe loses log(1 /
/// share) of the share of its mass, 1e-3.
constexpr double kLeastWeight = 1e-4;

/// Where a face as +Z sees it lies in the map: texel (x, y) is number first + x alongX + y alongY.
struct Placed {
    std::ptrdiff_t first = 0;
    std::ptrdiff_t alongX = 0;
    std::ptrdiff_t alongY = 0;
};

/// A level that is read, with what depends on its width alone.
struct Source {
    int width = 0;
    const Float4* texels = nullptr;
    std::vector<float> coordinates;  ///< u of each column, and v of each row
    std::vector<float> inverseNorms; ///< 1 / |(u, v, 1)|, row by row
    std::vector<float> solidAngles;
    std::array<std::array<Placed, kFaces>, kFaces>
        placed; ///< by the seeing face, then the seen one
};

double coordinate(int i, int width) {
    return (2.0 * i + 1.0) / width - 1.0;
}

/// Turns a direction as +Z sees it into that which a face sees so.
glm::dmat3 turnTo(int face) {
    const auto at = [face](float u, float v) {
        return glm::dvec3(shader::lodestar_cubeDirection(face, u, v));
    };
    const glm::dvec3 centre = at(0.0f, 0.0f);
    return {at(1.0f, 0.0f) - centre, centre - at(0.0f, 1.0f), centre};
}

std::ptrdiff_t texelAt(const glm::dvec3& direction, int width) {
    const glm::vec3 d(direction);
    const glm::vec2 uv = shader::lodestar_cubeCoordinates(d);
    const auto index = [width](float c) {
        return static_cast<std::ptrdiff_t>((c + 1.0f) * 0.5f * static_cast<float>(width));
    };
    return (shader::lodestar_cubeFace(d) * width + index(uv.y)) * width + index(uv.x);
}

Placed place(int seeing, int seen, int width) {
    const glm::dmat3 turn = turnTo(seeing);
    const auto number = [&](int x, int y) {
        const glm::vec3 d =
            shader::lodestar_cubeDirection(seen, static_cast<float>(coordinate(x, width)),
                                           static_cast<float>(coordinate(y, width)));
        return texelAt(turn * glm::dvec3(d), width);
    };
    const std::ptrdiff_t first = number(0, 0);
    return width == 1 ? Placed{first, 0, 0}
                      : Placed{first, number(1, 0) - first, number(0, 1) - first};
}

Source sourceFor(const Cubemap& chain, int level, int leastWidth) {
    const int wanted = std::max(2 * chain.width(level), leastWidth);
    while (level > 0 && chain.width(level) < wanted) {
        --level;
    }
    Source source;
    const int n = source.width = chain.width(level);
    source.texels = asFloat4(chain.level(level).data());
    for (int i = 0; i < n; ++i) {
        source.coordinates.push_back(static_cast<float>(coordinate(i, n)));
    }
    for (const float v : source.coordinates) {
        for (const float u : source.coordinates) {
            source.inverseNorms.push_back(1.0f / std::sqrt(u * u + v * v + 1.0f));
        }
    }
    for (const double solidAngle : texelSolidAngles(n)) {
        source.solidAngles.push_back(static_cast<float>(solidAngle));
    }
    for (int seeing = 0; seeing < kFaces; ++seeing) {
        for (int seen = 0; seen < kFaces; ++seen) {
            source.placed[static_cast<std::size_t>(seeing)][static_cast<std::size_t>(seen)] =
                place(seeing, seen, n);
        }
    }
    return source;
}

/// x^s for x in (0, 1]: log2 by a series in (m - 1) / (m + 1) of the mantissa m in [sqrt(1/2),
/// sqrt 2), off by 3e-8; exp2 by a polynomial, off by 2e-7 of itself.
inline float power(float x, float s) {
    const auto bits = std::bit_cast<std::int32_t>(x);
    const std::int32_t exponent = (bits - 0x3f3504f3) >> 23;
    const auto m = std::bit_cast<float>(bits - exponent * 0x800000);
    const float r = (m - 1.0f) / (m + 1.0f);
    const float q = r * r;
    const float log2 =
        static_cast<float>(exponent) +
        r * (2.88539008f + q * (0.961796694f + q * (0.577078016f + q * 0.412198583f)));
    const float y = std::max(s * log2, -120.0f);
    const auto whole = static_cast<std::int32_t>(y - 0.5f); // towards 0, y <= 0: to the nearest
    const float f = y - static_cast<float>(whole);
    const float e =
        1.0f + f * (0.693147182f +
                    f * (0.240226507f +
                         f * (0.0555041086f +
                              f * (0.00961812911f + f * (0.00133335581f + f * 0.000154035304f)))));
    return e * std::bit_cast<float>((whole + 127) * 0x800000);
}

/// A lobe on a row: cosine at column x is (c + a u_x) inverseNorms[x].
struct RowLobe {
    float c;
    float a;
    float exponent;
    float least; ///< cosines from here on count
};

/// A row's texels from a first one on, as each of the six faces sees them.
struct SixRows {
    const Float4* first[kFaces];
    std::ptrdiff_t step[kFaces];
};

struct SixSums {
    Float4 radiance[kFaces] = {};
    float weight = 0.0f;
};

/// Adds a row by the lobe. @param u, inverseNorms, solidAngles of its texels  @param weights room
LODESTAR_VECTOR_CLONES
void addRow(const RowLobe& lobe, const float* u, const float* inverseNorms,
            const float* solidAngles, const SixRows& rows, std::size_t count, float* weights,
            SixSums& sums) {
    for (std::size_t x = 0; x < count; ++x) {
        const float cosine = (lobe.c + lobe.a * u[x]) * inverseNorms[x];
        const float inRange = std::min(std::max(cosine, 1e-6f), 1.0f);
        const float weight = power(inRange, lobe.exponent) - static_cast<float>(kLeastWeight);
        weights[x] = cosine > lobe.least ? std::max(weight, 0.0f) * solidAngles[x] : 0.0f;
    }
    float weight = 0.0f;
    for (std::size_t x = 0; x < count; ++x) {
        weight += weights[x];
    }
    sums.weight += weight;
    for (int face = 0; face < kFaces; ++face) {
        const Float4* texel = rows.first[face];
        Float4 sum = {};
        for (std::size_t x = 0; x < count; ++x, texel += rows.step[face]) {
            sum += *texel * weights[x];
        }
        sums.radiance[face] += sum;
    }
}

SixRows rowsOf(const Source& source, std::size_t seen, std::size_t x, std::size_t y) {
    SixRows rows{};
    for (int face = 0; face < kFaces; ++face) {
        const Placed& placed = source.placed[static_cast<std::size_t>(face)][seen];
        rows.first[face] = source.texels + placed.first +
                           static_cast<std::ptrdiff_t>(x) * placed.alongX +
                           static_cast<std::ptrdiff_t>(y) * placed.alongY;
        rows.step[face] = placed.alongX;
    }
    return rows;
}

/// The lobe's sums about r as the six faces see it.
SixSums lobeSums(const Source& source, const glm::dvec3& r, double exponent,
                 std::vector<float>& weights) {
    const auto n = static_cast<std::size_t>(source.width);
    const double least = exponent > 0.0 ? std::pow(kLeastWeight, 1.0 / exponent) : 0.0;
    SixSums sums;
    for (std::size_t seen = 0; seen < kFaces; ++seen) {
        const FaceLinear axis = onFace(static_cast<int>(seen), r);
        if (axis.constant + std::abs(axis.alongU) + std::abs(axis.alongV) <= 0.0) {
            continue; // below the horizon
        }
        const TexelRange rows = rowsWithin(axis, least, n);
        for (std::size_t y = rows.begin; y < rows.end; ++y) {
            const auto v = static_cast<double>(source.coordinates[y]);
            const TexelRange columns = columnsWithin(axis, v, least, n);
            const std::size_t first = y * n + columns.begin;
            const RowLobe lobe{static_cast<float>(axis.constant + axis.alongV * v),
                               static_cast<float>(axis.alongU), static_cast<float>(exponent),
                               static_cast<float>(least)};
            addRow(lobe, source.coordinates.data() + columns.begin,
                   source.inverseNorms.data() + first, source.solidAngles.data() + first,
                   rowsOf(source, seen, columns.begin, y), columns.end - columns.begin,
                   weights.data(), sums);
        }
    }
    return sums;
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
void makeRow(const Source& source, Cubemap& mips, int level, int y) {
    const int n = mips.width(level);
    const auto wanted = static_cast<double>(shader::lodestar_prefilteredExponent(
        static_cast<float>(level), static_cast<float>(mips.width())));
    std::vector<float> weights(source.coordinates.size());
    for (int x = 0; x < n; ++x) {
        const double u = coordinate(x, n);
        const double v = coordinate(y, n);
        const glm::dvec3 r = glm::normalize(glm::dvec3(shader::lodestar_cubeDirection(
            kSeenFrom, static_cast<float>(u), static_cast<float>(v))));
        const double density = std::pow(1.0 + u * u + v * v, -1.5);
        const SixSums sums = lobeSums(
            source, r, exponentOfTexel(wanted, density, n, source.width, mips.width()), weights);
        for (int face = 0; face < kFaces; ++face) {
            const Float4 mean = sums.radiance[face] * (1.0f / sums.weight);
            mips.texel(face, x, y, level) = {mean[0], mean[1], mean[2], mean[3]};
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
    std::vector<Source> sources;
    for (int level = 0; level < mips.levelCount(); ++level) {
        sources.push_back(level == 0 ? Source{} : sourceFor(chain, level, run.leastSourceWidth));
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

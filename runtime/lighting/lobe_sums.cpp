// SPDX-License-Identifier: MIT
//
// The six faces are alike: what a texel of one weighs the cube by, seen from that face, the texel
// at the same place of the others does. So weights are made once, row by row of the faces as +Z
// sees them, and one or six sums read the map, each from its own face. Rows and columns that a lobe
// does not reach are not visited.
#include "lighting/lobe_sums.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "lighting/cube_rows.h"
#include "lighting/float4.h"
#include "lighting/vector_clones.h"
#include "lodestar/cube.glsl"

namespace lodestar::lighting {

namespace {

constexpr int kFaces = 6;
constexpr int kUpright = 4; ///< the face whose frame the cube's own is, +Z

/// Weights below this share of the peak are left out; what is kept is lowered by it, so that a
/// weight does not depend on which side of the limit rounding puts it. The lobe loses log(1 /
/// share) of the share of its mass, 1e-3.
constexpr double kLeastWeight = 1e-4;

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

LobeSource::Placed place(int seeing, int seen, int width) {
    const glm::dmat3 turn = turnTo(seeing);
    const auto number = [&](int x, int y) {
        const glm::vec3 d =
            shader::lodestar_cubeDirection(seen, static_cast<float>(coordinate(x, width)),
                                           static_cast<float>(coordinate(y, width)));
        return texelAt(turn * glm::dvec3(d), width);
    };
    const std::ptrdiff_t first = number(0, 0);
    return width == 1 ? LobeSource::Placed{first, 0, 0}
                      : LobeSource::Placed{first, number(1, 0) - first, number(0, 1) - first};
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

/// A row's texels from a first one on, as some faces see them.
struct SeenRows {
    const Float4* first[kFaces];
    std::ptrdiff_t step[kFaces];
    int faces;
};

struct Sums {
    Float4 radiance[kFaces] = {};
    float weight = 0.0f;
};

/// Adds a row by the lobe. @param u, inverseNorms, solidAngles of its texels  @param weights room
LODESTAR_VECTOR_CLONES
void addRow(const RowLobe& lobe, const float* u, const float* inverseNorms,
            const float* solidAngles, const SeenRows& rows, std::size_t count, float* weights,
            Sums& sums) {
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
    for (int face = 0; face < rows.faces; ++face) {
        const Float4* texel = rows.first[face];
        Float4 sum = {};
        for (std::size_t x = 0; x < count; ++x, texel += rows.step[face]) {
            sum += *texel * weights[x];
        }
        sums.radiance[face] += sum;
    }
}

/// Faces that see, [from, to).
struct Faces {
    int from;
    int to;
};

SeenRows rowsOf(const LobeSource& source, const Faces& faces, std::size_t seen, std::size_t x,
                std::size_t y) {
    SeenRows rows{{}, {}, faces.to - faces.from};
    for (int i = 0; i < rows.faces; ++i) {
        const LobeSource::Placed& placed =
            source.placed[static_cast<std::size_t>(faces.from + i)][seen];
        rows.first[i] = asFloat4(source.texels) + placed.first +
                        static_cast<std::ptrdiff_t>(x) * placed.alongX +
                        static_cast<std::ptrdiff_t>(y) * placed.alongY;
        rows.step[i] = placed.alongX;
    }
    return rows;
}

Sums lobeSums(const LobeSource& source, const Faces& faces, const glm::dvec3& r, double exponent,
              std::vector<float>& weights) {
    const auto n = static_cast<std::size_t>(source.width);
    weights.resize(std::max(weights.size(), n));
    const double least = exponent > 0.0 ? std::pow(kLeastWeight, 1.0 / exponent) : 0.0;
    Sums sums;
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
                   rowsOf(source, faces, seen, columns.begin, y), columns.end - columns.begin,
                   weights.data(), sums);
        }
    }
    return sums;
}

glm::vec4 meanOf(const Sums& sums, int face) {
    const Float4 mean = sums.radiance[face] * (1.0f / sums.weight);
    return {mean[0], mean[1], mean[2], mean[3]};
}

} // namespace

LobeSource lobeSource(const Cubemap& chain, int level) {
    LobeSource source;
    const int n = source.width = chain.width(level);
    source.texels = chain.level(level).data();
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

glm::vec4 lobeMean(const LobeSource& source, const glm::dvec3& direction, double exponent,
                   std::vector<float>& scratch) {
    return meanOf(lobeSums(source, {kUpright, kUpright + 1}, direction, exponent, scratch), 0);
}

std::array<glm::vec4, 6> sixLobeMeans(const LobeSource& source, const glm::dvec3& direction,
                                      double exponent, std::vector<float>& scratch) {
    const Sums sums = lobeSums(source, {0, kFaces}, direction, exponent, scratch);
    std::array<glm::vec4, 6> means;
    for (int face = 0; face < kFaces; ++face) {
        means[static_cast<std::size_t>(face)] = meanOf(sums, face);
    }
    return means;
}

} // namespace lodestar::lighting

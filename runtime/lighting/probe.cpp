// SPDX-License-Identifier: MIT
#include "lighting/probe.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include "lodestar/probes.glsl"

namespace lodestar::lighting {
namespace {

/// As floats.
bool finite(const glm::dmat4& m) {
    for (int c = 0; c < 4; ++c) {
        for (int r = 0; r < 4; ++r) {
            if (!std::isfinite(static_cast<float>(m[c][r]))) {
                return false;
            }
        }
    }
    return true;
}

/// A frame whose axes span less than that share of a cube of their lengths is flat: of a matrix of
/// floats the inverse has no digits left there.
constexpr double kFlat = 1e-7;
constexpr float kGreatest = 1e18f; ///< half extents whose squares are floats

bool flat(const glm::dmat3& m) {
    const double lengths = glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]);
    return !(std::abs(glm::determinant(m)) > kFlat * lengths);
}

glm::vec4 row(const glm::dmat4& m, int r) {
    return {static_cast<float>(m[0][r]), static_cast<float>(m[1][r]), static_cast<float>(m[2][r]),
            static_cast<float>(m[3][r])};
}

/// The integral of the smooth fade from t = 0: of t^2 (3 - 2 t) to 1, of 1 beyond.
double fadeIntegral(double t) {
    if (t <= 0.0) {
        return 0.0;
    }
    return t < 1.0 ? t * t * t - 0.5 * t * t * t * t : 0.5 + (t - 1.0);
}

double fade(double inside, double blend) {
    return static_cast<double>(
        shader::lodestar_probeFade(static_cast<float>(inside), static_cast<float>(blend)));
}

/// The mean of the fade over distances from one to another.
double meanFade(double from, double to, double blend) {
    if (to - from <= 1e-6 * (std::abs(from) + std::abs(to) + blend)) {
        return fade(0.5 * (from + to), blend);
    }
    if (blend <= 0.0) {
        return (std::max(to, 0.0) - std::max(from, 0.0)) / (to - from);
    }
    return blend * (fadeIntegral(to / blend) - fadeIntegral(from / blend)) / (to - from);
}

/// A box's weight along one axis, from low + blendLow to high - blendHigh 1.
struct Axis {
    double low, high;           ///< where the weight becomes 0
    double blendLow, blendHigh; ///< together at most high - low
};

/// The mean along an axis over an interval. The fades do not overlap, so that each is alone on its
/// side of where it ends.
double meanAlong(const Axis& axis, double from, double to) {
    const double a = std::max(from, axis.low);
    const double b = std::min(to, axis.high);
    if (a > b) {
        return 0.0;
    }
    const double middle = std::clamp(axis.low + axis.blendLow, a, b);
    const double rising = meanFade(a - axis.low, middle - axis.low, axis.blendLow);
    const double falling = meanFade(axis.high - b, axis.high - middle, axis.blendHigh);
    if (to - from <= 0.0) {
        return std::min(rising, falling);
    }
    return (rising * (middle - a) + falling * (b - middle)) / (to - from);
}

Axis axisOf(const PlacedVolume& volume, int i) {
    const double half = static_cast<double>(volume.halfExtents[i]);
    const double high = static_cast<double>(volume.blendHigh[i]);
    const double low = static_cast<double>(volume.blendLow[i]);
    const double outward = volume.outward ? 1.0 : 0.0;
    return {-half - outward * low, half + outward * high, low, high};
}

} // namespace

std::optional<PlacedVolume> place(const ProbeVolume& volume, const glm::mat4& worldFromNode,
                                  bool outward) {
    const glm::dmat4 worldFromVolume =
        glm::translate(glm::dmat4(worldFromNode), glm::dvec3(volume.center));
    // As floats, of which the least sizes have none left and the greatest are infinite.
    const glm::vec3 half(0.5 * volume.size);
    const bool inside = glm::all(glm::greaterThan(half, glm::vec3(0.0f))) &&
                        glm::all(glm::lessThan(half, glm::vec3(kGreatest)));
    const bool blends = std::all_of(volume.blend.begin(), volume.blend.end(), [](double blend) {
        return std::isfinite(static_cast<float>(blend));
    });
    if (!inside || !blends || !finite(worldFromVolume) || flat(glm::dmat3(worldFromVolume))) {
        return std::nullopt;
    }
    const glm::dmat4 volumeFromWorld = glm::inverse(worldFromVolume);
    if (!finite(volumeFromWorld)) {
        return std::nullopt;
    }
    PlacedVolume placed;
    PlacedVolume& v = placed;
    for (int i = 0; i < 3; ++i) {
        v.rows[static_cast<std::size_t>(i)] = row(volumeFromWorld, i);
    }
    const bool sphere = volume.shape == VolumeShape::Sphere;
    v.halfExtents = sphere ? glm::vec3(half.x) : half;
    v.sphere = sphere;
    v.outward = outward;
    for (int i = 0; i < 3; ++i) {
        const std::size_t high = sphere ? 0 : static_cast<std::size_t>(2 * i);
        const std::size_t low = sphere ? 0 : high + 1;
        // Two fades that would overlap meet in the middle.
        const double most =
            outward ? std::numeric_limits<double>::max() : static_cast<double>(v.halfExtents[i]);
        v.blendHigh[i] = static_cast<float>(std::clamp(volume.blend[high], 0.0, most));
        v.blendLow[i] = static_cast<float>(std::clamp(volume.blend[low], 0.0, most));
    }
    placed.measure = std::abs(glm::determinant(glm::dmat3(worldFromVolume))) * 8.0 *
                     static_cast<double>(v.halfExtents.x) * static_cast<double>(v.halfExtents.y) *
                     static_cast<double>(v.halfExtents.z) * (sphere ? 0.5235987755982988 : 1.0);
    const glm::dvec3 reach(v.halfExtents +
                           (outward ? glm::max(v.blendHigh, v.blendLow) : glm::vec3(0.0f)));
    const glm::dvec3 center(worldFromVolume[3]);
    glm::dvec3 extent(0.0);
    for (int i = 0; i < 3; ++i) {
        extent += glm::abs(glm::dvec3(worldFromVolume[i])) * reach[i];
    }
    placed.low = glm::vec3(center - extent);
    placed.high = glm::vec3(center + extent);
    return placed;
}

float meanWeight(const PlacedVolume& placed, const glm::vec3& low, const glm::vec3& high) {
    const PlacedVolume& volume = placed;
    const glm::dvec3 worldCenter = 0.5 * (glm::dvec3(low) + glm::dvec3(high));
    const glm::dvec3 worldHalf = 0.5 * (glm::dvec3(high) - glm::dvec3(low));
    glm::dvec3 center(0.0), half(0.0);
    for (int i = 0; i < 3; ++i) {
        const glm::dvec4 row(volume.rows[static_cast<std::size_t>(i)]);
        center[i] = glm::dot(row, glm::dvec4(worldCenter, 1.0));
        half[i] = glm::dot(glm::abs(glm::dvec3(row)), worldHalf);
    }
    for (int i = 0; i < 3; ++i) {
        if (!std::isfinite(center[i]) || !std::isfinite(half[i])) {
            return 0.0f; // of what is everywhere, or nowhere
        }
    }
    double weight = 1.0;
    if (volume.sphere) {
        const double radius = static_cast<double>(volume.halfExtents.x);
        const double blend = static_cast<double>(volume.blendHigh.x);
        const double reach = radius + (volume.outward ? blend : 0.0);
        const double nearest = glm::length(glm::max(glm::abs(center) - half, glm::dvec3(0.0)));
        const double farthest = glm::length(glm::abs(center) + half);
        weight = meanFade(reach - farthest, reach - nearest, blend);
    } else {
        for (int i = 0; i < 3 && weight > 0.0; ++i) {
            weight *= meanAlong(axisOf(volume, i), center[i] - half[i], center[i] + half[i]);
        }
    }
    return static_cast<float>(std::clamp(weight, 0.0, 1.0));
}

unsigned facesSeeing(const glm::vec3& position, double nearPlane, double farPlane,
                     const glm::vec3& low, const glm::vec3& high) {
    constexpr unsigned kAll = 0x3f;
    const glm::dvec3 a = glm::dvec3(low) - glm::dvec3(position);
    const glm::dvec3 b = glm::dvec3(high) - glm::dvec3(position);
    for (int i = 0; i < 3; ++i) {
        if (!std::isfinite(a[i]) || !std::isfinite(b[i])) {
            return kAll;
        }
    }
    unsigned faces = 0;
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2;
        const bool positive = face % 2 == 0;
        // The box in the face's own frame: depth along its axis, the two others across.
        const double deep = positive ? b[axis] : -a[axis];
        const double shallow = positive ? a[axis] : -b[axis];
        if (deep < nearPlane || shallow > farPlane) {
            continue;
        }
        bool seen = true;
        for (int k = 1; k < 3 && seen; ++k) {
            const int across = (axis + k) % 3;
            // Outside one of |across| <= depth: the box's corner nearest to it tells.
            seen = a[across] <= deep && -b[across] <= deep;
        }
        faces |= seen ? 1u << face : 0u;
    }
    return faces;
}

} // namespace lodestar::lighting

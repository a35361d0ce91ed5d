// SPDX-License-Identifier: MIT
//
// The day cycle: a light painted at some hours and blended between them over a day that has no end.
// Filtering is linear, so a blend of bakes is the bake of the blend. Hours are local solar time,
// [0, 24).
#pragma once

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "core/result.h"
#include "core/tally.h"
#include "lighting/gradient.h"
#include "lighting/rsrm_kernel.h"
#include "lighting/zonal.h"

namespace lodestar::lighting {

/// An hour brought into [0, 24); NaN and infinities become 0.
[[nodiscard]] double wrappedHour(double hour);

/// From a to b by t over the shorter arc; exactly 12 hours apart, forwards. @param t [0, 1]
[[nodiscard]] double blendedHour(double a, double b, double t);

/// Two places of a list and how far the second has come: t in [0, 1).
struct KeyBlend {
    std::size_t from = 0;
    std::size_t to = 0;
    double t = 0.0;
};

/// The keys about an hour: from the last one at or before it to the next, across midnight too.
/// @pre hours ascending without duplicates in [0, 24), at least one
[[nodiscard]] KeyBlend keysAt(std::span<const double> hours, double hour);

/// The direction a share t of the way from a to b along their great circle. Nearly opposite axes
/// go by way of a perpendicular that depends on a alone, nearly equal ones in a straight line.
/// @param a, b unit  @return unit
[[nodiscard]] glm::dvec3 slerpAxis(const glm::dvec3& a, const glm::dvec3& b, double t);

/// A sun's way over the sky at a place and day.
struct SunPath {
    double latitude = 0.0;            ///< radians [-pi/2, pi/2], north positive
    int dayOfYear = 81;               ///< [1, 366]
    glm::dvec3 north{0.0, 0.0, -1.0}; ///< unit, across +Y
    bool operator==(const SunPath&) const = default;
};

/// Direction towards the sun at an hour of local solar time: highest at 12, due east of the
/// meridian before (RSRM-11). @return unit
[[nodiscard]] glm::dvec3 sunDirection(const SunPath& path, double hour);

/// The sun's declination on a day, radians (Cooper 1969): within 0.7 degrees.
[[nodiscard]] double sunDeclination(int dayOfYear);

/// How much of a sun shines at its elevation: 1 from the horizon up, 0 from its diameter below it
/// down, smooth between (RSRM-12). @param radius angular radius, radians
[[nodiscard]] double sunVisibility(double elevation, double radius);

/// One moment of a day.
struct DayKey {
    double hour = 0.0;
    Gradient gradient;
    glm::dvec3 tint{1.0};           ///< factor on radiance, >= 0
    std::optional<glm::dvec3> axis; ///< towards the light; without one the light's own holds
};

/// A light over the day.
struct DayLight {
    LightKind kind = LightKind::Sky;
    glm::dvec3 axis{0.0, 1.0, 0.0};
    std::optional<SunPath> path; ///< where there is one, axes are its answers
    std::vector<DayKey> keys;
    std::string name{}; ///< for people and the plan; may be empty
    /// Whether the host's visibility hook is asked for it, as a sun's shadow answers; a sky has
    /// none.
    bool visibility = true;
    bool add = false; ///< a sky beside the distant environment, not in its place
};

/// Whether a light is a sky that stands in the distant environment's place.
[[nodiscard]] inline bool replacesEnvironment(const DayLight& light) {
    return light.kind == LightKind::Sky && !light.add;
}

/// A light put in order: hours in [0, 24) ascending, gradients by `repaired`, axes unit, tints and
/// stops' radiance times the tint in [0, 1e9]. Hours outside are wrapped and counted; of keys at
/// one hour the last listed holds, the others are counted; a zero or non-finite axis becomes +Y and
/// is counted; so is each tint, and each channel of a stop that is too bright under its tint.
/// @errors InputRefused, with a JSON pointer: no keys; an hour that is not finite; a gradient's; a
/// path out of range or with a north that has no part across +Y
[[nodiscard]] core::Result<DayLight> repaired(DayLight light, core::Tally& warnings);

/// What a light is at one hour.
struct DayMoment {
    KeyBlend keys;
    glm::dvec3 axis{0.0, 1.0, 0.0}; ///< unit
    double visibility = 1.0;        ///< a sun's below the horizon, else 1
};

/// @pre the light is as `repaired` leaves it
[[nodiscard]] DayMoment momentAt(const DayLight& light, double hour);

/// A key's zonal radiance, tint included: what is baked once an edit.
[[nodiscard]] ZonalRadiance keyRadiance(const DayLight& light, std::size_t key, const Zones& zones);

/// A key's unfiltered gradient, tint included: what stands beside its map.
[[nodiscard]] std::vector<glm::vec3> keyGradient(const DayLight& light, std::size_t key);

/// (1 - t) a + t b of two bakes, unfiltered gradients or radiances of one shape, times a factor. A
/// map takes a bake and a gradient of the same t and factor.
[[nodiscard]] RsrmBake blended(const RsrmBake& a, const RsrmBake& b, double t, double factor = 1.0);
[[nodiscard]] std::vector<glm::vec3> blended(const std::vector<glm::vec3>& a,
                                             const std::vector<glm::vec3>& b, double t,
                                             double factor = 1.0);
[[nodiscard]] ZonalRadiance blended(const ZonalRadiance& a, const ZonalRadiance& b, double t,
                                    double factor = 1.0);

/// The angular radius of a sun's disc: where its gradient first steps (two stops at one place
/// beyond 0), so that a glow around it does not count; its last stop where there is no step.
/// Radians.
/// @pre a sun's key in order
[[nodiscard]] double sunRadius(const Gradient& gradient);

} // namespace lodestar::lighting

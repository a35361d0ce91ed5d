// SPDX-License-Identifier: MIT
//
// Painted light: radiance as a function of the angle to an axis, given at stops. A sky's stops are
// elevations, a sun's are angles from its axis.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "core/result.h"
#include "core/tally.h"

namespace lodestar::lighting {

/// The range of radiance is [0, kMaxRadiance].
inline constexpr double kMaxRadiance = 1e9;

/// What a gradient is painted on: the whole sphere about the zenith, or a sun about its axis.
enum class LightKind { Sky, Sun };

enum class GradientInterpolation {
    Linear,
    Constant, ///< a stop holds up to the next one listed
    Smooth,   ///< t^2 (3 - 2 t) between stops: level at each
    Cubic,    ///< a monotone cubic (Fritsch and Butland 1984): smooth, never beyond its stops
};

/// The space that stops are interpolated in, applied to radiance as it is, also above 1: sRGB's
/// curve goes on, Oklab (Ottosson 2020) scales with its cube root.
enum class GradientSpace { Linear, Oklab, Srgb };

struct GradientStop {
    double at = 0.0;       ///< degrees: elevation [-90, 90] for a sky, angle [0, 180] for a sun
    glm::dvec3 color{0.0}; ///< linear Rec. 709
    double ev = 0.0;       ///< radiance is color x 2^ev, [0, 1e9]
    bool operator==(const GradientStop&) const = default;
};

struct Gradient {
    std::vector<GradientStop> stops;
    GradientInterpolation interpolation = GradientInterpolation::Linear;
    GradientSpace space = GradientSpace::Linear;
    bool operator==(const Gradient&) const = default;
};

/// A gradient put in order: stops from the axis outwards (a sky's from +90 down), radiance in
/// [0, 1e9]. Stops at one place keep the order listed. A list that runs the other way as a whole
/// is read backwards, so that a Constant one still holds each stop up to the next one listed (it
/// gains a stop: a step where the last one's reach begins); any other disorder is sorted and
/// counted, so is each radiance repaired: NaN and negative values become 0, larger ones 1e9.
/// @errors InputRefused, with a JSON pointer: no stops; `at` not a number or out of range
[[nodiscard]] core::Result<Gradient> repaired(Gradient gradient, LightKind kind,
                                              core::Tally& warnings);

/// A gradient as a function. Before the first stop the first radiance holds; after the last one a
/// sky's holds and a sun is black. At a step the later stop's side counts.
class RadianceProfile {
public:
    /// @pre as `repaired` leaves it
    RadianceProfile(const Gradient& gradient, LightKind kind);

    [[nodiscard]] LightKind kind() const { return kind_; }
    /// Radiance at an angle from the axis (a sky's is the zenith). @param theta radians [0, pi]
    [[nodiscard]] glm::dvec3 radiance(double theta) const;
    /// The angles of the stops, radians, ascending: between two neighbours radiance is smooth.
    [[nodiscard]] const std::vector<double>& breaks() const { return angles_; }

private:
    /// Value and slope at both ends of the piece that ends at stop i, in the space.
    [[nodiscard]] glm::dvec3 between(std::size_t i, double t) const;
    void setSlopes();

    LightKind kind_;
    GradientInterpolation interpolation_;
    GradientSpace space_;
    std::vector<double> angles_;
    std::vector<glm::dvec3> radiances_; ///< linear
    std::vector<glm::dvec3> values_;    ///< in the space
    std::vector<glm::dvec3> slopesIn_;  ///< Cubic: a radian, at a stop, of the piece before it
    std::vector<glm::dvec3> slopesOut_; ///< of the piece after it
};

/// Radiance of one stop, color x 2^ev, repaired.
[[nodiscard]] glm::dvec3 radianceOf(const GradientStop& stop);

} // namespace lodestar::lighting

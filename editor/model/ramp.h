// SPDX-License-Identifier: MIT
//
// A gradient as a function, for drawing, picking and adding stops: pure functions.
#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/result.h"
#include "document/document.h"
#include "lighting/gradient.h"

namespace lodestar::model {

/// The degrees that a stop may lie at.
struct AngleRange {
    double least = 0.0, most = 0.0;
};
[[nodiscard]] AngleRange anglesOf(lighting::LightKind kind);

/// Degrees from the axis of a stop's `at`, and back: a sky's counts from the zenith.
[[nodiscard]] double fromAxis(double at, lighting::LightKind kind);
[[nodiscard]] double atFromAxis(double degrees, lighting::LightKind kind);

/// The gradient as lighting reads it. @errors InputRefused as lighting::repaired
[[nodiscard]] core::Result<lighting::RadianceProfile> profileOf(const document::Gradient& gradient,
                                                                lighting::LightKind kind);

/// Radiance at many places, linear Rec. 709; black where the gradient is refused. The eyedropper on
/// a ramp is this with one place. @param at degrees as in the document
[[nodiscard]] std::vector<glm::dvec3> radianceAt(const document::Gradient& gradient,
                                                 lighting::LightKind kind,
                                                 std::span<const double> at);

/// A stop of a radiance: a colour in [0, 1] where 2^ev alone is the brightest channel's excess;
/// above 1e9 it is 1e9.
/// @param ev kept where the colour then lies in [0, 1]
[[nodiscard]] lighting::GradientStop stopOf(double at, const glm::dvec3& radiance, double ev = 0.0);

/// What a dragged stop may be drawn to.
struct Snap {
    double grid = 0.0;    ///< degrees between lines from 0 on; 0: none
    bool stops = false;   ///< other stops
    bool horizon = false; ///< 0 degrees
    double reach = 1.0;   ///< degrees; what is farther away does not draw
};

/// The nearest of what a stop is drawn to within reach (of two, horizon, then stops, then grid),
/// else the place itself. @param others degrees of the other stops
[[nodiscard]] double snapped(double at, const Snap& snap, std::span<const double> others);

} // namespace lodestar::model

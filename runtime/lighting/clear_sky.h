// SPDX-License-Identifier: MIT
//
// The built-in clear sky: an analytic function of direction, for a scene that brings no
// environment.
#pragma once

#include <glm/vec3.hpp>

namespace lodestar::lighting {

/// Towards the sun at 15:00: in the south-west, 40 degrees high. Unit.
[[nodiscard]] glm::dvec3 clearSkySunDirection();

/// The sun's angular radius, radians (0.27 degrees).
[[nodiscard]] double clearSkySunRadius();

/// Radiance of the sun's disc, uniform over it; added to the sky's.
[[nodiscard]] glm::dvec3 clearSkySunRadiance();

/// Radiance of sky and ground without the sun's disc. Continuous. @param direction unit
[[nodiscard]] glm::dvec3 clearSkyRadiance(const glm::dvec3& direction);

} // namespace lodestar::lighting

// SPDX-License-Identifier: MIT
//
// A photographed sky as lights that can be painted: its mean over azimuth as a gradient, its sun
// taken out as a light of its own.
#pragma once

#include <optional>

#include <glm/vec3.hpp>

#include "core/image.h"
#include "lighting/gradient.h"

namespace lodestar::lighting {

/// What was taken out of a panorama.
struct PhotographedSun {
    glm::dvec3 axis{0.0, 1.0, 0.0}; ///< unit, towards the middle of its light
    double radius = 0.0;            ///< radians: light nearer to the axis was taken
    glm::dvec3 irradiance{0.0};     ///< of a surface that faces it, all that was taken
    Gradient gradient;              ///< of the kind Sun; its energy is that irradiance
};

struct PhotographedLights {
    Gradient sky; ///< about the axis, of the kind Sky; its energy is that of what is left
    std::optional<PhotographedSun> sun;
    /// PanoramaZones' residual of the panorama, and of what is left without its sun: the share of
    /// light that no map symmetric about the axis has where the panorama has it.
    double residualBefore = 0.0;
    double residual = 0.0;
    core::Image rest; ///< the panorama without its sun
};

/// A sun is light within 12 degrees of the brightest place that falls to twice what is about it, in
/// rings, is ten times as bright there, and at least a fiftieth of all light. Within that
/// radius each texel gives what it has beyond the mean of the rings about it. The sky's gradient is
/// piecewise linear through the 16 means over azimuth that keptStops leaves.
/// @param panorama lat-long as for cubeFromLatLong, linear radiance, 3 channels, repaired
/// @param axis unit, of the sky  @param takeSun whether a sun is looked for
[[nodiscard]] PhotographedLights lightsFromPanorama(const core::Image& panorama,
                                                    const glm::dvec3& axis, bool takeSun = true);

} // namespace lodestar::lighting

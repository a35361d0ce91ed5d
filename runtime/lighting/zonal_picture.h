// SPDX-License-Identifier: MIT
//
// Zonal radiance of pictures: a strip painted from the axis outwards, or the mean over azimuth of a
// panorama about any axis.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "core/image.h"
#include "lighting/zonal.h"

namespace lodestar::lighting {

/// Of linear Rec. 709.
[[nodiscard]] double luminance(const glm::dvec3& radiance);

/// The direction of a place in a lat-long panorama: top +Y, the centre column -Z, rightwards to +X.
/// @param x, y pixels from the corner, a pixel's centre at one half @param panorama for its size
[[nodiscard]] glm::dvec3 latLongDirection(double x, double y, const core::Image& panorama);

/// A strip's texels cover equal angles, from the axis (a sky's zenith) to its opposite; each holds
/// one radiance. Zone means are exact. @pre not empty
[[nodiscard]] ZonalRadiance zonalFromStrip(const std::vector<glm::dvec3>& texels,
                                           const Zones& zones);

struct PanoramaZones {
    ZonalRadiance radiance;
    /// Share of the luminance that would have to move within its zone for the zone to be even: 0
    /// for a radially symmetric panorama but for what it changes across a zone or a texel, towards
    /// 1 for a small lamp away from the axis.
    double residual = 0.0;
};

/// Means of a lat-long panorama (cubeFromLatLong's orientation) over the zones about an axis. A
/// texel holds one radiance over its cell, as a strip's does, and gives each zone the solid angle
/// that lies within it, so that a texel's energy is kept whatever the axis.
/// @param panorama linear radiance, 3 channels, repaired  @param axis unit
[[nodiscard]] PanoramaZones zonalFromPanorama(const core::Image& panorama, const glm::dvec3& axis,
                                              const Zones& zones);

} // namespace lodestar::lighting

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

/// A strip's texels cover equal angles, from the axis (a sky's zenith) to its opposite; each holds
/// one radiance. Zone means are exact. @pre not empty
[[nodiscard]] ZonalRadiance zonalFromStrip(const std::vector<glm::dvec3>& texels,
                                           const Zones& zones);

struct PanoramaZones {
    ZonalRadiance radiance;
    /// Share of the luminance that would have to move along its circle about the axis for the
    /// panorama to be radially symmetric: 0 if it is, towards 1 for a small lamp away from the
    /// axis.
    double residual = 0.0;
};

/// Means of a lat-long panorama (cubeFromLatLong's orientation) over the zones about an axis: two
/// bilinear lookups a texel along either direction, on circles of equal areas.
/// @param panorama linear radiance, 3 channels, repaired  @param axis unit
[[nodiscard]] PanoramaZones zonalFromPanorama(const core::Image& panorama, const glm::dvec3& axis,
                                              const Zones& zones);

} // namespace lodestar::lighting

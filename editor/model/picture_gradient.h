// SPDX-License-Identifier: MIT
//
// Gradients out of pictures: what the SetGradient command is then given. io::loadRadiance reads
// the pictures.
#pragma once

#include <cstddef>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/image.h"
#include "core/result.h"
#include "document/document.h"

namespace lodestar::model {

/// The mean of a lat-long panorama over azimuth, about an axis, as a gradient.
/// @param panorama linear radiance, 3 channels, repaired  @param axis not zero
/// @param stops at most so many, by keptStops, [2, 65536]
/// @errors InputRefused: not twice as wide as high, no axis, too few stops
[[nodiscard]] core::Result<document::Gradient> gradientOfPanorama(const core::Image& panorama,
                                                                  const glm::dvec3& axis,
                                                                  lighting::LightKind kind,
                                                                  std::size_t stops);

/// A line over a picture, as on a photograph of a sky, and the angles of its ends, degrees as in
/// the document.
struct PictureLine {
    glm::dvec2 from{0.0}, to{0.0}; ///< pixels from the upper left corner; centres at 0.5
    double fromAt = 90.0, toAt = 0.0;
};

/// Radiance along a line, read between pixels linearly, as a gradient; its edges hold beyond the
/// picture.
/// @param picture linear radiance, 3 channels, repaired  @param stops as above
/// @errors InputRefused: an empty picture, a number that is none, ends at one angle, too few stops
[[nodiscard]] core::Result<document::Gradient> gradientAlongLine(const core::Image& picture,
                                                                 const PictureLine& line,
                                                                 lighting::LightKind kind,
                                                                 std::size_t stops);

} // namespace lodestar::model

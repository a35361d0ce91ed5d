// SPDX-License-Identifier: MIT
//
// Our own high dynamic range panoramas, computed: linear Rec. 709 radiance, lat-long with -Z in the
// centre, +X to the right and +Y up.
#pragma once

#include <functional>

#include <glm/vec3.hpp>

#include "core/image.h"

namespace lodestar::samples {

/// Radiance along a unit direction.
using Radiance = std::function<glm::vec3(const glm::vec3&)>;

/// A courtyard in the late afternoon: arcades about a tiled floor, the sun in the south-west.
/// Without its sun, which lat-long texels are too coarse to sample.
[[nodiscard]] glm::vec3 courtyardRadiance(const glm::vec3& direction);

/// A dark room with five soft boxes of different colours and sizes.
[[nodiscard]] glm::vec3 studioRadiance(const glm::vec3& direction);

/// Six colours, one a cube face, each with its name readable from inside and upright.
[[nodiscard]] glm::vec3 facesRadiance(const glm::vec3& direction);

/// A disc of light seen from the centre.
struct SunDisc {
    glm::vec3 direction; ///< unit, towards it
    float radius;        ///< radians
    glm::vec3 radiance;
};

/// The courtyard's sun: half a degree wide, its irradiance about that of the sky.
[[nodiscard]] SunDisc courtyardSun();

/// Samples a radiance over a panorama of the given height, samples x samples to a texel.
[[nodiscard]] core::Image renderPanorama(const Radiance& radiance, int height, int samples);

/// Adds a disc, each texel by the share of it that the disc covers, so that its irradiance is right
/// however coarse the texels.
void addSun(core::Image& panorama, const SunDisc& sun);

} // namespace lodestar::samples

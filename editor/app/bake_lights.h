// SPDX-License-Identifier: MIT
//
// `lodestar bake PANORAMA -o LIGHTS.lodestar.json`: a photographed sky as lights that can be
// painted.
#pragma once

#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "core/image.h"
#include "document/document.h"
#include "lighting/photographed_lights.h"

namespace lodestar::app {

/// Relative RMS difference over all normals between the irradiance of lights and of the panorama
/// that they were taken from, [0, inf). @param axis unit, of the sky
[[nodiscard]] double diffuseError(const core::Image& panorama,
                                  const lighting::PhotographedLights& lights,
                                  const glm::dvec3& axis);
/// What an artist should make of it: one sentence.
/// @param residual PhotographedLights'  @param error diffuseError's
[[nodiscard]] std::string photographAdvice(double residual, double error);
/// A sky, and a sun where one was found, with one key each, at noon. @param axis unit, of the sky
[[nodiscard]] std::vector<document::Light>
documentLights(const lighting::PhotographedLights& lights, const glm::dvec3& axis);

struct BakeLightsOptions {
    std::string source; ///< a panorama
    std::string output; ///< .json; one that exists stays
    std::string axis;   ///< X,Y,Z; empty: 0,1,0
    bool keepSun = false;
};

/// Writes the document and prints what it holds, and how far it is from the panorama, as JSON.
/// @return the exit status
[[nodiscard]] int bakeLights(const BakeLightsOptions& options);

} // namespace lodestar::app

// SPDX-License-Identifier: MIT
//
// The environments that the estimators are measured on: analytic ones by their definitions, and
// panoramas that Debian ships in blender-data, each as the texel means of a cube.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "lighting/cubemap.h"

namespace lodestar::testing {

struct NamedCube {
    std::string name;
    lighting::Cubemap base;
};

/// Texel means of a radiance function by a grid of subsamples, each weighted by the solid angle it
/// stands for. @param radiance of a unit direction  @param subsamples a side, 1: the texel's centre
[[nodiscard]] lighting::Cubemap
bakeCube(const std::function<glm::dvec3(const glm::dvec3&)>& radiance, int width, int subsamples);

/// A round lamp of radiance 100 on 0.05, tinted (1, 0.95, 0.85).
[[nodiscard]] lighting::Cubemap lampCube(const glm::dvec3& axis, double degrees, int width);

/// The axis near a cube corner about which lamps and extra directions are placed.
inline const glm::dvec3 kCornerAxis{0.48, 0.6, 0.64};
inline const glm::dvec3 kCentreAxis{0.0, 0.0, 1.0};

/// gradient, disc5, disc5c, checker, sixface and facechk.
[[nodiscard]] std::vector<NamedCube> analyticSet(int width);

/// Where blender-data keeps its world panoramas.
[[nodiscard]] std::filesystem::path panoramaPath(const std::string& name);

/// Panoramas by name as cubes, 4x4 bilinear subsamples a texel, negative values as 0.
[[nodiscard]] std::vector<NamedCube> panoramaSet(const std::vector<std::string>& names, int width);

} // namespace lodestar::testing

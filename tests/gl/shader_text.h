// SPDX-License-Identifier: MIT
//
// Small GPU evaluations for tests.
#pragma once

#include <vector>

#include <glm/vec4.hpp>

#include "gl/device.h"
#include "lighting/cubemap.h"

namespace lodestar::testing {

/// textureLod of a cube map for each (direction, level).
[[nodiscard]] std::vector<glm::vec4> fetchCube(gl::Device& device, const lighting::Cubemap& map,
                                               const std::vector<glm::vec4>& lookups);

} // namespace lodestar::testing

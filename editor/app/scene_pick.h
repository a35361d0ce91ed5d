// SPDX-License-Identifier: MIT
//
// What of a scene a ray meets.
#pragma once

#include <optional>

#include <glm/vec3.hpp>

#include "scene/scene.h"

namespace lodestar::app {

/// The primitive that a ray meets first.
struct Met {
    std::size_t node = 0;
    int mesh = 0;
    std::size_t primitive = 0;
    float distance = 0.0f; ///< in lengths of the ray's direction
};

/// Triangles are met from both sides, as they stand at rest; a primitive with a skin by its box.
/// @param direction need not be of length 1  @return nothing where the ray meets none
[[nodiscard]] std::optional<Met> firstMet(const scene::Scene& scene, const glm::vec3& origin,
                                          const glm::vec3& direction);

} // namespace lodestar::app

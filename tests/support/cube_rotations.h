// SPDX-License-Identifier: MIT
//
// A cube map turned by a rotation that takes the cube to itself: texels change places, none
// changes.
#pragma once

#include <glm/mat3x3.hpp>

#include "support/cubes.h"

namespace lodestar::testing {

/// What lies along d in the map lies along turn * d in the result. Level 0.
inline lighting::Cubemap turnedCube(const lighting::Cubemap& map, const glm::mat3& turn) {
    const int n = map.width();
    lighting::Cubemap result(n);
    for (int i = 0; i < 6 * n * n; ++i) {
        const int face = i / (n * n);
        const int x = i % n;
        const int y = i / n % n;
        const glm::vec3 d = turn * glm::vec3(texelDirection(face, x, y, n));
        const auto index = [n](float place) {
            return std::clamp(static_cast<int>((0.5f * place + 0.5f) * static_cast<float>(n)), 0,
                              n - 1);
        };
        const shader::vec2 place = shader::lodestar_cubeCoordinates(d);
        result.texel(shader::lodestar_cubeFace(d), index(place.x), index(place.y)) =
            map.texel(face, x, y);
    }
    return result;
}

} // namespace lodestar::testing

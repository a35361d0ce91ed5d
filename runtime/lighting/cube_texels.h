// SPDX-License-Identifier: MIT
//
// A cube map's texels as a GPU takes them.
#pragma once

#include <cstdint>
#include <vector>

#include "lighting/cubemap.h"

namespace lodestar::lighting {

/// RGBA, face by face in GL's order, row by row, level by level.
struct CubeTexels {
    int width = 0;      ///< of level 0's faces
    bool half = true;   ///< half floats, else floats
    float scale = 1.0f; ///< what a stored colour is multiplied by to be radiance; alpha is as it is
    std::vector<std::vector<std::uint8_t>> levels;

    [[nodiscard]] std::size_t bytes() const;
    [[nodiscard]] std::uint64_t texels() const;
};

/// Half floats with a power-of-two scale where the largest value allows it, else floats: nothing is
/// clamped.
[[nodiscard]] CubeTexels cubeTexels(const Cubemap& map);

} // namespace lodestar::lighting

// SPDX-License-Identifier: MIT
//
// What lies across the edges of a cube's faces. Used by the seamless lookup and by filters that
// reach over an edge.
#pragma once

#include <array>

#include <glm/vec4.hpp>

#include "lighting/cubemap.h"

namespace lodestar::lighting {

/// The four edges of a face: column -1, column n, row -1, row n.
enum class Edge { Left, Right, Top, Bottom };

/// A texel by face, column and row.
struct TexelIndex {
    int face = 0;
    int x = 0;
    int y = 0;
};

/// The row or column of texels that lies across one edge, walked along that edge: texel t (counted
/// in the direction of growing x or y of the face we come from) is (x + t * stepX, y + t * stepY).
struct SeamWalk {
    int face = 0;
    int x = 0;
    int y = 0;
    int stepX = 0;
    int stepY = 0;

    [[nodiscard]] TexelIndex at(int t) const { return {face, x + t * stepX, y + t * stepY}; }
};

/// @param width face width, >= 1
[[nodiscard]] SeamWalk seamWalk(int face, Edge edge, int width);

/// A texel of a level whose x and y may each lie one step outside the face: across an edge it is
/// the neighbouring face's, at a corner of the cube the mean of the three texels that meet there.
/// @pre x, y in [-1, width]
[[nodiscard]] glm::vec4 seamlessTexel(const Cubemap& map, int level, int face, int x, int y);

} // namespace lodestar::lighting

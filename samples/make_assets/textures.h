// SPDX-License-Identifier: MIT
//
// Our own textures, computed. Colours are made linear and stored sRGB-encoded; everything else is
// stored as it is. All tile, except the occlusion maps.
#pragma once

#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/image.h"

namespace lodestar::samples {

/// A surface as images of one size; row 0 at the top.
struct Material {
    core::Image color;             ///< sRGB-encoded base colour
    core::Image normal;            ///< tangent space, green towards the image's top
    core::Image occlusion;         ///< r: 1 open
    core::Image exponent;          ///< r: log2(s + 1) / kExponentScale
    core::Image metallicRoughness; ///< g roughness, b metallic
};

/// Exponent maps hold log2(s + 1) over this: the greatest is 4095.
inline constexpr float kExponentScale = 12.0f;

/// One side of a wooden crate: planks, frame, brace, iron corners. Varnish is worn in places.
[[nodiscard]] Material crateSide(int size);

/// Square stone tiles with worn, polished middles; 2 x 2 tiles an image.
[[nodiscard]] Material stoneTiles(int size);

/// A varnished table top of long boards.
[[nodiscard]] Material tableBoards(int size);

/// Hammered metal of a colour with dull patches.
[[nodiscard]] Material hammeredMetal(int size, const glm::vec3& color);

/// Glazed ceramic with painted bands, for a surface of revolution (v down its side).
[[nodiscard]] Material paintedCeramic(int size);

/// Woven, striped cloth.
[[nodiscard]] Material stripedCloth(int size);

/// A ball that keeps light from a floor: where it stands over the floor's (u, v), metres.
struct Occluder {
    glm::vec3 centre; ///< y is the height above the floor
    float radius;
};

/// How open a floor is beneath balls. The floor spans [-half, half] about `centre` (x, z), u along
/// +x and v along +z. @return r in [0, 1]
[[nodiscard]] core::Image floorOcclusion(int size, const glm::vec2& centre, const glm::vec2& half,
                                         const std::vector<Occluder>& occluders);

} // namespace lodestar::samples

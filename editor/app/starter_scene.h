// SPDX-License-Identifier: MIT
//
// What the editor shows where no scene is named: spheres of one exponent each, on a round floor.
#pragma once

#include "io/gltf.h"

namespace lodestar::app {

/// Five metal spheres of exponents 4 to 16384 in front, five of coloured varnish behind them, all
/// 1 m across, on a pale floor; a camera looks at them from the south.
[[nodiscard]] io::GltfFile starterScene();

/// One sphere of radius 1 m about the origin with texture coordinates, of one material.
[[nodiscard]] io::GltfFile sphereScene();

} // namespace lodestar::app

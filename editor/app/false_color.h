// SPDX-License-Identifier: MIT
//
// Numbers as colours: ever lighter, from near black over blue, red and orange to near white, so
// that it reads without colour too.
#pragma once

#include <glm/vec3.hpp>

#include "core/image.h"

namespace lodestar::app {

/// @param share [0, 1], clamped; NaN is black  @return sRGB as encoded, [0, 1]
[[nodiscard]] glm::vec3 falseColor(double share);

/// An image of one channel in false colour, 4 channels as a PNG holds them.
/// @param most the value that is lightest, > 0
[[nodiscard]] core::Image falseColorPicture(const core::Image& values, double most);

} // namespace lodestar::app

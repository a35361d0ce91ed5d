// SPDX-License-Identifier: MIT
//
// False colours: from near black through violet and red to pale yellow, perceptually even.
#pragma once

#include <glm/vec3.hpp>

namespace lodestar::ui {

/// The colour of a number, sRGB-encoded. Equal steps of the number are equal distances in Oklab
/// [Ottosson20], and lightness rises throughout, so that it reads in grey and by the
/// colour-blind.
/// @param x [0, 1], clamped; NaN as 0
[[nodiscard]] glm::vec3 falseColor(double x);

} // namespace lodestar::ui

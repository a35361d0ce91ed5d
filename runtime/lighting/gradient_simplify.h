// SPDX-License-Identifier: MIT
//
// Fewer stops for nearly the same gradient.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lighting/gradient.h"

namespace lodestar::lighting {

/// Which stops stay when all but `count` have gone, first and last among them: again and again the
/// stop goes whose triangle with its neighbours, of angle and radiance in all channels, is smallest
/// (Visvalingam and Whyatt 1993). All stay where there are no more than `count`.
/// @param stops in order  @pre count >= 2
[[nodiscard]] std::vector<bool> keptStops(std::span<const GradientStop> stops, std::size_t count);

} // namespace lodestar::lighting

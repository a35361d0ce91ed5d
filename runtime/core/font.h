// SPDX-License-Identifier: MIT
//
// A small bitmap font of our own: ASCII 32 to 126, seven rows above the baseline and two below,
// each glyph as wide as it is drawn. Other characters show as a box.
#pragma once

#include <array>
#include <string>

#include "core/image.h"

namespace lodestar::core {

inline constexpr int kFontAscent = 7;
inline constexpr int kFontDescent = 2;

/// Width of a line of text in pixels. @param scale size of a dot, >= 1
[[nodiscard]] int textWidth(const std::string& text, int scale);

/// Draws a line of text with its top left corner at (x, y); what lies outside the image is cut off.
/// @param image of three channels or four, of which the first three are written
void drawText(Image& image, int x, int y, const std::string& text, int scale,
              const std::array<float, 3>& color);

} // namespace lodestar::core

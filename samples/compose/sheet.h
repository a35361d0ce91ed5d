// SPDX-License-Identifier: MIT
//
// A contact sheet: rows of pictures with a title, column heads and captions.
#pragma once

#include <string>
#include <vector>

#include "core/image.h"

namespace lodestar::samples {

struct Cell {
    core::Image image; ///< encoded, 4 channels: rgb and unassociated alpha
    std::string caption;
    std::vector<core::Image> insets; ///< as image; small maps laid over its lower left
};

struct SheetRow {
    std::string label; ///< above the row; may be empty
    std::vector<Cell> cells;
};

struct Sheet {
    std::string title;
    std::string note;                 ///< a line below the title
    std::vector<std::string> columns; ///< heads, spread evenly over the width
    std::vector<SheetRow> rows;
    int width = 1280; ///< of the whole sheet, pixels
};

/// Draws a sheet; insets are stretched to a third of their picture's width, texels kept sharp. Each
/// row's pictures are made equally high and shrunk to the sheet's width together (never enlarged).
/// @pre every row has a cell, no image is empty
[[nodiscard]] core::Image drawSheet(const Sheet& sheet);

} // namespace lodestar::samples

// SPDX-License-Identifier: MIT
//
// The plots of `lodestar cost`, drawn by gnuplot.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cost_table.h"
#include "core/result.h"

namespace lodestar::app {

struct CostPlot {
    std::string title;
    std::filesystem::path file; ///< an SVG
};

/// Whether gnuplot can be run.
[[nodiscard]] bool canPlot();

/// Draws three plots a map: error against fetches, against milliseconds with the Pareto front, and
/// against the exponent. @errors OutputFailed naming the file
[[nodiscard]] core::Result<std::vector<CostPlot>> plotCost(const CostTable& table,
                                                           const std::filesystem::path& folder);

} // namespace lodestar::app

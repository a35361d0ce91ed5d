// SPDX-License-Identifier: MIT
//
// The page of `lodestar cost`: one HTML file that needs no other and no network.
#pragma once

#include <string>
#include <vector>

#include "app/cost_plots.h"
#include "app/cost_table.h"
#include "core/result.h"

namespace lodestar::app {

/// The conclusion in words, a sentence a line: what the table says of its maps.
[[nodiscard]] std::vector<std::string> costConclusion(const CostTable& table);

/// The page. @param pictures PNGs of table.pictures, in its order
/// @errors InputRefused where a plot or picture cannot be read again
[[nodiscard]] core::Result<std::string>
costPage(const CostTable& table, const std::vector<CostPlot>& plots,
         const std::vector<std::filesystem::path>& pictures);

} // namespace lodestar::app

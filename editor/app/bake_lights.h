// SPDX-License-Identifier: MIT
//
// `lodestar bake PANORAMA -o LIGHTS.lodestar.json`: a photographed sky as lights that can be
// painted.
#pragma once

#include <string>

namespace lodestar::app {

struct BakeLightsOptions {
    std::string source; ///< a panorama
    std::string output; ///< .json; one that exists stays
    std::string axis;   ///< X,Y,Z; empty: 0,1,0
    bool keepSun = false;
};

/// Writes the document and prints what it holds, and how far it is from the panorama, as JSON.
/// @return the exit status
[[nodiscard]] int bakeLights(const BakeLightsOptions& options);

} // namespace lodestar::app

// SPDX-License-Identifier: MIT
//
// The rows of numerical hazards, each with what the C++ form of the shading text answers.
#pragma once

#include <vector>

#include "support/glsl_function.h"

namespace lodestar::testing {

struct HazardRow {
    int number; ///< of docs/numerics.md
    const char* file;
    const char* expression; ///< of p0 to p9, one number, C++ and GLSL
    GlslCase inputs;
    double expected;
    double bound; ///< absolute
    double inCpp; ///< the expression's value
};

[[nodiscard]] std::vector<HazardRow> hazardRows();

} // namespace lodestar::testing

// SPDX-License-Identifier: MIT
#include "parity/rows.h"

#include <string_view>

#include "parity/cases.h"
#include "parity/tolerances.h"

namespace lodestar::testing {

namespace {

/// Functions that fetch nothing, in a file where others do, link with its hooks only.
const char* hooksOf(std::string_view file) {
    return file == "lodestar/rsrm.glsl" ? "rsrm_helpers.glsl" : nullptr;
}

} // namespace

std::vector<ParityRow> parityRows() {
    std::vector<ParityRow> rows;
#define PARITY_ROW(function, file, cases, tolerance, ...)                                          \
    rows.push_back({#function, file, 0, #__VA_ARGS__, cases, tolerance, hooksOf(file)});
#include "parity/function_rows.inc"
#undef PARITY_ROW
    for (int specular = 0; specular < kSpecularVariants; ++specular) {
#define PARITY_ROW(function, file, cases, tolerance, ...)                                          \
    rows.push_back({#function, file, specular, #__VA_ARGS__, cases, tolerance, "helpers.glsl"});
#include "parity/environment_rows.inc"
#undef PARITY_ROW
    }
#define PARITY_ROW(function, file, cases, tolerance, ...)                                          \
    rows.push_back({#function, file, 0, #__VA_ARGS__, cases, tolerance, "rsrm_helpers.glsl"});
#include "parity/rsrm_rows.inc"
#undef PARITY_ROW
    return rows;
}

} // namespace lodestar::testing

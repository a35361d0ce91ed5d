// SPDX-License-Identifier: MIT
//
// The functions of shaders/lodestar as rows that can be evaluated by both compilations, float and
// double, with the rounding error each may have.
#pragma once

#include <vector>

namespace lodestar::testing {

/// Half a unit in the last place of a float of 1: the relative error of one rounding.
inline constexpr double kRounding = 5.9604644775390625e-8;

/// How an argument is drawn.
struct DualRange {
    double low;
    double high;
    bool logarithmic = false;
};

struct DualRow {
    const char* name;
    std::vector<DualRange> arguments;
    double absolute; ///< in roundings: |float - double| <= (absolute + relative |double|) kRounding
    double relative;
    double (*evaluate)(const double* arguments);
};

/// The same rows, evaluated in float and in double.
[[nodiscard]] std::vector<DualRow> floatRows();
[[nodiscard]] std::vector<DualRow> doubleRows();

} // namespace lodestar::testing

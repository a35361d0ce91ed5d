// SPDX-License-Identifier: MIT
//
// The hazards of docs/numerics.md in C++: the rows of hazard_rows.inc.
#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "numerics/hazard_rows.h"

namespace lodestar::testing {

TEST(Hazards, InCpp) {
    const std::vector<HazardRow> rows = hazardRows();
    ASSERT_FALSE(rows.empty());
    for (const HazardRow& row : rows) {
        EXPECT_LE(std::abs(row.inCpp - row.expected), row.bound)
            << row.number << ": " << row.expression << " is " << row.inCpp << ", not "
            << row.expected;
    }
}

} // namespace lodestar::testing

// SPDX-License-Identifier: MIT
#include "core/parallel.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace lodestar::core {
namespace {

TEST(Parallel, EachIndexOnce) {
    for (const std::size_t count : {0u, 1u, 2u, 1000u}) {
        std::vector<int> calls(count);
        inParallel(count, [&](std::size_t i) { ++calls[i]; });
        EXPECT_EQ(std::count(calls.begin(), calls.end(), 1), static_cast<std::ptrdiff_t>(count));
    }
}

TEST(Parallel, ProgressComesOnTheCallersThreadAndRises) {
    std::vector<std::size_t> told; // not guarded: a race here is one in inParallel
    inParallel(
        500, [](std::size_t) {}, [&](std::size_t done) { told.push_back(done); });
    EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
    EXPECT_TRUE(std::all_of(told.begin(), told.end(),
                            [](std::size_t done) { return done >= 1 && done <= 500; }));
}

} // namespace
} // namespace lodestar::core

// SPDX-License-Identifier: MIT
#include "core/tally.h"

#include <gtest/gtest.h>

namespace lodestar::core {
namespace {

TEST(Tally, CountsByRule) {
    Tally tally;
    EXPECT_TRUE(tally.empty());
    tally.add("negative");
    tally.add("negative", 3);
    tally.add("not finite");
    EXPECT_EQ(tally.counts().at("negative"), 4u);
    EXPECT_EQ(tally.counts().at("not finite"), 1u);
    EXPECT_EQ(tally.counts().size(), 2u);
}

TEST(Tally, NothingCountedLeavesNoRule) {
    Tally tally;
    tally.add("negative", 0);
    EXPECT_TRUE(tally.empty());
}

TEST(Tally, MergingAddsUp) {
    Tally first;
    first.add("a", 2);
    first.add("b", 1);
    Tally second;
    second.add("b", 5);
    second.add("c", (1ull << 40));
    first.merge(second);
    EXPECT_EQ(first.counts().at("a"), 2u);
    EXPECT_EQ(first.counts().at("b"), 6u);
    EXPECT_EQ(first.counts().at("c"), 1ull << 40);
    EXPECT_EQ(second.counts().size(), 2u) << "the other tally is left as it was";
    first.merge(Tally());
    EXPECT_EQ(first.counts().size(), 3u);
}

} // namespace
} // namespace lodestar::core

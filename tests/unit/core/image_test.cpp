// SPDX-License-Identifier: MIT
#include "core/image.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "support/throwing_contract.h"

namespace lodestar::core {
namespace {

TEST(Image, StartsEmptyAndIsZeroWhenMade) {
    EXPECT_TRUE(Image().empty());
    const Image image(4, 3, 2);
    EXPECT_EQ(image.width(), 4);
    EXPECT_EQ(image.height(), 3);
    EXPECT_EQ(image.channels(), 2);
    ASSERT_EQ(image.pixels().size(), 24u);
    EXPECT_TRUE(std::all_of(image.pixels().begin(), image.pixels().end(),
                            [](float x) { return x == 0.0f; }));
}

TEST(Image, RowsRunFromTheTopWithChannelsInterleaved) {
    Image image(3, 2, 4);
    for (std::size_t i = 0; i < image.pixels().size(); ++i) {
        image.pixels()[i] = static_cast<float>(i);
    }
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 3; ++x) {
            for (int c = 0; c < 4; ++c) {
                EXPECT_EQ(image.at(x, y)[c], static_cast<float>((y * 3 + x) * 4 + c));
            }
        }
    }
    image.at(2, 1)[3] = -1.0f;
    EXPECT_EQ(image.pixels().back(), -1.0f);
}

TEST(Image, CopiesAreIndependent) {
    Image first(1, 1, 1);
    Image second = first;
    second.at(0, 0)[0] = 5.0f;
    EXPECT_EQ(first.at(0, 0)[0], 0.0f);
}

TEST(Image, AnEmptyRectangleIsAnImageWithoutPixels) {
    EXPECT_TRUE(Image(0, 7, 3).empty());
    EXPECT_EQ(Image(0, 7, 3).height(), 7);
}

TEST(Image, RefusesWhatIsNoImage) {
    const testing::ThrowingContracts throwing;
    EXPECT_THROW(Image(1, 1, 0), testing::ContractBroken);
    EXPECT_THROW(Image(-1, 1, 1), testing::ContractBroken);
    EXPECT_THROW(Image(1, -1, 1), testing::ContractBroken);
    EXPECT_THROW(Image(1, 1, 5), testing::ContractBroken);
}

} // namespace
} // namespace lodestar::core

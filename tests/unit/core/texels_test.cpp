// SPDX-License-Identifier: MIT
#include "core/texels.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/throwing_contract.h"

namespace lodestar::core {
namespace {

TEST(Texels, TakeAsManyBytesAsTheirDepthSays) {
    EXPECT_TRUE(Texels().empty());
    EXPECT_EQ(Texels(5, 3).bytes().size(), 60u);
    EXPECT_EQ(Texels(5, 3, SampleDepth::Bits16).bytes().size(), 120u);
    EXPECT_EQ(Texels(5, 3, SampleDepth::Bits16).rowBytes(), 40u);
    const testing::ThrowingContracts throwing;
    EXPECT_THROW(Texels(-1, 1), testing::ContractBroken);
    EXPECT_THROW(Texels(1, -1), testing::ContractBroken);
}

TEST(Texels, EveryLevelComesBackAsItWasSet) {
    for (const SampleDepth depth : {SampleDepth::Bits8, SampleDepth::Bits16}) {
        const int most = depth == SampleDepth::Bits8 ? 255 : 65535;
        Texels texels(most + 1, 1, depth);
        for (int level = 0; level <= most; ++level) {
            texels.set(level, 0, level % 4, static_cast<float>(level) / static_cast<float>(most));
        }
        for (int level = 0; level <= most; ++level) {
            ASSERT_EQ(texels.value(level, 0, level % 4),
                      static_cast<float>(level) / static_cast<float>(most));
        }
    }
}

TEST(Texels, JustBelowHalfALevelIsNone) {
    for (const SampleDepth depth : {SampleDepth::Bits8, SampleDepth::Bits16}) {
        const float most = depth == SampleDepth::Bits8 ? 255.0f : 65535.0f;
        float value = 0.5f / most;
        while (value * most >= 0.5f) {
            value = std::nextafter(value, 0.0f);
        }
        Texels texels(1, 1, depth); // adding a half and cutting off would give the first level
        texels.set(0, 0, 0, value);
        EXPECT_EQ(texels.value(0, 0, 0), 0.0f);
    }
}

TEST(Texels, ValuesOutsideAreBroughtIn) {
    for (const SampleDepth depth : {SampleDepth::Bits8, SampleDepth::Bits16}) {
        Texels texels(2, 2, depth);
        texels.set(1, 1, 0, -3.0f);
        texels.set(1, 1, 1, 7.0f);
        texels.set(1, 1, 2, std::nanf(""));
        texels.set(1, 1, 3, INFINITY);
        EXPECT_EQ(texels.value(1, 1, 0), 0.0f);
        EXPECT_EQ(texels.value(1, 1, 1), 1.0f);
        EXPECT_EQ(texels.value(1, 1, 2), 0.0f);
        EXPECT_EQ(texels.value(1, 1, 3), 1.0f);
        EXPECT_EQ(texels.value(0, 1, 3), 0.0f);
    }
}

} // namespace
} // namespace lodestar::core

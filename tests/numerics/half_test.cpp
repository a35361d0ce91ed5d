// SPDX-License-Identifier: MIT
//
// Half floats (hazards 6 to 8 of docs/numerics.md): rounded to nearest, clamped where they would be
// infinite, and maps brighter than they reach stored with a scale.
#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "core/half.h"
#include "lighting/cube_texels.h"
#include "support/cubes.h"

namespace lodestar::testing {

using core::floatFromHalf;
using core::halfFromFloat;

TEST(HalfFloats, EveryOneComesBackAsItWas) {
    for (unsigned bits = 0; bits < 65536; ++bits) {
        const auto half = static_cast<std::uint16_t>(bits);
        const float value = floatFromHalf(half);
        if (std::isnan(value)) {
            EXPECT_TRUE(std::isnan(floatFromHalf(halfFromFloat(value)))) << bits;
        } else {
            EXPECT_EQ(halfFromFloat(value), half) << bits;
        }
    }
}

// Between two neighbours: the nearer one, and of the middle the even one.
TEST(HalfFloats, RoundToTheNearest) {
    for (std::uint16_t low = 0; low < 0x7bff; ++low) {
        const auto high = static_cast<std::uint16_t>(low + 1);
        const float middle = 0.5f * (floatFromHalf(low) + floatFromHalf(high)); // exact
        ASSERT_EQ(halfFromFloat(middle), low % 2 == 0 ? low : high) << low;
        ASSERT_EQ(halfFromFloat(std::nextafter(middle, 0.0f)), low) << low;
        ASSERT_EQ(halfFromFloat(std::nextafter(middle, 1e9f)), high) << low;
        ASSERT_EQ(halfFromFloat(-middle), 0x8000 | (low % 2 == 0 ? low : high)) << low;
    }
}

TEST(HalfFloats, FiniteNumbersStayFinite) {
    for (const float value :
         {65504.0f, 65519.0f, 65520.0f, 147020.615f, 1e9f, std::numeric_limits<float>::max()}) {
        EXPECT_EQ(floatFromHalf(halfFromFloat(value)), 65504.0f) << value;
        EXPECT_EQ(floatFromHalf(halfFromFloat(-value)), -65504.0f) << value;
    }
    EXPECT_TRUE(std::isinf(floatFromHalf(halfFromFloat(std::numeric_limits<float>::infinity()))));
}

// A sun of irradiance 10 over its disc of 0.2666 degrees; twice the solid angle by 4 pi sin^2(t /
// 2), which 2 pi (1 - cos t) in float misses by 0.2 %.
TEST(HalfFloats, AMapsScaleKeepsASun) {
    const double half = 0.2666 * M_PI / 360.0;
    const double omega = 4.0 * M_PI * std::sin(half) * std::sin(half);
    EXPECT_NEAR(omega, 6.80180402e-5, 1e-13);
    const float radiance = static_cast<float>(10.0 / omega);
    for (const float brightest : {1.0f, 65504.0f, 65520.0f, radiance, 4e6f, 1e9f}) {
        lighting::Cubemap map = constantCube(4, glm::vec4(0.25f));
        map.texel(2, 1, 1) = glm::vec4(brightest);
        const lighting::CubeTexels texels = lighting::cubeTexels(map);
        const std::size_t at = 4 * (2 * 16 + 4 * 1 + 1);
        float stored = 0.0f;
        if (texels.half) {
            std::uint16_t bits = 0;
            std::memcpy(&bits, texels.levels[0].data() + at * sizeof bits, sizeof bits);
            stored = floatFromHalf(bits);
            EXPECT_LE(stored, 65504.0f);
        } else {
            std::memcpy(&stored, texels.levels[0].data() + at * sizeof stored, sizeof stored);
        }
        // Eleven bits, rounded: half a step.
        EXPECT_NEAR(stored * texels.scale, brightest, brightest * 0x1p-11f);
        EXPECT_EQ(texels.half, brightest <= 64.0f * 65504.0f) << brightest;
    }
}

} // namespace lodestar::testing

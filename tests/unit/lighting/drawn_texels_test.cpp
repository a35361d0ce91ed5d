// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "lighting/drawn_texels.h"
#include "lighting/environment.h"

namespace lodestar::lighting {
namespace {

// Texel means of a gradient from 0 to 2 have the mean 1 over the sphere in each channel, to the
// rounding of floats.
TEST(DrawnTexels, TheSumIsOverTheSphere) {
    const Cubemap gradient = cubeFromAnalytic(*parseAnalytic("gradient:0,2"), 16);
    EXPECT_NEAR(lightSum(gradient) / (12.0 * std::numbers::pi), 1.0, 1e-5);
}

// A lamp of 10 degrees with half of the light: evenly spaced points give it half of the draws, to
// one.
TEST(DrawnTexels, EachShareOfTheLightIsDrawnAsOften) {
    const double angle = 10.0 * std::numbers::pi / 180.0;
    const double share = 0.5 * (1.0 - std::cos(angle)); // of the sphere
    const double inside = (1.0 - share) / share;
    const Cubemap map = cubeFromAnalytic(
        DiscEnvironment{{0.0, 1.0, 0.0}, angle, glm::dvec3(inside), glm::dvec3(1.0)}, 64);
    const std::vector<DrawnTexel> drawn = drawnTexels(map, 1000);
    ASSERT_EQ(drawn.size(), 1000u);
    int lamp = 0;
    glm::dvec3 mean(0.0);
    for (const DrawnTexel& texel : drawn) {
        EXPECT_NEAR(glm::length(texel.direction), 1.0, 1e-6);
        // Texels that the rim crosses reach half a diagonal, 1.3 degrees, further.
        lamp += std::acos(static_cast<double>(texel.direction.y)) < angle + 0.023 ? 1 : 0;
        mean += glm::dvec3(texel.radianceOverDensity) / 1000.0;
    }
    // Beside the lamp that ring of 1.3 degrees holds .3 % of the rest.
    EXPECT_NEAR(lamp, 500, 3);
    EXPECT_NEAR(3.0 * mean.r / lightSum(map), 1.0, 1e-5) << "their mean is the light";
}

TEST(DrawnTexels, OfABlackMapThereAreNone) {
    EXPECT_TRUE(drawnTexels(Cubemap(4), 16).empty());
}

} // namespace
} // namespace lodestar::lighting

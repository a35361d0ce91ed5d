// SPDX-License-Identifier: MIT
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "app/error_view.h"
#include "ui/false_color.h"

namespace lodestar::app {
namespace {

/// Oklab of an sRGB-encoded colour. [Ottosson20], the other way than the map's.
glm::dvec3 oklab(const glm::vec3& encoded) {
    glm::dvec3 c(encoded);
    for (int i = 0; i < 3; ++i) {
        c[i] = c[i] <= 0.04045 ? c[i] / 12.92 : std::pow((c[i] + 0.055) / 1.055, 2.4);
    }
    const double l = std::cbrt(0.4122214708 * c.r + 0.5363325363 * c.g + 0.0514459929 * c.b);
    const double m = std::cbrt(0.2119034982 * c.r + 0.6806995451 * c.g + 0.1073969566 * c.b);
    const double s = std::cbrt(0.0883024619 * c.r + 0.2817188376 * c.g + 0.6299787005 * c.b);
    return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
            1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
            0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

// Steps along the curve are equal; their chords are shorter by the turn's square over 24, .5 %
// where a sixteenth of the curve turns by 20 degrees, and floats of sRGB keep a step to 1e-5.
TEST(FalseColor, EqualStepsLookEquallyFarApartAndEverLighter) {
    constexpr int kParts = 16;
    const double whole =
        glm::distance(oklab(ui::falseColor(0.0)), oklab(ui::falseColor(1.0 / kParts)));
    for (int i = 1; i < kParts; ++i) {
        const glm::dvec3 from = oklab(ui::falseColor(static_cast<double>(i) / kParts));
        const glm::dvec3 to = oklab(ui::falseColor((i + 1.0) / kParts));
        EXPECT_NEAR(glm::distance(from, to) / whole, 1.0, 0.006) << i;
        EXPECT_GT(to.x, from.x + 0.02) << i;
    }
}

TEST(FalseColor, NumbersBeyondItsEndsAreTheEnds) {
    EXPECT_EQ(ui::falseColor(-1.0), ui::falseColor(0.0));
    EXPECT_EQ(ui::falseColor(std::nan("")), ui::falseColor(0.0));
    EXPECT_EQ(ui::falseColor(7.0), ui::falseColor(1.0));
}

core::Image pixels(const std::vector<glm::vec4>& values) {
    core::Image image(static_cast<int>(values.size()), 1, 4);
    for (std::size_t i = 0; i < values.size(); ++i) {
        std::copy_n(&values[i].x, 4, image.at(static_cast<int>(i), 0));
    }
    return image;
}

// Surfaces of sums 3, 1.2 and 0 against 3, 1, 0.06; the mean of the reference is 4.06 / 3, a tenth
// of it .13533, so that the darkest errs by .06 / .13533.
TEST(ErrorView, ErrorsAreOverTheReferenceOrATenthOfItsMean) {
    ErrorView view(pixels({{1, 1, 1, 1}, {0.6f, 0.6f, 0, 1}, {0, 0, 0, 1}, {9, 9, 9, 0}}));
    view.add(pixels({{1, 1, 1, 1}, {0.5f, 0.5f, 0, 1}, {0.02f, 0.02f, 0.02f, 1}, {0, 0, 0, 0}}));
    const ErrorFigures figures = view.figures();
    const double dark = 0.06 / (0.1 * 4.06 / 3.0);
    EXPECT_EQ(figures.pixels, 3u);
    EXPECT_NEAR(figures.mean, (0.2 + dark) / 3.0, 1e-6);
    EXPECT_NEAR(figures.rms, std::sqrt((0.04 + dark * dark) / 3.0), 1e-6);
    EXPECT_NEAR(figures.worst, dark, 1e-6);
    EXPECT_EQ(figures.worstX, 2);
    EXPECT_EQ(figures.spread, 0.0);
}

TEST(ErrorView, TheReferenceIsTheMeanOfItsPasses) {
    ErrorView view(pixels({{2, 2, 2, 1}}));
    view.add(pixels({{1, 1, 1, 1}}));
    view.add(pixels({{3, 3, 3, 1}}));
    EXPECT_EQ(view.passes(), 2);
    EXPECT_NEAR(view.figures().mean, 0.0, 1e-6);
    EXPECT_NEAR(view.figures().spread, 0.5, 1e-6) << "half of 3 - 1, over 2";
}

} // namespace
} // namespace lodestar::app

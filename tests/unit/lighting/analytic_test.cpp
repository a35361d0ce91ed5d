// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "lighting/clear_sky.h"
#include "lighting/environment.h"
#include "lighting/mips.h"
#include "support/cubes.h"

namespace lodestar::lighting {
namespace {

constexpr double kPi = std::numbers::pi;

TEST(ParseAnalytic, KnowsItsWords) {
    EXPECT_TRUE(isAnalytic("constant:1,1,1"));
    EXPECT_TRUE(isAnalytic("disc:"));
    EXPECT_FALSE(isAnalytic("constant"));
    EXPECT_FALSE(isAnalytic("sky.hdr"));
    EXPECT_FALSE(isAnalytic("C:\\sky.hdr"));
    EXPECT_FALSE(isAnalytic(""));
}

TEST(ParseAnalytic, ReadsEveryKind) {
    const auto constant = parseAnalytic("constant:0.5,1,2e3");
    ASSERT_TRUE(constant);
    EXPECT_EQ(std::get<ConstantEnvironment>(*constant).radiance, glm::dvec3(0.5, 1, 2000));
    const auto gradient = parseAnalytic("gradient:0.1,1/2/3");
    ASSERT_TRUE(gradient);
    EXPECT_EQ(std::get<GradientEnvironment>(*gradient).down, glm::dvec3(0.1));
    EXPECT_EQ(std::get<GradientEnvironment>(*gradient).up, glm::dvec3(1, 2, 3));
    const auto disc = parseAnalytic("disc:0,-3,4,90,1/2/3");
    ASSERT_TRUE(disc);
    const auto& d = std::get<DiscEnvironment>(*disc);
    EXPECT_NEAR(d.axis.y, -0.6, 1e-15);
    EXPECT_NEAR(d.axis.z, 0.8, 1e-15);
    EXPECT_NEAR(d.angularRadius, kPi / 2, 1e-15);
    EXPECT_EQ(d.inside, glm::dvec3(1, 2, 3));
    EXPECT_EQ(d.outside, glm::dvec3(0));
    EXPECT_EQ(std::get<DiscEnvironment>(*parseAnalytic("disc:1e-200,0,0,+5,1,0.25")).outside,
              glm::dvec3(0.25));
    const auto faces = parseAnalytic("faces:1;2/3/4;5,6,7;0;0;9");
    ASSERT_TRUE(faces);
    EXPECT_EQ(std::get<FacesEnvironment>(*faces).radiance[1], glm::dvec3(2, 3, 4));
    EXPECT_EQ(std::get<FacesEnvironment>(*faces).radiance[2], glm::dvec3(5, 6, 7));
}

TEST(ParseAnalytic, RefusesWithAUsageError) {
    for (const char* text : {"constant:",
                             "constant:1",
                             "constant:1,1",
                             "constant:1,1,1,1",
                             "constant:1,,1",
                             "constant:1,x,1",
                             "constant:1,1,1 ",
                             "constant:-1,0,0",
                             "constant:1e10,0,0",
                             "constant:nan,0,0",
                             "constant:inf,0,0",
                             "constant:1e999,0,0",
                             "constant:0x10,0,0",
                             "constant:+,0,0",
                             "constant:+-1,0,0",
                             "gradient:1",
                             "gradient:1,2,3",
                             "gradient:1/2,1",
                             "gradient:1/2/3/4,1",
                             "disc:0,0,0,5,1",
                             "disc:0,1,0,5",
                             "disc:0,1,0,0,1",
                             "disc:0,1,0,181,1",
                             "disc:0,1,0,-5,1",
                             "disc:0,1,0,5,1,2,3",
                             "disc:nan,1,0,5,1",
                             "disc:0,1,0,5,-1",
                             "faces:1;2;3;4;5",
                             "faces:1;2;3;4;5;6;7",
                             "faces:1;2;3;4;5;",
                             "faces:1,2;1;1;1;1;1",
                             "sky.hdr",
                             ""}) {
        const auto result = parseAnalytic(text);
        ASSERT_FALSE(result) << text;
        EXPECT_EQ(result.error().code, core::ErrorCode::Usage) << text;
        EXPECT_FALSE(result.error().what.empty());
        EXPECT_EQ(result.error().message().find('\n'), std::string::npos);
    }
}

TEST(ParseAnalytic, SurvivesAnyText) {
    std::mt19937 random(1);
    const std::string_view letters = "0123456789.,;/:+-eEnaif x\n\xff";
    std::uniform_int_distribution<std::size_t> letter(0, letters.size() - 1);
    std::uniform_int_distribution<int> length(0, 40);
    int refused = 0;
    for (int k = 0; k < 20000; ++k) {
        std::string text = k % 2 == 0 ? "disc:" : "faces:";
        for (int i = length(random); i > 0; --i) {
            text += letters[letter(random)];
        }
        refused += parseAnalytic(text) ? 0 : 1;
    }
    EXPECT_GT(refused, 0);
}

TEST(AnalyticRadiance, IsTheFunctionNamed) {
    const auto at = [](const char* text, const glm::dvec3& d) {
        return radiance(*parseAnalytic(text), glm::normalize(d)).x;
    };
    EXPECT_EQ(at("constant:3,0,0", {1, 2, 3}), 3.0);
    EXPECT_NEAR(at("gradient:1,3", {0, -1, 0}), 1.0, 1e-15);
    EXPECT_NEAR(at("gradient:1,3", {1, 0, 0}), 2.0, 1e-15);
    EXPECT_NEAR(at("gradient:1,3", {0, 1, 0}), 3.0, 1e-15);
    const double inside = 9.99 * kPi / 180.0;
    const double outside = 10.01 * kPi / 180.0;
    EXPECT_EQ(at("disc:0,1,0,10,5,2", {std::sin(inside), std::cos(inside), 0}), 5.0);
    EXPECT_EQ(at("disc:0,1,0,10,5,2", {std::sin(outside), std::cos(outside), 0}), 2.0);
    EXPECT_EQ(at("faces:1;2;3;4;5;6", {0.1, -0.2, -1}), 6.0);
    EXPECT_EQ(at("faces:1;2;3;4;5;6", {-1, 0.5, 0.5}), 2.0);
}

/// Mean over the sphere of y f(d): 1/3 of the slope for a function linear in y.
double firstMomentY(const Cubemap& cube, int channel) {
    const int n = cube.width();
    const std::vector<double> omega = texelSolidAngles(n);
    double sum = 0.0;
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < n * n; ++i) {
            sum += omega[static_cast<std::size_t>(i)] *
                   testing::texelDirection(face, i % n, i / n, n).y *
                   static_cast<double>(cube.texel(face, i % n, i / n)[channel]);
        }
    }
    return sum / (4.0 * kPi);
}

TEST(CubeFromAnalytic, GradientMeetsClosedForms) {
    for (const int n : {1, 2, 7, 64, 256}) {
        const Cubemap cube = cubeFromAnalytic(*parseAnalytic("gradient:0.25/1/0,1.25/3/1"), n);
        // Texels in float: 6e-8 each.
        EXPECT_NEAR(sphereMean(cube, 0).x, 0.75, 1e-7) << n;
        EXPECT_NEAR(sphereMean(cube, 0).y, 2.0, 2e-7) << n;
        // Texel means against centre directions: each texel loses a share (texel size)^2 / 12
        // twice, so this is a check of 256 only: (2 / 256)^2 / 6 = 1e-5.
        if (n == 256) {
            EXPECT_NEAR(firstMomentY(cube, 0), 0.5 / 3.0, 1e-5 * 0.5);
        }
    }
}

/// Exact texel means of y: the mean of unit directions over a spherical rectangle is half the sum
/// over its four edges of edge angle times edge normal, over the solid angle.
double exactMeanY(int face, int x, int y, int n) {
    const auto corner = [&](int a, int b) {
        const float u = 2.0f * static_cast<float>(x + a) / static_cast<float>(n) - 1.0f;
        const float v = 2.0f * static_cast<float>(y + b) / static_cast<float>(n) - 1.0f;
        return glm::normalize(glm::dvec3(shader::lodestar_cubeDirection(face, u, v)));
    };
    const glm::dvec3 corners[4] = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
    glm::dvec3 sum(0.0);
    for (int k = 0; k < 4; ++k) {
        const glm::dvec3 c = glm::cross(corners[k], corners[(k + 1) % 4]);
        const double angle = std::atan2(glm::length(c), glm::dot(corners[k], corners[(k + 1) % 4]));
        sum += 0.5 * angle * glm::normalize(c);
    }
    const glm::dvec3 centre = testing::texelDirection(face, x, y, n);
    const double sign = glm::dot(sum, centre) < 0.0 ? -1.0 : 1.0;
    return sign * sum.y / texelSolidAngles(n)[static_cast<std::size_t>(y * n + x)];
}

TEST(CubeFromAnalytic, GradientTexelsAreExactMeans) {
    for (const int n : {1, 2, 8, 64}) {
        const Cubemap cube = cubeFromAnalytic(*parseAnalytic("gradient:0,2"), n);
        for (int face = 0; face < 6; ++face) {
            for (int i = 0; i<n * n; i += n> 8 ? 37 : 1) {
                EXPECT_NEAR(static_cast<double>(cube.texel(face, i % n, i / n).x),
                            1.0 + exactMeanY(face, i % n, i / n, n), 5e-7)
                    << n << " face " << face << " texel " << i;
            }
        }
    }
}

/// A disc of radiance 1 on 0 has the mean (1 - cos r) / 2 = sin^2(r / 2), wherever it lies, down to
/// radii far below a texel. The rim is cut to cells of a sixteenth of the radius: 1e-4.
TEST(CubeFromAnalytic, DiscKeepsItsEnergy) {
    for (const char* axis : {"0,0,1", "1,1,1", "0.48,0.6,0.64", "-0.3,0.01,-0.9", "1,1,0.001"}) {
        for (const double degrees : {1e-6, 1e-3, 0.27, 1.0, 5.0, 30.0, 90.0, 150.0, 179.9, 180.0}) {
            for (const int n : {1, 3, 64}) {
                const std::string text =
                    "disc:" + std::string(axis) + "," + std::to_string(degrees) + ",1";
                const auto disc = parseAnalytic(text);
                ASSERT_TRUE(disc) << text;
                const double half = 0.5 * std::get<DiscEnvironment>(*disc).angularRadius;
                const double expected = std::sin(half) * std::sin(half);
                EXPECT_NEAR(sphereMean(cubeFromAnalytic(*disc, n), 0).x, expected, 1e-4 * expected)
                    << text << " width " << n;
            }
        }
    }
}

TEST(CubeFromAnalytic, FacesAreConstant) {
    const Cubemap cube = cubeFromAnalytic(*parseAnalytic("faces:1;2;3;4;5;6/7/8"), 5);
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < 25; ++i) {
            EXPECT_EQ(cube.texel(face, i % 5, i / 5).r, static_cast<float>(face + 1));
        }
    }
    EXPECT_EQ(cube.texel(5, 0, 0), glm::vec4(6, 7, 8, 1));
}

/// Irradiance about a normal in double over all texels.
glm::dvec3 irradiance(const Cubemap& cube, const glm::dvec3& normal) {
    const int n = cube.width();
    const std::vector<double> omega = texelSolidAngles(n);
    glm::dvec3 sum(0.0);
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < n * n; ++i) {
            const double c = glm::dot(testing::texelDirection(face, i % n, i / n, n), normal);
            sum += omega[static_cast<std::size_t>(i)] * std::max(c, 0.0) *
                   glm::dvec3(cube.texel(face, i % n, i / n));
        }
    }
    return sum;
}

double luminance(const glm::dvec3& c) {
    return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
}

TEST(ClearSky, HasTheEnergyItPromises) {
    const glm::dvec3 sun = clearSkySunDirection();
    EXPECT_NEAR(glm::length(sun), 1.0, 1e-15);
    EXPECT_LT(sun.x, 0.0); // south-west
    EXPECT_GT(sun.z, 0.0);
    EXPECT_NEAR(std::asin(sun.y) * 180.0 / kPi, 40.0, 1e-12);
    const double s = std::sin(clearSkySunRadius());
    EXPECT_NEAR(luminance(clearSkySunRadiance()) * kPi * s * s, 3.0, 0.05);
    const Cubemap cube = cubeFromAnalytic(ClearSkyEnvironment{}, 128);
    const double all = luminance(irradiance(cube, {0, 1, 0}));
    const double ofSky = all - 3.0 * sun.y;
    EXPECT_NEAR(ofSky, 0.8, 0.1);
    // A white surface in the sun: below the shoulder, above the middle.
    EXPECT_NEAR(all / kPi, 0.9, 0.1);
}

/// The cube holds the sun's whole energy: means over texels, the disc cut exactly.
TEST(ClearSky, CubeMeansAgreeAcrossWidths) {
    const double fine = sphereMean(cubeFromAnalytic(ClearSkyEnvironment{}, 512), 0).y;
    for (const int n : {32, 64, 255, 256}) {
        const double mean = sphereMean(cubeFromAnalytic(ClearSkyEnvironment{}, n), 0).y;
        // Of it the disc is 3e-4 to the rim's 1e-4; the sky's own error is the midpoint rule's,
        // 1e-4.
        EXPECT_NEAR(mean, fine, 2e-4 * fine) << n;
    }
}

TEST(ClearSky, IsContinuousAndFiniteOutsideTheSun) {
    std::mt19937 random(5);
    const glm::dvec3 sun = clearSkySunDirection();
    for (int k = 0; k < 20000; ++k) {
        const glm::dvec3 d(testing::randomDirection(random));
        const glm::dvec3 e =
            glm::normalize(d + 1e-6 * glm::dvec3(testing::randomDirection(random)));
        const glm::dvec3 a = clearSkyRadiance(d);
        EXPECT_TRUE(std::isfinite(a.x) && a.x > 0.0 && a.y > 0.0 && a.z > 0.0);
        if (glm::dot(d, sun) < 0.999) {
            // The steepest place is the haze below the horizon: 1 in 0.06 radians; the glow 0.8
            // * 60.
            EXPECT_LT(std::abs(a.y - clearSkyRadiance(e).y), 1e-6 * 100.0);
        }
    }
    const glm::dvec3 above = clearSkyRadiance(glm::normalize(glm::dvec3(1, 1e-9, 0)));
    const glm::dvec3 below = clearSkyRadiance(glm::normalize(glm::dvec3(1, -1e-9, 0)));
    EXPECT_NEAR(above.y, below.y, 1e-6);
}

} // namespace
} // namespace lodestar::lighting

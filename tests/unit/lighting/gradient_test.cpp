// SPDX-License-Identifier: MIT
#include "lighting/gradient.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include "lighting/zonal.h"

namespace lodestar::lighting {
namespace {

constexpr double kRadians = std::numbers::pi / 180.0;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

GradientStop grey(double at, double value) {
    return {at, glm::dvec3(value), 0.0};
}

RadianceProfile profileOf(Gradient gradient, LightKind kind) {
    core::Tally warnings;
    auto result = repaired(std::move(gradient), kind, warnings);
    EXPECT_TRUE(result.ok());
    return {*result, kind};
}

double skyAt(const RadianceProfile& profile, double elevation) {
    return profile.radiance((90.0 - elevation) * kRadians).r;
}

} // namespace

TEST(Gradient, HoldsItsEndsAndInterpolatesBetweenStops) {
    const auto sky = profileOf({{grey(90, 1), grey(30, 4)}}, LightKind::Sky);
    EXPECT_NEAR(skyAt(sky, 90), 1.0, 1e-12);
    EXPECT_NEAR(skyAt(sky, 60), 2.5, 1e-12);
    EXPECT_NEAR(skyAt(sky, -90), 4.0, 1e-12);
    const auto sun = profileOf({{grey(1, 5), grey(3, 1)}}, LightKind::Sun);
    EXPECT_EQ(sun.radiance(0.0).r, 5.0);
    EXPECT_NEAR(sun.radiance(2 * kRadians).r, 3.0, 1e-12);
    EXPECT_EQ(sun.radiance(3.01 * kRadians).r, 0.0); // beyond its last stop
}

TEST(Gradient, AStopsRadianceIsColorTimesTwoToTheEv) {
    const auto sky = profileOf({{{0, {1.0, 0.5, 0.0}, 10.0}}}, LightKind::Sky);
    EXPECT_EQ(sky.radiance(1.0), glm::dvec3(1024.0, 512.0, 0.0));
}

TEST(Gradient, TwoStopsAtOnePlaceStepInTheOrderListed) {
    const auto sky =
        profileOf({{grey(90, 1), grey(0, 1), grey(0, 3), grey(-90, 3)}}, LightKind::Sky);
    EXPECT_NEAR(skyAt(sky, 1e-6), 1.0, 1e-6);
    EXPECT_EQ(skyAt(sky, 0), 3.0);
    EXPECT_EQ(skyAt(sky, -1e-6), 3.0);
    // The same list read from the ground up, not sorted and not warned about.
    core::Tally warnings;
    const auto upwards =
        repaired({{grey(-90, 3), grey(0, 3), grey(0, 1), grey(90, 1)}}, LightKind::Sky, warnings);
    ASSERT_TRUE(upwards.ok());
    EXPECT_TRUE(warnings.empty());
    EXPECT_EQ(RadianceProfile(*upwards, LightKind::Sky).radiance(90.0 * kRadians).r, 3.0);
    for (const auto interpolation : {GradientInterpolation::Smooth, GradientInterpolation::Cubic,
                                     GradientInterpolation::Constant}) {
        const auto one =
            profileOf({{grey(0.5, 1), grey(0.5, 3), grey(1, 3)}, interpolation}, LightKind::Sun);
        EXPECT_EQ(one.radiance(0.4999 * kRadians).r, 1.0);
        EXPECT_EQ(one.radiance(0.5 * kRadians).r, 3.0);
    }
}

// "Up to the next one" is towards the zenith for a sky listed from the ground up.
TEST(Gradient, AConstantListHoldsTowardsTheNextOneListed) {
    core::Tally warnings;
    const auto turned =
        repaired({{grey(-60, 3), grey(-10, 2), grey(30, 1)}, GradientInterpolation::Constant},
                 LightKind::Sky, warnings);
    ASSERT_TRUE(turned.ok());
    EXPECT_TRUE(warnings.empty());
    const RadianceProfile sky(*turned, LightKind::Sky);
    for (const auto& [elevation, value] : {std::pair{-80.0, 3.0},
                                           {-59.0, 3.0},
                                           {-11.0, 3.0},
                                           {-9.0, 2.0},
                                           {29.0, 2.0},
                                           {31.0, 1.0},
                                           {90.0, 1.0}}) {
        EXPECT_EQ(skyAt(sky, elevation), value) << elevation;
    }
    // Listed downwards the same stops hold the other way.
    const auto down =
        profileOf({{grey(30, 1), grey(-10, 2), grey(-60, 3)}, GradientInterpolation::Constant},
                  LightKind::Sky);
    EXPECT_EQ(skyAt(down, -9.0), 1.0);
    EXPECT_EQ(skyAt(down, -11.0), 2.0);
    // In order now: what is repaired again stays.
    const auto again = repaired(*turned, LightKind::Sky, warnings);
    ASSERT_EQ(again->stops.size(), turned->stops.size());
    for (std::size_t i = 0; i < again->stops.size(); ++i) {
        EXPECT_EQ(again->stops[i].at, turned->stops[i].at);
        EXPECT_EQ(again->stops[i].color, turned->stops[i].color);
    }
    // A sun listed inwards, black beyond its outermost stop.
    const auto sun = profileOf(
        {{grey(3, 1), {1, glm::dvec3(5), 1.0}}, GradientInterpolation::Constant}, LightKind::Sun);
    EXPECT_EQ(sun.radiance(0.5 * kRadians).r, 10.0);
    EXPECT_EQ(sun.radiance(1.5 * kRadians).r, 1.0);
    EXPECT_EQ(sun.radiance(3.5 * kRadians).r, 0.0);
}

TEST(Gradient, RefusesWhatHasNoPlace) {
    core::Tally warnings;
    EXPECT_EQ(repaired({}, LightKind::Sky, warnings).error().where, "/stops");
    EXPECT_EQ(repaired({{grey(0, 1), grey(91, 1)}}, LightKind::Sky, warnings).error().where,
              "/stops/1/at");
    EXPECT_FALSE(repaired({{grey(-1, 1)}}, LightKind::Sun, warnings).ok());
    EXPECT_FALSE(repaired({{grey(kNan, 1)}}, LightKind::Sun, warnings).ok());
    EXPECT_TRUE(warnings.empty());
}

TEST(Gradient, SortsAndRepairsAndCounts) {
    core::Tally warnings;
    Gradient gradient{{grey(10, 1), grey(60, 2), {0, {kNan, -1.0, kInfinity}, 0.0}}};
    gradient.stops.push_back({-20, {1.0, 1.0, 1.0}, kNan});
    const auto result = repaired(gradient, LightKind::Sky, warnings);
    ASSERT_TRUE(result.ok());
    EXPECT_EQ(result->stops[0].at, 60.0);
    EXPECT_EQ(result->stops[2].color, glm::dvec3(0.0, 0.0, 1e9));
    EXPECT_EQ(warnings.counts().at("gradient stops out of order, sorted"), 1u);
    EXPECT_EQ(warnings.counts().at("gradient radiance not a number, set to 0"), 4u);
    EXPECT_EQ(warnings.counts().at("gradient radiance negative, set to 0"), 1u);
    EXPECT_EQ(warnings.counts().at("gradient radiance above 1e9, set to 1e9"), 1u);
}

TEST(Gradient, EverySpaceKeepsItsStopsAndGreysAndStaysPositive) {
    for (const auto space : {GradientSpace::Linear, GradientSpace::Oklab, GradientSpace::Srgb}) {
        for (const auto interpolation :
             {GradientInterpolation::Linear, GradientInterpolation::Smooth,
              GradientInterpolation::Cubic}) {
            const auto sky = profileOf({{{90, {0.0, 0.0, 1.0}, 0.0},
                                         {40, {40.0, 30.0, 0.0}, 1.0},
                                         {0, {0.1, 0.2, 0.3}, 0.0}},
                                        interpolation,
                                        space},
                                       LightKind::Sky);
            const glm::dvec3 middle = sky.radiance(50.0 * kRadians);
            // Oklab's published matrices are inverse to each other within 1e-7.
            EXPECT_NEAR(middle.r, 80.0, 1e-4);
            EXPECT_NEAR(middle.g, 60.0, 1e-4);
            EXPECT_NEAR(middle.b, 0.0, 1e-4);
            for (int i = 0; i <= 180; ++i) {
                const glm::dvec3 c = sky.radiance(i * kRadians);
                EXPECT_TRUE(c.r >= 0.0 && c.g >= 0.0 && c.b >= 0.0 && c.r < 81.0);
            }
        }
    }
    // Half way in sRGB between black and white is 0.2140.
    const auto srgb =
        profileOf({{grey(90, 0), grey(-90, 1)}, {}, GradientSpace::Srgb}, LightKind::Sky);
    EXPECT_NEAR(skyAt(srgb, 0), 0.21404114, 1e-7);
    // In Oklab greys interpolate as cube roots.
    const auto oklab =
        profileOf({{grey(90, 0), grey(-90, 1)}, {}, GradientSpace::Oklab}, LightKind::Sky);
    EXPECT_NEAR(skyAt(oklab, 0), 0.125, 1e-6);
}

TEST(Gradient, CubicIsMonotoneAndSmooth) {
    const auto sun = profileOf(
        {{grey(0, 10), grey(10, 9), grey(20, 1), grey(60, 0)}, GradientInterpolation::Cubic},
        LightKind::Sun);
    double before = 10.0;
    for (int i = 1; i <= 600; ++i) {
        const double value = sun.radiance(0.1 * i * kRadians).r;
        EXPECT_LE(value, before + 1e-12) << i;
        before = value;
    }
    const double h = 1e-5;
    const double left = (sun.radiance(20 * kRadians).r - sun.radiance(20 * kRadians - h).r) / h;
    const double right = (sun.radiance(20 * kRadians + h).r - sun.radiance(20 * kRadians).r) / h;
    EXPECT_NEAR(left, right, 0.05 * std::abs(left)); // curvature times h
}

TEST(Zones, MeansAreExactForConstantsAndKeepEnergy) {
    for (const auto kind : {LightKind::Sky, LightKind::Sun}) {
        const ZonalRadiance flat =
            zonalRadiance(profileOf({{grey(0, 7), grey(90, 7)}}, LightKind::Sky), zonesFor(kind));
        for (const glm::dvec3& mean : flat.means) {
            EXPECT_NEAR(mean.r, 7.0, 1e-12);
        }
        // A disc of 0.27 degrees fills sin^2(0.135 degrees) of the sphere.
        const auto sun = profileOf({{grey(0.27, 1e6)}}, LightKind::Sun);
        const double energy = sphereMean(zonalRadiance(sun, zonesFor(kind))).g;
        const double half = std::sin(0.135 * kRadians);
        EXPECT_NEAR(energy, 1e6 * half * half, 1e-9 * energy);
    }
    // Linear in elevation e from 0 at the nadir to 1 at the zenith: its mean is 1/2.
    const auto ramp = profileOf({{grey(90, 1), grey(-90, 0)}}, LightKind::Sky);
    EXPECT_NEAR(sphereMean(zonalRadiance(ramp, {ZoneSpacing::EqualHeight, 3})).r, 0.5, 1e-9);
}

TEST(Zones, EdgesAreEqualInTheirOwnMeasure) {
    const auto sky = zoneEdges({ZoneSpacing::EqualHeight, 8});
    const auto sun = zoneEdges({ZoneSpacing::Quartic, 8});
    for (int j = 0; j <= 8; ++j) {
        const auto i = static_cast<std::size_t>(j);
        EXPECT_NEAR(std::cos(sky[i]), 1.0 - j / 4.0, 1e-15);
        EXPECT_NEAR(std::sqrt(std::sin(0.5 * sun[i])), j / 8.0, 1e-15);
    }
}

// Rings of any width, narrow and wide beside the pieces between stops: a ring's mean is that of its
// two halves.
TEST(Zones, ARingIsItsHalves) {
    using Interpolation = GradientInterpolation;
    for (const auto interpolation : {Interpolation::Linear, Interpolation::Constant,
                                     Interpolation::Smooth, Interpolation::Cubic}) {
        for (const auto space :
             {GradientSpace::Linear, GradientSpace::Oklab, GradientSpace::Srgb}) {
            const RadianceProfile profile({{{90.0, glm::dvec3(0.2, 0.5, 2.0), 0.0},
                                            {20.0, glm::dvec3(3.0, 1.0, 0.5), 1.0},
                                            {1.5, glm::dvec3(1.0, 1.0, 1.0), 0.0},
                                            {0.0, glm::dvec3(0.5, 0.3, 0.2), 2.0},
                                            {-90.0, glm::dvec3(0.4, 0.4, 0.4), 0.0}},
                                           interpolation,
                                           space},
                                          LightKind::Sky);
            for (const int rings : {7, 60, 500, 2048}) {
                std::vector<double> edges;
                std::vector<double> halves;
                for (int i = 0; i <= 2 * rings; ++i) {
                    halves.push_back(std::numbers::pi * i / (2.0 * rings));
                    if (i % 2 == 0) {
                        edges.push_back(halves.back());
                    }
                }
                const auto whole = ringMeans(profile, edges);
                const auto parts = ringMeans(profile, halves);
                for (std::size_t j = 0; j < whole.size(); ++j) {
                    const double a = ringArea(halves[2 * j], halves[2 * j + 1]);
                    const double b = ringArea(halves[2 * j + 1], halves[2 * j + 2]);
                    const glm::dvec3 mean = (a * parts[2 * j] + b * parts[2 * j + 1]) / (a + b);
                    for (int c = 0; c < 3; ++c) {
                        ASSERT_NEAR(whole[j][c], mean[c], 1e-8 * mean[c])
                            << static_cast<int>(interpolation) << static_cast<int>(space) << " "
                            << rings << " " << j;
                    }
                }
            }
        }
    }
}

} // namespace lodestar::lighting

// SPDX-License-Identifier: MIT
#include "lighting/day.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "lighting/rsrm.h"
#include "numerics/oracles.h"

namespace lodestar::lighting {
namespace {

using testing::oracleCases;

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;

DayKey keyAt(double hour, double value) {
    return {hour, {{{0.0, glm::dvec3(value), 0.0}, {0.27, glm::dvec3(value), 0.0}}}, {1, 1, 1}, {}};
}

DayLight inOrder(DayLight light) {
    core::Tally warnings;
    auto result = repaired(std::move(light), warnings);
    EXPECT_TRUE(result.ok());
    EXPECT_TRUE(warnings.empty());
    return *result;
}

} // namespace

TEST(DayOracles, TimeWrapsAndBlendsOverTheShorterArc) {
    for (const auto& one : oracleCases("time_wrap")) {
        const auto& in = one["in"];
        EXPECT_NEAR(blendedHour(in["a"], in["b"], in["t"]), one["out"]["hour"].get<double>(), 1e-12)
            << in;
    }
    EXPECT_NEAR(wrappedHour(-1e-9), 24.0 - 1e-9, 1e-14); // a rounding of 24
    EXPECT_EQ(wrappedHour(-1e-17), 0.0);                 // 24 less that rounds to 24
    EXPECT_EQ(wrappedHour(24.0), 0.0);
    for (const double hour : {1e300, -1e300, 1e17, -1e17}) {
        EXPECT_GE(wrappedHour(hour), 0.0) << hour;
        EXPECT_LT(wrappedHour(hour), 24.0) << hour;
    }
    EXPECT_EQ(wrappedHour(std::numeric_limits<double>::quiet_NaN()), 0.0);
}

TEST(DayOracles, SlerpAndItsAngles) {
    const glm::dvec3 a(0.0, 0.0, 1.0);
    for (const auto& one : oracleCases("slerp")) {
        const auto b = one["in"]["b"].get<std::vector<double>>();
        const auto v = one["out"]["v"].get<std::vector<double>>();
        const glm::dvec3 got = slerpAxis(a, {b[0], b[1], b[2]}, one["in"]["t"]);
        EXPECT_LT(glm::distance(got, glm::dvec3(v[0], v[1], v[2])), 1e-12) << one["in"];
    }
    for (const double angle : {0.0, 1e-9, 1e-4, 0.5, 3.0, kPi - 2e-4}) {
        const glm::dvec3 b(std::sin(angle), 0.0, std::cos(angle));
        for (const double t : {0.0, 0.25, 0.5, 1.0}) {
            const glm::dvec3 v = slerpAxis(a, b, t);
            EXPECT_NEAR(glm::length(v), 1.0, 1e-12);
            // An arc tangent keeps its digits at both ends. Worst is the widest angle: a and b each
            // times 1 / sin(2e-4), whose roundings of 1e-16 the sum does not lose: 1e-12.
            EXPECT_NEAR(std::atan2(glm::length(glm::cross(a, v)), glm::dot(a, v)), t * angle, 1e-12)
                << angle << " " << t;
        }
    }
}

TEST(Slerp, OppositeAxesTurnByWayOfAPerpendicular) {
    for (const glm::dvec3& a :
         {glm::dvec3(0, 1, 0), glm::dvec3(1, 0, 0), glm::normalize(glm::dvec3(1, -2, 3))}) {
        for (const double off : {0.0, 5e-5}) {
            const glm::dvec3 b = glm::normalize(-a + off * glm::dvec3(0.3, 0.2, 0.9));
            EXPECT_LT(glm::distance(slerpAxis(a, b, 0.0), a), 1e-12);
            EXPECT_LT(glm::distance(slerpAxis(a, b, 1.0), b), 1e-12);
            EXPECT_NEAR(glm::dot(slerpAxis(a, b, 0.5), a), 0.0, 1e-12);
            EXPECT_NEAR(glm::dot(slerpAxis(a, b, 0.25), a), std::sqrt(0.5), 1e-9);
        }
    }
}

TEST(Day, KeysAreFoundAcrossMidnight) {
    const std::vector<double> hours = {1.0, 5.0, 22.0};
    const auto expect = [&](double hour, std::size_t from, std::size_t to, double t) {
        const KeyBlend blend = keysAt(hours, hour);
        EXPECT_EQ(blend.from, from) << hour;
        EXPECT_EQ(blend.to, to) << hour;
        EXPECT_NEAR(blend.t, t, 1e-12) << hour;
    };
    expect(1.0, 0, 1, 0.0);
    expect(4.0, 0, 1, 0.75);
    expect(5.0, 1, 2, 0.0);
    expect(22.0, 2, 0, 0.0);
    expect(23.5, 2, 0, 0.5);
    expect(0.25, 2, 0, 0.75);
    expect(24.25, 2, 0, 0.75);
    expect(-2.0, 2, 0, 0.0);
    EXPECT_EQ(keysAt(std::vector<double>{7.0}, 3.0).t, 0.0);
}

TEST(Day, RepairsAndRefuses) {
    core::Tally warnings;
    DayLight light{
        LightKind::Sun, {0.0, 3.0, 0.0}, {}, {keyAt(25.0, 1), keyAt(6.0, 2), keyAt(1.0, 3)}};
    light.keys[1].tint = {-1.0, std::nan(""), 2.0};
    light.keys[1].axis = glm::dvec3(0.0);
    const auto result = repaired(light, warnings);
    ASSERT_TRUE(result.ok());
    ASSERT_EQ(result->keys.size(), 2u);
    EXPECT_EQ(result->keys[0].gradient.stops[0].color.r, 3.0); // the last listed
    EXPECT_EQ(result->keys[1].tint, glm::dvec3(0.0, 0.0, 2.0));
    EXPECT_EQ(*result->keys[1].axis, glm::dvec3(0.0, 1.0, 0.0));
    EXPECT_EQ(warnings.counts().at("hour outside [0, 24), wrapped"), 1u);
    EXPECT_EQ(warnings.counts().at("two keys at one hour, the last listed kept"), 1u);
    EXPECT_EQ(warnings.counts().at("tint outside [0, 1e9], clamped"), 2u);
    EXPECT_EQ(warnings.counts().at("axis without a direction, set to +Y"), 1u);

    EXPECT_EQ(repaired(DayLight{}, warnings).error().where, "/keys");
    light.keys[2].gradient.stops[1].at = -3.0;
    EXPECT_EQ(repaired(light, warnings).error().where, "/keys/2/gradient/stops/1/at");
    light.keys[0].hour = std::nan("");
    EXPECT_EQ(repaired(light, warnings).error().where, "/keys/0/hour");
    light.path = SunPath{2.0, 81, {0, 0, -1}};
    EXPECT_EQ(repaired(light, warnings).error().where, "/path/latitude");
    light.path = SunPath{0.5, 0, {0, 0, -1}};
    EXPECT_EQ(repaired(light, warnings).error().where, "/path/dayOfYear");
    light.path = SunPath{0.5, 81, {0, 1, 0}};
    EXPECT_EQ(repaired(light, warnings).error().where, "/path/north");
}

/// Radiance times tint stays in the range; what is in range is left alone.
TEST(Day, BrightStopsUnderBrightTintsAreLoweredAndCounted) {
    DayLight light{LightKind::Sun, {0.0, 1.0, 0.0}, {}, {keyAt(6.0, 3e8)}};
    light.keys[0].gradient.stops.push_back({1.0, glm::dvec3(2.0), 1.0});
    light.keys[0].tint = {7.0, 1.0, 0.0};
    core::Tally warnings;
    const auto result = repaired(light, warnings);
    ASSERT_TRUE(result.ok());
    // The red of two stops.
    EXPECT_EQ(warnings.counts().at("radiance times tint above 1e9, set to 1e9"), 2u);
    EXPECT_EQ(warnings.counts().size(), 1u);
    const auto& stops = result->keys[0].gradient.stops;
    EXPECT_NEAR(radianceOf(stops[0]).r * 7.0, 1e9, 1e-6);
    EXPECT_EQ(radianceOf(stops[1]).g, 3e8);
    EXPECT_EQ(radianceOf(stops[2]), glm::dvec3(4.0));
    const ZonalRadiance zonal = keyRadiance(*result, 0, zonesFor(LightKind::Sun));
    EXPECT_NEAR(zonal.means[0].r, 1e9, 1e-6);
    inOrder(*result); // which expects no warning the second time
    light.keys[0] = keyAt(6.0, 1e9);
    light.keys[0].tint = glm::dvec3(1e9);
    ASSERT_TRUE(repaired(light, warnings).ok());
    EXPECT_NEAR(keyRadiance(*repaired(light, warnings), 0, zonesFor(LightKind::Sun)).means[0].r,
                1e9, 1e-6);
}

/// A constant sky has one radiance at every exponent, the mirror's too, through tints, blends and
/// factors: where the row past the last knew nothing of them, a mirror showed another sky.
TEST(Day, TintsBlendsAndFactorsReachTheMirror) {
    DayLight light{LightKind::Sky, {0.0, 1.0, 0.0}, {}, {keyAt(6.0, 4.0), keyAt(18.0, 1.0)}};
    light.keys[0].tint = {1.0, 0.5, 0.25};
    light.keys[1].tint = {0.125, 2.0, 8.0};
    light = inOrder(light);
    RsrmLayout layout = kRsrmSmall;
    layout.columns = 40;
    layout.rows = 6;
    RsrmKernel kernel(zonesFor(LightKind::Sky), columnAngles(layout.columnMap, layout.columns),
                      bakedExponents(layout));
    kernel.addLambert();
    const RsrmBake bakes[] = {kernel.bake(keyRadiance(light, 0, kernel.zones())),
                              kernel.bake(keyRadiance(light, 1, kernel.zones()))};
    const std::vector<glm::vec3> gradients[] = {keyGradient(light, 0), keyGradient(light, 1)};
    for (const double t : {0.0, 0.3, 1.0}) {
        const RsrmTexels texels = encode(layout, blended(bakes[0], bakes[1], t, 0.7));
        const auto gradient = blended(gradients[0], gradients[1], t, 0.7);
        const glm::dvec3 sky =
            0.7 * ((1.0 - t) * 4.0 * light.keys[0].tint + t * 1.0 * light.keys[1].tint);
        for (const double s : {8.0, 1e5, HUGE_VAL}) {
            for (const double theta : {0.0, 1.0, 3.0}) {
                const glm::dvec3 got(rsrmRadiance(texels, gradient, theta, s));
                const glm::dvec3 lambert(rsrmLambert(texels, theta));
                for (int c = 0; c < 3; ++c) {
                    // Nine bits of a root, half a step of 1/256 of the brightest channel's at
                    // most, doubled; a mirror's and Lambert's are floats.
                    const double most = std::max({sky.r, sky.g, sky.b});
                    EXPECT_NEAR(got[c], sky[c],
                                std::isinf(s) ? 1e-6 * sky[c] : std::sqrt(sky[c] * most) / 256.0)
                        << t << " s " << s << " channel " << c;
                    EXPECT_NEAR(lambert[c], sky[c], 2e-6 * sky[c]);
                }
            }
        }
    }
}

// The blend of bakes is the bake of the blend: floats of both round 256 products, 1e-6.
TEST(Day, BlendingBakesIsBakingTheBlend) {
    DayLight light{LightKind::Sun, {0.0, 1.0, 0.0}, {}, {keyAt(6.0, 1e4), keyAt(18.0, 0.0)}};
    light.keys[1].gradient = {{{0.0, {1.0, 5.0, 0.2}, 2.0}, {30.0, {0.0, 0.1, 0.0}, 0.0}},
                              GradientInterpolation::Smooth};
    light.keys[0].tint = {1.0, 0.5, 0.25};
    light = inOrder(light);
    RsrmLayout layout = kRsrmSmall;
    layout.columns = 40;
    layout.rows = 6;
    const RsrmKernel kernel(zonesFor(LightKind::Sun),
                            columnAngles(layout.columnMap, layout.columns), bakedExponents(layout));
    const ZonalRadiance first = keyRadiance(light, 0, kernel.zones());
    const ZonalRadiance second = keyRadiance(light, 1, kernel.zones());
    const RsrmBake a = kernel.bake(first);
    const RsrmBake b = kernel.bake(second);
    for (const double t : {0.0, 0.3, 0.999, 1.0}) {
        const RsrmBake blend = blended(a, b, t, 0.7);
        const RsrmBake direct = kernel.bake(blended(first, second, t, 0.7));
        for (std::size_t i = 0; i < blend.planes.size(); ++i) {
            ASSERT_NEAR(blend.planes[i], direct.planes[i], 2e-6f * direct.planes[i] + 1e-30f) << t;
        }
    }
    EXPECT_EQ(blended(a, b, 1.0).planes, b.planes);
}

TEST(Day, TheSunFollowsItsPath) {
    const SunPath equinox{48.0 * kDegree, 81, {0.0, 0.0, -1.0}};
    EXPECT_NEAR(sunDeclination(81), 0.0, 1e-3);
    const glm::dvec3 noon = sunDirection(equinox, 12.0);
    EXPECT_NEAR(std::asin(noon.y), 42.0 * kDegree, 1e-3);
    EXPECT_NEAR(noon.x, 0.0, 1e-12);
    EXPECT_GT(noon.z, 0.0); // due south
    EXPECT_NEAR(glm::distance(sunDirection(equinox, 6.0), glm::dvec3(1.0, 0.0, 0.0)), 0.0, 1e-3);
    EXPECT_LT(sunDirection(equinox, 18.0).x, -0.999);
    EXPECT_NEAR(sunDirection(equinox, 0.0).y, -std::cos(48.0 * kDegree), 1e-3);
    // Summer north of the polar circle: it does not set.
    const SunPath north{80.0 * kDegree, 172, {0.0, 0.0, -1.0}};
    for (int hour = 0; hour < 24; ++hour) {
        EXPECT_GT(sunDirection(north, hour).y, 0.0);
    }
    // North along +X: east is +Z.
    const SunPath turned{0.0, 81, {1.0, 0.0, 0.0}};
    EXPECT_GT(sunDirection(turned, 6.0).z, 0.999);
    // South of the equator the noon sun stands in the north.
    EXPECT_LT(sunDirection({-48.0 * kDegree, 81, {0, 0, -1}}, 12.0).z, 0.0);
}

TEST(Day, ASunFadesOverItsDiameterBelowTheHorizon) {
    const double radius = 0.27 * kDegree;
    EXPECT_EQ(sunVisibility(0.1, radius), 1.0);
    EXPECT_EQ(sunVisibility(0.0, radius), 1.0);
    EXPECT_NEAR(sunVisibility(-radius, radius), 0.5, 1e-12);
    EXPECT_EQ(sunVisibility(-2.0 * radius, radius), 0.0);
    EXPECT_EQ(sunVisibility(-1e-9, 0.0), 0.0);
    // A sun with a glow all around it sets with its disc, one without a step with its last stop.
    DayKey glowing = keyAt(12, 1);
    glowing.gradient.stops.push_back({0.27, glm::dvec3(0.01), 0.0});
    glowing.gradient.stops.push_back({180.0, glm::dvec3(0.0), 0.0});
    EXPECT_EQ(sunRadius(glowing.gradient), radius);
    const DayLight glow =
        inOrder({LightKind::Sun, {0, 1, 0}, SunPath{0.0, 81, {0, 0, -1}}, {glowing}});
    EXPECT_EQ(momentAt(glow, 12.0).visibility, 1.0);
    EXPECT_EQ(momentAt(glow, 0.0).visibility, 0.0);
    glowing.gradient.stops.erase(glowing.gradient.stops.begin() + 1);
    EXPECT_EQ(sunRadius(glowing.gradient), kPi);
    glowing.gradient.stops.insert(glowing.gradient.stops.begin(), glowing.gradient.stops[0]);
    EXPECT_EQ(sunRadius(glowing.gradient), kPi); // a step on the axis is no disc's edge
    DayLight sun =
        inOrder({LightKind::Sun, {0, 1, 0}, SunPath{0.0, 81, {0, 0, -1}}, {keyAt(12, 1)}});
    EXPECT_EQ(momentAt(sun, 12.0).visibility, 1.0);
    EXPECT_EQ(momentAt(sun, 0.0).visibility, 0.0);
    sun.path.reset();
    sun.keys.push_back(keyAt(18.0, 1));
    sun.keys[1].axis = glm::dvec3(1.0, 0.0, 0.0);
    EXPECT_LT(glm::distance(momentAt(sun, 15.0).axis, glm::normalize(glm::dvec3(1, 1, 0))), 1e-12);
}

} // namespace lodestar::lighting

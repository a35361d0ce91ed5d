// SPDX-License-Identifier: MIT
//
// What holds of skies and suns for every valid gradient and query, and of gradients for any
// numbers. u below is 2^-23.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/quadrature.h"
#include "lighting/day.h"
#include "lighting/light_map.h"
#include "lighting/rsrm_weights.h"
#include "numerics/property_inputs.h"

namespace lodestar::testing {

namespace {

using namespace lighting;

constexpr double u = 0x1p-23;

rc::Gen<LightKind> kind() {
    return rc::gen::element(LightKind::Sky, LightKind::Sun);
}

/// One to six stops anywhere, some at one place, in every interpolation; linear, where a value
/// between two stops lies between theirs.
rc::Gen<Gradient> gradient(LightKind kind) {
    return rc::gen::exec([kind] {
        Gradient result;
        result.interpolation =
            *rc::gen::element(GradientInterpolation::Linear, GradientInterpolation::Constant,
                              GradientInterpolation::Smooth, GradientInterpolation::Cubic);
        const int count = *rc::gen::inRange(1, 7);
        for (int i = 0; i < count; ++i) {
            const double place = static_cast<double>(*rc::gen::inRange(0, 37)) * 5.0;
            result.stops.push_back({kind == LightKind::Sky ? place - 90.0 : place,
                                    glm::dvec3(static_cast<double>(*radiance()),
                                               static_cast<double>(*uniform(0.0f, 1.0f)), 0.0),
                                    0.0});
        }
        core::Tally warnings;
        return *repaired(result, kind, warnings);
    });
}

/// A small layout: a kernel is made once a kind.
RsrmLayout smallLayout() {
    return {RsrmColumns::Refined, 48, 12, RsrmEncoding::SharedExponent};
}

std::shared_ptr<RsrmKernels> kernels() {
    static const auto shared = std::make_shared<RsrmKernels>();
    return shared;
}

/// Angles from the axis whose cosines are the rule's nodes over [-1, 1].
std::vector<double> heights(const core::GaussRule& rule) {
    std::vector<double> thetas;
    for (const double node : rule.nodes) {
        thetas.push_back(std::acos(2.0 * node - 1.0));
    }
    return thetas;
}

double greatest(const Gradient& gradient, int channel) {
    double most = 0.0;
    for (const GradientStop& stop : gradient.stops) {
        most = std::max(most, radianceOf(stop)[channel]);
    }
    return most;
}
/// A sun is black beyond its last stop.
double least(const Gradient& gradient, LightKind kind, int channel) {
    double low = kind == LightKind::Sun ? 0.0 : INFINITY;
    for (const GradientStop& stop : gradient.stops) {
        low = std::min(low, radianceOf(stop)[channel]);
    }
    return low;
}

} // namespace

// Weights are none negative and sum to 1 to 1e-12. In float each is rounded, and their products are
// summed four at a time in 64 steps: 70 roundings.
RC_GTEST_PROP(RsrmBakes, LieWithinTheGradient, ()) {
    const LightKind of = *kind();
    const Gradient given = *gradient(of);
    const auto kernel = kernels()->get(smallLayout(), of);
    const RsrmBake bake = kernel->bake(zonalRadiance(RadianceProfile(given, of), kernel->zones()));
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const double low = least(given, of, static_cast<int>(channel));
        const double high = greatest(given, static_cast<int>(channel));
        for (std::size_t e = 0; e < bake.exponents.size(); ++e) {
            const float* row = bake.value(e, channel);
            for (std::size_t i = 0; i < bake.columns; ++i) {
                const auto value = static_cast<double>(row[i]);
                RC_ASSERT(value >= low - 40.0 * u * high && value <= high * (1.0 + 24.0 * u));
            }
        }
    }
}

// What is stored is fitted between rows and rounded to nine bits, so that the ends are not kept,
// but finite, not negative, and in proportion it stays: doubled four times over, each stored root
// is.
RC_GTEST_PROP(RsrmMaps, AreFiniteAndLinearInRadiance, ()) {
    const LightKind of = *kind();
    Gradient given = *gradient(of);
    for (GradientStop& stop : given.stops) {
        stop.color = glm::clamp(stop.color, 0.0, 1e7); // so that 16 times as much is valid
    }
    const auto kernel = kernels()->get(smallLayout(), of);
    const auto mapOf = [&](double factor) {
        Gradient scaled = given;
        for (GradientStop& stop : scaled.stops) {
            stop.color *= factor;
        }
        const RadianceProfile profile(scaled, of);
        return std::pair(
            encode(smallLayout(), kernel->bake(zonalRadiance(profile, kernel->zones()))),
            unfiltered(profile));
    };
    const auto [one, gradientOfOne] = mapOf(1.0);
    const auto [sixteen, gradientOfSixteen] = mapOf(16.0);
    const double theta = static_cast<double>(*uniform(0.0f, std::numbers::pi_v<float>));
    const double s = static_cast<double>(*anyFloat());
    const glm::vec3 a = rsrmRadiance(one, gradientOfOne, theta, s);
    const glm::vec3 b = rsrmRadiance(sixteen, gradientOfSixteen, theta, s);
    RC_ASSERT(std::isfinite(a.r) && a.r >= 0.0f && a.b == 0.0f);
    // Subnormal RGB9_E5 roots, below 2^-16, have fewer bits: their squares.
    RC_ASSERT(std::abs(b.r - 16.0f * a.r) <= 4.0f * 0x1p-23f * b.r + 16.0f * 0x1p-31f);
    const glm::vec3 lambert = rsrmLambert(one, theta);
    RC_ASSERT(static_cast<double>(lambert.r) >=
              least(given, of, 0) - 40.0 * u * greatest(given, 0));
    RC_ASSERT(static_cast<double>(lambert.r) <= greatest(given, 0) * (1.0 + 40.0 * u));
}

// Hazard 32: a symmetric kernel moves light, none is lost: the mean of what is filtered is the mean
// of what was given. Filtered radiance of a step is smooth but for kinks of order s + 1 where the
// lobe's end passes it, at which a rule of n nodes is off by about n^-(s + 2) of the step.
RC_GTEST_PROP(RsrmBakes, KeepTheMean, ()) {
    constexpr int kNodes = 400;
    static const core::GaussRule rule = core::gaussLegendre(kNodes);
    const LightKind of = *kind();
    const Zones zones{ZoneSpacing::EqualHeight, 16};
    static const RsrmKernel kernel(zones, heights(rule), {1.0, 2.0, 7.0, 40.0});
    const Gradient given = *gradient(of);
    const ZonalRadiance radiance = zonalRadiance(RadianceProfile(given, of), zones);
    const RsrmBake bake = kernel.bake(radiance);
    for (std::size_t e = 0; e < bake.exponents.size(); ++e) {
        double mean = 0.0;
        for (std::size_t i = 0; i < bake.columns; ++i) {
            mean += rule.weights[i] * static_cast<double>(bake.value(e, 0)[i]);
        }
        RC_ASSERT(std::abs(mean - sphereMean(radiance).r) <=
                  (40.0 * u + 4.0 * std::pow(kNodes, -3.0)) * greatest(given, 0));
    }
}

// Hazard 27: a row of a sun, 2e-5 of its disc, is lost beside sharper ones where all share one
// scale of eight bits. The mean over a lobe of exponent 1 about the axis: 1 - cos^2 of the disc's
// radius.
TEST(RsrmMaps, ASunIsNotLostAtLowExponents) {
    constexpr double kDisc = 0.27 * std::numbers::pi / 180.0;
    const Gradient disc{{{0.0, glm::dvec3(1e4), 0.0}, {0.27, glm::dvec3(1e4), 0.0}}};
    const double expected = 1e4 * 2.22064455e-5;
    EXPECT_NEAR(1e4 * std::sin(kDisc) * std::sin(kDisc), expected, 1e-9);
    const RadianceProfile profile(disc, LightKind::Sun);
    const auto valueOf = [&](const RsrmLayout& layout) {
        const auto kernel = kernels()->get(layout, LightKind::Sun);
        const RsrmTexels texels =
            encode(layout, kernel->bake(zonalRadiance(profile, kernel->zones())));
        return static_cast<double>(rsrmRadiance(texels, unfiltered(profile), 0.0, 1.0).r);
    };
    EXPECT_NEAR(valueOf(kRsrmSmall), expected, 0.01 * expected);
    // As published, a step or two of 255 are left of it.
    EXPECT_GT(std::abs(valueOf(kRsrmPublishedColumns) - expected), 0.04 * expected);
}

// Axis and direction turned together: the angle between them, which is all that is asked for.
RC_GTEST_PROP(Days, TurnWithTheirAxis, ()) {
    const glm::dmat3 turn(cubeRotation(*rc::gen::inRange(0, 24)));
    const glm::dvec3 a = glm::normalize(glm::dvec3(*direction()));
    const glm::dvec3 b = glm::normalize(glm::dvec3(*direction()));
    const double t = static_cast<double>(*uniform(0.0f, 1.0f));
    const double angle = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
    RC_PRE(angle < std::numbers::pi - 1e-3); // half a turn has no side of its own
    const glm::dvec3 between = slerpAxis(a, b, t);
    RC_ASSERT(std::abs(glm::length(between) - 1.0) <= 1e-12);
    RC_ASSERT(glm::distance(slerpAxis(turn * a, turn * b, t), turn * between) <= 1e-12);
    RC_ASSERT(glm::distance(slerpAxis(b, a, 1.0 - t), between) <= 1e-12);
}

RC_GTEST_PROP(Days, AnyHourIsWithinTheDay, ()) {
    const double hour =
        *rc::gen::oneOf(rc::gen::map(anyFloat(), [](float x) { return static_cast<double>(x); }),
                        rc::gen::map(uniform(-1e-9f, 1e-9f),
                                     [](float x) { return 24.0 + static_cast<double>(x); }));
    const double wrapped = wrappedHour(hour);
    RC_ASSERT(wrapped >= 0.0 && wrapped < 24.0);
    RC_ASSERT(wrappedHour(wrapped) == wrapped);
    const std::vector<double> hours{1.0, 5.5, 22.0};
    const KeyBlend blend = keysAt(hours, hour);
    RC_ASSERT(blend.from < 3 && blend.to < 3 && blend.t >= 0.0 && blend.t < 1.0);
}

// What is repaired is what was not valid, and counted once each.
RC_GTEST_PROP(Gradients, AnyNumbersBecomeRadianceAndAreCounted, ()) {
    Gradient given;
    std::uint64_t wrong = 0;
    for (int i = 0; i < 4; ++i) {
        GradientStop stop{static_cast<double>(20 * i), {}, static_cast<double>(*anyFloat())};
        for (int c = 0; c < 3; ++c) {
            stop.color[c] = static_cast<double>(*anyFloat());
            const double value = stop.color[c] * std::exp2(stop.ev);
            wrong += value >= 0.0 && value <= 1e9 ? 0U : 1U;
        }
        given.stops.push_back(stop);
    }
    core::Tally warnings;
    const auto result = repaired(given, LightKind::Sun, warnings);
    RC_ASSERT(result.ok());
    std::uint64_t counted = 0;
    for (const auto& [rule, count] : warnings.counts()) {
        counted += count;
    }
    RC_ASSERT(counted == wrong);
    for (const GradientStop& stop : result->stops) {
        for (int c = 0; c < 3; ++c) {
            RC_ASSERT(radianceOf(stop)[c] >= 0.0 && radianceOf(stop)[c] <= 1e9);
            RC_ASSERT(std::isfinite(stop.color[c]) || std::isfinite(stop.ev));
        }
    }
    const RadianceProfile profile(*result, LightKind::Sun);
    const glm::dvec3 between = profile.radiance(static_cast<double>(*uniform(0.0f, 3.14f)));
    RC_ASSERT(between.r >= 0.0 && between.r <= 1e9 * (1.0 + 0x1p-51)); // two products and a sum
}

} // namespace lodestar::testing

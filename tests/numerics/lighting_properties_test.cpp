// SPDX-License-Identifier: MIT
//
// What holds of runtime/lighting for every valid map and query. u below is 2^-23; bounds count
// roundings of u / 2, of the map's greatest radiance where sums of it are concerned.
#include <algorithm>
#include <array>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "lighting/lookup.h"
#include "lighting/mips.h"
#include "numerics/property_inputs.h"
#include "support/cube_rotations.h"

namespace lodestar::testing {

namespace {

using lighting::Cubemap;
using lighting::EstimatorKind;
using lighting::Lobe;
using lighting::LookupRequest;
using lighting::PreparedEnvironment;

constexpr double u = 0x1p-23;

/// Faces of 1 to 17 texels: even noise, many decades, one bright or one dark texel.
rc::Gen<Cubemap> cube() {
    return rc::gen::exec([] {
        const int width = *rc::gen::element(1, 2, 3, 4, 5, 7, 8, 16, 17);
        const int kind = *rc::gen::inRange(0, 4);
        std::mt19937 random(*whole(rc::gen::arbitrary<unsigned>()));
        std::uniform_real_distribution<float> unit(0.0f, 1.0f);
        const float scale = kind == 1 ? 1.0f : *logarithmic(1e-3f, 1e6f);
        Cubemap map(width);
        for (glm::vec4& texel : map.level(0)) {
            const auto one = [&] {
                return scale * (kind == 0   ? unit(random)
                                : kind == 1 ? std::pow(10.0f, 12.0f * unit(random) - 3.0f)
                                            : 0.5f);
            };
            texel = {one(), one(), one(), 1.0f};
        }
        if (kind >= 2) {
            map.level(0)[random() % map.level(0).size()] *= kind == 2 ? 1000.0f : 0.0f;
        }
        return map;
    });
}

struct Range {
    glm::dvec3 low{INFINITY};
    glm::dvec3 high{0.0};
    void add(const glm::dvec3& value) {
        low = glm::min(low, value);
        high = glm::max(high, value);
    }
    [[nodiscard]] double greatest() const { return std::max({high.r, high.g, high.b}); }
    /// False for NaN. @param share of the ends that a value may be beyond them
    [[nodiscard]] bool holds(const glm::dvec3& value, double share) const {
        for (int c = 0; c < 3; ++c) {
            if (!(value[c] >= low[c] * (1.0 - share) && value[c] <= high[c] * (1.0 + share))) {
                return false;
            }
        }
        return true;
    }
};

Range rangeOf(const Cubemap& map, int level) {
    Range range;
    for (const glm::vec4& texel : map.level(level)) {
        range.add(glm::dvec3(texel));
    }
    return range;
}

struct Ask {
    EstimatorKind kind;
    Lobe lobe;
};
const std::vector<Ask> kAsks{{EstimatorKind::Mip, Lobe::Phong},
                             {EstimatorKind::MipFloor, Lobe::Phong},
                             {EstimatorKind::Bias, Lobe::Phong},
                             {EstimatorKind::BiasVertex, Lobe::Phong},
                             {EstimatorKind::Tent, Lobe::Phong},
                             {EstimatorKind::Tent, Lobe::BlinnPhong},
                             {EstimatorKind::Prefiltered, Lobe::Phong},
                             {EstimatorKind::Prefiltered, Lobe::BlinnPhong},
                             {EstimatorKind::LowestMip, Lobe::Lambert},
                             {EstimatorKind::Sh9, Lobe::Lambert},
                             {EstimatorKind::Irradiance, Lobe::Lambert},
                             {EstimatorKind::Reference, Lobe::Phong},
                             {EstimatorKind::Reference, Lobe::BlinnPhong},
                             {EstimatorKind::Reference, Lobe::Lambert}};

LookupRequest request() {
    const Ask ask = *rc::gen::elementOf(kAsks);
    const glm::vec3 d = *direction();
    return {ask.lobe, static_cast<double>(*exponent()), glm::dvec3(d), {ask.kind, *uniform(0, 6)}};
}

PreparedEnvironment prepared(const Cubemap& map, EstimatorKind kind) {
    return lighting::prepare(map, lighting::partsFor({kind, 0.0f}));
}

Cubemap scaled(Cubemap map, float factor) {
    for (glm::vec4& texel : map.level(0)) {
        texel = glm::vec4(glm::vec3(texel) * factor, 1.0f);
    }
    return map;
}

double largestDifference(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 d = glm::abs(a - b);
    return std::max({d.r, d.g, d.b});
}

} // namespace

// Each texel is a mean, of at most nine, whose weights sum to 1: eight roundings a level.
RC_GTEST_PROP(MipChains, ALevelLiesWithinTheFinerOnes, ()) {
    const Cubemap map = *cube();
    for (const Cubemap& chain : {lighting::boxMips(map), lighting::solidAngleMips(map)}) {
        for (int level = 1; level < chain.levelCount(); ++level) {
            const Range finer = rangeOf(chain, level - 1);
            for (const glm::vec4& texel : chain.level(level)) {
                RC_ASSERT(finer.holds(glm::dvec3(texel), 8.0 * u));
            }
        }
    }
}

// Tents are scaled to the map's mean, so that no finer level bounds them; their means are. Sums of
// 1734 texels in rows of 17, in float.
RC_GTEST_PROP(MipChains, ALevelOfTentsKeepsTheMeanAndIsNeverNegative, ()) {
    const Cubemap chain = lighting::tentMips(*cube());
    const glm::dvec4 mean = lighting::sphereMean(chain, 0);
    for (int level = 0; level < chain.levelCount(); ++level) {
        for (const glm::vec4& texel : chain.level(level)) {
            RC_ASSERT(std::isfinite(texel.r) && texel.r >= 0.0f);
        }
        RC_ASSERT(std::abs(lighting::sphereMean(chain, level).r - mean.r) <= 20.0 * u * mean.r);
    }
}

// Three mixes a level and one between, each three roundings, and the means above. Irradiance: sums
// of 27 runs of 64 products, twice.
RC_GTEST_PROP(Lookups, AreFiniteAndWithinWhatTheyRead, ()) {
    const Cubemap map = *cube();
    const LookupRequest asked = request();
    const PreparedEnvironment environment = prepared(map, asked.estimator.kind);
    const glm::dvec3 radiance = lighting::lookup(environment, asked).radiance;
    if (asked.estimator.kind == EstimatorKind::Sh9) { // rings, and is clamped
        // Coefficients times at most 1, 2, 5/8 and 15/8: below 8 means.
        const Range whole{glm::dvec3(0.0), 8.0 * rangeOf(map, 0).high};
        RC_ASSERT(whole.holds(radiance, 16.0 * u));
        return;
    }
    Range range = rangeOf(map, 0);
    for (int level = 1; level < environment.tentMips.levelCount(); ++level) {
        const Range tents = rangeOf(environment.tentMips, level);
        range.add(tents.low);
        range.add(tents.high);
    }
    RC_ASSERT(range.holds(radiance, 120.0 * u));
}

// Powers of two round nothing, so that not a bit may differ.
RC_GTEST_PROP(Lookups, AreLinearInRadiance, ()) {
    const Cubemap map = *cube();
    const LookupRequest asked = request();
    const EstimatorKind kind = asked.estimator.kind;
    const glm::dvec3 one = lighting::lookup(prepared(map, kind), asked).radiance;
    const glm::dvec3 quarter = lighting::lookup(prepared(scaled(map, 0.25f), kind), asked).radiance;
    RC_ASSERT(quarter == 0.25 * one);
    const glm::dvec3 none = lighting::lookup(prepared(scaled(map, 0.0f), kind), asked).radiance;
    RC_ASSERT(none == glm::dvec3(0.0));
}

// The sum of two maps; each rounds as below, the sum's texels once more. Tents are no sums: they
// are scaled by what both maps' means say. Nine coefficients are clamped.
RC_GTEST_PROP(Lookups, OfASumAreSums, ()) {
    Cubemap a = *cube();
    const LookupRequest asked = request();
    const EstimatorKind kind = asked.estimator.kind;
    RC_PRE(kind != EstimatorKind::Tent && kind != EstimatorKind::Sh9);
    const Cubemap b = randomCube(a.width(), 3);
    const double greatest = rangeOf(a, 0).greatest() + rangeOf(b, 0).greatest();
    const glm::dvec3 parts = lighting::lookup(prepared(a, kind), asked).radiance +
                             lighting::lookup(prepared(b, kind), asked).radiance;
    for (std::size_t i = 0; i < a.level(0).size(); ++i) {
        a.level(0)[i] += b.level(0)[i];
    }
    const glm::dvec3 whole = lighting::lookup(prepared(a, kind), asked).radiance;
    RC_ASSERT(largestDifference(whole, parts) <= 300.0 * u * greatest);
}

// Sums run in another order: of 1734 texels in runs of 17 and 102 runs, twice (120 u); places
// on a face are off by 2 u of 17 texels, three mixes (102 u); levels by 40 u. Below an exponent of
// 1 the reference counts a texel on the very horizon whole or not at all, as its centre is rounded.
RC_GTEST_PROP(Lookups, TurnWithTheMap, ()) {
    const Cubemap map = *cube();
    const glm::mat3 turn = cubeRotation(*rc::gen::inRange(0, 24));
    LookupRequest asked = request();
    const EstimatorKind kind = asked.estimator.kind;
    RC_PRE(kind != EstimatorKind::Reference || asked.exponent >= 1.0);
    const glm::dvec3 before = lighting::lookup(prepared(map, kind), asked).radiance;
    asked.direction = glm::dmat3(turn) * asked.direction;
    const glm::dvec3 after =
        lighting::lookup(prepared(turnedCube(map, turn), kind), asked).radiance;
    RC_ASSERT(largestDifference(before, after) <= 300.0 * u * rangeOf(map, 0).greatest());
}

// A sharper lobe reads no coarser level (levels up to 5 by 8 u), and what is no exponent the level
// of the one that it is repaired to.
RC_GTEST_PROP(Lookups, LevelsFallWithTheExponent, ()) {
    LookupRequest asked = request();
    RC_PRE(asked.estimator.kind == EstimatorKind::Mip ||
           asked.estimator.kind == EstimatorKind::Tent ||
           asked.estimator.kind == EstimatorKind::Prefiltered);
    const PreparedEnvironment environment =
        prepared(constantCube(16, glm::vec4(1.0f)), asked.estimator.kind);
    const double before = lighting::lookup(environment, asked).level;
    RC_ASSERT(before >= 0.0 && before <= 4.0);
    asked.exponent = 1.5 * asked.exponent + 0.5;
    RC_ASSERT(lighting::lookup(environment, asked).level <= before + 40.0 * u);
    const float any = *anyFloat();
    asked.exponent = static_cast<double>(any);
    const double level = lighting::lookup(environment, asked).level;
    asked.exponent = static_cast<double>(shader::lodestar_repairExponent(any));
    RC_ASSERT(lighting::lookup(environment, asked).level == level);
}

RC_GTEST_PROP(Lookups, AnyVectorReadsTheMap, ()) {
    const Cubemap map = *cube();
    LookupRequest asked = request();
    asked.direction = glm::dvec3(glm::vec3(*anyFloat(), *anyFloat(), *anyFloat()));
    RC_PRE(asked.estimator.kind != EstimatorKind::Reference); // whose contract wants a unit one
    const glm::dvec3 radiance =
        lighting::lookup(prepared(map, asked.estimator.kind), asked).radiance;
    RC_ASSERT(radiance.r >= 0.0 && radiance.r <= 8.0 * rangeOf(map, 0).greatest());
}

// What is repaired is what was not valid, and nothing else.
RC_GTEST_PROP(Repair, AnyBitsBecomeRadianceAndAreCounted, ()) {
    core::Image image(7, 5, 3);
    std::uint64_t wrong = 0;
    for (float& value : image.pixels()) {
        value = *rc::gen::oneOf(anyFloat(), radiance());
        wrong += value >= 0.0f && value <= 1e9f ? 0U : 1U;
    }
    const std::vector<float> given = image.pixels();
    core::Tally warnings;
    lighting::repairRadiance(image, warnings);
    std::uint64_t counted = 0;
    for (const auto& [rule, count] : warnings.counts()) {
        counted += count;
    }
    RC_ASSERT(counted == wrong);
    for (std::size_t i = 0; i < given.size(); ++i) {
        const float value = image.pixels()[i];
        RC_ASSERT(value >= 0.0f && value <= 1e9f);
        RC_ASSERT(!(given[i] >= 0.0f && given[i] <= 1e9f) || value == given[i]);
    }
}

} // namespace lodestar::testing

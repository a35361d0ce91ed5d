// SPDX-License-Identifier: MIT
//
// Whether a sky is another times a factor, and what a probe that keeps its sky apart does of it.
#include <limits>
#include <memory>
#include <optional>

#include <gtest/gtest.h>

#include "plan/probe_worlds.h"

namespace lodestar::plan {
namespace {

SkyRadiance skyOf(std::vector<glm::vec3> samples) {
    SkyRadiance sky;
    sky.samples = std::move(samples);
    return sky;
}

/// Any shape, times a factor as a tint makes it.
SkyRadiance evening(const glm::vec3& factor) {
    return skyOf({glm::vec3(0.3f, 0.7f, 0.0f) * factor, glm::vec3(1e-6f, 0.1f, 0.0f) * factor,
                  glm::vec3(0.0f, 1e4f, 0.0f) * factor});
}

TEST(SkyFactor, IsThatOfAnIntensityOrATint) {
    for (const float intensity : {1.0f, 0.8f, 1e-6f, 16.0f, 1.0f / 3.0f}) {
        for (const glm::vec3 tint : {glm::vec3(1.0f), glm::vec3(0.1f, 0.7f, 1.0f)}) {
            const auto factor = skyFactor(evening(glm::vec3(1.0f)), evening(intensity * tint));
            ASSERT_TRUE(factor.has_value()) << intensity;
            for (int c = 0; c < 2; ++c) { // a product's rounding
                EXPECT_NEAR((*factor)[c], intensity * tint[c], 2e-7f * intensity * tint[c]);
            }
            EXPECT_EQ(factor->b, 1.0f); // black before and after
        }
    }
}

// A difference twice what is taken for rounding is one; a quarter of it is none.
TEST(SkyFactor, TellsAShapeFromRounding) {
    const SkyRadiance flat = skyOf({glm::vec3(1.0f), glm::vec3(1.0f)});
    const auto tilted = [](float by) {
        return skyOf({glm::vec3(1.0f), glm::vec3(1.0f, 1.0f, 1.0f + by)});
    };
    EXPECT_FALSE(skyFactor(flat, tilted(0x1p-18f)));
    EXPECT_FALSE(skyFactor(flat, tilted(-0x1p-18f)));
    EXPECT_TRUE(skyFactor(flat, tilted(0x1p-21f)));
    EXPECT_FALSE(skyFactor(evening(glm::vec3(1.0f)), flat));
}

TEST(SkyFactor, OfChannelsThatWereOrBecomeBlack) {
    const SkyRadiance white = skyOf({glm::vec3(1.0f)});
    EXPECT_EQ(skyFactor(white, skyOf({glm::vec3(0.0f, 0.5f, 0.5f)})), glm::vec3(0.0f, 0.5f, 0.5f));
    EXPECT_FALSE(skyFactor(skyOf({glm::vec3(0.0f, 0.5f, 0.5f)}), white));
    EXPECT_FALSE(skyFactor(skyOf({glm::vec3(0.0f)}), skyOf({glm::vec3(1e-45f)})));
    EXPECT_EQ(skyFactor(skyOf({}), skyOf({})), glm::vec3(1.0f));
    EXPECT_EQ(skyFactor(skyOf({glm::vec3(0.0f)}), skyOf({glm::vec3(0.0f)})), glm::vec3(1.0f));
}

TEST(SkyFactor, EndsWhereHalfFloatsOrAnythingElseDo) {
    const SkyRadiance sky = evening(glm::vec3(1.0f));
    EXPECT_TRUE(skyFactor(sky, evening(glm::vec3(kGreatestFactor))));
    EXPECT_FALSE(skyFactor(sky, evening(glm::vec3(1.01f * kGreatestFactor))));
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(skyFactor(sky, evening(glm::vec3(kNan))));
    EXPECT_FALSE(skyFactor(evening(glm::vec3(kNan)), sky));
    SkyRadiance turned = evening(glm::vec3(0.5f));
    turned.rest = 1;
    EXPECT_FALSE(skyFactor(sky, turned));
    EXPECT_FALSE(skyFactor(sky, skyOf({glm::vec3(1.0f)})));
}

// Beside an environment that stays, a sky's factor is none of what stands behind all.
TEST(SkyFactor, IsOneBesideAnEnvironment) {
    SkyRadiance then = evening(glm::vec3(1.0f)), now = evening(glm::vec3(0.5f));
    then.fixed = now.fixed = true;
    EXPECT_FALSE(skyFactor(then, now));
    EXPECT_EQ(skyFactor(then, then), glm::vec3(1.0f));
}

// Two skies that dim by different factors are another shape.
TEST(SkyFactor, IsOneForAllSkies) {
    const SkyRadiance then = skyOf({glm::vec3(1.0f), glm::vec3(0.2f)});
    EXPECT_TRUE(skyFactor(then, skyOf({glm::vec3(0.5f), glm::vec3(0.1f)})));
    EXPECT_FALSE(skyFactor(then, skyOf({glm::vec3(0.5f), glm::vec3(0.2f)})));
}

void shine(World& world, SkyRadiance sky) {
    ++world.light.sky;
    world.light.radiance = std::make_shared<const SkyRadiance>(std::move(sky));
}

World ratioLobby(bool ratio = true) {
    World world = lobby();
    world.probes()[0].relight =
        ratio ? lighting::ProbeRelight::Ratio : lighting::ProbeRelight::Compose;
    shine(world, evening(glm::vec3(1.0f)));
    return world;
}

// A factor, though the frames between are many, is always over the sky that was composed.
TEST(ProbeRatio, AFactorIsNoPass) {
    World world = ratioLobby();
    EXPECT_TRUE(workOf(world.frame(), 0)->compose);
    for (const float factor : {0.8f, 0.1f, 3.0f}) {
        shine(world, evening(glm::vec3(factor)));
        const EffectPlan now = world.frame();
        EXPECT_TRUE(now.probeWork.empty());
        EXPECT_TRUE(now.probeFaces.empty());
        EXPECT_NEAR(world.input.probes[0].skyFactor.r, factor, 2e-7f * factor);
    }
    shine(world, evening(glm::vec3(0.8f)));
    const std::string words = planText(world.frame());
    EXPECT_NE(words.find("Probe 'Lobby': sky 0.8, 0.8, 1 times as bright: a factor, no pass\n"),
              std::string::npos)
        << words;
}

TEST(ProbeRatio, AnotherShapeIsComposed) {
    World world = ratioLobby();
    world.frame();
    shine(world, skyOf({glm::vec3(1.0f), glm::vec3(0.5f), glm::vec3(0.25f)}));
    const EffectPlan composed = world.frame();
    ASSERT_NE(workOf(composed, 0), nullptr);
    EXPECT_TRUE(composed.probeFaces.empty());
    EXPECT_NE(planText(composed).find("composed again: the sky has changed, not by a factor"),
              std::string::npos);
    const auto cost = [](const EffectPlan& plan, const std::string& effect) {
        for (const Effect& each : plan.effects) {
            if (each.effect == effect) {
                return each.cost.passes;
            }
        }
        return std::uint64_t{0};
    };
    EXPECT_EQ(cost(composed, "probe-compose"), 12u);
    EXPECT_EQ(cost(composed, "probe-irradiance"), 4u);
    EXPECT_TRUE(world.frame().probeWork.empty());
    EXPECT_EQ(world.input.probes[0].skyFactor, glm::vec3(1.0f));
}

// Nothing of it where it is not asked for: every change composes, no draw's shader has two chains.
TEST(ProbeRatio, IsOnlyWhereItIsAskedFor) {
    World world = ratioLobby(false);
    const EffectPlan first = world.frame();
    EXPECT_FALSE(has(first.drawFeatures.at(0), Feature::ProbeSkies));
    shine(world, evening(glm::vec3(0.8f)));
    const EffectPlan second = world.frame();
    EXPECT_NE(workOf(second, 0), nullptr);
    EXPECT_FALSE(second.runs("probe-ratio"));
    World other = ratioLobby();
    EXPECT_TRUE(has(other.frame().drawFeatures.at(0), Feature::ProbeSkies));
    other.input.draws.push_back(drawAt({100, 0, 0}));
    const EffectPlan both = other.frame();
    ASSERT_EQ(both.drawFeatures.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) { // the second draw is far from the probe
        EXPECT_EQ(has(both.drawFeatures[i], Feature::ProbeSkies), both.drawOrder[i] == 0);
    }
}

} // namespace
} // namespace lodestar::plan

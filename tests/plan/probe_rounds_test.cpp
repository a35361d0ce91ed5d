// SPDX-License-Identifier: MIT
//
// Rounds of faces that something comes between: movement, changed light, a probe that moves or
// goes.
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "plan/probe_worlds.h"

namespace lodestar::plan {
namespace {

std::array<glm::dvec3, 3> sunOf(double power) {
    return along(glm::dvec3(power), {0, 1, 0});
}

// Captured for a mirror alone it has level 0 and no irradiance; a matt draw that comes asks for
// both.
TEST(ProbeRounds, ANewReceiverGetsWhatItReads) {
    World world = lobby();
    world.input.draws[0].diffuse = false;
    world.input.draws[0].bluntest = world.input.draws[0].sharpest = 1e6;
    const EffectPlan first = world.frame();
    EXPECT_EQ(first.probeWork[0].lastLevel, 0);
    EXPECT_FALSE(first.probeWork[0].irradiance);
    world.input.draws.push_back(drawAt({1, 0, 2}));
    const EffectPlan second = world.frame();
    EXPECT_TRUE(second.probeFaces.empty());
    ASSERT_NE(workOf(second, 0), nullptr);
    EXPECT_TRUE(workOf(second, 0)->irradiance);
    EXPECT_GT(workOf(second, 0)->lastLevel, 3);
    EXPECT_TRUE(world.frame().probeWork.empty());
}

// Q may begin where P's inside is gone; P draws all of its round anew when it is back.
TEST(ProbeRounds, AProbeWhoseInsideGoesBeginsAnew) {
    World world = lobby();
    world.probes().push_back(probeAt("Q", {8, 0, 0}, 10.0, 1.0));
    world.histories().emplace_back();
    world.input.draws.push_back(drawAt({8, 0, 2}));
    world.input.draws[0].screenShare = 1.0f;
    world.input.faceBudget = 4;
    const EffectPlan begun = world.frame();
    ASSERT_EQ(begun.probeFaces.size(), 4u);
    ASSERT_EQ(begun.probeFaces[0].probe, 0u);
    const glm::dvec3 size = world.probes()[0].influence.size;
    world.probes()[0].influence.size = glm::dvec3(0.0);
    EXPECT_EQ(world.frame().probeFaces[0].probe, 1u); // Q begins
    world.probes()[0].influence.size = size;
    std::size_t drawn = 0;
    for (int i = 0; i < 6 && !world.histories()[0].ready; ++i) {
        for (const ProbeFace& face : world.frame().probeFaces) {
            drawn += face.probe == 0 ? 1 : 0;
        }
    }
    EXPECT_TRUE(world.histories()[0].ready);
    EXPECT_EQ(drawn, 6u);
}

// A lift that never rests crosses two faces; the others still see that the light has changed.
TEST(ProbeRounds, ChangedLightIsSeenThoughSomethingAlwaysMoves) {
    World world = lobby();
    world.light.sources = {sunOf(1.0)};
    world.frame();
    world.input.faceBudget = 1;
    const auto step = [&] {
        world.moved = {{"lift", {-0.4f, -0.4f, -4.0f}, {0.4f, 0.4f, -3.0f}, 0.1},
                       {"cart", {3.0f, -0.4f, -0.4f}, {4.0f, 0.4f, 0.4f}, 0.1}};
        return world.frame();
    };
    step();
    world.light.sources = {sunOf(3.0)};
    std::array<int, 6> drawn{};
    for (int i = 0; i < 60; ++i) {
        for (const ProbeFace& face : step().probeFaces) {
            ++drawn[static_cast<std::size_t>(face.face)];
        }
    }
    for (const int count : drawn) {
        EXPECT_GT(count, 0);
    }
    EXPECT_LT(lightChange(world.histories()[0].capturedUnder, world.light), 0.1);
}

TEST(ProbeRounds, AProbeThatMovesInItsFirstRoundIsCapturedWhereItStands) {
    World world = lobby();
    world.input.faceBudget = 2;
    world.frame();
    world.probes()[0].position.x = 1.0;
    std::size_t drawn = 2;
    for (int i = 0; i < 8; ++i) {
        drawn += world.frame().probeFaces.size();
    }
    EXPECT_EQ(drawn, 6u + 2u); // the two that were drawn elsewhere
}

TEST(ProbeRounds, OnceIsOnce) {
    using lighting::ProbeUpdate;
    for (const ProbeUpdate update : {ProbeUpdate::Once, ProbeUpdate::OnDemand}) {
        World world = lobby(update);
        world.input.faceBudget = 2;
        std::size_t drawn = 0;
        const auto step = [&] {
            world.moved = {{"all", {-9, -9, -9}, {9, 9, 9}, 0.1}};
            drawn += world.frame().probeFaces.size();
        };
        for (int i = 0; i < 10; ++i) {
            step();
        }
        EXPECT_EQ(drawn, 6u);
        world.histories()[0].requested = true;
        for (int i = 0; i < 10; ++i) {
            step();
        }
        EXPECT_EQ(drawn, 12u);
    }
}

// All that 200 probes see moves in every frame and one face a frame is drawn, so that a round is 6
// frames. One probe lights a share of 0 of the picture, the others .15: urgencies of .01 to .16, by
// patience squared. A probe that has waited X frames is passed over only for such as have waited at
// least X / r, r = sqrt(.16 / .01) = 4, for each once in the next X / r frames: these are at most
// 200 rounds, so that X <= 1200 r, and it waits at most 1200 (r + 1) in all.
TEST(ProbeRounds, OneFaceAFrameIsEnoughForNoneToStarve) {
    constexpr int kProbes = 200, kLongest = 1200 * 5;
    World world{std::vector<lighting::Probe>()};
    for (int i = 0; i < kProbes; ++i) {
        world.probes().push_back(
            probeAt(std::string("p").append(std::to_string(i)), {10.0 * i, 0, 0}, 9.0, 1.0));
        world.input.draws.push_back(drawAt({10.0f * static_cast<float>(i), 0, 1}));
        world.input.draws.back().screenShare = i == 0 ? 0.0f : 0.15f;
    }
    world.histories().resize(kProbes);
    world.input.faceBudget = 1;
    std::vector<int> published(kProbes), rounds(kProbes), longest(kProbes);
    for (int frame = 0; frame < 2 * kLongest; ++frame) {
        world.moved = {{"all", {-1e4f, -9, -9}, {1e4f, 9, 9}, 0.0}};
        const EffectPlan plan = world.frame();
        ASSERT_EQ(plan.probeFaces.size(), 1u) << frame;
        for (const ProbeWork& work : plan.probeWork) {
            if (work.publish) {
                ++rounds[work.probe];
                longest[work.probe] = std::max(longest[work.probe], frame - published[work.probe]);
                published[work.probe] = frame;
            }
        }
        for (int i = 0; frame == 6 * kProbes && i < kProbes; ++i) {
            EXPECT_EQ(rounds[static_cast<std::size_t>(i)], 1)
                << i; // all show before one shows anew
        }
    }
    for (int i = 0; i < kProbes; ++i) {
        const auto at = static_cast<std::size_t>(i);
        EXPECT_LE(std::max(longest[at], 2 * kLongest - published[at]), kLongest) << i;
        EXPECT_GE(rounds[at], rounds[0]) << i; // what shows more is served no less often
    }
}

// What a frame's probes take, by what the views say, is within the budget, or there is one face
// alone; what a round that goes on has left of the budget is not enough for its next face.
TEST(ProbeRounds, MillisecondsAreABudgetToo) {
    constexpr int kProbes = 12;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    World world{std::vector<lighting::Probe>()};
    std::vector<double> faceMs, lightMs;
    for (int i = 0; i < kProbes; ++i) {
        world.probes().push_back(
            probeAt(std::string("p").append(std::to_string(i)), {10.0 * i, 0, 0}, 9.0, 1.0));
        world.input.draws.push_back(drawAt({10.0f * static_cast<float>(i), 0, 1}));
        faceMs.push_back(0.2 + unit(random));
        lightMs.push_back(0.2 + 2.0 * unit(random));
    }
    world.histories().resize(kProbes);
    world.describe = [&](std::size_t i, ProbeView& view) {
        view.faceMs.fill(faceMs[i]);
        view.lightMs = lightMs[i];
    };
    world.input.faceBudget = 100;
    int several = 0, cut = 0;
    for (int frame = 0; frame < 600; ++frame) {
        world.input.probeBudgetMs = 8.0 * unit(random);
        const auto x = static_cast<float>(120.0 * unit(random));
        world.moved = {{"crowd", {x, -1, -1}, {x + 30, 1, 1}, 1.0}};
        const EffectPlan plan = world.frame();
        double faces = 0.0, light = 0.0;
        for (const ProbeFace& face : plan.probeFaces) {
            faces += faceMs[face.probe];
        }
        for (const ProbeWork& work : plan.probeWork) {
            light += lightMs[work.probe];
        }
        if (plan.probeFaces.size() > 1) {
            EXPECT_LE(faces + light, world.input.probeBudgetMs + 1e-9) << frame;
            ++several;
        }
        if (const std::size_t last = plan.probeFaces.empty() ? 0 : plan.probeFaces.back().probe;
            world.histories()[last].drawnFor > 0) {
            EXPECT_GT(faces + light + faceMs[last] + lightMs[last], world.input.probeBudgetMs)
                << frame;
            ++cut;
        }
    }
    EXPECT_GT(several, 100);
    EXPECT_GT(cut, 100);
}

TEST(ProbeRounds, AFaceOfUnknownCostIsDrawnAlone) {
    World world = lobby();
    world.input.probeBudgetMs = 100.0;
    EXPECT_EQ(world.frame().probeFaces.size(), 1u);
    world.describe = [](std::size_t, ProbeView& view) { view.faceMs.fill(1.0); };
    world.input.probeBudgetMs = 3.5;
    const EffectPlan second = world.frame();
    EXPECT_EQ(second.probeFaces.size(), 3u);
    world.input.probeBudgetMs = 0.0;
    EXPECT_EQ(world.frame().probeFaces.size(), 1u); // one in any case
    world.moved = {{"all", {-9, -9, -9}, {9, 9, 9}, 0.1}};
    world.probes().push_back(probeAt("Attic", {20, 0, 0}, 10.0, 1.0));
    world.histories().emplace_back();
    world.input.draws.push_back(drawAt({20, 0, 2}));
    EXPECT_EQ(captureText(world.frame(), "Attic"),
              "skipped: waits, the frame's milliseconds are spent: 6 faces, it shows nothing yet");
}

TEST(ProbeRounds, LightThatIsNoNumberCountsAsChanged) {
    const double infinity = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    LightState one, other;
    one.sources = {sunOf(1.0)};
    for (const double power : {infinity, nan}) {
        other.sources = {{glm::dvec3(power), glm::dvec3(power), glm::dvec3(power)}};
        EXPECT_TRUE(std::isinf(lightChange(one, other)));
        EXPECT_TRUE(std::isinf(lightChange(other, one)));
    }
    EXPECT_EQ(lightChange(one, one), 0.0);
    World world = lobby();
    world.frame();
    world.light.sources = {sunOf(1.0)};
    EXPECT_EQ(captureText(world.frame(), "Lobby"),
              "6 of 6 faces: there is light where there was none");
}

} // namespace
} // namespace lodestar::plan

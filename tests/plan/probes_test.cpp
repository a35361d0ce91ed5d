// SPDX-License-Identifier: MIT
//
// Light probes without a GPU: which light a draw, what a frame captures, what it says of it.
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "lodestar/probes.glsl"
#include "plan/probe_worlds.h"

namespace lodestar::plan {
namespace {

TEST(ProbePlan, IsCapturedWholeThenRests) {
    World world = lobby();
    const EffectPlan first = world.frame();
    EXPECT_EQ(first.probeFaces.size(), 6u);
    ASSERT_EQ(first.probeWork.size(), 1u);
    EXPECT_TRUE(first.probeWork[0].publish);
    EXPECT_EQ(first.probeWork[0].fadeLeft, 1);
    EXPECT_TRUE(first.probeWork[0].irradiance);
    // It lights in the frame that captures it.
    EXPECT_EQ(first.drawChoices[0].probe[0], 0);
    EXPECT_TRUE(has(first.drawFeatures[0], Feature::Probe));
    EXPECT_FALSE(has(first.drawFeatures[0], Feature::SecondProbe));
    // But not its own capture.
    EXPECT_EQ(first.probeFaces[4].choices.size(), 1u); // +Z sees the ball
    EXPECT_EQ(first.probeFaces[4].choices[0].probe[0], ProbeChoice::kNone);
    for (int i = 0; i < 3; ++i) {
        const EffectPlan later = world.frame();
        EXPECT_TRUE(later.probeFaces.empty());
        EXPECT_TRUE(later.probeWork.empty());
        EXPECT_EQ(captureText(later, "Lobby"), "skipped: nothing that it sees has changed");
    }
}

TEST(ProbePlan, OnlyFacesThatSeeWhatMovedAreDrawnAgain) {
    World world = lobby();
    world.frame();
    world.moved = {{"the lift", {-0.4f, -0.4f, -4.0f}, {0.4f, 0.4f, -3.0f}, 0.1}};
    const EffectPlan plan = world.frame();
    ASSERT_EQ(plan.probeFaces.size(), 1u);
    EXPECT_EQ(plan.probeFaces[0].face, 5);
    EXPECT_EQ(captureText(plan, "Lobby"), "1 of 6 faces: the lift moved");
    EXPECT_TRUE(workOf(plan, 0)->publish);
    world.moved = {{"far away", {5000, 0, 0}, {5001, 1, 1}, 0.1}}; // beyond the far plane
    EXPECT_TRUE(world.frame().probeFaces.empty());
}

TEST(ProbePlan, WaitsForItsFacesAndSaysSo) {
    World world = lobby();
    world.input.faceBudget = 4;
    EXPECT_EQ(world.frame().probeFaces.size(), 4u);
    const EffectPlan second = world.frame();
    EXPECT_EQ(second.probeFaces.size(), 2u);
    EXPECT_TRUE(workOf(second, 0)->publish);
    world.input.faceBudget = 0;
    world.moved = {{"the lift", {-9, -9, -9}, {9, 9, 9}, 0.1}};
    for (int i = 0; i < 3; ++i) {
        const EffectPlan plan = world.frame();
        EXPECT_TRUE(plan.probeFaces.empty());
        EXPECT_EQ(captureText(plan, "Lobby"),
                  "skipped: waits, the frame's faces are spent: 6 faces, the lift moved");
    }
}

TEST(ProbePlan, PublishedFacesFadeInAsLongAsTheyTook) {
    World world = lobby();
    world.frame();
    world.input.faceBudget = 2;
    world.moved = {{"all", {-9, -9, -9}, {9, 9, 9}, 0.1}};
    EXPECT_TRUE(world.frame().probeWork.empty()); // never half updated
    EXPECT_TRUE(world.frame().probeWork.empty());
    for (const int left : {3, 2, 1}) {
        const EffectPlan plan = world.frame();
        ASSERT_NE(workOf(plan, 0), nullptr);
        EXPECT_EQ(workOf(plan, 0)->fadeLeft, left);
    }
    EXPECT_TRUE(world.frame().probeWork.empty());
}

TEST(ProbePlan, AChangedSkyIsComposedWithoutFaces) {
    World world = lobby();
    world.frame();
    world.light.sky = 7;
    const EffectPlan plan = world.frame();
    EXPECT_TRUE(plan.probeFaces.empty());
    ASSERT_NE(workOf(plan, 0), nullptr);
    EXPECT_TRUE(workOf(plan, 0)->compose);
    EXPECT_FALSE(workOf(plan, 0)->publish);
    EXPECT_NE(planText(plan).find("Probe 'Lobby': composed again: the sky has changed"),
              std::string::npos);
    EXPECT_TRUE(world.frame().probeWork.empty());
}

TEST(ProbePlan, BouncedLightIsCapturedAgainBeyondTheThreshold) {
    World world = lobby();
    const auto sun = [](double power, const glm::dvec3& axis) {
        return std::array<glm::dvec3, 3>{power * axis, power * axis, power * axis};
    };
    world.light.sources = {sun(1.0, {0, 1, 0})};
    world.frame();
    world.light.sources = {sun(1.08, {0, 1, 0})};
    EXPECT_TRUE(world.frame().probeFaces.empty());
    world.light.sources = {sun(1.12, {0, 1, 0})};
    const EffectPlan plan = world.frame();
    EXPECT_EQ(plan.probeFaces.size(), 6u);
    EXPECT_EQ(captureText(plan, "Lobby"), "6 of 6 faces: its light has changed by 12 %");
    // A turn of the axis counts as the way of its tip.
    world.light.sources = {sun(1.12, glm::normalize(glm::dvec3(0.2, 1, 0)))};
    EXPECT_EQ(world.frame().probeFaces.size(), 6u);
    EXPECT_EQ(lightChange({}, {}), 0.0);
    EXPECT_TRUE(std::isinf(lightChange({}, world.light)));
}

TEST(ProbePlan, PoliciesAskForWhatTheySay) {
    using lighting::ProbeUpdate;
    const std::vector<Moved> everything = {{"all", {-9, -9, -9}, {9, 9, 9}, 0.1}};
    const auto facesOver = [&](ProbeUpdate update, int every) {
        World world = lobby(update);
        world.probes()[0].every = every;
        std::vector<std::size_t> faces;
        for (int i = 0; i < 7; ++i) {
            world.moved = everything;
            world.histories()[0].requested = i == 5;
            faces.push_back(world.frame().probeFaces.size());
        }
        return faces;
    };
    using Faces = std::vector<std::size_t>;
    EXPECT_EQ(facesOver(ProbeUpdate::Once, 1), (Faces{6, 0, 0, 0, 0, 6, 0}));
    EXPECT_EQ(facesOver(ProbeUpdate::OnDemand, 1), (Faces{6, 0, 0, 0, 0, 6, 0}));
    EXPECT_EQ(facesOver(ProbeUpdate::OnChange, 1), (Faces{6, 6, 6, 6, 6, 6, 6}));
    EXPECT_EQ(facesOver(ProbeUpdate::Always, 1), (Faces{6, 6, 6, 6, 6, 6, 6}));
    EXPECT_EQ(facesOver(ProbeUpdate::Every, 3), (Faces{6, 0, 0, 6, 0, 6, 0}));
}

TEST(ProbePlan, WhatNobodySeesCostsNothing) {
    World world = lobby();
    world.probes().push_back(probeAt("Attic", {100, 0, 0}, 4.0, 0.0));
    world.histories().emplace_back();
    lighting::Probe flat = probeAt("Flat", {0, 0, 0}, 4.0, 0.0);
    flat.influence.size.y = 0.0;
    world.probes().push_back(flat);
    world.histories().emplace_back();
    const EffectPlan plan = world.frame();
    EXPECT_EQ(captureText(plan, "Attic"), "skipped: nobody sees it");
    EXPECT_EQ(captureText(plan, "Flat"), "skipped: it has no inside");
    EXPECT_EQ(plan.probeFaces.size(), 6u);
    world.input.draws[0].visible = false;
    world.moved = {{"all", {-9, -9, -9}, {9, 9, 9}, 0.1}};
    const EffectPlan unseen = world.frame();
    EXPECT_TRUE(unseen.probeFaces.empty());
    EXPECT_TRUE(unseen.probeWork.empty());
    EXPECT_EQ(captureText(unseen, "Lobby"), "skipped: nobody sees it");
}

TEST(ProbePlan, LevelsAreThoseThatExponentsSample) {
    World world = lobby();
    world.input.draws[0].diffuse = false;
    world.input.draws[0].bluntest = 1e6; // a mirror: level 0 alone
    EXPECT_EQ(world.frame().probeWork[0].lastLevel, 0);
    World dull = lobby();
    dull.input.draws[0].glossy = false;
    EXPECT_EQ(dull.frame().probeWork[0].lastLevel, 2) << "32 texels, of which irradiance is made";
    World both = lobby();
    both.input.draws[0].bluntest = 0.0;
    EXPECT_EQ(both.frame().probeWork[0].lastLevel, 7);
}

TEST(ProbePlan, DrawsOfOnePairAreOneCall) {
    World world = lobby();
    world.probes().push_back(probeAt("East", {8, 0, 0}, 10.0, 1.0));
    world.histories().emplace_back();
    world.input.faceBudget = 12;
    world.input.draws = {drawAt({-2, 0, 0}), drawAt({-3, 0, 0}), drawAt({4, 0, 0}),
                         drawAt({11, 0, 0})};
    const EffectPlan plan = world.frame();
    EXPECT_EQ(plan.batches.size(), 3u);
    EXPECT_EQ(std::count_if(plan.drawFeatures.begin(), plan.drawFeatures.end(),
                            [](Features set) { return has(set, Feature::SecondProbe); }),
              1);
    EXPECT_EQ(plan, lodestar::plan::plan(world.input)); // of the same input
}

// Every frame some things move; each probe that is needed is published before long.
TEST(ProbePlan, TheBudgetHoldsAndNoneStarves) {
    constexpr int kProbes = 60, kFrames = 2000;
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<lighting::Probe> probes;
    World world{std::vector<lighting::Probe>()};
    for (int i = 0; i < kProbes; ++i) {
        world.probes().push_back(
            probeAt(std::string("p").append(std::to_string(i)), {10.0 * i, 0, 0}, 9.0, 1.0));
        world.histories().emplace_back();
        world.input.draws.push_back(drawAt({10.0f * static_cast<float>(i), 0, 1}));
        world.input.draws.back().screenShare = unit(random);
    }
    std::vector<int> published(kProbes);
    std::vector<int> longest(kProbes);
    for (int frame = 0; frame < kFrames; ++frame) {
        world.input.faceBudget = frame % 4 == 0 ? 3 : 2;
        for (int i = 0; i < 5; ++i) {
            const float x = 600.0f * unit(random);
            world.moved.push_back({"crowd", {x, -1, -1}, {x + 2, 1, 1}, 5.0 * unit(random)});
        }
        const EffectPlan plan = world.frame();
        ASSERT_LE(static_cast<int>(plan.probeFaces.size()), world.input.faceBudget);
        int inProgress = 0;
        for (std::size_t i = 0; i < kProbes; ++i) {
            const ProbeWork* work = workOf(plan, i);
            if (work != nullptr && work->publish) {
                longest[i] = std::max(longest[i], frame - published[i]);
                published[i] = frame;
            }
            const auto& drawn = world.histories()[i].drawn;
            inProgress += std::count(drawn.begin(), drawn.end(), true) > 0 ? 1 : 0;
        }
        ASSERT_LE(inProgress, 1) << frame;
    }
    // All are stale nearly always, so that each waits for the others: 60 probes of 6 faces at 2.25
    // a frame are 160 frames. Urgency is share x speed x patience squared: the least, .01 x 1,
    // overtakes the greatest, 1.01 x 6, when it has waited sqrt(606) = 25 times as long; the others
    // serve in turn, so that none waits longer than 25 rounds, and most wait a few.
    for (int i = 0; i < kProbes; ++i) {
        EXPECT_GT(published[static_cast<std::size_t>(i)], 0) << i;
        EXPECT_LT(longest[static_cast<std::size_t>(i)], 25 * 160 / 4) << i;
    }
}

/// What a point at the middle of a draw gets of each probe, by index, and of the sky last.
std::vector<double> sharesAt(const std::vector<ProbeView>& probes, const ProbeChoice& choice,
                             const glm::vec3& at) {
    const auto weight = [&](std::size_t slot) {
        const int probe = choice.probe[slot];
        if (probe == ProbeChoice::kNone) {
            return 0.0f;
        }
        const lighting::PlacedVolume& v = *probes[static_cast<std::size_t>(probe)].influence;
        return shader::lodestar_volumeWeight({v.rows[0], v.rows[1], v.rows[2], v.halfExtents,
                                              v.blendHigh, v.blendLow, v.sphere ? 1.0f : 0.0f,
                                              v.outward ? 1.0f : 0.0f},
                                             at);
    };
    const shader::LodestarShares shares = shader::lodestar_probeShares(
        weight(0), weight(1), choice.factor[0], choice.factor[1], choice.open);
    std::vector<double> all(probes.size() + 1);
    for (std::size_t slot = 0; slot < 2; ++slot) {
        if (choice.probe[slot] != ProbeChoice::kNone) {
            all[static_cast<std::size_t>(choice.probe[slot])] +=
                static_cast<double>(slot == 0 ? shares.first : shares.second);
        }
    }
    all.back() = static_cast<double>(shares.environment);
    return all;
}

// A draw walks through random layouts. Between two steps of 1 mm no share jumps: means of weights
// change by at most 1.5 / blend a metre, factors by the ratio of such changes to what is shown.
TEST(ProbeChoices, SharesDoNotJumpOnAWalk) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    double worst = 0.0;
    for (int layout = 0; layout < 40; ++layout) {
        std::vector<ProbeView> probes;
        for (int i = 0; i < 5; ++i) {
            lighting::Probe probe =
                probeAt("p", {3 * unit(random), 3 * unit(random), 3 * unit(random)},
                        4.0 + 2.0 * static_cast<double>(unit(random)), 1.0);
            probe.priority = i % 3;
            probe.exterior = i % 2 == 0;
            probes.push_back(viewOf(probe));
        }
        const ProbeIndex index(probes);
        const std::vector<bool> lights(probes.size(), true);
        const glm::vec3 from(6 * unit(random), 4 * unit(random), 4 * unit(random));
        const glm::vec3 step = 0.001f * glm::normalize(-from);
        std::vector<double> before;
        double strongest = 1.0;
        for (int i = 0; i < 12000; ++i) {
            const glm::vec3 at = from + static_cast<float>(i) * step;
            const ProbeChoice choice = index.choose(at - 0.4f, at + 0.4f, lights);
            const std::vector<double> now = sharesAt(probes, choice, at);
            double sum = 0.0;
            for (const double share : now) {
                EXPECT_GE(share, -1e-6);
                sum += share;
            }
            ASSERT_NEAR(sum, 1.0, 1e-5);
            const double factors = static_cast<double>(choice.factor[0] + choice.factor[1]);
            if (!before.empty() && strongest > 0.5 && factors > 0.5) {
                for (std::size_t k = 0; k < now.size(); ++k) {
                    worst = std::max(worst, std::abs(now[k] - before[k]));
                }
            }
            before = now;
            strongest = factors;
        }
    }
    // Weights: 3 faces x 1.5 / m, twice in the product of two; factors the same over what is shown,
    // a half at least: 9 + 9 x 2 a metre, times 1 mm. A jump would be of a share's own size.
    EXPECT_LT(worst, 0.027);
}

TEST(ProbeChoices, ThePriorityThenTheSmallerStandsInFront) {
    std::vector<ProbeView> probes = {viewOf(probeAt("hall", {0, 0, 0}, 20.0, 0.0)),
                                     viewOf(probeAt("niche", {0, 0, 0}, 2.0, 0.0)),
                                     viewOf(probeAt("room", {0, 0, 0}, 6.0, 0.0))};
    const std::vector<bool> lights(3, true);
    {
        const ProbeIndex index(probes);
        EXPECT_EQ(index.choose(glm::vec3(-0.1f), glm::vec3(0.1f), lights).probe[0], 1);
        EXPECT_EQ(index.choose(glm::vec3(2.0f), glm::vec3(2.2f), lights).probe[0], 2);
        EXPECT_EQ(index.choose(glm::vec3(8.0f), glm::vec3(8.2f), lights).probe[0], 0);
    }
    probes[0].priority = 5;
    const ProbeIndex index(probes);
    EXPECT_EQ(index.choose(glm::vec3(-0.1f), glm::vec3(0.1f), lights).probe[0], 0);
}

TEST(ProbeChoices, AnInteriorThatCannotLightKeepsTheSkyOut) {
    lighting::Probe room = probeAt("room", {0, 0, 0}, 4.0, 0.2);
    room.exterior = false;
    const std::vector<ProbeView> probes = {viewOf(room)};
    const ProbeIndex index(probes);
    for (const bool ready : {false, true}) {
        const ProbeChoice own = index.choose(glm::vec3(-0.5f), glm::vec3(0.5f), {ready}, 0);
        EXPECT_TRUE(own.dark[0]);
        EXPECT_NEAR(sharesAt(probes, own, glm::vec3(0.0f)).back(), 0.0, 1e-6);
    }
    EXPECT_FALSE(index.choose(glm::vec3(-0.5f), glm::vec3(0.5f), {true}).dark[0]);
    const ProbeChoice outside = index.choose(glm::vec3(5.0f), glm::vec3(6.0f), {true});
    EXPECT_EQ(outside.probe[0], ProbeChoice::kNone);
    EXPECT_EQ(outside.open, 1.0f);
}

TEST(ProbeChoices, DeepNestsAndBrokenFramesAreDefined) {
    std::vector<ProbeView> probes;
    for (int i = 0; i < 200; ++i) {
        probes.push_back(viewOf(probeAt("p", {0, 0, 0}, 1.0 + i, 0.1)));
    }
    lighting::ProbeVolume volume;
    glm::mat4 broken(1.0f);
    broken[1][1] = std::numeric_limits<float>::quiet_NaN();
    probes.emplace_back(); // no inside
    probes.back().influence = lighting::place(volume, broken, false);
    EXPECT_FALSE(probes.back().influence.has_value());
    const ProbeIndex index(probes);
    const std::vector<bool> lights(probes.size(), true);
    EXPECT_EQ(index.choose(glm::vec3(-0.1f), glm::vec3(0.1f), lights).probe[0], 0);
    std::vector<int> touched;
    index.touching(glm::vec3(0.0f), glm::vec3(0.0f), touched);
    EXPECT_EQ(touched.size(), 200u);
}

} // namespace
} // namespace lodestar::plan

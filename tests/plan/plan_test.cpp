// SPDX-License-Identifier: MIT
//
// Given this scene, exactly these effects. No GL.
#include <set>
#include <string>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "plan/plan_inputs.h"

namespace lodestar::plan {
namespace {

using lighting::Estimator;
using lighting::EstimatorKind;

TEST(Plan, GlossyAndDiffuseCallForTentMipsAndIrradiance) {
    const EffectPlan result = plan(scene({ball()}));
    EXPECT_EQ(result.prepare, (lighting::PreparedParts{false, true, false, true}));
    EXPECT_TRUE(result.runs("tent-mips"));
    EXPECT_TRUE(result.runs("irradiance"));
    EXPECT_FALSE(result.runs("box-mips"));
    EXPECT_FALSE(result.runs("sh9"));
    EXPECT_FALSE(result.runs("backdrop"));
    EXPECT_FALSE(result.runs("punctual-lights"));
    // A chain of 64, 32 .. 1 texels a side: 6 (4^7 - 1) / 3.
    EXPECT_EQ(effect(result, "tent-mips").cost.texelsWritten, 6u * ((1u << 14) - 1u) / 3u);
}

TEST(Plan, OneTableOfSurfacesAndParts) {
    struct Case {
        const char* name;
        bool diffuse, glossy, visible, backdrop;
        EstimatorKind specular, lambert;
        lighting::PreparedParts parts; // box, tent, sh9, irradiance, prefiltered
    };
    const Case cases[] = {
        {"matte",
         true,
         false,
         true,
         false,
         EstimatorKind::Tent,
         EstimatorKind::Irradiance,
         {false, false, false, true}},
        {"metal",
         false,
         true,
         true,
         false,
         EstimatorKind::Tent,
         EstimatorKind::Irradiance,
         {false, true, false, false}},
        {"hidden", true, true, false, false, EstimatorKind::Tent, EstimatorKind::Irradiance, {}},
        {"hidden, backdrop",
         true,
         true,
         false,
         true,
         EstimatorKind::Tent,
         EstimatorKind::Irradiance,
         {false, true, false, false}},
        {"published",
         true,
         true,
         true,
         true,
         EstimatorKind::Mip,
         EstimatorKind::LowestMip,
         {true, false, false, false}},
        {"floor and sh9",
         true,
         true,
         true,
         false,
         EstimatorKind::MipFloor,
         EstimatorKind::Sh9,
         {true, false, true, false}},
        {"tent and lowest",
         true,
         true,
         true,
         false,
         EstimatorKind::Tent,
         EstimatorKind::LowestMip,
         {true, true, false, false}},
        {"ring",
         true,
         true,
         true,
         false,
         EstimatorKind::Ring7,
         EstimatorKind::Irradiance,
         {false, true, false, true}},
        {"prefiltered",
         true,
         true,
         true,
         true,
         EstimatorKind::Prefiltered,
         EstimatorKind::Sh9,
         {false, false, true, false, true}},
        {"taps",
         false,
         true,
         true,
         false,
         EstimatorKind::Taps,
         EstimatorKind::LowestMip,
         {false, true, false, false}},
        {"bias twice",
         true,
         true,
         true,
         false,
         EstimatorKind::Bias,
         EstimatorKind::Bias,
         {true, false, false, false}},
    };
    for (const Case& c : cases) {
        DrawView draw = ball();
        draw.diffuse = c.diffuse;
        draw.glossy = c.glossy;
        draw.visible = c.visible;
        PlanInput input = scene({draw});
        input.backdrop = c.backdrop;
        input.specular.kind = c.specular;
        input.diffuse.kind = c.lambert;
        EXPECT_EQ(plan(input).prepare, c.parts) << c.name;
    }
}

TEST(Plan, NothingIsMadeTwice) {
    PlanInput input = scene({ball()});
    input.alreadyPrepared = plan(input).prepare;
    input.environment.changed = false;
    const EffectPlan second = plan(input);
    EXPECT_EQ(second.prepare, lighting::PreparedParts{});
    EXPECT_EQ(effect(second, "tent-mips").decision, Decision::Skip);
    EXPECT_EQ(effect(second, "tent-mips").cost.texelsWritten, 0u);
    input.environment.changed = true;
    EXPECT_TRUE(plan(input).runs("tent-mips"));
}

TEST(Plan, OpaqueFirstThenBlendedFromTheBack) {
    DrawView nearGlass = ball(), farGlass = ball(), solid = ball(), hidden = ball();
    nearGlass.blended = farGlass.blended = true;
    nearGlass.distance = 1.0f;
    farGlass.distance = 5.0f;
    hidden.visible = false;
    const EffectPlan result = plan(scene({nearGlass, hidden, farGlass, solid}));
    EXPECT_EQ(result.drawOrder, (std::vector<std::size_t>{3, 2, 0}));
    EXPECT_EQ(result.drawFeatures.size(), 3u);
}

TEST(Plan, EmptySceneCallsForNothing) {
    const EffectPlan result = plan(scene({}));
    for (const Effect& each : result.effects) {
        EXPECT_EQ(each.decision, Decision::Skip) << each.effect;
        EXPECT_FALSE(each.reason.empty()) << each.effect;
    }
    EXPECT_TRUE(result.drawOrder.empty());
}

TEST(Plan, LightsAddTheirFeatureToVisibleDrawsOnly) {
    PlanInput input = scene({ball()});
    EXPECT_FALSE(has(plan(input).drawFeatures.at(0), Feature::PunctualLights));
    input.lightCount = 2;
    EXPECT_TRUE(has(plan(input).drawFeatures.at(0), Feature::PunctualLights));
    EXPECT_TRUE(plan(input).runs("punctual-lights"));
    input.draws[0].visible = false;
    EXPECT_FALSE(plan(input).runs("punctual-lights"));
}

TEST(Plan, UnlitDrawsAskForNoLight) {
    DrawView sign = ball();
    sign.features = bit(Feature::Unlit);
    sign.lit = false; // diffuse and glossy say yes: an unlit draw is not asked
    PlanInput input = scene({sign});
    input.lightCount = 1;
    const EffectPlan alone = plan(input);
    EXPECT_EQ(alone.prepare, lighting::PreparedParts{});
    for (const char* name : {"tent-mips", "irradiance", "punctual-lights"}) {
        EXPECT_EQ(effect(alone, name).decision, Decision::Skip) << name;
        EXPECT_NE(effect(alone, name).reason.find("unlit"), std::string::npos) << name;
    }
    EXPECT_EQ(alone.drawFeatures.at(0), bit(Feature::Unlit));
    // Beside a lit draw it still pays for nothing.
    input.draws.push_back(ball());
    const EffectPlan both = plan(input);
    EXPECT_TRUE(both.runs("tent-mips"));
    for (std::size_t i = 0; i < both.drawOrder.size(); ++i) {
        const bool lit = both.drawOrder[i] == 1;
        EXPECT_EQ(has(both.drawFeatures[i], Feature::Environment), lit);
        EXPECT_EQ(has(both.drawFeatures[i], Feature::PunctualLights), lit);
    }
}

TEST(Plan, JointsAndTargetsAreMadeReadyForWhatIsSeenAndHasChanged) {
    const auto decided = [](bool visible, bool changed) {
        DrawView draw = ball();
        draw.visible = visible;
        draw.features |= bit(Feature::Skinning);
        draw.morphBytes = 1000;
        draw.weightsChanged = changed;
        PlanInput input = scene({draw});
        input.jointsMoved = changed;
        input.jointBytes = 480;
        return plan(input);
    };
    const EffectPlan run = decided(true, true);
    EXPECT_TRUE(run.runs("skinning"));
    EXPECT_EQ(effect(run, "skinning").cost.uploadBytes, 480u);
    EXPECT_TRUE(run.runs("morphs"));
    EXPECT_EQ(effect(run, "morphs").cost.uploadBytes, 1000u);
    const EffectPlan still = decided(true, false);
    const EffectPlan unseen = decided(false, true);
    const EffectPlan without = plan(scene({ball()}));
    std::set<std::string> reasons;
    for (const char* name : {"skinning", "morphs"}) {
        for (const EffectPlan* skipped : {&still, &unseen}) {
            EXPECT_EQ(effect(*skipped, name).decision, Decision::Skip) << name;
            EXPECT_EQ(effect(*skipped, name).cost.uploadBytes, 0u) << name;
            reasons.insert(effect(*skipped, name).reason);
        }
        EXPECT_EQ(effect(without, name).decision, Decision::Skip) << name;
    }
    EXPECT_EQ(reasons.size(), 4u) << "each skip says why in its own words";
}

// The plan is pure: the same input gives the same plan, and every visible draw is drawn once.
RC_GTEST_PROP(PlanProperty, PureAndComplete, ()) {
    std::vector<DrawView> draws(*rc::gen::inRange<std::size_t>(0, 40));
    for (DrawView& draw : draws) {
        draw.features = *rc::gen::inRange<Features>(0, 1u << 20);
        draw.visible = *rc::gen::arbitrary<bool>();
        draw.blended = *rc::gen::arbitrary<bool>();
        draw.glossy = *rc::gen::arbitrary<bool>();
        draw.diffuse = *rc::gen::arbitrary<bool>();
        draw.distance = static_cast<float>(*rc::gen::inRange(-10, 10));
    }
    const PlanInput input = scene(draws);
    const EffectPlan first = plan(input);
    const EffectPlan second = plan(input);
    RC_ASSERT(first.drawOrder == second.drawOrder);
    RC_ASSERT(first.drawFeatures == second.drawFeatures);
    RC_ASSERT(first.prepare == second.prepare);
    std::vector<int> drawn(draws.size(), 0);
    for (std::size_t index : first.drawOrder) {
        ++drawn[index];
    }
    for (std::size_t i = 0; i < draws.size(); ++i) {
        RC_ASSERT(drawn[i] == (draws[i].visible ? 1 : 0));
    }
}

TEST(Plan, DrawsOfOneMeshAndMaterialAreOneCall) {
    std::vector<DrawView> draws(6, ball());
    for (std::size_t i = 0; i < draws.size(); ++i) {
        draws[i].geometry = i % 2;
        draws[i].material = 1;
    }
    draws[2].material = 2;
    draws[4].mirrored = true;
    draws[5].visible = false;
    const EffectPlan result = plan(scene(draws));
    // Materials before geometry, so that they are bound seldom; mirrored ones apart.
    EXPECT_EQ(result.drawOrder, (std::vector<std::size_t>{0, 4, 1, 3, 2}));
    std::vector<std::size_t> counts;
    std::uint64_t calls = 0;
    for (const Batch& batch : result.batches) {
        counts.push_back(batch.count);
    }
    for (const Effect& effect : result.effects) {
        calls += effect.effect == "draw" ? effect.cost.draws : 0;
    }
    EXPECT_EQ(counts, (std::vector<std::size_t>{1, 1, 2, 1}));
    EXPECT_TRUE(result.batches[1].mirrored);
    EXPECT_EQ(calls, result.batches.size());
}

TEST(Plan, CapturesShareTheBudget) {
    PlanInput input = scene({ball()});
    input.captures = {{"lobby", {true, false, true, false, false, true}, true},
                      {"attic", {false, false, false, false, false, false}, true},
                      {"cellar", {true, true, true, true, true, true}, false},
                      {"tower", {false, false, false, true, false, false}, false}};
    const auto facesOf = [&](int budget) {
        input.faceBudget = budget;
        std::vector<std::pair<std::size_t, int>> faces;
        for (const CaptureFace& face : plan(input).captureFaces) {
            faces.emplace_back(face.capture, face.face);
        }
        return faces;
    };
    using Faces = std::vector<std::pair<std::size_t, int>>;
    EXPECT_EQ(facesOf(0), Faces{});
    EXPECT_EQ(facesOf(-3), Faces{});
    EXPECT_EQ(facesOf(4), (Faces{{0, 0}, {0, 2}, {0, 5}, {2, 0}}));
    EXPECT_EQ(facesOf(100).size(), 10u);
    input.faceBudget = 4;
    const EffectPlan result = plan(input);
    std::vector<std::string> lines;
    std::uint64_t passes = 0;
    for (const Effect& one : result.effects) {
        if (one.effect == "probe-capture") {
            lines.push_back(one.subject + ": " + one.reason);
            passes += one.cost.passes;
        }
    }
    EXPECT_EQ(passes, 4u);
    EXPECT_EQ(lines, (std::vector<std::string>{
                         "lobby: 3 of 3 missing faces: it is asked for anew",
                         "attic: it shows what it has captured, and nothing asks for it anew",
                         "cellar: 1 of 6 missing faces: it shows nothing yet",
                         "tower: 1 face is missing, and the frame has no face left"}));
    EXPECT_NE(planText(result).find("Probe 'attic': skipped: it shows"), std::string::npos);
    EXPECT_NE(planText(result).find("Probe 'lobby': 3 of 3"), std::string::npos);
}

// A host draws faces after the plan is made: none of them is published before all are there.
TEST(Plan, FacesThatComeLaterArePublishedLater) {
    PlanInput input = scene({ball()});
    ProbeView probe;
    probe.subject = "hall";
    probe.influence = lighting::place({}, glm::mat4(1.0f), false);
    probe.stale.fill(true);
    input.probes = {probe};
    input.faceBudget = 6;
    EXPECT_TRUE(plan(input).runs("probe-compose"));
    input.facesComeLater = true;
    const EffectPlan asks = plan(input);
    EXPECT_EQ(asks.probeFaces.size(), 6u);
    EXPECT_TRUE(asks.probeWork.empty());
    input.probes[0].stale.fill(false);
    input.probes[0].drawn.fill(true);
    input.probes[0].awaited[3] = true;
    const EffectPlan waits = plan(input);
    EXPECT_TRUE(waits.probeFaces.empty());
    EXPECT_TRUE(waits.probeWork.empty());
    EXPECT_NE(planText(waits).find("waits for faces that were asked for"), std::string::npos);
    input.probes[0].awaited[3] = false;
    const EffectPlan publishes = plan(input);
    ASSERT_EQ(publishes.probeWork.size(), 1u);
    EXPECT_TRUE(publishes.probeWork[0].publish);
    EXPECT_FALSE(publishes.drawChoices.empty());
}

TEST(Plan, FormsAreFeaturesOfWhatUsesThem) {
    DrawView unlit = ball();
    unlit.lit = false;
    PlanInput input = scene({ball(), unlit});
    const Features forms = bit(Feature::SgLobes) | bit(Feature::SgFresnel);
    for (const int lamps : {0, 2}) {
        input.lightCount = lamps;
        input.lobes = lighting::LobeForm::Power;
        input.fresnel = lighting::FresnelForm::Schlick;
        EXPECT_EQ(plan(input).drawFeatures[0] & forms, 0u) << "nothing was asked for";
        input.lobes = lighting::LobeForm::Sg;
        EXPECT_EQ(plan(input).drawFeatures[0] & forms,
                  lamps > 0 ? bit(Feature::SgLobes) : Features{0});
        input.fresnel = lighting::FresnelForm::Sg;
        const EffectPlan both = plan(input);
        EXPECT_EQ(both.drawFeatures[0] & forms, lamps > 0 ? forms : bit(Feature::SgFresnel));
        EXPECT_EQ(both.drawFeatures[1] & forms, 0u) << "it takes no light";
    }
    EXPECT_EQ(featureNames(forms), (std::vector<std::string>{"sg-lobes", "sg-fresnel"}));
}

} // namespace
} // namespace lodestar::plan

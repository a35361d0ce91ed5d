// SPDX-License-Identifier: MIT
//
// Skies and suns: what of them a frame makes, reads and leaves out.
#include "plan/plan_inputs.h"

namespace lodestar::plan {
namespace {

RsrmLightView light(const char* name, int shadow) {
    RsrmLightView view;
    view.subject = name;
    view.texels = 100;
    view.uploadBytes = 800;
    view.shadow = shadow;
    return view;
}

/// Under a sky and a sun alone.
PlanInput underLights(std::vector<DrawView> draws) {
    PlanInput input = scene(std::move(draws));
    input.environment.present = false;
    input.rsrmLights = {light("sky", -1), light("sun", 0)};
    input.shadowTexels = 64;
    return input;
}

// Shaders know by a light's place what it is.
TEST(Plan, SunsComeBeforeSkiesThoseWithShadowsFirst) {
    PlanInput input = underLights({ball()});
    input.rsrmLights = {light("sky", -1), light("moon", -1), light("sun", 0), light("glow", -1)};
    input.rsrmLights[0].sky = input.rsrmLights[3].sky = true;
    const EffectPlan result = plan(input);
    std::vector<std::size_t> order;
    for (const LitLight& lit : result.rsrmLights) {
        order.push_back(lit.light);
    }
    EXPECT_EQ(order, (std::vector<std::size_t>{2, 1, 0, 3}));
    EXPECT_EQ(result.suns(), 2u);
    EXPECT_EQ(result.shadowedLights(), 1u);
}

TEST(Plan, LightsStandInForTheEnvironment) {
    const EffectPlan result = plan(underLights({ball()}));
    EXPECT_EQ(result.prepare, lighting::PreparedParts{});
    ASSERT_EQ(result.rsrmLights.size(), 2u);
    EXPECT_EQ(result.shadowedLights(), 1u);
    EXPECT_EQ(result.rsrmLights[0].light, 1u) << "lights with shadows come first";
    EXPECT_TRUE(result.rsrmLights[0].drawShadow);
    EXPECT_TRUE(result.rsrmLights[1].blend);
    EXPECT_EQ(result.rsrmLights[1].shadow, -1);
    EXPECT_EQ(result.casters, std::vector<std::size_t>{0});
    EXPECT_EQ(effect(result, "rsrm-blend").cost.uploadBytes, 800u);
    EXPECT_EQ(effect(result, "shadow-map").cost.texelsWritten, 64u);
    EXPECT_TRUE(has(result.drawFeatures[0], Feature::RsrmLights));
    EXPECT_TRUE(has(result.drawFeatures[0], Feature::Shadows));
    EXPECT_FALSE(has(result.drawFeatures[0], Feature::Environment));
}

// Of a sun lookups may be as sharp as (SUN-6) says: 2048 where the sharpest else is 443.
TEST(Plan, MirrorsAloneReadTheGradients) {
    PlanInput input = underLights({ball(), ball()});
    for (const double last : {443.2, 2048.5}) {
        input.rsrmLights[0].sky = input.rsrmLights[1].sky = last > 2048.0;
        input.draws[0].sharpest = last - 2.0;
        input.draws[1].sharpest = last + 2.0;
        EXPECT_FALSE(has(plan(input).drawFeatures[0], Feature::RsrmMirror)) << last;
        EXPECT_TRUE(has(plan(input).drawFeatures[1], Feature::RsrmMirror)) << last;
    }
    input.rsrmPublished = true;
    EXPECT_FALSE(has(plan(input).drawFeatures[1], Feature::RsrmMirror)) << "as published";
    input.rsrmLights.clear();
    EXPECT_FALSE(has(plan(input).drawFeatures[1], Feature::RsrmMirror));
}

TEST(Plan, OwnRowsAreAFeatureOfWhatReadsMaps) {
    DrawView unlit = ball();
    unlit.lit = false;
    DrawView sharp = ball();
    sharp.sharpest = 300.0;
    PlanInput input = underLights({sharp, unlit});
    EXPECT_FALSE(has(plan(input).drawFeatures[0], Feature::RsrmRows));
    input.rsrmRows = true;
    input.rsrmGreatestExponent = 200.0;
    const EffectPlan result = plan(input);
    EXPECT_TRUE(has(result.drawFeatures[0], Feature::RsrmRows));
    EXPECT_TRUE(has(result.drawFeatures[0], Feature::RsrmMirror)) << "beyond the last of them";
    EXPECT_FALSE(has(result.drawFeatures[1], Feature::RsrmRows)) << "it takes no light";
    EXPECT_EQ(featureNames(bit(Feature::RsrmRows)), std::vector<std::string>{"rsrm-rows"});
    input.rsrmLights.clear();
    EXPECT_FALSE(has(plan(input).drawFeatures[0], Feature::RsrmRows)) << "there are no maps";
}

TEST(Plan, ASunThatDoesNotShineCostsNothing) {
    PlanInput input = underLights({ball()});
    input.rsrmLights[1].shines = false;
    input.rsrmLights[0].sky = true;
    input.draws[0].sharpest = 1000.0; // beyond the last row in a sun's map, not in a sky's
    const EffectPlan result = plan(input);
    ASSERT_EQ(result.rsrmLights.size(), 1u);
    EXPECT_EQ(result.rsrmLights[0].light, 0u);
    EXPECT_FALSE(has(result.drawFeatures[0], Feature::RsrmMirror));
    EXPECT_FALSE(result.runs("shadow-map"));
    EXPECT_FALSE(has(result.drawFeatures[0], Feature::Shadows));
}

TEST(Plan, LightsThatHaveNotChangedAreKept) {
    PlanInput input = underLights({ball()});
    for (RsrmLightView& view : input.rsrmLights) {
        view.changed = view.shadowChanged = false;
    }
    const EffectPlan result = plan(input);
    EXPECT_FALSE(result.runs("rsrm-blend"));
    EXPECT_FALSE(result.runs("shadow-map"));
    EXPECT_EQ(result.rsrmLights.size(), 2u);
    EXPECT_EQ(result.rsrmLights[0].shadow, 0) << "it is drawn already, and read";
}

TEST(Plan, NothingReceivesWhereNothingIsLit) {
    DrawView unlit = ball();
    unlit.lit = false;
    unlit.features |= bit(Feature::Unlit);
    const EffectPlan result = plan(underLights({unlit}));
    EXPECT_FALSE(result.runs("rsrm-blend"));
    EXPECT_FALSE(result.runs("shadow-map"));
    EXPECT_TRUE(result.rsrmLights.empty());
}

} // namespace
} // namespace lodestar::plan

// SPDX-License-Identifier: MIT
//
// The freehand brush.
#include <cmath>

#include "model_support.h"

namespace lodestar::model {
namespace {

using lighting::LightKind;

Model flatSky() {
    return modelOf(LightKind::Sky, {{90, glm::dvec3(0.5), 0}, {-90, glm::dvec3(0.5), 0}});
}

Brush brushOf(double size, double softness, double strength, double value) {
    return {BrushMode::Paint, size, softness, strength, glm::dvec3(value)};
}

TEST(BrushStrokes, AHardOnePaintsABandWithSteps) {
    Model model = flatSky();
    did(model, BrushStroke{keyId(model), brushOf(10, 0, 1, 2), {20}});
    for (double at = -89; at <= 89; at += 0.5) {
        const bool inside = at > 15 && at < 25;
        const bool edge = at == 15 || at == 25;
        if (!edge) {
            EXPECT_DOUBLE_EQ(redAt(model, at), inside ? 2.0 : 0.5) << at;
        }
    }
    EXPECT_EQ(placesOf(model), (std::vector<double>{90, 25, 25, 15, 15, -90}));
}

TEST(BrushStrokes, ASoftOneFallsOffSmoothly) {
    Model model = flatSky();
    did(model, BrushStroke{keyId(model), brushOf(20, 1, 0.8, 2.5), {0}});
    EXPECT_NEAR(redAt(model, 0), 0.5 + 0.8 * 2.0, 1e-12) << "strength in the middle";
    double last = redAt(model, 0);
    for (double at = 0; at <= 10; at += 0.25) {
        const double t = at / 10;
        const double falloff = 1 - t * t * (3 - 2 * t);
        // Straight lines between five stops of a cubic: h^2/8 of its largest slope's change,
        // (1/4)^2 / 8 * 6 = 0.047 of the height.
        EXPECT_NEAR(redAt(model, at), 0.5 + 1.6 * falloff, 1.6 * 0.047) << at;
        EXPECT_NEAR(redAt(model, at), redAt(model, -at), 1e-12) << at;
        EXPECT_LE(redAt(model, at), last + 1e-12);
        last = redAt(model, at);
    }
    EXPECT_DOUBLE_EQ(redAt(model, 10.5), 0.5);
}

TEST(BrushStrokes, TheWayBetweenSamplesIsPainted) {
    Model few = flatSky();
    Model many = flatSky();
    did(few, BrushStroke{keyId(few), brushOf(6, 0.5, 0.7, 3), {-20, 35}});
    const MergeToken drag = many.newToken();
    BrushStroke stroke{keyId(many), brushOf(6, 0.5, 0.7, 3), {}};
    for (double at = -20; at <= 35; at += 0.25) {
        stroke.path.push_back(at);
        did(many, stroke, drag);
    }
    EXPECT_EQ(textOf(few), textOf(many)) << "however fast the hand was";
    Model back = flatSky();
    did(back, BrushStroke{keyId(back), brushOf(6, 0.5, 0.7, 3), {35, -20}});
    EXPECT_EQ(textOf(back), textOf(few)) << "either way";
    EXPECT_EQ(many.undoCount(), 1U);
    EXPECT_NEAR(redAt(few, 7.0), 0.5 + 0.7 * 2.5, 1e-12);
    EXPECT_TRUE(many.undo());
    EXPECT_EQ(textOf(many), textOf(flatSky()));
}

TEST(BrushStrokes, WhatLiesBesideTheStrokeStays) {
    Model model = sampleModel();
    std::vector<double> before;
    for (double at = -90; at <= 90; at += 0.5) {
        before.push_back(redAt(model, at));
    }
    did(model, BrushStroke{keyId(model), brushOf(8, 0.6, 1, 5), {-4, 14}});
    for (double at = -90; at <= 90; at += 0.5) {
        if (at < -8 || at > 18) {
            EXPECT_NEAR(redAt(model, at), before[static_cast<std::size_t>(2 * at + 180)], 1e-14)
                << at;
        }
    }
    EXPECT_DOUBLE_EQ(redAt(model, 5), 5.0);
    EXPECT_DOUBLE_EQ(redAt(model, 0), 5.0) << "the step inside is painted over";
}

TEST(BrushStrokes, AGlowAboutASunLeavesItsDisc) {
    Model model = modelOf(LightKind::Sun, {{0, glm::dvec3(1000), 0}, {0.27, glm::dvec3(1000), 0}});
    did(model, BrushStroke{keyId(model), brushOf(4, 1, 1, 3), {10}});
    EXPECT_DOUBLE_EQ(redAt(model, 0.2), 1000.0);
    EXPECT_DOUBLE_EQ(redAt(model, 0.3), 0.0);
    EXPECT_DOUBLE_EQ(redAt(model, 7.9), 0.0);
    EXPECT_NEAR(redAt(model, 10), 3.0, 1e-12);
    EXPECT_DOUBLE_EQ(redAt(model, 12.5), 0.0);
}

TEST(BrushStrokes, SmoothLevelsAPeakAndAStep) {
    Model model = modelOf(LightKind::Sky, {{90, glm::dvec3(0), 0},
                                           {10, glm::dvec3(0), 0},
                                           {10, glm::dvec3(1), 0},
                                           {-90, glm::dvec3(1), 0}});
    Brush smooth = brushOf(16, 0.5, 1, 0);
    smooth.mode = BrushMode::Smooth;
    did(model, BrushStroke{keyId(model), smooth, {10}});
    EXPECT_NEAR(redAt(model, 10 + 1e-6), redAt(model, 10 - 1e-6), 1e-4) << "no step any more";
    EXPECT_NEAR(redAt(model, 10), 0.5, 0.06) << "one place in nine on either side";
    double last = 0;
    for (double at = 30; at >= -20; at -= 0.25) {
        EXPECT_GE(redAt(model, at), last - 1e-12) << at;
        last = redAt(model, at);
    }
    EXPECT_DOUBLE_EQ(redAt(model, 25), 0.0);
    EXPECT_DOUBLE_EQ(redAt(model, -5), 1.0);
}

TEST(BrushStrokes, RubbingInOnePlaceDoesNotPileStops) {
    Model model = flatSky();
    for (int i = 0; i < 200; ++i) {
        ASSERT_TRUE(model.execute(
            BrushStroke{keyId(model), brushOf(12, 0.7, 0.2, i % 2), {5 + 0.01 * (i % 7)}}));
    }
    EXPECT_LT(stopsOf(model).size(), 120U);
}

TEST(BrushStrokes, ABrushThatIsNoneIsRefused) {
    Model model = flatSky();
    const Id key = keyId(model);
    const double inf = std::numeric_limits<double>::infinity();
    for (const Brush& brush :
         {brushOf(0, 0.5, 1, 1), brushOf(-1, 0.5, 1, 1), brushOf(inf, 0.5, 1, 1),
          brushOf(181, 0.5, 1, 1), brushOf(5, 1.5, 1, 1), brushOf(5, std::nan(""), 1, 1),
          brushOf(5, 0.5, 2, 1), brushOf(5, 0.5, 1, -1), brushOf(5, 0.5, 1, inf),
          brushOf(5e-324, 0.5, 1, 1)}) {
        EXPECT_FALSE(refusal(model, BrushStroke{key, brush, {0}}).empty());
    }
    refusal(model, BrushStroke{key, Brush{}, {}});
    refusal(model, BrushStroke{key, Brush{}, {0, std::nan("")}});
    const auto nothing = model.execute(BrushStroke{key, brushOf(5, 0.5, 0, 1), {0}});
    ASSERT_TRUE(nothing);
    EXPECT_FALSE(nothing->changed) << "without strength no stop is added";
}

} // namespace
} // namespace lodestar::model

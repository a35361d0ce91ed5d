// SPDX-License-Identifier: MIT
//
// Commands on stops, and the pure functions about gradients.
#include <algorithm>
#include <cmath>

#include "model/clipboard.h"
#include "model_support.h"

namespace lodestar::model {
namespace {

using lighting::GradientInterpolation;
using lighting::GradientStop;
using lighting::LightKind;

GradientStop grey(double at, double value, double ev = 0.0) {
    return {at, glm::dvec3(value), ev};
}

Model skyOf(const std::vector<GradientStop>& stops) {
    return modelOf(LightKind::Sky, stops);
}

std::vector<double> redsOf(const Model& model) {
    std::vector<double> reds;
    for (const document::Stop& stop : stopsOf(model)) {
        reds.push_back(lighting::radianceOf(stop.stop).r);
    }
    return reds;
}

TEST(Stops, AnAddedOneShinesAsBefore) {
    Model model = skyOf({grey(90, 4, 2), grey(0, 1), grey(0, 0.5), grey(-90, 0)});
    std::vector<double> before;
    for (double at = -90; at <= 90; at += 1) {
        before.push_back(redAt(model, at));
    }
    did(model, AddStop{keyId(model), 45.0});
    did(model, AddStop{keyId(model), -30.0});
    ASSERT_EQ(placesOf(model), (std::vector<double>{90, 45, 0, 0, -30, -90}));
    EXPECT_DOUBLE_EQ(stopsOf(model)[1].stop.ev, 4.0) << "8.5 needs 2^4, its colour lies in [0, 1]";
    for (double at = -90; at <= 90; at += 1) {
        // A handful of roundings of values up to 16.
        EXPECT_NEAR(redAt(model, at), before[static_cast<std::size_t>(at + 90)], 16 * 8e-16) << at;
    }
}

TEST(Stops, OneAddedBeyondASunLeavesTheDiscAsItIs) {
    Model model = modelOf(LightKind::Sun, {grey(0, 100), grey(0.27, 100)});
    did(model, AddStop{keyId(model), 10.0});
    EXPECT_EQ(placesOf(model), (std::vector<double>{0, 0.27, 0.27, 10}));
    EXPECT_DOUBLE_EQ(redAt(model, 0.2), 100.0);
    EXPECT_DOUBLE_EQ(redAt(model, 0.3), 0.0);
}

TEST(Stops, ThoseThatMeetKeepTheirSides) {
    Model model = skyOf({grey(90, 1), grey(40, 2), grey(10, 3), grey(-90, 4)});
    const Id upper = stopId(model, 1);
    const Id lower = stopId(model, 2);
    did(model, MoveStops{{{upper, 10.0}}});
    EXPECT_EQ(stopId(model, 1), upper);
    EXPECT_NEAR(redAt(model, 10.0 + 1e-9), 2.0, 1e-6);
    EXPECT_DOUBLE_EQ(redAt(model, 10.0), 3.0) << "a step, the lower side counts";
    did(model, MoveStops{{{lower, 50.0}, {upper, -120.0}}});
    EXPECT_EQ(placesOf(model), (std::vector<double>{90, 50, -90, -90})) << "brought into range";
    EXPECT_EQ(stopId(model, 2), upper);
}

TEST(Stops, ValuesOfManyAreSetAtOnce) {
    Model model = sampleModel();
    did(model, SetStops{{stopId(model, 0), stopId(model, 2), stopId(model, 1, 0, 1)},
                        {},
                        glm::dvec3(0.25, 0.5, 1),
                        2.0});
    EXPECT_EQ(stopsOf(model)[0].stop.color, glm::dvec3(0.25, 0.5, 1));
    EXPECT_EQ(stopsOf(model, 0, 1)[1].stop.ev, 2.0);
    EXPECT_EQ(stopsOf(model)[0].unknown, "{\"pin\":7}") << "unknown members stay";
    did(model, SetStops{{stopId(model, 3)}, 33.0, {}, {}});
    EXPECT_EQ(placesOf(model), (std::vector<double>{90, 33, 20, 0, -90}));
}

TEST(Stops, TheLastTwoStay) {
    Model model = skyOf({grey(90, 1), grey(0, 2), grey(-90, 3)});
    EXPECT_EQ(refusal(model, DeleteStops{{stopId(model, 0), stopId(model, 1)}}),
              "a gradient keeps its last two stops");
    did(model, DeleteStops{{stopId(model, 1)}});
    EXPECT_EQ(redsOf(model), (std::vector<double>{1, 3}));
    refusal(model, DeleteStops{{stopId(model, 0)}});
}

TEST(Stops, ReverseTurnsTheGradientAround) {
    Model model = skyOf({grey(80, 1), grey(20, 2), grey(20, 3), grey(-40, 4)});
    did(model, ReverseStops{keyId(model)});
    EXPECT_EQ(placesOf(model), (std::vector<double>{80, 20, 20, -40}));
    EXPECT_EQ(redsOf(model), (std::vector<double>{4, 3, 2, 1}));
    did(model, ReverseStops{keyId(model)});
    EXPECT_EQ(redsOf(model), (std::vector<double>{1, 2, 3, 4}));
}

TEST(Stops, MirrorMakesASkyOfItsUpperHalf) {
    Model model = skyOf({grey(90, 1), grey(30, 4), grey(-30, 2), grey(-90, 8)});
    did(model, MirrorStops{keyId(model)});
    EXPECT_EQ(placesOf(model), (std::vector<double>{90, 30, 0, -30, -90}));
    for (double at = 0; at <= 90; at += 0.5) {
        EXPECT_NEAR(redAt(model, at), redAt(model, -at), 1e-14) << at;
    }
    EXPECT_NEAR(redAt(model, 0), 3.0, 1e-12) << "as the upper half came down to the horizon";
    Model stairs = skyOf({grey(90, 1), grey(30, 4), grey(-30, 2)});
    did(stairs, SetInterpolation{keyId(stairs), GradientInterpolation::Constant});
    did(stairs, MirrorStops{keyId(stairs)});
    for (double at = 1; at < 90; at += 7) { // not at the steps themselves
        EXPECT_DOUBLE_EQ(redAt(stairs, at), redAt(stairs, -at)) << at;
    }
    Model below = skyOf({grey(-10, 1), grey(-90, 2)});
    refusal(below, MirrorStops{keyId(below)});
}

TEST(Stops, MirrorOfASunIsAboutItsMiddle) {
    Model model = modelOf(LightKind::Sun, {grey(0, 2), grey(4, 6), grey(20, 1)});
    did(model, MirrorStops{keyId(model)});
    EXPECT_EQ(placesOf(model), (std::vector<double>{0, 4, 10, 16, 20}));
    for (double at = 0; at < 10; at += 0.5) {
        EXPECT_NEAR(redAt(model, at), redAt(model, 20 - at), 1e-13) << at;
    }
}

TEST(Stops, DistributeSpacesThemEvenly) {
    Model model = skyOf({grey(90, 1), grey(80, 2), grey(80, 3), grey(-20, 4), grey(-90, 5)});
    did(model, DistributeStops{keyId(model)});
    EXPECT_EQ(placesOf(model), (std::vector<double>{90, 45, 0, -45, -90}));
    EXPECT_EQ(redsOf(model), (std::vector<double>{1, 2, 3, 4, 5}));
}

TEST(Stops, DistributedFromTheLeftEachHoldsAsLong) {
    Model model = skyOf({grey(90, 1), grey(80, 2), grey(-20, 3), grey(-90, 4)});
    did(model, DistributeStops{keyId(model), true});
    EXPECT_EQ(placesOf(model), (std::vector<double>{90, 45, 0, -45}));
    EXPECT_EQ(redsOf(model), (std::vector<double>{1, 2, 3, 4}));
    ASSERT_TRUE(model.undo());
    EXPECT_EQ(placesOf(model), (std::vector<double>{90, 80, -20, -90}));
}

TEST(Stops, SimplifyFindsTheCornersOfAPolyline) {
    std::vector<GradientStop> stops;
    for (int i = 0; i <= 9000; ++i) {
        const double at = 90.0 - 0.02 * i;
        const double value = at > 30 ? 1 + (at - 30) / 60 : at >= 0 ? 1 - (30 - at) / 60 : 0.1;
        stops.push_back(grey(at, value));
    }
    Model model = skyOf(stops);
    const Id last = stopId(model, 9000);
    did(model, SimplifyStops{keyId(model), 5});
    ASSERT_EQ(stopsOf(model).size(), 5U);
    EXPECT_EQ(stopId(model, 4), last);
    for (double at = -90; at <= 90; at += 0.5) {
        const double value = at > 30 ? 1 + (at - 30) / 60 : at >= 0 ? 1 - (30 - at) / 60 : 0.1;
        EXPECT_NEAR(redAt(model, at), value, 1e-9) << at; // five corners hold it all
    }
    refusal(model, SimplifyStops{keyId(model), 1});
}

TEST(Stops, TenThousandAreWorkedOnInReasonableTime) {
    std::vector<GradientStop> stops;
    stops.reserve(10000);
    for (int i = 0; i < 10000; ++i) {
        stops.push_back(grey(90.0 - 0.018 * i, 0.5 + 0.5 * std::sin(0.01 * i)));
    }
    Model model = skyOf(stops);
    const std::string start = textOf(model);
    std::vector<StopMove> moves;
    std::vector<Id> all;
    moves.reserve(10000);
    all.reserve(10000);
    for (std::size_t i = 0; i < 10000; ++i) {
        all.push_back(stopId(model, i));
        moves.push_back({all.back(), -90.0 + 0.018 * static_cast<double>(i)});
    }
    const Id key = keyId(model);
    const MergeToken drag = model.newToken();
    constexpr int kFrames = 20;
    for (int i = 0; i < kFrames; ++i) { // a drag of one stop among them
        did(model, MoveStops{{{all[5000], 0.5 + 0.1 * i}}}, drag);
    }
    did(model, BrushStroke{key, Brush{}, {10.0, 30.0}});
    did(model, MoveStops{moves});
    did(model, SetStops{all, {}, {}, 1.0});
    did(model, ReverseStops{key});
    did(model, SimplifyStops{key, 64});
    EXPECT_EQ(stopsOf(model).size(), 64U);
    while (model.undo()) {
    }
    EXPECT_EQ(textOf(model), start);
}

TEST(Stops, AsManyAsThereMayBeAreSelectedAndCopied) {
    std::vector<GradientStop> stops;
    stops.reserve(kMostStops);
    for (std::size_t i = 0; i < kMostStops; ++i) {
        stops.push_back(grey(90.0 - 180.0 * static_cast<double>(i) / kMostStops, 0.5));
    }
    Model model = skyOf(stops);
    std::vector<Id> all = model.ids().lights[0].keys[0].stops;
    std::reverse(all.begin(), all.end());
    model.select({Id::None, Id::None, all, {}, {}});
    const auto copied = copyStops(model, all);
    EXPECT_EQ(model.selection().stops, all) << "in the order selected";
    ASSERT_TRUE(copied);
    all.push_back(all.front());
    model.select({Id::None, Id::None, all, {}, {}});
    EXPECT_EQ(model.selection().stops.size(), kMostStops) << "each once";
    EXPECT_FALSE(refusal(model, AddStop{keyId(model), 3.0}).empty());
    const document::Stop one{grey(3.0, 0.5), {}};
    EXPECT_FALSE(refusal(model, InsertStops{keyId(model), {one}}).empty());
    did(model, DeleteStops{{stopId(model, 7)}});
    EXPECT_FALSE(refusal(model, InsertStops{keyId(model), {one, one}}).empty());
    did(model, InsertStops{keyId(model), {one}});
    EXPECT_EQ(stopsOf(model).size(), kMostStops);
}

TEST(Stops, AGradientThatRunsTheOtherWayKeepsItsLook) {
    for (const auto interpolation :
         {GradientInterpolation::Linear, GradientInterpolation::Constant}) {
        Model model = skyOf({grey(-90, 1), grey(-10, 2), grey(40, 3), grey(90, 4)});
        did(model, SetInterpolation{keyId(model), GradientInterpolation::Smooth});
        EXPECT_EQ(placesOf(model), (std::vector<double>{90, 40, -10, -90})) << "put in order";
        EXPECT_TRUE(model.undo());
        EXPECT_EQ(placesOf(model), (std::vector<double>{-90, -10, 40, 90})) << "byte for byte";
        document::Document document = model.document();
        document.lights[0].keys[0].gradient.interpolation = interpolation;
        model = Model(document);
        std::vector<double> before;
        for (double at = -89.5; at <= 90; at += 1) {
            before.push_back(redAt(model, at));
        }
        did(model, SetSpace{keyId(model), lighting::GradientSpace::Oklab});
        did(model, SetSpace{keyId(model), lighting::GradientSpace::Linear});
        for (double at = -89.5; at <= 90; at += 1) {
            EXPECT_DOUBLE_EQ(redAt(model, at), before[static_cast<std::size_t>(at + 89.5)]) << at;
        }
    }
}

TEST(Stops, WhatLightingMendsDoesNotHinderACommand) {
    Model model = skyOf({grey(90, -3), grey(10, 1, 200), grey(-90, 0.5)});
    did(model, MoveStops{{{stopId(model, 0), 60.0}}});
    EXPECT_EQ(redsOf(model), (std::vector<double>{0, 1e9, 0.5}));
    EXPECT_EQ(stopsOf(model)[1].stop.ev, 0.0);
}

TEST(Ramp, PicksRadianceAndMakesStopsOfIt) {
    const Model model = skyOf({grey(90, 4, 1), grey(-90, 0)});
    EXPECT_DOUBLE_EQ(redAt(model, 0), 4.0);
    document::Gradient none;
    const double at = 3.0;
    EXPECT_EQ(radianceAt(none, LightKind::Sky, {&at, 1}).front(), glm::dvec3(0.0));
    for (const double value : {0.0, 1e-30, 0.3, 1.0, 1.5, 1024.0, 1e9}) {
        const GradientStop stop = stopOf(5.0, glm::dvec3(value, 0.5 * value, 0), 0.0);
        EXPECT_EQ(lighting::radianceOf(stop), glm::dvec3(value, 0.5 * value, 0)) << value;
        EXPECT_LE(stop.color.r, 1.0);
        EXPECT_TRUE(value <= 1.0 ? stop.ev == 0.0 : stop.color.r > 0.5) << value;
    }
    EXPECT_EQ(stopOf(5.0, glm::dvec3(0.5), 2.0).ev, 2.0) << "kept where it does";
}

// Oklab and back makes a rounding more of 1e9, and so does an ev that is no whole number.
TEST(Ramp, MakesNoStopsBeyondTheMost) {
    for (const double radiance : {1e9, std::nextafter(1e9, 2e9), 2e9}) {
        for (int i = 0; i <= 1000; ++i) {
            const GradientStop stop = stopOf(5.0, glm::dvec3(0, radiance, 1), 29.5 + 0.002 * i);
            const double shines = stop.color.g * std::exp2(stop.ev);
            ASSERT_LE(shines, 1e9) << radiance << ", " << i;
            ASSERT_GE(shines, 1e9 * (1.0 - 3.0 * 0x1p-52))
                << "two powers by a unit, two products by half";
        }
    }
}

TEST(Ramp, SnapsToTheNearestWithinReach) {
    const std::vector<double> others = {12.0, 31.0};
    EXPECT_EQ(snapped(12.7, {0.0, true, false, 1.0}, others), 12.0);
    EXPECT_EQ(snapped(13.7, {0.0, true, false, 1.0}, others), 13.7);
    EXPECT_EQ(snapped(-0.4, {5.0, true, true, 1.0}, others), 0.0);
    EXPECT_EQ(snapped(-0.4, {0.0, false, true, 1.0}, others), 0.0) << "the horizon alone";
    EXPECT_EQ(snapped(-0.4, {0.0, true, false, 1.0}, others), -0.4) << "no horizon";
    EXPECT_EQ(snapped(1.0, {0.0, false, true, 1.0}, others), 0.0) << "as far as it reaches";
    EXPECT_EQ(snapped(29.2, {5.0, true, false, 1.0}, others), 30.0);
    EXPECT_EQ(snapped(29.2, {5.0, false, false, 0.5}, others), 29.2);
    EXPECT_EQ(snapped(30.5, {5.0, true, false, 1.0}, others), 31.0) << "of two the stop";
    EXPECT_EQ(snapped(-17.4, {2.5, false, false, 2.0}, {}), -17.5);
    EXPECT_TRUE(std::isnan(snapped(std::nan(""), {2.5, true, true, 2.0}, others)));
}

// The place is one where the mean of it and itself rounds to its neighbour.
TEST(DistributeStopsCommand, KeepsStopsOfOnePlaceWhereTheyAre) {
    const double at = 89.19999998807907;
    Model model = modelOf(lighting::LightKind::Sky, {{at, {1, 1, 1}, 0},
                                                     {at, {0, 1, 1}, 0},
                                                     {at, {1, 0, 1}, 0},
                                                     {at, {1, 1, 0}, 0},
                                                     {at, {0, 0, 1}, 0},
                                                     {at, {0, 1, 0}, 0}});
    ASSERT_TRUE(model.execute(DistributeStops{keyId(model)}));
    EXPECT_EQ(placesOf(model), std::vector<double>(6, at));
}

} // namespace
} // namespace lodestar::model

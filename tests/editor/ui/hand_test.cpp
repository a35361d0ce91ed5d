// SPDX-License-Identifier: MIT
//
// What the hand does on a panel, without a picture: fields act on all that is selected, a fast
// stroke paints the way between.
#include <gtest/gtest.h>
#include <imgui.h>

#include "model/presets.h"
#include "model/ramp.h"
#include "ui/session.h"
#include "ui/workspace.h"

namespace lodestar::ui {
namespace {

class Hand : public ::testing::Test {
protected:
    Hand() {
        document::Document document;
        document.lights = {model::builtInPresets().front().lights.front()};
        document.lights[0].keys[0].gradient.space = lighting::GradientSpace::Linear;
        model_.reset(document);
        frame();
        frame();
    }

    void frame() {
        session_.frame(1280, 800, 1.0f, 1.0 / 60.0,
                       [&] { (void)workspace_.draw(model_, around_); });
        EXPECT_EQ(session_.failure(), "");
    }
    void give(const Input& input) {
        session_.push(input);
        frame();
    }
    /// @param x share of the thing's width
    void moveTo(const char* mark, float x = 0.5f) {
        const Mark& place = workspace_.marks().at(mark);
        give(MotionInput{place.low.x + x * (place.high.x - place.low.x), place.center().y});
    }
    void typeInto(const char* mark, const std::string& text) {
        moveTo(mark);
        give(KeyInput{Key::Control, true, false, true, false});
        give(ButtonInput{0, true});
        give(ButtonInput{0, false});
        give(KeyInput{Key::Control, false, false, false, false});
        for (const char letter : text) {
            give(TextInput{static_cast<char32_t>(letter)});
        }
        give(KeyInput{Key::Enter, true, false, false, false});
        give(KeyInput{Key::Enter, false, false, false, false});
    }
    [[nodiscard]] const document::Gradient& gradient() const {
        return model_.document().lights[0].keys[0].gradient;
    }

    model::Model model_;
    Surroundings around_;
    Workspace workspace_;
    Session session_{Session::Drawing::None};
};

TEST_F(Hand, AFieldActsOnAllStopsThatAreSelected) {
    model::Selection selection;
    selection.stops = model_.ids().lights[0].keys[0].stops;
    ASSERT_GE(selection.stops.size(), 2u);
    model_.select(selection);
    frame();
    typeInto("stop ev", "1.25");
    for (const document::Stop& stop : gradient().stops) {
        EXPECT_EQ(stop.stop.ev, 1.25);
    }
    EXPECT_EQ(model_.undoCount(), 1u);
}

TEST_F(Hand, AFastStrokePaintsTheWayBetween) {
    ViewState& view = workspace_.view();
    view.brush = true;
    view.brushSettings = {model::BrushMode::Paint, 4.0, 0.5, 1.0, glm::dvec3(7.0)};
    moveTo("ramp", 0.25f);
    give(ButtonInput{0, true});
    moveTo("ramp", 0.75f);
    give(ButtonInput{0, false});
    EXPECT_EQ(model_.undoCount(), 1u);
    const auto kind = lighting::LightKind::Sky;
    for (const double place : {0.25, 0.4, 0.5, 0.6, 0.75}) {
        const double at = atOf(place, kind);
        EXPECT_NEAR(model::radianceAt(gradient(), kind, {&at, 1}).front().r, 7.0, 1e-9) << at;
    }
    const double beside = atOf(0.15, kind);
    EXPECT_LT(model::radianceAt(gradient(), kind, {&beside, 1}).front().r, 6.0);
}

TEST_F(Hand, ADragThatHoldsNothingDeletesNothing) {
    moveTo("ramp", 0.8f);
    const Mark& ramp = workspace_.marks().at("ramp");
    const float x = ramp.low.x + 0.8f * (ramp.high.x - ramp.low.x);
    const float below = ramp.high.y + 8.0f; // among the handles, where there is none
    give(MotionInput{x, below});
    give(ButtonInput{0, true});
    give(MotionInput{x, below + 60.0f});
    give(MotionInput{x, below + 200.0f});
    give(ButtonInput{0, false});
    frame();
    EXPECT_EQ(model_.undoCount(), 0u);
    EXPECT_TRUE(workspace_.log().empty()) << workspace_.log().back().text;
}

TEST_F(Hand, EscapeCancelsADrag) {
    const document::Document before = model_.document();
    const auto escape = [&] {
        give(KeyInput{Key::Escape, true, false, false, false});
        give(KeyInput{Key::Escape, false, false, false, false});
    };
    for (const float away : {0.0f, 200.0f}) { // along the strip, and off it to be deleted
        SCOPED_TRACE(away);
        const ImVec2 handle = workspace_.marks().at("stop 1").center();
        give(MotionInput{handle.x, handle.y});
        give(ButtonInput{0, true});
        give(MotionInput{handle.x + 20.0f, handle.y});
        give(MotionInput{handle.x + 40.0f, handle.y + away});
        EXPECT_FALSE(model_.document() == before);
        escape();
        EXPECT_TRUE(model_.document() == before);
        give(MotionInput{handle.x + 60.0f, handle.y});
        give(ButtonInput{0, false});
        EXPECT_TRUE(model_.document() == before) << "the drag goes on after it was cancelled";
        EXPECT_EQ(model_.undoCount(), 0u);
        EXPECT_EQ(model_.redoCount(), 0u);
    }
    moveTo("tint");
    give(ButtonInput{0, true});
    moveTo("tint", 0.7f);
    EXPECT_EQ(model_.undoCount(), 1u);
    escape();
    give(ButtonInput{0, false});
    EXPECT_TRUE(model_.document() == before) << "a number's drag";
}

TEST_F(Hand, EscapeTakesBackNoStepThatWasDoneBefore) {
    const ImVec2 handle = workspace_.marks().at("stop 1").center();
    const float there = handle.x + 30.0f;
    give(MotionInput{handle.x, handle.y});
    give(ButtonInput{0, true});
    give(MotionInput{handle.x + 15.0f, handle.y});
    give(MotionInput{there, handle.y});
    give(ButtonInput{0, false});
    const document::Document moved = model_.document();
    give(ButtonInput{0, true});
    give(MotionInput{there + 20.0f, handle.y});
    EXPECT_EQ(model_.undoCount(), 2u);
    give(MotionInput{there, handle.y}); // where it began: no step
    EXPECT_EQ(model_.undoCount(), 1u);
    give(KeyInput{Key::Escape, true, false, false, false});
    give(ButtonInput{0, false});
    EXPECT_EQ(model_.undoCount(), 1u);
    EXPECT_TRUE(model_.document() == moved);
}

TEST_F(Hand, WhatADragSaysOfItselfMovesNothing) {
    const ImVec2 handle = workspace_.marks().at("stop 1").center();
    give(MotionInput{handle.x, handle.y});
    give(ButtonInput{0, true});
    give(MotionInput{handle.x + 20.0f, handle.y});
    const float before = workspace_.marks().at("Reverse").low.y;
    give(MotionInput{handle.x + 20.0f, handle.y + 200.0f});
    frame();
    EXPECT_FALSE(workspace_.marks().contains("Brush")) << "nothing is said";
    EXPECT_EQ(workspace_.marks().at("Reverse").low.y, before);
    give(ButtonInput{0, false});
}

TEST_F(Hand, ArrowsMoveAndChooseTheKeysOfTheDay) {
    document::Document document = model_.document();
    document.lights[0].keys.resize(1);
    document.lights[0].keys[0].hour = 6.0;
    document.lights[0].keys.push_back(document.lights[0].keys[0]);
    document.lights[0].keys[1].hour = 18.0;
    model_.reset(document);
    frame();
    const auto hour = [&](std::size_t key) { return model_.document().lights[0].keys[key].hour; };
    const auto stroke = [&](Key key, bool shift, bool control) {
        give(KeyInput{key, true, shift, control, false});
        give(KeyInput{key, false, false, false, false});
    };
    const ImVec2 key = workspace_.marks().at("key 0").center();
    give(MotionInput{key.x, key.y});
    give(ButtonInput{0, true});
    give(ButtonInput{0, false});
    stroke(Key::Right, false, false);
    EXPECT_EQ(hour(0), 6.25);
    EXPECT_EQ(workspace_.view().hour, 6.25);
    stroke(Key::Left, true, false);
    EXPECT_EQ(hour(0), 5.25);
    stroke(Key::Right, false, true);
    EXPECT_EQ(workspace_.view().hour, 18.0);
    EXPECT_EQ(model_.selection().key, model_.ids().lights[0].keys[1].id);
    stroke(Key::Right, false, false);
    EXPECT_EQ(hour(1), 18.25);
    EXPECT_EQ(hour(0), 5.25);
    stroke(Key::Right, false, true);
    EXPECT_EQ(workspace_.view().hour, 5.25) << "after the last the first";
    EXPECT_EQ(model_.undoCount(), 3u);
}

} // namespace
} // namespace lodestar::ui

// SPDX-License-Identifier: MIT
//
// The gradient's strip as gradient editors are expected to behave, and what is typed into it.
#include <cctype>
#include <cmath>

#include "editor/ui/editor_fixture.h"
#include "model/ramp.h"

namespace lodestar::testing {
namespace {

using platform::Key;

class StripTest : public EditorTest {
protected:
    void SetUp() override {
        EditorTest::SetUp();
        if (!IsSkipped() && !HasFatalFailure()) {
            click(mark("key 0").center());
        }
    }
    [[nodiscard]] const std::vector<document::Stop>& stops() {
        return light(0).keys.front().gradient.stops;
    }
    [[nodiscard]] double at(model::Id stop) { return model().stop(stop)->stop.at; }
    [[nodiscard]] model::Id selected() { return model().selection().stops.front(); }
    void modifier(Key key, bool down, platform::Modifiers modifiers) {
        send(platform::KeyEvent{key, down, false, down ? modifiers : platform::Modifiers{}});
        settle();
    }
    /// Drags with keys that are held once the drag has begun.
    void dragHeld(const ImVec2& from, const ImVec2& to,
                  const std::vector<std::pair<Key, platform::Modifiers>>& keys) {
        moveTo(from);
        button(true);
        for (const auto& [key, modifiers] : keys) {
            modifier(key, true, modifiers);
        }
        moveTo({0.5f * (from.x + to.x), to.y});
        moveTo(to);
        button(false);
        for (const auto& [key, modifiers] : keys) {
            modifier(key, false, modifiers);
        }
    }
    [[nodiscard]] ImVec2 handle(double degrees) const {
        return {onRamp(static_cast<float>(ui::placeOf(degrees, lighting::LightKind::Sky))).x,
                onRamp(0.0f, 1.25f).y};
    }
};

TEST_F(StripTest, ADoubleClickAddsOneStop) {
    const std::size_t before = stops().size();
    moveTo(onRamp(0.3f));
    button(true);
    button(false);
    button(true);
    button(false);
    EXPECT_EQ(stops().size(), before + 1);
}

TEST_F(StripTest, AClickAndItsDragAreOneStep) {
    const std::size_t before = stops().size();
    const std::size_t steps = model().undoCount();
    drag(onRamp(0.3f), onRamp(0.36f));
    EXPECT_EQ(model().undoCount(), steps + 1);
    const double place = at(selected());
    EXPECT_NEAR(ui::placeOf(place, lighting::LightKind::Sky), 0.36, 0.01);
    const std::string with = document::writeDocument(model().document());
    control(Key::Z);
    EXPECT_EQ(stops().size(), before);
    control(Key::Y);
    EXPECT_EQ(document::writeDocument(model().document()), with);
    moveTo(onRamp(0.6f));
    button(true);
    moveTo(onRamp(0.65f));
    EXPECT_EQ(stops().size(), before + 2);
    press(Key::Escape);
    button(false);
    EXPECT_EQ(document::writeDocument(model().document()), with)
        << "the stop is gone with its drag";
    EXPECT_EQ(model().undoCount(), steps + 1);
}

TEST_F(StripTest, ArrowsMoveTheSelectedStops) {
    click(onRamp(0.3f));
    const model::Id stop = selected();
    const double start = at(stop);
    press(Key::Right);
    EXPECT_DOUBLE_EQ(at(stop), start - 1.0);
    press(Key::Left);
    press(Key::Left);
    EXPECT_DOUBLE_EQ(at(stop), start + 1.0);
    press(Key::Right, {true, false, false});
    EXPECT_DOUBLE_EQ(at(stop), start - 9.0);
    ASSERT_EQ(model().selection().stops.size(), 1u);
    for (int i = 0; i < 12; ++i) {
        press(Key::Left, {true, false, false});
    }
    EXPECT_DOUBLE_EQ(at(stop), 90.0) << "held within the strip";
}

TEST_F(StripTest, RightAndMiddleClicksDeleteAStop) {
    const std::size_t before = stops().size();
    for (const auto which : {platform::PointerButton::Right, platform::PointerButton::Middle}) {
        click(onRamp(0.22f));
        ASSERT_EQ(stops().size(), before + 1);
        moveTo(handle(at(selected())));
        button(true, which);
        button(false, which);
        EXPECT_EQ(stops().size(), before);
    }
}

TEST_F(StripTest, CtrlAndShiftSnap) {
    click(onRamp(0.25f));
    const model::Id stop = selected();
    const platform::Modifiers controlled{false, true, false};
    const platform::Modifiers shifted{true, false, false};
    const platform::Modifiers both{true, true, false};
    dragHeld(handle(at(stop)), handle(33.4), {{Key::Control, controlled}});
    EXPECT_DOUBLE_EQ(at(stop), 35.0);
    dragHeld(handle(at(stop)), handle(21.6), {{Key::Shift, shifted}, {Key::Control, both}});
    EXPECT_NEAR(at(stop), std::round(at(stop)), 1e-9);
    EXPECT_NEAR(at(stop), 21.6, 1.1);
    dragHeld(handle(at(stop)), handle(2.0), {{Key::Shift, shifted}});
    const double there = at(stop);
    const bool onOther = std::any_of(stops().begin(), stops().end(),
                                     [&](const document::Stop& s) { return s.stop.at == there; });
    EXPECT_TRUE(there == 0.0 || onOther);
}

TEST_F(StripTest, AColourIsDroppedOnTheStripAndOnAHandle) {
    click(onRamp(0.25f));
    const model::Id first = selected();
    typeInto("stop ev", "0");
    ASSERT_TRUE(
        model().execute(model::SetStops{{first}, {}, glm::dvec3(0.25, 0.5, 0.75), 0.0}).ok());
    settle();
    const std::size_t before = stops().size();
    const ui::Mark field = mark("stop color");
    // The swatch is left of the channels, at the field's height.
    const ui::Mark ramp = mark("ramp");
    const ImVec2 swatch(ramp.low.x + 7.2f * 15.0f + 12.0f, field.center().y);
    drag(swatch, onRamp(0.6f));
    ASSERT_EQ(stops().size(), before + 1) << "dropped on the strip";
    const document::Stop* dropped = model().stop(selected());
    EXPECT_EQ(dropped->stop.color, glm::dvec3(0.25, 0.5, 0.75));
    EXPECT_NEAR(dropped->stop.at, -18.0, 1.0);
    keep("dropped");
    const model::Id second = selected();
    ASSERT_TRUE(
        model().execute(model::SetStops{{second}, {}, glm::dvec3(1.0, 0.0, 0.5), 0.0}).ok());
    settle();
    drag(swatch, handle(at(first)));
    EXPECT_EQ(stops().size(), before + 1) << "dropped on a handle";
    EXPECT_EQ(model().stop(first)->stop.color, glm::dvec3(1.0, 0.0, 0.5));
}

TEST_F(StripTest, AColourOfTextIsPastedIntoTheSelectedStops) {
    click(onRamp(0.25f));
    const model::Id stop = selected();
    setClipboard("#ff8000\n");
    control(Key::V);
    const glm::dvec3 color = lighting::radianceOf(model().stop(stop)->stop);
    // IEC 61966-2-1: 128/255 is 0.2158605 linear; 1e-6 is above floats' rounding.
    EXPECT_NEAR(color.r, 1.0, 1e-6);
    EXPECT_NEAR(color.g, 0.2158605, 1e-6);
    EXPECT_EQ(color.b, 0.0);
    const std::string before = document::writeDocument(model().document());
    for (const char* text : {"#ff80", "#gg8000", "ff8000", "#-1-1-1", ""}) {
        setClipboard(text);
        control(Key::V);
        EXPECT_EQ(document::writeDocument(model().document()), before) << text;
    }
}

TEST_F(StripTest, ResetGivesANewLightsGradient) {
    click(mark("Reset").center());
    EXPECT_EQ(stops().size(), 2u);
    EXPECT_EQ(model().undoCount(), 1u);
}

TEST_F(StripTest, WhateverIsTypedTheDocumentIsSound) {
    click(onRamp(0.25f));
    for (const char* field : {"stop at", "stop ev", "stop color"}) {
        for (const char* typed :
             {"inf", "-inf", "nan", "-1", "1e-310", "-0", "1e400", "", "--", "0x"}) {
            SCOPED_TRACE(std::string(field) + " '" + typed + "'");
            typeInto(field, typed);
            core::Tally repaired;
            const std::string text = document::writeDocument(model().document());
            const auto again = document::parseDocument(text, repaired);
            ASSERT_TRUE(again.ok()) << field << " " << typed << ": " << again.error().message();
            EXPECT_EQ(document::writeDocument(*again), text) << field << " " << typed;
            EXPECT_TRUE(repaired.counts().empty()) << field << " " << typed;
        }
    }
}

TEST_F(StripTest, TenThousandStopsAndAWindowOfOnePixel) {
    document::Gradient many;
    for (int i = 0; i < 10000; ++i) {
        many.stops.push_back({{90.0 - 0.018 * i, glm::dvec3(0.5 + 0.00005 * i), 0.0}, {}});
    }
    const model::Id key = model().ids().lights[0].keys[0].id;
    ASSERT_TRUE(model().execute(model::SetGradient{key, many}).ok());
    settle();
    EXPECT_EQ(stops().size(), 10000u);
    // One handle for each pixel, of all of which the strip is the width.
    frame();
    const auto& marks = editor_->workspace().marks();
    const auto handles = std::count_if(marks.begin(), marks.end(), [](const auto& named) {
        return named.first.starts_with("stop ") &&
               std::isdigit(static_cast<unsigned char>(named.first[5])) != 0;
    });
    const auto pixels = std::lround(mark("ramp").high.x - mark("ramp").low.x);
    EXPECT_GE(handles, pixels - 1);
    EXPECT_LE(handles, pixels + 1);
    drag(onRamp(0.2f), onRamp(0.5f));
    drag(onRamp(0.2f), onRamp(0.2f)); // of no width
    control(Key::A);
    press(Key::Right);
    EXPECT_GE(stops().size(), 10000u);
    const std::string text = document::writeDocument(model().document());
    auto tiny = gl::DisplayTarget::make(device(), 1, 1);
    ASSERT_TRUE(tiny.ok());
    for (int i = 0; i < 3; ++i) {
        ASSERT_TRUE(editor_->drawFrame(1, 1, 1.0f, tiny->framebuffer()).ok());
    }
    EXPECT_EQ(document::writeDocument(model().document()), text);
    frame();
    settle();
    EXPECT_TRUE(has("ramp"));
}

} // namespace
} // namespace lodestar::testing

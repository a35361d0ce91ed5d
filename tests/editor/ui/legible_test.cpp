// SPDX-License-Identifier: MIT
//
// What is read on the panels, without a picture: numbers have their room at their widest, and what
// comes to be known moves nothing.
#include <gtest/gtest.h>
#include <imgui.h>

#include "model/presets.h"
#include "ui/session.h"
#include "ui/workspace.h"

namespace lodestar::ui {
namespace {

class Legible : public ::testing::Test {
protected:
    Legible() {
        document::Document document;
        document.lights = model::builtInPresets().front().lights;
        model_.reset(document);
        around_.materials = {{"gold", 2048.0, glm::dvec3(0.0), glm::dvec3(0.9), {}}};
        around_.preview = 1; // some texture: nothing is drawn
        around_.accuracy.material = "gold";
        for (const char* name : {"rsrm", "rsrm-published", "rsrm-published-columns"}) {
            around_.accuracy.lines.push_back({name});
        }
        around_.accuracy.lines.front().used = true;
        model::Selection selection;
        selection.materials = {"gold"};
        model_.select(selection);
        frames();
    }
    void frame() {
        session_.frame(kWidth, height_, 1.0f, 1.0 / 60.0,
                       [&] { (void)workspace_.draw(model_, around_); });
        EXPECT_EQ(session_.failure(), "");
    }
    void frames() {
        for (int i = 0; i < 4; ++i) {
            frame();
        }
    }
    void give(const Input& input) {
        session_.push(input);
        frame();
    }
    void click(const ImVec2& place) {
        give(MotionInput{place.x, place.y});
        give(ButtonInput{0, true});
        give(ButtonInput{0, false});
        frames();
    }
    /// @param error relative, of the first; the others' are as large as errors are
    void measure(double error) {
        for (EstimateLine& line : around_.accuracy.lines) {
            line.error = 1.0;
            line.worst = 461.14;
            line.ms = 9.47;
            line.fetches = 2;
        }
        around_.accuracy.lines.front().error = error;
        frames();
    }
    [[nodiscard]] const Mark& mark(const std::string& name) const {
        return workspace_.marks().at(name);
    }

    static constexpr int kWidth = 1280;
    int height_ = 800;
    model::Model model_;
    Surroundings around_;
    Workspace workspace_;
    Session session_{Session::Drawing::None};
};

TEST_F(Legible, ErrorsOfAnySizeHaveRoomInThePlotAndTheTable) {
    click(mark("tab Accuracy").center());
    for (const double error : {1.2e-8, 1.2e-6, 0.0123, 0.7, 40.0}) {
        SCOPED_TRACE(error);
        measure(error);
        const Mark& plot = mark("accuracy plot");
        int numbers = 0;
        for (const auto& [name, place] : workspace_.marks()) {
            if (name.rfind("plot error ", 0) == 0) {
                ++numbers;
                EXPECT_GE(place.low.x, plot.low.x) << name;
            }
        }
        EXPECT_GE(numbers, 1);
        const Mark& fetches = mark("fetches of rsrm");
        EXPECT_LE(fetches.low.x + ImGui::CalcTextSize("fetches").x, fetches.clipHigh.x);
    }
}

TEST_F(Legible, WhatIsMeasuredMovesNoStrip) {
    for (int i = 0; i < 20; ++i) { // until the panel begins to overflow, and beyond
        SCOPED_TRACE(height_);
        for (EstimateLine& line : around_.accuracy.lines) {
            line = {line.name};
        }
        frames();
        const Mark before = mark("ramp");
        const float below = mark("environment source").low.y;
        measure(0.0043);
        EXPECT_EQ(mark("ramp").high.x, before.high.x);
        EXPECT_EQ(mark("environment source").low.y, below);
        height_ -= 10;
    }
}

TEST_F(Legible, FalseColoursHaveTheirScale) {
    EXPECT_FALSE(workspace_.marks().contains("false colour scale"));
    click(mark("False colours").center());
    const Mark& scale = mark("false colour scale");
    EXPECT_EQ(scale.low.x, mark("ramp").low.x);
    EXPECT_EQ(scale.high.x, mark("ramp").high.x);
}

TEST_F(Legible, ADayOfTheYearIsTypedAsANumberBesideItsDate) {
    const model::Id sun = model_.ids().lights[1].id;
    ASSERT_EQ(model_.light(sun)->kind, lighting::LightKind::Sun);
    model::Selection selection;
    selection.light = sun;
    model_.select(selection);
    frames();
    if (!model_.light(sun)->path) {
        click(mark("by place and date").center());
    }
    ASSERT_TRUE(model_.light(sun)->path.has_value());
    for (const int day : {1, 59, 60, 366}) {
        const ImVec2 place = mark("day of year").center();
        give(MotionInput{place.x, place.y});
        give(KeyInput{Key::Control, true, false, true, false});
        give(ButtonInput{0, true});
        give(ButtonInput{0, false});
        give(KeyInput{Key::Control, false, false, false, false});
        for (const char digit : std::to_string(day)) {
            give(TextInput{static_cast<char32_t>(digit)});
        }
        give(KeyInput{Key::Enter, true, false, false, false});
        give(KeyInput{Key::Enter, false, false, false, false});
        EXPECT_EQ(model_.light(sun)->path->dayOfYear, day);
    }
}

} // namespace
} // namespace lodestar::ui

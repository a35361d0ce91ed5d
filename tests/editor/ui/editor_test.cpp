// SPDX-License-Identifier: MIT
//
// The editor as a person uses it, by synthetic events.
#include <cmath>

#include <glm/geometric.hpp>

#include "editor/ui/editor_fixture.h"
#include "io/document_file.h"
#include "model/ramp.h"

namespace lodestar::testing {
namespace {

using platform::Key;

TEST_F(EditorTest, ShowsEveryPanelAndRests) {
    keep("first");
    for (const char* name : {"viewport", "ramp", "day", "light 0", "material 0", "tab Plan",
                             "menu File", "stop 0", "key 0", "preset"}) {
        const ui::Mark place = mark(name);
        EXPECT_GE(place.low.x, 0.0f) << name;
        EXPECT_GE(place.low.y, 0.0f) << name;
        EXPECT_LE(place.high.x, static_cast<float>(kWidth)) << name;
        EXPECT_LE(place.high.y, static_cast<float>(kHeight)) << name;
        EXPECT_GT(place.high.x, place.low.x) << name;
    }
    EXPECT_FALSE(editor_->wantsFrame());
    EXPECT_GT(editor_->patience(), 0.2);
    EXPECT_FALSE(model().dirty());
    // The picture is neither black nor flat.
    const core::Image picture = viewport();
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < picture.pixels().size(); i += 4) {
        const double value = static_cast<double>(picture.pixels()[i]);
        sum += value;
        squares += value * value;
    }
    const double count = static_cast<double>(picture.pixels().size()) / 4.0;
    EXPECT_GT(sum / count, 0.1);
    EXPECT_GT(squares / count - (sum / count) * (sum / count), 0.005);
}

TEST_F(EditorTest, APaintedStrokeIsInThePictureOfItsOwnFrame) {
    press(Key::B);
    ASSERT_TRUE(editor_->workspace().view().brush);
    editor_->workspace().view().brushSettings.color = {0.0, 6.0, 0.0};
    editor_->workspace().view().brushSettings.size = 60.0;
    moveTo(onRamp(0.2f));
    const core::Image before = viewport();
    const int pictures = editor_->picturesDrawn();
    send(platform::ButtonEvent{platform::PointerButton::Left, true, {}});
    frame(); // the press and its picture
    EXPECT_EQ(editor_->picturesDrawn(), pictures + 1);
    EXPECT_EQ(model().undoCount(), 1u);
    const core::Image after = part(shown(), mark("viewport"));
    EXPECT_GT(difference(before, after), 0.01) << "the stroke did not light the scene";
    moveTo(onRamp(0.35f));
    button(false);
    keep("stroke");
    EXPECT_EQ(model().undoCount(), 1u) << "one stroke is one step";
    EXPECT_EQ(model().undoName(), "Paint");
    control(Key::Z);
    EXPECT_EQ(model().undoCount(), 0u);
    EXPECT_LT(difference(before, viewport()), 1e-3);
}

TEST_F(EditorTest, StopsAreAddedDraggedTypedAndDeleted) {
    const std::size_t before = light(0).keys.front().gradient.stops.size();
    click(mark("key 0").center());
    const auto stops = [&] { return light(0).keys.front().gradient.stops.size(); };
    click(onRamp(0.25f));
    ASSERT_EQ(stops(), before + 1);
    ASSERT_EQ(model().selection().stops.size(), 1u);
    const model::Id added = model().selection().stops.front();
    EXPECT_NEAR(model().stop(added)->stop.at, 45.0, 1.0) << "a quarter of the way down a sky";
    EXPECT_EQ(model().undoCount(), 1u);

    const ImVec2 handle(onRamp(0.25f).x, onRamp(0.0f, 1.25f).y);
    drag(handle, {onRamp(0.4f).x, handle.y});
    EXPECT_NEAR(model().stop(added)->stop.at, 18.0, 1.5);
    EXPECT_EQ(model().undoCount(), 2u) << "one drag is one step";

    typeInto("stop at", "33.25");
    EXPECT_DOUBLE_EQ(model().stop(added)->stop.at, 33.25);
    typeInto("stop at", "1e39");
    EXPECT_DOUBLE_EQ(model().stop(added)->stop.at, 90.0) << "typed numbers stay in range";
    typeInto("stop at", "-20");
    EXPECT_DOUBLE_EQ(model().stop(added)->stop.at, -20.0);
    typeInto("stop ev", "3.5");
    EXPECT_DOUBLE_EQ(model().stop(added)->stop.ev, 3.5);
    keep("stop");

    press(Key::Delete);
    EXPECT_EQ(stops(), before);
    control(Key::Z);
    EXPECT_EQ(stops(), before + 1);
    const float x = onRamp(static_cast<float>(ui::placeOf(-20.0, lighting::LightKind::Sky))).x;
    drag({x, handle.y}, {x, handle.y - 150.0f});
    EXPECT_EQ(stops(), before) << "dragged away";
}

TEST_F(EditorTest, StopsAreCutAndPasted) {
    click(onRamp(0.25f));
    const std::string text = document::writeDocument(model().document());
    control(Key::X);
    EXPECT_NE(document::writeDocument(model().document()), text);
    EXPECT_EQ(model().undoCount(), 2u);
    control(Key::V);
    EXPECT_EQ(document::writeDocument(model().document()), text);
    EXPECT_EQ(model().undoCount(), 3u);
}

TEST_F(EditorTest, TheLastTwoStopsStay) {
    control(Key::A);
    press(Key::Delete);
    EXPECT_FALSE(editor_->workspace().log().empty());
    EXPECT_TRUE(editor_->workspace().log().back().isError);
    EXPECT_EQ(model().undoCount(), 0u);
}

TEST_F(EditorTest, AnExponentIsTypedAndSlid) {
    click(mark("material 1").center());
    ASSERT_EQ(model().selection().materials.size(), 1u);
    const std::string name = model().selection().materials.front();
    const core::Image before = viewport();
    typeInto("exponent", "100");
    EXPECT_DOUBLE_EQ(*model().document().materials.at(name).exponent, 100.0);
    EXPECT_GT(difference(before, viewport()), 1e-4);
    typeInto("exponent", "-7");
    EXPECT_DOUBLE_EQ(*model().document().materials.at(name).exponent, 0.0);
    const ui::Mark slider = mark("exponent slider");
    drag({slider.low.x + 10.0f, slider.center().y}, {slider.high.x - 4.0f, slider.center().y});
    EXPECT_GT(*model().document().materials.at(name).exponent, 1e6);
    EXPECT_EQ(model().undoCount(), 3u);
    keep("material");
    for (int i = 0; i < 3; ++i) {
        control(Key::Z);
    }
    EXPECT_EQ(model().undoCount(), 0u);
    EXPECT_EQ(model().document().materials.count(name), 0u);
    EXPECT_LT(difference(before, viewport()), 1e-3);
}

TEST_F(EditorTest, TheDayIsScrubbedAndPlays) {
    const ui::Mark day = mark("day");
    const core::Image before = viewport();
    drag({day.low.x + 0.3f * (day.high.x - day.low.x), day.center().y},
         {day.low.x + 0.5f * (day.high.x - day.low.x), day.center().y});
    EXPECT_NEAR(editor_->workspace().view().hour, 12.0, 0.2);
    EXPECT_GT(difference(before, viewport()), 0.005);
    EXPECT_EQ(model().undoCount(), 0u) << "an hour is how it is looked at";
    keep("noon");
    send(platform::KeyEvent{Key::Y, true, false, {}});
    frame();
    ASSERT_TRUE(editor_->workspace().view().playing);
    const double hour = editor_->workspace().view().hour;
    editor_->advance(1.0);
    EXPECT_NEAR(editor_->workspace().view().hour, hour + 0.4, 0.01);
    EXPECT_EQ(editor_->patience(), 0.0);
    send(platform::KeyEvent{Key::Y, false, false, {}});
    frame();
    send(platform::KeyEvent{Key::Y, true, false, {}});
    frame();
    EXPECT_FALSE(editor_->workspace().view().playing);
    send(platform::KeyEvent{Key::Y, false, false, {}});
    settle();
    EXPECT_FALSE(editor_->wantsFrame());
}

TEST_F(EditorTest, TheEyedropperGivesAStopTheViewportsRadiance) {
    click(onRamp(0.9f));
    const model::Id stop = model().selection().stops.front();
    press(Key::I);
    const ui::Mark viewport = mark("viewport");
    click({viewport.center().x, viewport.low.y + 20.0f}); // the sky
    const glm::dvec3 radiance = lighting::radianceOf(model().stop(stop)->stop);
    EXPECT_GT(radiance.r + radiance.g + radiance.b, 0.0);
    EXPECT_FALSE(editor_->workspace().view().picking);
    EXPECT_EQ(model().undoCount(), 2u);
    click({viewport.center().x, viewport.low.y + 20.0f});
    EXPECT_EQ(model().undoCount(), 2u) << "it picks once";
}

TEST_F(EditorTest, TheEyedropperReadsWhereItPointsAtTheHourThatIsShown) {
    // Blue above the horizon at the hour that is shown, and darker at any other.
    document::Document blue;
    blue.lights.emplace_back().keys.resize(2);
    for (document::Key& key : blue.lights[0].keys) {
        const glm::dvec3 above(0.0, 0.0, 1.0);
        const glm::dvec3 below(1.0, 0.0, 0.0);
        key.gradient.stops = {
            {{90, above, 0}, {}}, {{0, above, 0}, {}}, {{0, below, 0}, {}}, {{-90, below, 0}, {}}};
    }
    blue.lights[0].keys[0].hour = editor_->workspace().view().hour;
    blue.lights[0].keys[1].hour = editor_->workspace().view().hour - 12.0;
    blue.lights[0].keys[1].tint = glm::dvec3(0.0);
    ASSERT_TRUE(model().execute(model::ReplaceDocument{blue}).ok());
    settle();
    model::Selection selection;
    selection.stops = {model().ids().lights[0].keys[0].stops[3]};
    model().select(selection);
    settle();
    press(Key::I);
    const ui::Mark viewport = mark("viewport");
    click({viewport.center().x, viewport.low.y + 20.0f});
    const glm::dvec3 radiance = lighting::radianceOf(light(0).keys[0].gradient.stops[3].stop);
    constexpr double kHalf = 1.0 / 1024.0; // a half-float's step at 1
    EXPECT_NEAR(radiance.r, 0.0, kHalf);
    EXPECT_NEAR(radiance.g, 0.0, kHalf);
    EXPECT_NEAR(radiance.b, 1.0, kHalf);
}

TEST_F(EditorTest, SavesAndOpensAgain) {
    app::EditorOptions options;
    options.lighting = folder_.file("sky.lodestar.json");
    open(options);
    click(onRamp(0.3f));
    ASSERT_TRUE(model().dirty());
    EXPECT_EQ(editor_->title(), "sky.lodestar.json * - Lodestar");
    const std::string text = document::writeDocument(model().document());
    control(Key::S);
    EXPECT_FALSE(model().dirty());
    EXPECT_EQ(editor_->title(), "sky.lodestar.json - Lodestar");
    open(options);
    EXPECT_EQ(document::writeDocument(model().document()), text);

    click(onRamp(0.6f));
    const std::string unsaved = document::writeDocument(model().document());
    ASSERT_NE(unsaved, text);
    send(platform::CloseEvent{});
    EXPECT_TRUE(editor_->closing());
    open(options);
    EXPECT_EQ(document::writeDocument(model().document()), unsaved) << "not recovered";
    control(Key::Z);
    EXPECT_EQ(document::writeDocument(model().document()), text);
}

TEST_F(EditorTest, MenusShowTheirKeysAndQuittingAsks) {
    click(mark("menu Edit").center());
    keep("menu");
    EXPECT_TRUE(has("Undo"));
    press(Key::Escape);
    click(onRamp(0.3f));
    control(Key::Q);
    settle();
    ASSERT_TRUE(has("Stay"));
    keep("question");
    EXPECT_FALSE(editor_->closing());
    click(mark("Stay").center());
    EXPECT_FALSE(editor_->closing());
    control(Key::Q);
    settle();
    click(mark("Quit without saving").center());
    EXPECT_TRUE(editor_->closing());
}

TEST_F(EditorTest, TheCameraOrbitsAndFrames) {
    const core::Image before = viewport();
    const ImVec2 center = mark("viewport").center();
    drag(center, {center.x + 120.0f, center.y + 10.0f});
    const core::Image turned = viewport();
    EXPECT_GT(difference(before, turned), 0.005);
    press(Key::F);
    keep("framed");
    EXPECT_GT(difference(turned, viewport()), 0.005);
    press(Key::Home);
    EXPECT_LT(difference(before, viewport()), 0.002);
}

TEST_F(EditorTest, ExposureBrightensThePictureThatIsShown) {
    const core::Image before = viewport();
    const double exposure = editor_->workspace().view().exposure;
    press(Key::Plus);
    EXPECT_GT(editor_->workspace().view().exposure, exposure);
    EXPECT_GT(difference(before, viewport()), 0.005);
    press(Key::Minus);
    EXPECT_LT(difference(before, viewport()), 0.002);
}

} // namespace
} // namespace lodestar::testing

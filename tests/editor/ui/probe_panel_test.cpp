// SPDX-License-Identifier: MIT
//
// Light probes and the environment through the panels, by synthetic events.
#include <cmath>

#include "editor/ui/editor_fixture.h"

namespace lodestar::testing {
namespace {

using platform::Key;

class ProbePanels : public EditorTest {
protected:
    [[nodiscard]] const lighting::Probe& probe(std::size_t index = 0) {
        return model().document().probes.at(index).probe;
    }
    /// Turns the wheel over the properties until a field is in the window.
    void reach(const std::string& name) {
        const ui::Mark panel = mark("ramp");
        moveTo({panel.high.x - 4.0f, static_cast<float>(kHeight) - 40.0f});
        for (int i = 0; i < 20 && mark(name).high.y > static_cast<float>(kHeight) - 4.0f; ++i) {
            send(platform::WheelEvent{-1.0});
            settle();
        }
    }
    [[nodiscard]] const ui::ProbeLine& line(std::size_t index = 0) const {
        return editor_->surroundings().probes.at(index);
    }
};

TEST_F(ProbePanels, AProbeIsAddedCapturesAndGoesByUndo) {
    const core::Image before = viewport();
    click(mark("Add probe").center());
    ASSERT_EQ(model().document().probes.size(), 1u);
    keep("probe");
    ASSERT_EQ(editor_->surroundings().probes.size(), 1u);
    EXPECT_TRUE(line().shown);
    EXPECT_TRUE(line().ready);
    EXPECT_DOUBLE_EQ(line().progress, 1.0);
    // Its spheres mirror each other now, and its volume is drawn over the picture.
    EXPECT_GT(difference(before, viewport()), 1e-3);
    EXPECT_FALSE(editor_->wantsFrame()) << "a probe that is captured asks for frames";
    for (const char* name : {"probe name", "probe node", "probe position", "probe size",
                             "probe handle x", "probe handle y", "Capture now"}) {
        const ui::Mark place = mark(name);
        EXPECT_LE(place.high.x, static_cast<float>(kWidth)) << name;
        EXPECT_GT(place.high.x, place.low.x) << name;
    }
    control(Key::Z);
    EXPECT_TRUE(model().document().probes.empty());
    EXPECT_FALSE(model().dirty());
    EXPECT_LT(difference(before, viewport()), 1e-6);
    control(Key::Z, true);
    EXPECT_EQ(model().document().probes.size(), 1u);
}

TEST_F(ProbePanels, AHandleMovesTheProbeAlongItsAxisInOneStep) {
    click(mark("Add probe").center());
    const glm::dvec3 from = probe().position;
    const std::size_t steps = model().undoCount();
    const ImVec2 handle = mark("probe handle y").center();
    drag(handle, {handle.x, handle.y - 40.0f});
    EXPECT_GT(probe().position.y, from.y + 0.01);
    EXPECT_DOUBLE_EQ(probe().position.x, from.x);
    EXPECT_DOUBLE_EQ(probe().position.z, from.z);
    // The handle went with the pointer: it is where it was let go.
    EXPECT_NEAR(mark("probe handle y").center().y, handle.y - 40.0f, 6.0f);
    EXPECT_EQ(model().undoCount(), steps + 1);
    EXPECT_DOUBLE_EQ(line().progress, 1.0) << "what it captured is not captured anew";
    control(Key::Z);
    EXPECT_EQ(probe().position, from);
}

TEST_F(ProbePanels, OrbitingBesideTheHandlesStillOrbits) {
    click(mark("Add probe").center());
    const glm::mat4 before = editor_->surroundings().clipFromWorld;
    const ui::Mark place = mark("viewport");
    drag({place.low.x + 20.0f, place.low.y + 20.0f}, {place.low.x + 80.0f, place.low.y + 20.0f});
    EXPECT_NE(editor_->surroundings().clipFromWorld, before);
}

TEST_F(ProbePanels, NumbersAreTypedAndStayInRange) {
    click(mark("Add probe").center());
    reach("probe interior");
    typeInto("probe intensity", "2.5");
    EXPECT_DOUBLE_EQ(probe().intensity, 2.5);
    typeInto("probe intensity", "-4");
    EXPECT_DOUBLE_EQ(probe().intensity, 0.0);
    typeInto("probe resolution", "0");
    EXPECT_EQ(probe().capture.resolution, 1);
    typeInto("probe resolution", "64");
    EXPECT_EQ(probe().capture.resolution, 64);
    for (const char* text : {"inf", "nan", "1e400", "1e-310", "x"}) {
        typeInto("probe intensity", text);
        EXPECT_TRUE(std::isfinite(probe().intensity)) << text;
    }
    click(mark("probe proxy").center());
    ASSERT_TRUE(probe().proxy.has_value());
    EXPECT_EQ(probe().proxy->size, probe().influence.size);
    reach("probe interior");
    click(mark("probe interior").center());
    EXPECT_FALSE(probe().exterior);
}

TEST_F(ProbePanels, AFileThatIsNotThereIsOneLineAndThePictureStays) {
    click(mark("Add probe").center());
    const core::Image before = viewport();
    click(mark("probe light of").center());
    type("no such.hdr");
    press(Key::Enter);
    EXPECT_EQ(probe().source, "no such.hdr");
    ASSERT_FALSE(editor_->workspace().log().empty());
    EXPECT_NE(editor_->workspace().log().back().text.find("no such.hdr"), std::string::npos);
    EXPECT_LT(difference(before, viewport()), 1e-6);
    control(Key::Z);
    EXPECT_TRUE(probe().source.empty());
}

TEST_F(ProbePanels, OneThatIsMovedOrTakenAwayLetsTheOtherBe) {
    click(mark("Add probe").center());
    click(mark("Add probe").center()); // a point is lit by two
    ASSERT_EQ(model().document().probes.size(), 2u);
    lighting::Probe moved = probe(1);
    moved.position.y += 0.5;
    ASSERT_TRUE(model().execute(model::SetProbe{model().ids().probes[1], moved}).ok());
    frame();
    EXPECT_TRUE(line(0).ready && line(1).ready);
    settle();
    ASSERT_TRUE(model().execute(model::RemoveProbes{{model().ids().probes[0]}}).ok());
    frame();
    ASSERT_EQ(editor_->surroundings().probes.size(), 1u);
    EXPECT_TRUE(line(0).ready) << "the one that stays begins anew";
    EXPECT_DOUBLE_EQ(line(0).progress, 1.0);
}

TEST_F(ProbePanels, AnEnvironmentIsNamedTurnedAndRemoved) {
    const core::Image before = viewport();
    click(mark("environment source").center());
    type("gradient:0.1,2");
    press(Key::Enter);
    ASSERT_TRUE(model().document().environment.has_value());
    typeInto("environment ev", "1.5");
    EXPECT_DOUBLE_EQ(model().document().environment->ev, 1.5);
    typeInto("environment rotation", "90");
    EXPECT_NEAR(model().document().environment->rotation, std::acos(0.0), 1e-12);
    keep("environment");
    click(mark("environment source").center());
    control(Key::A);
    send(platform::KeyEvent{Key::Control, false, false, {}});
    type("no such.hdr");
    press(Key::Enter);
    EXPECT_EQ(model().document().environment->source, "no such.hdr");
    ASSERT_FALSE(editor_->workspace().log().empty());
    EXPECT_NE(editor_->workspace().log().back().text.find("no such.hdr"), std::string::npos)
        << editor_->workspace().log().back().text << model().document().environment->source;
    while (model().undo()) {
    }
    frame();
    settle();
    EXPECT_FALSE(model().document().environment.has_value());
    EXPECT_LT(difference(before, viewport()), 1e-6);
}

} // namespace
} // namespace lodestar::testing

// SPDX-License-Identifier: MIT
//
// Keys that are held in a drag: before it, from its first motion on, and pressed or let go midway.
#include <cmath>

#include "editor/ui/editor_fixture.h"
#include "model/ramp.h"

namespace lodestar::testing {
namespace {

using platform::Key;

class DragKeysTest : public EditorTest {
protected:
    void SetUp() override {
        EditorTest::SetUp();
        if (!IsSkipped() && !HasFatalFailure()) {
            click(mark("key 0").center());
        }
    }
    [[nodiscard]] double at(model::Id stop) { return model().stop(stop)->stop.at; }
    [[nodiscard]] const std::vector<model::Id>& chosen() { return model().selection().stops; }
    /// A stop that stands at an angle, alone selected.
    model::Id stopAt(double degrees) {
        const model::Id key = model().ids().lights[0].keys[0].id;
        const auto made =
            model().execute(model::AddStop{key, degrees}); // with the gradient's own radiance
        EXPECT_TRUE(made.ok());
        settle();
        return made->created.front();
    }
    [[nodiscard]] ImVec2 handle(double degrees) const {
        return {onRamp(static_cast<float>(ui::placeOf(degrees, lighting::LightKind::Sky))).x,
                onRamp(0.0f, 1.25f).y};
    }
    /// Degrees of a pixel of the strip: what a drag can tell apart.
    [[nodiscard]] double pixel() const {
        const ui::Mark ramp = mark("ramp");
        return 180.0 / static_cast<double>(ramp.high.x - ramp.low.x);
    }
};

TEST_F(DragKeysTest, ControlSnapsFromTheFirstMotionOn) {
    const model::Id stop = stopAt(52.2);
    hold(true, false);
    moveTo(handle(52.2));
    button(true);
    EXPECT_EQ(at(stop), 52.2) << "a press alone moves nothing";
    moveTo(handle(47.9));
    EXPECT_EQ(at(stop), 50.0);
    moveTo(handle(33.4));
    EXPECT_EQ(at(stop), 35.0);
    button(false);
    hold(false, false);
    EXPECT_EQ(chosen(), std::vector{stop}) << "a drag takes no stop out of the selection";
}

TEST_F(DragKeysTest, KeysActWhereThePointerRests) {
    const model::Id stop = stopAt(52.2);
    const std::size_t steps = model().undoCount();
    moveTo(handle(52.2));
    button(true);
    moveTo(handle(33.4));
    const double anywhere = at(stop);
    EXPECT_NEAR(anywhere, 33.4, pixel());
    hold(true, false);
    EXPECT_EQ(at(stop), 35.0);
    hold(true, true);
    EXPECT_EQ(at(stop), std::round(anywhere));
    hold(false, false);
    EXPECT_EQ(at(stop), anywhere);
    button(false);
    EXPECT_EQ(model().undoCount(), steps + 1);
}

TEST_F(DragKeysTest, AClickWithAKeySelectsAndADragMovesAllThatAre) {
    const model::Id first = stopAt(52.2);
    const model::Id second = stopAt(-33.0);
    for (const bool shift : {false, true}) {
        click(handle(52.2));
        ASSERT_EQ(chosen(), std::vector{first});
        hold(!shift, shift);
        click(handle(-33.0));
        EXPECT_EQ(chosen(), (std::vector{first, second}));
        click(handle(-33.0));
        EXPECT_EQ(chosen(), std::vector{first}) << "a second click takes it out";
        click(handle(-33.0));
        hold(false, false);
        click(handle(-33.0));
        EXPECT_EQ(chosen(), std::vector{second}) << "without a key it alone";
    }
    hold(true, false);
    click(handle(52.2));
    drag(handle(52.2), handle(41.0));
    hold(false, false);
    EXPECT_EQ(at(first), 40.0);
    EXPECT_NEAR(at(second), -33.0 - 12.2, 1e-9) << "the others go along";
    EXPECT_EQ(chosen(), (std::vector{second, first}));
}

class GizmoKeysTest : public EditorTest {
protected:
    void SetUp() override {
        EditorTest::SetUp();
        if (!IsSkipped() && !HasFatalFailure()) {
            click(mark("Add probe").center());
        }
    }
    [[nodiscard]] double y() { return model().document().probes.at(0).probe.position.y; }
    /// Of the scene's diagonal, as the tooltip says.
    [[nodiscard]] double step() const {
        const ui::Surroundings& around = editor_->surroundings();
        const double twentieth = static_cast<double>(glm::distance(around.low, around.high)) / 20.0;
        return std::pow(10.0, std::floor(std::log10(twentieth)));
    }
    [[nodiscard]] static bool isMultiple(double value, double step) {
        return std::abs(value / step - std::round(value / step)) < 1e-9;
    }
};

TEST_F(GizmoKeysTest, ControlSnapsFromTheFirstMotionOnAndMidway) {
    const double from = y();
    const std::size_t steps = model().undoCount();
    const ImVec2 place = mark("probe handle y").center();
    hold(true, false);
    moveTo(place);
    button(true);
    EXPECT_EQ(y(), from) << "a press alone moves nothing";
    moveTo({place.x, place.y - 20.0f});
    EXPECT_NE(y(), from);
    EXPECT_TRUE(isMultiple(y(), step())) << y();
    moveTo({place.x, place.y - 47.0f});
    const double snapped = y();
    EXPECT_TRUE(isMultiple(snapped, step())) << snapped;
    keep("gizmo-snapped");
    hold(false, false);
    const double anywhere = y();
    EXPECT_FALSE(isMultiple(anywhere, step()));
    EXPECT_LE(std::abs(anywhere - snapped), 0.5 * step());
    hold(true, true);
    EXPECT_TRUE(isMultiple(y(), 0.1 * step())) << y();
    EXPECT_LE(std::abs(y() - anywhere), 0.05 * step());
    hold(true, false);
    EXPECT_EQ(y(), snapped);
    button(false);
    hold(false, false);
    EXPECT_EQ(model().undoCount(), steps + 1);
}

TEST_F(GizmoKeysTest, ShiftGoesATenthOfTheWay) {
    const double from = y();
    const ImVec2 place = mark("probe handle y").center();
    drag(place, {place.x, place.y - 30.0f});
    const double whole = y() - from;
    control(Key::Z);
    ASSERT_EQ(y(), from);
    hold(false, true);
    const ImVec2 again = mark("probe handle y").center();
    drag(again, {again.x, again.y - 30.0f});
    hold(false, false);
    // Perspective makes a pixel of a longer way another length: of a way this short by a tenth.
    EXPECT_NEAR(y() - from, 0.1 * whole, 0.01 * whole);
    ASSERT_GT(whole, 0.0);
}

} // namespace
} // namespace lodestar::testing

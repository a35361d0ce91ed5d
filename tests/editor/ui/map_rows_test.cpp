// SPDX-License-Identifier: MIT
//
// The rows of the maps under the user's hands, by synthetic events.
#include <cmath>

#include "editor/ui/editor_fixture.h"

namespace lodestar::testing {
namespace {

using platform::Key;

class MapRowsEditorTest : public EditorTest {
protected:
    [[nodiscard]] std::vector<double> rows() {
        return lighting::rowExponents(document::mapLayout(model().document()));
    }
    /// A place on a row's slider. @param exponent [1, 16384]
    [[nodiscard]] ImVec2 onSlider(std::size_t row, double exponent) const {
        const ui::Mark slider = mark("row slider " + std::to_string(row));
        const double share = std::log2((exponent + 1.0) / 2.0) / std::log2(16385.0 / 2.0);
        // The grab's own width is left at both ends; about, for what is asked for is a change.
        return {slider.low.x + static_cast<float>(share) * (slider.high.x - slider.low.x),
                slider.center().y};
    }
    void openRows() {
        click(mark("tab Map rows").center());
        settle();
        ASSERT_TRUE(has("row slider 1"));
    }
};

TEST_F(MapRowsEditorTest, ASliderMovesItsRowAndThePictureWithIt) {
    openRows();
    keep("default");
    const core::Image usual = viewport();
    ASSERT_EQ(rows().size(), 24U);
    // Few rows, so that each weighs.
    ASSERT_TRUE(model().execute(model::SetMapRows{{1.0, 12.0, 400.0}}).ok());
    frame();
    const core::Image few = viewport();
    EXPECT_GT(difference(usual, few), 1e-4);
    const std::size_t steps = model().undoCount();
    moveTo(onSlider(1, 12.0));
    button(true);
    core::Image last = few;
    for (const double exponent : {25.0, 60.0, 150.0}) {
        const ImVec2 place = onSlider(1, exponent);
        send(platform::MotionEvent{static_cast<double>(place.x), static_cast<double>(place.y)});
        frame(); // one: the picture follows in the frame that the row moves in
        EXPECT_NEAR(rows()[1], exponent, 0.2 * exponent); // the grab has a width
        const core::Image moved = part(shown(), mark("viewport"));
        EXPECT_GT(difference(last, moved), 1e-4) << exponent;
        last = moved;
    }
    button(false);
    keep("dragged");
    EXPECT_EQ(model().undoCount(), steps + 1) << "a drag is one step";
    // Beyond its neighbour a row stops beside it.
    drag(onSlider(1, rows()[1]), onSlider(1, 5000.0));
    EXPECT_NEAR(rows()[1], 400.0 / 1.01, 0.1);
    control(Key::Z);
    control(Key::Z);
    EXPECT_EQ(rows(), (std::vector<double>{1.0, 12.0, 400.0}));
    EXPECT_EQ(difference(few, viewport()), 0.0);
    control(Key::Z);
    EXPECT_EQ(rows().size(), 24U);
    EXPECT_EQ(difference(usual, viewport()), 0.0);
}

TEST_F(MapRowsEditorTest, RowsAreAddedRemovedTypedAndReset) {
    openRows();
    click(mark("Add row").center());
    EXPECT_EQ(rows().size(), 24U) << "as many as there may be";
    EXPECT_FALSE(model().document().rsrm);
    click(mark("remove row 1").center());
    ASSERT_EQ(rows().size(), 23U);
    const double next = rows()[1];
    click(mark("Add row").center());
    ASSERT_EQ(rows().size(), 24U);
    EXPECT_GT(rows()[1], 1.0) << "in the gap that was left";
    EXPECT_LT(rows()[1], next);
    typeInto("row 1", "1.9");
    EXPECT_DOUBLE_EQ(rows()[1], 1.9);
    typeInto("row 1", "900");
    EXPECT_NEAR(rows()[1], next / 1.01, 1e-9) << "a row stays between its neighbours";
    click(mark("Default rows").center());
    EXPECT_FALSE(model().document().rsrm);
    ASSERT_TRUE(model().execute(model::SetMapRows{{1.0, 12.0}}).ok());
    frame();
    click(mark("remove row 0").center());
    EXPECT_EQ(rows().size(), 2U) << "two at least";
    keep("two");
}

TEST_F(MapRowsEditorTest, ErrorsAreOfTheRowsThatThereAre) {
    click(mark("material 3").center());
    openRows();
    ASSERT_TRUE(model().execute(model::SetMapRows{{1.0, 12.0, 400.0}}).ok());
    frame();
    const auto measured = [&] {
        const auto& all = editor_->surroundings().accuracy.rows;
        return all.size() == 3 && std::all_of(all.begin(), all.end(), [](const ui::MapRow& row) {
                   return row.error.has_value();
               });
    };
    waitUntil(measured);
    ASSERT_TRUE(measured());
    const std::vector<ui::MapRow> before = editor_->surroundings().accuracy.rows;
    EXPECT_EQ(before[1].exponent, 12.0);
    EXPECT_NEAR(before[0].between, std::sqrt(2.0 * 13.0) - 1.0, 1e-9);
    EXPECT_TRUE(before[1].betweenError.has_value());
    EXPECT_GT(std::max(*before[0].betweenError, *before[1].betweenError), 0.005)
        << "three rows are too few, and it is seen";
    settle();
    keep("measured");
}

} // namespace
} // namespace lodestar::testing

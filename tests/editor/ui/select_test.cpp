// SPDX-License-Identifier: MIT
//
// Selecting on the picture and framing what is selected.
#include "app/scene_pick.h"
#include "editor/ui/editor_fixture.h"
#include "support/shapes.h"

namespace lodestar::testing {
namespace {

using platform::Key;

class Select : public EditorTest {
protected:
    /// Where a world point is in the window.
    [[nodiscard]] ImVec2 seen(const glm::vec3& point) {
        const glm::vec4 clip = editor_->surroundings().clipFromWorld * glm::vec4(point, 1.0f);
        const ui::Mark place = mark("viewport");
        return {place.low.x + (place.high.x - place.low.x) * (0.5f + 0.5f * clip.x / clip.w),
                place.low.y + (place.high.y - place.low.y) * (0.5f - 0.5f * clip.y / clip.w)};
    }
    [[nodiscard]] const std::vector<std::string>& chosen() { return model().selection().materials; }
};

TEST_F(Select, AClickSelectsWhatIsUnderItAndCtrlOneMore) {
    // The middle of the front row stands before the world's middle.
    click(seen({0.0f, 0.5f, 0.75f}));
    ASSERT_EQ(chosen().size(), 1u);
    const std::string middle = chosen().front();
    EXPECT_EQ(middle, "metal 256");
    keep("selected");
    EXPECT_TRUE(has("exponent"));
    send(platform::KeyEvent{Key::Control, true, false, {false, true, false}});
    click(seen({0.0f, 0.0f, 4.0f}));
    send(platform::KeyEvent{Key::Control, false, false, {}});
    EXPECT_EQ(chosen(), (std::vector<std::string>{middle, "floor"}));
    click({mark("viewport").low.x + 5.0f, mark("viewport").low.y + 5.0f}); // the sky
    EXPECT_TRUE(chosen().empty());
    EXPECT_EQ(model().undoCount(), 0u) << "a selection is no step";
}

TEST_F(Select, ADragAndAPickSelectNothing) {
    const ImVec2 ball = seen({0.0f, 0.5f, 0.75f});
    drag(ball, {ball.x + 60.0f, ball.y});
    EXPECT_TRUE(chosen().empty());
    press(Key::I);
    click(mark("viewport").center());
    EXPECT_TRUE(chosen().empty());
    EXPECT_FALSE(editor_->workspace().view().picking);
}

TEST_F(Select, FramingBringsItNearAndShiftBringsAllBack) {
    press(Key::F, {true, false, false});
    const glm::mat4 all = editor_->surroundings().clipFromWorld;
    click(seen({0.0f, 0.5f, 0.75f}));
    ASSERT_EQ(chosen().size(), 1u);
    press(Key::F);
    const ImVec2 middle = mark("viewport").center();
    const ui::Mark place = mark("viewport");
    // The ball is 1 m across and fills most of the picture's height.
    const float top = seen({0.0f, 1.0f, 0.75f}).y;
    const float bottom = seen({0.0f, 0.0f, 0.75f}).y;
    EXPECT_GT(bottom - top, 0.5f * (place.high.y - place.low.y));
    EXPECT_NEAR(0.5f * (top + bottom), middle.y, 0.25f * (place.high.y - place.low.y));
    press(Key::F, {true, false, false});
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            EXPECT_NEAR(editor_->surroundings().clipFromWorld[column][row], all[column][row],
                        1e-3f * (1.0f + std::abs(all[column][row])));
        }
    }
    // A material without a node that is selected.
    model::Selection material;
    material.materials = chosen();
    editor_->workspace().view().node = -1;
    model().select(material);
    press(Key::F);
    const float near = seen({0.0f, 0.0f, 0.75f}).y - seen({0.0f, 1.0f, 0.75f}).y;
    EXPECT_GT(near, 0.5f * (place.high.y - place.low.y));
}

TEST(FirstMet, IsTheNearestTriangleOfAnyNodeFromBothSides) {
    io::GltfFile file;
    file.meshes.push_back({"ball", {sphere(32, 64)}, {}});
    for (const float x : {0.0f, 5.0f}) {
        io::GltfNode node;
        node.mesh = 0;
        node.translation = {x, 0.0f, 0.0f};
        node.scale = glm::vec3(2.0f, 1.0f, 1.0f);
        file.nodes.push_back(node);
    }
    file.scenes.push_back({"scene", {0, 1}});
    const scene::Scene scene = scene::buildScene(file, 0);
    const auto met = app::firstMet(scene, {20.0f, 0.01f, 0.01f}, {-2.0f, 0.0f, 0.0f});
    ASSERT_TRUE(met.has_value());
    EXPECT_EQ(met->node, 1u);
    EXPECT_NEAR(met->distance, 6.5f, 0.02f); // in the direction's lengths: (20 - 7) / 2
    const auto inside = app::firstMet(scene, {5.0f, 0.01f, 0.01f}, {-1.0f, 0.0f, 0.0f});
    ASSERT_TRUE(inside.has_value());
    EXPECT_EQ(inside->node, 1u);
    EXPECT_FALSE(app::firstMet(scene, {0.0f, 3.0f, 0.0f}, {1.0f, 0.0f, 0.0f}).has_value());
}

} // namespace
} // namespace lodestar::testing

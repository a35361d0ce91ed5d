// SPDX-License-Identifier: MIT
//
// What is done in the interface as a script of commands: copied, saved, carried out again.
#include <fstream>
#include <sstream>

#include "editor/ui/editor_fixture.h"
#include "model/command_text.h"

namespace lodestar::testing {
namespace {

using platform::Key;

class RecordTest : public EditorTest {
protected:
    [[nodiscard]] std::string text() { return document::writeDocument(model().document()); }
    /// An edit of each kind that a pointer and keys make.
    void editSomething() {
        click(mark("key 0").center());
        click(onRamp(0.3f));
        drag(onRamp(0.3f, 1.25f), onRamp(0.4f, 1.25f));
        press(Key::B);
        drag(onRamp(0.5f), onRamp(0.7f));
        press(Key::B);
        click(mark("Add key").center());
        click(mark("Add probe").center());
        const ImVec2 handle = mark("probe handle y").center();
        drag(handle, {handle.x, handle.y - 30.0f});
        press(Key::R);
        control(Key::Z);
    }
};

TEST_F(RecordTest, StepsAreCopiedAndCarriedOutAgain) {
    const document::Document before = model().document();
    editSomething();
    ASSERT_GE(model().undoCount(), 5u);
    const std::string after = text();
    press(Key::C, {true, true, false});
    send(platform::KeyEvent{Key::Control, false, false, {}});
    settle();
    model::Model again(before);
    const auto run = model::runScript(clipboard(), again);
    ASSERT_TRUE(run.ok()) << run.error().message() << clipboard();
    EXPECT_EQ(*run, model().undoCount());
    EXPECT_EQ(document::writeDocument(again.document()), after);
    EXPECT_EQ(text(), after) << "copying changes nothing";
}

TEST_F(RecordTest, StepsAreSavedAndCarriedOutAgain) {
    const document::Document before = model().document();
    editSomething();
    const std::string path = folder_.file("steps.jsonl");
    control(Key::E);
    type(path);
    keep("save-steps");
    press(Key::Enter);
    std::ostringstream script;
    script << std::ifstream(path).rdbuf();
    model::Model again(before);
    const auto run = model::runScript(script.str(), again);
    ASSERT_TRUE(run.ok()) << run.error().message();
    EXPECT_EQ(document::writeDocument(again.document()), text());
    control(Key::E);
    type(folder_.file("no/such/folder.jsonl"));
    press(Key::Enter);
    EXPECT_TRUE(editor_->workspace().log().back().isError);
}

} // namespace
} // namespace lodestar::testing

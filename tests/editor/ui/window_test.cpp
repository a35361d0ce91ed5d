// SPDX-License-Identifier: MIT
//
// A user's way through the editor, each task in at most eight actions: by injected events in every
// run, and beside that in a real window on a virtual display, where each step must be seen in the
// part of the window that it changes. What both showed is left in editor-screenshots/.
#include <algorithm>
#include <fstream>
#include <optional>

#include "core/tally.h"
#include "editor/ui/editor_fixture.h"
#include "editor/ui/real_window.h"
#include "io/document_file.h"

namespace lodestar::testing {
namespace {

using platform::Key;

constexpr double kSteps = 2.0 / 255.0; ///< one step of rounding on either side
constexpr int kMostActions = 8;

/// What is done is done to an editor in this process, whose marks tell where things are, and at the
/// same places of the window where there is one.
class Tasks : public EditorTest {
protected:
    void SetUp() override {
        EditorTest::SetUp();
        if (IsSkipped() || HasFatalFailure()) {
            return;
        }
        std::filesystem::create_directories("editor-screenshots");
        std::filesystem::copy_file(
            std::string(LODESTAR_TEST_DATA) + "/../samples/skies/clear.lodestar.json", file_);
    }
    void TearDown() override {
        window_.reset();
        EditorTest::TearDown();
    }

    void task(const char* name) {
        EXPECT_LE(actions_, kMostActions) << task_;
        task_ = name;
        actions_ = 0;
        remember();
    }
    /// What a step showed, and where it must have changed something.
    void look(const std::string& place, double least) {
        const ui::Mark part = mark(place);
        const core::Image now = whole();
        EXPECT_GT(compare(EditorTest::part(now, part), EditorTest::part(before_, part), kSteps)
                      .failingFraction,
                  least)
            << task_ << ": " << place << " has not changed";
        save(now, "injected");
        if (window_) {
            const core::Image seen = window_->shown();
            save(seen, "window");
            EXPECT_GT(
                compare(EditorTest::part(seen, part), EditorTest::part(seenBefore_, part), kSteps)
                    .failingFraction,
                least)
                << task_ << ": " << place << " has not changed in the window";
        }
    }
    void remember() {
        before_ = whole();
        if (window_) {
            seenBefore_ = window_->shown();
        }
    }
    /// The share of a place that the window shows otherwise than it once did.
    [[nodiscard]] double changedSince(const core::Image& once, const core::Image& now,
                                      const std::string& place) const {
        return compare(part(now, mark(place)), part(once, mark(place)), kSteps).failingFraction;
    }

    void open() {
        ++actions_;
        app::EditorOptions options;
        options.lighting = file_;
        EditorTest::open(options);
        if (window_) {
            ASSERT_TRUE(window_->open()) << "no window";
            ASSERT_TRUE(window_->resize(kWidth, kHeight)) << "nothing is shown";
            window_->rest();
        }
    }
    /// A real pointer is at whole pixels.
    static ImVec2 rounded(const ImVec2& place) {
        return {std::round(place.x), std::round(place.y)};
    }
    void click(const ImVec2& exact) {
        const ImVec2 place = rounded(exact);
        ++actions_;
        EditorTest::click(place);
        if (window_) {
            window_->click(place.x, place.y);
        }
    }
    void drag(const ImVec2& exactFrom, const ImVec2& exactTo) {
        const ImVec2 from = rounded(exactFrom);
        const ImVec2 to = rounded(exactTo);
        ++actions_;
        EditorTest::drag(from, to);
        if (window_) {
            window_->drag(from.x, from.y, to.x, to.y);
        }
    }
    void key(Key key, const std::string& name, platform::Modifiers modifiers = {}) {
        ++actions_;
        press(key, modifiers);
        if (window_) {
            window_->key(name);
        }
    }
    void number(const std::string& field, const std::string& text) {
        actions_ += 3; // Ctrl + click, typing, Enter
        const ImVec2 place = mark(field).center();
        typeInto(field, text);
        if (window_) {
            window_->click(place.x, place.y, "ctrl");
            window_->type(text);
            window_->key("Return");
        }
    }
    /// The program ends, and what it said is nothing.
    void close() {
        send(platform::CloseEvent{});
        EXPECT_TRUE(editor_->closing());
        if (window_) {
            const RunResult ended = window_->close();
            EXPECT_EQ(ended.status, 0) << ended.err;
            EXPECT_EQ(ended.err, "");
        }
    }

    void doAll();
    void editAll();

    core::Image whole() {
        (void)viewport(); // stands still
        return shown();
    }
    void save(core::Image picture, const std::string& kind) {
        for (std::size_t i = 3; picture.channels() == 4 && i < picture.pixels().size(); i += 4) {
            picture.pixels()[i] = 1.0f;
        }
        std::string name = task_;
        std::replace(name.begin(), name.end(), ' ', '-');
        EXPECT_TRUE(
            io::writeImage("editor-screenshots/" + name + "-" + kind + ".png", picture).ok());
    }
    [[nodiscard]] std::string contents() const {
        std::ifstream file(file_, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    }

    std::string file_ = folder_.file("sky.lodestar.json");
    std::optional<RealWindow> window_;
    core::Image before_, seenBefore_;
    std::string task_ = "0 nothing";
    int actions_ = 0;
};

void Tasks::editAll() {
    task("2 add a stop");
    click(onRamp(0.22f));
    look("ramp", 0.0); // the line over the new stop's place
    ASSERT_EQ(model().undoCount(), 1U);

    task("3 drag it");
    const float handles = onRamp(0.0f, 1.25f).y;
    drag({onRamp(0.22f).x, handles}, {onRamp(0.36f).x, handles});
    look("ramp", 0.02);
    ASSERT_EQ(model().undoCount(), 2U);

    task("4 paint a stroke");
    key(Key::B, "b");
    drag(onRamp(0.08f), onRamp(0.3f));
    key(Key::B, "b");
    look("viewport", 0.2);
    look("ramp", 0.08);
    ASSERT_EQ(model().undoName(), "Paint");

    task("5 type an exponent");
    click(mark("material 3").center());
    const std::string name = model().selection().materials.at(0);
    number("exponent", "12");
    look("viewport", 0.001);
    EXPECT_DOUBLE_EQ(*model().document().materials.at(name).exponent, 12.0);
    ASSERT_EQ(model().undoCount(), 4U);

    task("6 scrub the day");
    const ui::Mark day = mark("day");
    drag({day.low.x + 0.5f * (day.high.x - day.low.x), day.center().y},
         {day.low.x + 0.3f * (day.high.x - day.low.x), day.center().y});
    look("viewport", 0.2);
    EXPECT_EQ(model().undoCount(), 4U) << "an hour is how it is looked at";
}

void Tasks::doAll() {
    const std::string original = contents();
    task("1 open the sample");
    open();
    before_ = core::Image(kWidth, kHeight, 4);
    seenBefore_ = window_ ? core::Image(kWidth, kHeight, window_->shown().channels()) : before_;
    look("viewport", 0.3);
    const std::string first = document::writeDocument(model().document());
    editAll();
    const std::string edited = document::writeDocument(model().document());

    task("7 undo it all");
    for (int i = 0; i < 4; ++i) {
        key(Key::Z, "ctrl+z", {false, true, false});
    }
    look("viewport", 0.2);
    EXPECT_EQ(document::writeDocument(model().document()), first);
    EXPECT_FALSE(model().dirty());

    task("8 redo and save");
    for (int i = 0; i < 4; ++i) {
        key(Key::Z, "ctrl+shift+z", {true, true, false});
    }
    look("viewport", 0.2);
    EXPECT_EQ(contents(), original) << "written before it was saved";
    key(Key::S, "ctrl+s", {false, true, false});
    EXPECT_FALSE(model().dirty());
    EXPECT_TRUE(contents() == edited) << "the window's program painted something else";

    task("9 reopen");
    close();
    open();
    EXPECT_EQ(document::writeDocument(model().document()), edited);
    EXPECT_EQ(model().undoCount(), 0U);
    click(mark("material 3").center());
    look("viewport", 0.0); // another hour than the one that was left
    close();
    EXPECT_LE(actions_, kMostActions);
    EXPECT_FALSE(std::filesystem::exists("imgui.ini"));
}

TEST_F(Tasks, EachTakesEightActionsAtMost) {
    doAll();
}

TEST_F(Tasks, ARealWindowDoesTheSame) {
    if (const std::string missing = missingPrograms(); !missing.empty()) {
        GTEST_SKIP() << missing;
    }
    window_.emplace(folder_, file_, "1440x900");
    doAll();
}

TEST(Editor, ItsWindowFitsASmallScreen) {
    if (const std::string missing = missingPrograms(); !missing.empty()) {
        GTEST_SKIP() << missing;
    }
    const TemporaryFolder folder;
    RealWindow window(folder, folder.file("sky.lodestar.json"), "1024x700");
    ASSERT_TRUE(window.open());
    window.rest();
    // What is seen of it is all of it: a part that the screen does not have is in no picture.
    const auto [width, height] = window.size();
    const core::Image seen = window.shown();
    EXPECT_EQ(seen.width(), width);
    EXPECT_EQ(seen.height(), height);
    EXPECT_LE(width, 1024);
    EXPECT_LE(height, 700);
    EXPECT_GT(width, 900) << "it uses what there is";
    EXPECT_GT(height, 550);
    std::filesystem::create_directories("editor-screenshots");
    window.keep("editor-screenshots/small-screen.png");
    EXPECT_EQ(window.close().status, 0);
}

TEST(Editor, ItsWindowIsAsLargeToTheEyeOnADenseScreen) {
    if (const std::string missing = missingPrograms(); !missing.empty()) {
        GTEST_SKIP() << missing;
    }
    const TemporaryFolder folder;
    std::array<int, 2> sizes[2];
    for (const int scale : {1, 2}) {
        RealWindow window(folder, folder.file("sky.lodestar.json"), "3840x1920");
        ASSERT_TRUE(window.setDensity(96 * scale));
        ASSERT_TRUE(window.open());
        sizes[scale - 1] = window.size();
        EXPECT_EQ(window.close().status, 0);
    }
    EXPECT_EQ(sizes[1][0], 2 * sizes[0][0]);
    EXPECT_EQ(sizes[1][1], 2 * sizes[0][1]);
}

TEST(Editor, WithoutADisplayItSaysSoAndIsStatusFour) {
    const RunResult run = runLodestar({"edit"}, {"DISPLAY="});
    EXPECT_EQ(run.status, 4);
    ASSERT_EQ(run.errorLines().size(), 1u) << run.err;
    EXPECT_NE(run.err.find("display"), std::string::npos) << run.err;
}

} // namespace
} // namespace lodestar::testing

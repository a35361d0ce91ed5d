// SPDX-License-Identifier: MIT
//
// The editor's files: what others do to them, presets of the user, what is dropped, full disks.
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <csignal>
#include <sys/resource.h>
#include <unistd.h>

#include "editor/ui/editor_fixture.h"
#include "model/clipboard.h"
#include "model/presets.h"

namespace lodestar::testing {
namespace {

namespace fs = std::filesystem;
using platform::Key;

class EditorFilesTest : public EditorTest {
protected:
    void SetUp() override {
        ::setenv("XDG_DATA_HOME", folder_.file("data").c_str(), 1);
        EditorTest::SetUp();
        if (IsSkipped() || HasFatalFailure()) {
            return;
        }
        options_.lighting = path_;
        open(options_);
        control(Key::S);
        ASSERT_FALSE(model().dirty());
    }
    void TearDown() override {
        EditorTest::TearDown();
        ::unsetenv("XDG_DATA_HOME");
    }
    [[nodiscard]] std::string text() { return document::writeDocument(model().document()); }
    [[nodiscard]] static std::string onDisk(const std::string& path) {
        std::ostringstream text;
        text << std::ifstream(path).rdbuf();
        return text.str();
    }
    /// As another program would: the document with its lights in another order.
    std::string editOutside() {
        document::Document other = model().document();
        std::reverse(other.lights.begin(), other.lights.end());
        const std::string written = document::writeDocument(other);
        std::ofstream(path_) << written << '\n';
        return written;
    }
    /// The time that passes until the editor looks.
    void wait() {
        editor_->advance(1.1);
        settle();
    }
    [[nodiscard]] const ui::LogLine& said() const { return editor_->workspace().log().back(); }

    std::string path_ = folder_.file("sky.lodestar.json");
    app::EditorOptions options_;
};

TEST_F(EditorFilesTest, AFileThatNobodyTouchesDrawsNothing) {
    EXPECT_LE(editor_->patience(), 1.0);
    const int frames = editor_->framesDrawn();
    for (int i = 0; i < 5; ++i) {
        wait();
    }
    EXPECT_EQ(editor_->framesDrawn(), frames);
}

TEST_F(EditorFilesTest, AChangedFileIsReadAgainWhereNothingIsUnsaved) {
    const std::string before = text();
    const std::string outside = editOutside();
    wait();
    EXPECT_EQ(text(), outside);
    EXPECT_FALSE(model().dirty());
    control(Key::Z);
    EXPECT_EQ(text(), before);
    EXPECT_TRUE(model().dirty());
}

TEST_F(EditorFilesTest, AChangedFileIsAskedAboutWhereSomethingIsUnsaved) {
    click(onRamp(0.3f));
    const std::string mine = text();
    const std::string outside = editOutside();
    wait();
    ASSERT_TRUE(has("Keep mine"));
    keep("outside");
    EXPECT_EQ(text(), mine);
    click(mark("Keep mine").center());
    EXPECT_EQ(text(), mine);
    control(Key::Z);
    EXPECT_TRUE(model().dirty()) << "what was saved is no more on the disk";
    control(Key::Z, true);
    editOutside();
    std::ofstream(path_, std::ios::app) << "\n"; // another size than the last
    wait();
    ASSERT_TRUE(has("Read it again"));
    click(mark("Read it again").center());
    EXPECT_EQ(text(), outside);
    EXPECT_FALSE(model().dirty());
    control(Key::Z);
    EXPECT_EQ(text(), mine);
}

TEST_F(EditorFilesTest, ARemovedFileStaysHereUnsaved) {
    const std::string before = text();
    fs::remove(path_);
    wait();
    EXPECT_TRUE(model().dirty());
    EXPECT_TRUE(said().isError);
    EXPECT_EQ(text(), before);
    control(Key::S);
    EXPECT_FALSE(model().dirty());
    EXPECT_EQ(onDisk(path_), before);
}

TEST_F(EditorFilesTest, ABrokenFileIsALineInTheLog) {
    const std::string before = text();
    std::ofstream(path_) << "{ \"lights\": [";
    wait();
    EXPECT_TRUE(said().isError);
    EXPECT_EQ(text(), before);
    EXPECT_TRUE(model().dirty());
}

TEST_F(EditorFilesTest, PresetsAreSavedListedUsedAndDeleted) {
    click(onRamp(0.3f));
    const std::string mine = text();
    click(mark("preset").center());
    click(mark("preset name").center());
    type("evening");
    press(Key::Enter);
    ASSERT_TRUE(fs::exists(folder_.file("data/lodestar/presets/evening.lodestar.json")))
        << said().text;
    click(mark("preset").center());
    click(mark("preset/Studio").center());
    EXPECT_NE(text(), mine);
    click(mark("preset").center());
    ASSERT_TRUE(has("preset/evening"));
    keep("presets");
    click(mark("preset/evening").center());
    EXPECT_EQ(text(), mine);
    click(mark("preset").center());
    click(mark("delete preset/evening").center());
    ASSERT_TRUE(has("preset/evening")) << "one click deletes nothing";
    click(mark("delete preset/evening").center());
    EXPECT_FALSE(fs::exists(folder_.file("data/lodestar/presets/evening.lodestar.json")));
    EXPECT_FALSE(has("preset/evening"));
    EXPECT_EQ(text(), mine);
}

TEST_F(EditorFilesTest, BadPresetsAreSentences) {
    for (const char* name : {"", "../up", ".hidden"}) {
        const std::size_t lines = editor_->workspace().log().size();
        click(mark("preset").center());
        click(mark("preset name").center());
        control(Key::A);
        press(Key::Backspace);
        type(name);
        press(Key::Enter);
        press(Key::Escape);
        // The same sentence is told once in a row.
        EXPECT_GE(editor_->workspace().log().size(), lines) << name;
        EXPECT_TRUE(said().isError) << name;
    }
    EXPECT_FALSE(fs::exists(folder_.file("data/up.lodestar.json")));
    fs::create_directories(folder_.file("data/lodestar/presets"));
    std::ofstream(folder_.file("data/lodestar/presets/bad.lodestar.json")) << "not json";
    click(mark("preset").center());
    EXPECT_FALSE(has("preset/bad"));
    EXPECT_NE(said().text.find("preset left out"), std::string::npos) << said().text;
}

TEST_F(EditorFilesTest, DroppedFilesAreOpenedOrPasted) {
    const document::Document before = model().document();
    const model::Id key = model().ids().lights[1].keys[0].id;
    const auto copied = model::copyGradient(model(), key);
    ASSERT_TRUE(copied.ok());
    std::ofstream(folder_.file("gradient.json")) << *copied;
    click(mark("key 0").center());
    send(platform::DropEvent{{folder_.file("gradient.json")}});
    settle();
    EXPECT_EQ(model().undoCount(), 1u) << said().text;
    EXPECT_EQ(editor_->title(), "sky.lodestar.json * - Lodestar") << "still the same document";
    control(Key::Z);
    ASSERT_EQ(model().document(), before);
    const std::size_t lines = editor_->workspace().log().size();
    std::ofstream(folder_.file("notes.txt")) << "words";
    send(platform::DropEvent{{folder_.file("notes.txt"), folder_.file("absent.gltf")}});
    finish();
    EXPECT_EQ(editor_->workspace().log().size(), lines + 3) << "two refusals, and what was begun";
    EXPECT_EQ(model().document(), before);
    EXPECT_FALSE(editor_->surroundings().work.has_value());
}

/// What is written ends after so many bytes of a file.
class FullDisk {
public:
    explicit FullDisk(rlim_t bytes) {
        handler_ = ::signal(SIGXFSZ, SIG_IGN);
        ::getrlimit(RLIMIT_FSIZE, &limit_);
        rlimit tight = limit_;
        tight.rlim_cur = bytes;
        ::setrlimit(RLIMIT_FSIZE, &tight);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;
    ~FullDisk() {
        ::setrlimit(RLIMIT_FSIZE, &limit_);
        ::signal(SIGXFSZ, handler_);
    }

private:
    rlimit limit_{};
    void (*handler_)(int) = nullptr;
};

TEST_F(EditorFilesTest, AFullDiskAndAReadOnlyFolderKeepTheDocument) {
    const std::string saved = onDisk(path_);
    click(onRamp(0.3f));
    const std::string mine = text();
    {
        const FullDisk full(64);
        control(Key::S);
        EXPECT_TRUE(said().isError);
        EXPECT_TRUE(model().dirty());
        control(Key::Q);
        settle();
        click(mark("Save and quit").center());
        EXPECT_FALSE(editor_->closing()) << "what could not be saved is not lost";
    }
    EXPECT_EQ(onDisk(path_), saved);
    EXPECT_EQ(text(), mine);
    if (::geteuid() != 0) { // root may write everywhere
        fs::permissions(folder_.path(), fs::perms::owner_read | fs::perms::owner_exec);
        control(Key::S);
        fs::permissions(folder_.path(), fs::perms::owner_all);
        EXPECT_TRUE(said().isError);
        EXPECT_TRUE(model().dirty());
    }
    EXPECT_EQ(onDisk(path_), saved);
    control(Key::S);
    EXPECT_EQ(onDisk(path_), mine);
}

TEST_F(EditorFilesTest, WhatIsThrownAwayIsNotOfferedAgain) {
    const fs::path side = model::autosavePath(path_);
    click(onRamp(0.3f));
    editor_->advance(0.01);
    for (int i = 0; i < 1000 && !fs::exists(side); ++i) { // 5 s of the clock
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        editor_->advance(0.01);
    }
    ASSERT_TRUE(fs::exists(side));
    control(Key::Q);
    settle();
    click(mark("Quit without saving").center());
    EXPECT_TRUE(editor_->closing());
    EXPECT_FALSE(fs::exists(side));
}

} // namespace
} // namespace lodestar::testing

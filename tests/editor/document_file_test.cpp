// SPDX-License-Identifier: MIT
//
// A document's file: saving, the side file, recovery, what others do, what a disk refuses.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "model/document_file.h"
#include "model_support.h"
#include "support/run.h"

namespace lodestar::model {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryFolder;

std::string contents(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void write(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

/// The time of a file, so many seconds after now.
void setTime(const fs::path& path, int seconds) {
    fs::last_write_time(path, fs::file_time_type::clock::now() + std::chrono::seconds(seconds));
}

std::size_t filesIn(const fs::path& folder) {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

/// A folder with a document that is open.
class DocumentFileTest : public ::testing::Test {
protected:
    DocumentFileTest() : path_(folder_.path() / "sky.lodestar.json") {
        write(path_, kDocument);
        reopen();
    }
    void reopen() {
        core::Tally warnings;
        auto opened = DocumentFile::open(path_, model_, warnings);
        ASSERT_TRUE(opened) << opened.error().message();
        file_ = std::move(*opened);
    }
    void edit(double ev) { did(model_, SetEnvironment{{}, {}, ev}); }
    bool autosaved(double now) {
        const auto wrote = file_.autosave(model_, now);
        EXPECT_TRUE(wrote) << (wrote ? "" : wrote.error().message());
        return wrote && *wrote;
    }
    /// The environment's EV of a file's document.
    static double evIn(const fs::path& path) { return documentOf(contents(path)).environment->ev; }

    TemporaryFolder folder_;
    fs::path path_;
    Model model_;
    DocumentFile file_;
};

TEST_F(DocumentFileTest, SavesAndReadsTheSameAgain) {
    edit(3.0);
    EXPECT_TRUE(model_.dirty());
    ASSERT_TRUE(file_.save(model_));
    EXPECT_FALSE(model_.dirty());
    EXPECT_EQ(contents(path_), textOf(model_));
    EXPECT_NE(contents(path_).find("\"secret\""), std::string::npos) << "what no version knows";
    const std::string text = textOf(model_);
    reopen();
    EXPECT_EQ(textOf(model_), text);
    EXPECT_EQ(model_.undoCount(), 0U);
    EXPECT_EQ(filesIn(folder_.path()), 1U);
}

TEST_F(DocumentFileTest, SavesAtAnotherPath) {
    edit(3.0);
    EXPECT_FALSE(autosaved(0.0));
    EXPECT_TRUE(autosaved(kAutosaveSeconds));
    EXPECT_TRUE(fs::exists(autosavePath(path_)));
    const fs::path other = folder_.path() / "other.lodestar.json";
    ASSERT_TRUE(file_.saveAs(model_, other));
    EXPECT_EQ(filesIn(folder_.path()), 2U) << "what is saved elsewhere is not offered here";
    EXPECT_EQ(file_.path(), other);
    EXPECT_EQ(contents(path_), kDocument);
    EXPECT_EQ(contents(other), textOf(model_));
    DocumentFile none;
    EXPECT_EQ(none.save(model_).error().code, core::ErrorCode::Usage);
    EXPECT_FALSE(none.recovery());
    EXPECT_EQ(none.poll(), Outside::Nothing);
}

TEST_F(DocumentFileTest, AFileThatIsNotThereIsAnEmptyDocument) {
    path_ = folder_.path() / "new.lodestar.json";
    reopen();
    EXPECT_EQ(model_.document(), document::Document{});
    EXPECT_FALSE(fs::exists(path_)) << "until it is saved";
    ASSERT_TRUE(file_.save(model_));
    EXPECT_TRUE(fs::exists(path_));
}

TEST_F(DocumentFileTest, WhatEditingStartsFromIsNoStepAndNotUnsaved) {
    const fs::path path = folder_.path() / "new.lodestar.json";
    Model model;
    core::Tally warnings;
    auto file = DocumentFile::open(path, model, warnings, documentOf(kDocument));
    ASSERT_TRUE(file);
    const std::string first = textOf(model);
    EXPECT_EQ(first, textOf(sampleModel()));
    EXPECT_FALSE(model.dirty());
    EXPECT_EQ(model.undoCount(), 0U);
    const auto written = file->autosave(model, 1000.0);
    EXPECT_TRUE(written && !*written);
    did(model, RemoveEnvironment{});
    EXPECT_TRUE(model.undo());
    EXPECT_EQ(textOf(model), first);
    ASSERT_TRUE(file->save(model));
    // One that is there stands for itself.
    ASSERT_TRUE(DocumentFile::open(path, model, warnings, {}));
    EXPECT_EQ(textOf(model), first);
}

TEST_F(DocumentFileTest, ABrokenFileLeavesTheModel) {
    const std::string text = textOf(model_);
    write(path_, "{\"lodestar\": 1, \"lights\": 3}");
    core::Tally warnings;
    const auto opened = DocumentFile::open(path_, model_, warnings);
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().file, path_.string());
    EXPECT_EQ(opened.error().where, "/lights");
    EXPECT_EQ(textOf(model_), text);
}

TEST_F(DocumentFileTest, TheSideFileIsWrittenAfterFiveSeconds) {
    const fs::path side = autosavePath(path_);
    EXPECT_FALSE(autosaved(100.0));
    edit(1.0);
    EXPECT_FALSE(autosaved(101.0));
    edit(1.5);
    EXPECT_FALSE(autosaved(105.9));
    EXPECT_FALSE(fs::exists(side));
    EXPECT_TRUE(autosaved(106.0)) << "from when it was first seen ahead";
    EXPECT_EQ(evIn(side), 1.5);
    EXPECT_FALSE(autosaved(200.0)) << "it has all";
    EXPECT_TRUE(model_.dirty()) << "the document itself is not saved";
    EXPECT_EQ(contents(path_), kDocument);
    edit(2.0);
    EXPECT_FALSE(autosaved(201.0));
    EXPECT_TRUE(autosaved(206.0));
    EXPECT_EQ(evIn(side), 2.0);
    ASSERT_TRUE(file_.save(model_));
    EXPECT_FALSE(fs::exists(side)) << "no more needed";
}

TEST_F(DocumentFileTest, TheSideFileIsWrittenAfterTwentyStrokes) {
    const MergeToken drag = model_.newToken();
    for (int frame = 0; frame < 100; ++frame) { // a drag is one
        ASSERT_TRUE(model_.execute(SetEnvironment{{}, {}, 30 + 0.01 * frame}, drag));
        ASSERT_FALSE(autosaved(0.001 * frame));
    }
    for (int stroke = 2; stroke <= 19; ++stroke) {
        edit(stroke);
        ASSERT_FALSE(autosaved(0.2)) << stroke;
    }
    edit(20.0);
    EXPECT_TRUE(autosaved(0.2));
    EXPECT_EQ(evIn(autosavePath(path_)), 20.0);
}

TEST_F(DocumentFileTest, UndoneToWhatIsSavedNeedsNoSideFile) {
    edit(1.0);
    EXPECT_FALSE(autosaved(0.0));
    EXPECT_TRUE(autosaved(5.0));
    EXPECT_TRUE(model_.undo());
    EXPECT_FALSE(autosaved(6.0));
    EXPECT_TRUE(autosaved(11.0));
    EXPECT_FALSE(fs::exists(autosavePath(path_)));
}

TEST_F(DocumentFileTest, WhatWasNotSavedIsRecovered) {
    edit(1.0);
    EXPECT_FALSE(autosaved(0.0));
    EXPECT_TRUE(autosaved(5.0));
    const std::string text = textOf(model_);
    reopen(); // after the program's death
    const auto found = file_.recovery();
    ASSERT_TRUE(found);
    ASSERT_TRUE(file_.recover(model_, *found));
    EXPECT_EQ(textOf(model_), text);
    EXPECT_TRUE(model_.dirty());
    EXPECT_TRUE(model_.undo()) << "it can be undone";
    EXPECT_EQ(model_.document(), documentOf(kDocument));
    EXPECT_TRUE(model_.redo());
    ASSERT_TRUE(file_.save(model_));
    reopen();
    EXPECT_EQ(textOf(model_), text);
    EXPECT_FALSE(file_.recovery());
}

TEST_F(DocumentFileTest, OnlyANewerAndDifferentSideFileIsOffered) {
    const fs::path side = autosavePath(path_);
    document::Document other = documentOf(kDocument);
    write(side, document::writeDocument(other)); // the same, written another way
    setTime(side, 10);
    reopen();
    EXPECT_FALSE(file_.recovery());
    other.environment->ev = 9.0;
    write(side, document::writeDocument(other));
    setTime(side, -10);
    reopen();
    EXPECT_FALSE(file_.recovery()) << "older";
    fs::last_write_time(side, fs::last_write_time(path_));
    EXPECT_TRUE(file_.recovery()) << "within one tick of the file system's clock";
    setTime(side, 10);
    EXPECT_TRUE(file_.recovery());
    file_.discardAutosave();
    EXPECT_FALSE(fs::exists(side));
    for (const char* text : {"", "{", "{\"lodestar\": 1, \"lights\": 3}"}) {
        write(side, text);
        setTime(side, 10);
        EXPECT_FALSE(file_.recovery()) << text;
    }
}

TEST_F(DocumentFileTest, TemporariesOfTheDeadAreTakenAway) {
    const pid_t dead = ::fork();
    if (dead == 0) {
        ::_exit(0);
    }
    ::waitpid(dead, nullptr, 0);
    const std::string of = path_.string() + ".tmp-" + std::to_string(dead) + "-0";
    const std::string sides = autosavePath(path_).string() + ".tmp-" + std::to_string(dead) + "-1";
    const std::string living = path_.string() + ".tmp-" + std::to_string(::getpid()) + "-0";
    const std::string foreign = path_.string() + ".tmp-notes";
    for (const std::string& each : {of, sides, living, foreign}) {
        write(each, "x");
    }
    reopen();
    EXPECT_FALSE(fs::exists(of));
    EXPECT_FALSE(fs::exists(sides));
    EXPECT_TRUE(fs::exists(living));
    EXPECT_TRUE(fs::exists(foreign));
}

TEST_F(DocumentFileTest, WhatOthersDoIsToldOnce) {
    EXPECT_EQ(file_.poll(), Outside::Nothing);
    edit(1.0);
    ASSERT_TRUE(file_.save(model_));
    EXPECT_EQ(file_.poll(), Outside::Nothing) << "our own";
    document::Document other = model_.document();
    other.environment->ev = -7.0;
    write(path_, document::writeDocument(other));
    setTime(path_, 10);
    EXPECT_EQ(file_.poll(), Outside::Changed);
    EXPECT_EQ(file_.poll(), Outside::Nothing);
    core::Tally warnings;
    ASSERT_TRUE(file_.reload(model_, warnings));
    EXPECT_EQ(model_.document(), other);
    EXPECT_FALSE(model_.dirty());
    EXPECT_TRUE(model_.undo()) << "one's own work is not lost";
    EXPECT_EQ(model_.document().environment->ev, 1.0);
    EXPECT_TRUE(model_.dirty());
    setTime(path_, 20);
    EXPECT_EQ(file_.poll(), Outside::Nothing) << "touched, not changed";
}

TEST_F(DocumentFileTest, AFileThatIsGoneKeepsTheDocument) {
    edit(1.0);
    ASSERT_TRUE(file_.save(model_));
    fs::remove(path_);
    EXPECT_EQ(file_.poll(), Outside::Removed);
    EXPECT_EQ(file_.poll(), Outside::Nothing);
    model_.markUnsaved();
    core::Tally warnings;
    const auto reloaded = file_.reload(model_, warnings);
    ASSERT_FALSE(reloaded);
    EXPECT_EQ(reloaded.error().file, path_.string());
    EXPECT_EQ(model_.document().environment->ev, 1.0);
    ASSERT_TRUE(file_.save(model_));
    EXPECT_EQ(evIn(path_), 1.0);
    EXPECT_EQ(file_.poll(), Outside::Nothing);
    fs::remove_all(folder_.path());
    edit(2.0);
    const auto saved = file_.save(model_);
    ASSERT_FALSE(saved) << "its folder is gone too";
    EXPECT_EQ(saved.error().code, core::ErrorCode::OutputFailed);
    EXPECT_TRUE(model_.dirty());
}

TEST_F(DocumentFileTest, AnotherProgramsNonsenseIsNotRead) {
    edit(1.0);
    write(path_, "{ half");
    setTime(path_, 10);
    EXPECT_EQ(file_.poll(), Outside::Changed);
    core::Tally warnings;
    EXPECT_FALSE(file_.reload(model_, warnings));
    EXPECT_EQ(model_.document().environment->ev, 1.0);
    EXPECT_TRUE(model_.dirty());
}

/// Makes every write fail for as long as it lives.
class FullDisk {
public:
    FullDisk() {
        // A limit on file size fails the write with EFBIG where a full disk gives ENOSPC.
        ::signal(SIGXFSZ, SIG_IGN);
        ::getrlimit(RLIMIT_FSIZE, &limit_);
        const rlimit tight{100, limit_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &tight);
    }
    ~FullDisk() { ::setrlimit(RLIMIT_FSIZE, &limit_); }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;

private:
    rlimit limit_{};
};

TEST_F(DocumentFileTest, AFullDiskLeavesTheOldFileAndTheDocument) {
    edit(1.0);
    EXPECT_FALSE(autosaved(0.0));
    {
        const FullDisk full;
        const auto saved = file_.save(model_);
        ASSERT_FALSE(saved);
        EXPECT_EQ(saved.error().code, core::ErrorCode::OutputFailed);
        EXPECT_EQ(saved.error().file, path_.string());
        const auto side = file_.autosave(model_, 6.0);
        ASSERT_FALSE(side);
        const auto again = file_.autosave(model_, 7.0);
        ASSERT_TRUE(again) << "told once";
        EXPECT_FALSE(*again);
        EXPECT_FALSE(file_.autosave(model_, 6.0 + kAutosaveRetrySeconds))
            << "and tried again later";
    }
    EXPECT_EQ(contents(path_), kDocument);
    EXPECT_EQ(filesIn(folder_.path()), 1U) << "no half-written file stays";
    EXPECT_TRUE(model_.dirty());
    EXPECT_EQ(model_.document().environment->ev, 1.0);
    EXPECT_FALSE(autosaved(40.0));
    EXPECT_TRUE(autosaved(6.0 + 2 * kAutosaveRetrySeconds));
    ASSERT_TRUE(file_.save(model_));
    EXPECT_EQ(evIn(path_), 1.0);
}

TEST_F(DocumentFileTest, AFolderThatMayNotBeWrittenRefusesBoth) {
    edit(1.0);
    EXPECT_FALSE(autosaved(0.0));
    fs::permissions(folder_.path(), fs::perms(0555));
    const bool root = ::geteuid() == 0; // whom no permission holds
    if (root) {
        ASSERT_EQ(::seteuid(65534), 0);
    }
    const auto saved = file_.save(model_);
    const auto side = file_.autosave(model_, 6.0);
    if (root) {
        ASSERT_EQ(::seteuid(0), 0);
    }
    fs::permissions(folder_.path(), fs::perms(0755));
    ASSERT_FALSE(saved);
    EXPECT_EQ(saved.error().code, core::ErrorCode::OutputFailed);
    EXPECT_FALSE(side);
    EXPECT_TRUE(model_.dirty());
    EXPECT_EQ(contents(path_), kDocument);
    ASSERT_TRUE(file_.save(model_));
}

TEST_F(DocumentFileTest, ADeviceIsNotReplacedByAFile) {
    edit(1.0);
    const auto saved = file_.saveAs(model_, "/dev/full");
    ASSERT_FALSE(saved);
    EXPECT_EQ(file_.path(), path_);
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
    EXPECT_TRUE(model_.dirty());
}

} // namespace
} // namespace lodestar::model

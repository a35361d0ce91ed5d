// SPDX-License-Identifier: MIT
//
// `lodestar edit` in a real window on a virtual display: a user's way through it, each step seen in
// the part of the window where it must be.
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <future>

#include <gtest/gtest.h>

#include "core/tally.h"
#include "io/document_file.h"
#include "support/picture.h"
#include "support/run.h"
#include "support/virtual_display.h"

namespace lodestar::testing {
namespace {

constexpr int kWidth = 1200, kHeight = 760;
constexpr double kSteps = 2.0 / 255.0; ///< one step of rounding on either side

/// Places of the layout at that size, in pixels: what editor_ui_test finds by name.
constexpr std::array<int, 4> kViewport{250, 30, 560, 410};
constexpr std::array<int, 4> kStrip{835, 145, 354, 80};

class EditorWindow : public ::testing::Test {
protected:
    void SetUp() override {
        if (const std::string missing = missingPrograms(); !missing.empty()) {
            GTEST_SKIP() << missing;
        }
        display_ = std::make_unique<VirtualDisplay>();
        ASSERT_TRUE(display_->isReady()) << "Xvfb or openbox did not start";
        run();
    }
    void TearDown() override {
        display_.reset(); // whoever still shows a window there ends
        if (run_.valid()) {
            run_.wait();
        }
    }
    void run() {
        run_ = std::async(std::launch::async, [this] {
            return runLodestar({"edit", "--lighting", file_}, {"DISPLAY=" + display_->name()},
                               400.0);
        });
        ASSERT_TRUE(soon([this] {
            window_ = output("xdotool search --onlyvisible --class lodestar");
            window_ = window_.substr(0, window_.find('\n'));
            return !window_.empty();
        })) << "no window";
        output("xdotool windowsize --sync " + window_ + " " + std::to_string(kWidth) + " " +
               std::to_string(kHeight));
        ASSERT_TRUE(soon([this] {
            const core::Image now = shown();
            return now.width() == kWidth && now.height() == kHeight && isLit(now);
        })) << "nothing is shown";
        rest();
    }
    /// Waits until two pictures in a row are the same.
    void rest() {
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        core::Image last = shown();
        EXPECT_TRUE(soon([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(300));
            core::Image now = shown();
            const bool same = now.pixels() == last.pixels();
            last = std::move(now);
            return same;
        })) << "an editor at rest goes on drawing";
    }
    /// Whether some of the viewport is bright.
    static bool isLit(const core::Image& image) {
        const core::Image view = part(image, kViewport);
        return std::any_of(view.pixels().begin(), view.pixels().end(),
                           [](float value) { return value > 0.5f; });
    }
    void key(const std::string& name) {
        // As a keyboard's, not sent to the window: the modifiers are then the server's.
        output("xdotool windowactivate --sync " + window_ + " key --delay 100 " + name);
        rest();
    }
    void click(int x, int y) {
        output("xdotool mousemove --window " + window_ + " " + std::to_string(x) + " " +
               std::to_string(y) + " sleep 0.2 mousedown 1 sleep 0.2 mouseup 1");
        rest();
    }
    void drag(int x0, int y0, int x1, int y1) {
        const auto at = [&](int x, int y) {
            return "mousemove --window " + window_ + " " + std::to_string(x) + " " +
                   std::to_string(y) + " sleep 0.2 ";
        };
        output("xdotool " + at(x0, y0) + "mousedown 1 sleep 0.2 " +
               at((x0 + x1) / 2, (y0 + y1) / 2) + at(x1, y1) + "mouseup 1");
        rest();
    }
    /// Where LODESTAR_SCREENSHOTS names a folder, what is shown is left there to be looked at.
    void keep(const std::string& name) {
        if (const char* folder = std::getenv("LODESTAR_SCREENSHOTS")) {
            output("import -window " + window_ + " " + std::string(folder) + "/window-" + name +
                   ".png");
        }
    }
    core::Image shown() {
        const std::string path = folder_.file("shown.png");
        std::filesystem::remove(path);
        output("import -window " + window_ + " -depth 8 png24:" + path);
        return std::filesystem::exists(path) ? readPicture(path) : core::Image();
    }
    static core::Image part(const core::Image& whole, const std::array<int, 4>& place) {
        core::Image cut(place[2], place[3], whole.channels());
        for (int y = 0; y < cut.height() && place[1] + y < whole.height(); ++y) {
            for (int x = 0; x < cut.width() && place[0] + x < whole.width(); ++x) {
                std::copy_n(whole.at(place[0] + x, place[1] + y), whole.channels(), cut.at(x, y));
            }
        }
        return cut;
    }
    /// The share of a part that differs from an earlier picture.
    double changed(const core::Image& before, const std::array<int, 4>& place) {
        return compare(part(shown(), place), part(before, place), kSteps).failingFraction;
    }
    document::Document saved() {
        core::Tally warnings;
        auto document = io::loadDocument(file_, warnings);
        EXPECT_TRUE(document.ok()) << (document ? "" : document.error().message());
        return document ? *document : document::Document{};
    }

    TemporaryFolder folder_;
    std::string file_ = folder_.file("sky.lodestar.json");
    std::unique_ptr<VirtualDisplay> display_;
    std::string window_;
    std::future<RunResult> run_;
};

TEST_F(EditorWindow, PaintsUndoesSavesAndCloses) {
    const core::Image first = shown();
    keep("1-first");
    click(kStrip[0] + 88, kStrip[1] + 20); // a stop at 45 degrees
    EXPECT_GT(changed(first, kStrip), 0.0005) << "no stop was added";

    const core::Image added = shown();
    key("b");
    drag(kStrip[0] + 30, kStrip[1] + 20, kStrip[0] + 130, kStrip[1] + 20); // white over the sky
    EXPECT_GT(changed(added, kStrip), 0.08) << "the strip was not painted";
    EXPECT_GT(changed(added, kViewport), 0.2) << "the scene does not show what was painted";

    keep("2-painted");
    key("ctrl+z");
    // A picture that has just changed may have fewer samples at its edges.
    EXPECT_LT(changed(added, kViewport), 0.03) << "undo does not lead back";
    key("ctrl+shift+z");
    EXPECT_GT(changed(added, kViewport), 0.2) << "redo does not lead there";

    const core::Image painted = shown();
    drag(400, 515, 330, 515); // the day, to the morning
    EXPECT_GT(changed(painted, kViewport), 0.2) << "another hour looks the same";
    drag(330, 515, 662, 515);

    EXPECT_FALSE(std::filesystem::exists(file_));
    key("ctrl+s");
    ASSERT_TRUE(soon([this] { return std::filesystem::exists(file_); })) << "not saved";
    const document::Document document = saved();
    ASSERT_EQ(document.lights.size(), 2u);
    std::size_t white = 0; // stops that the brush left: radiance 1 in all channels
    for (const document::Key& key : document.lights[0].keys) {
        white += static_cast<std::size_t>(std::count_if(
            key.gradient.stops.begin(), key.gradient.stops.end(), [](const document::Stop& stop) {
                return stop.stop.color == glm::dvec3(1.0) && stop.stop.ev == 0.0;
            }));
    }
    EXPECT_GE(white, 2u) << "what was painted is not in the file";
    EXPECT_FALSE(std::filesystem::exists("imgui.ini"));

    do {
        output("xdotool windowactivate --sync " + window_ + " key alt+F4");
    } while (run_.wait_for(std::chrono::seconds(2)) != std::future_status::ready);
    RunResult ended = run_.get();
    EXPECT_EQ(ended.status, 0) << ended.err;
    EXPECT_EQ(ended.err, "");
}

TEST(Editor, WithoutADisplayItSaysSoAndIsStatusFour) {
    const RunResult run = runLodestar({"edit"}, {"DISPLAY="});
    EXPECT_EQ(run.status, 4);
    ASSERT_EQ(run.errorLines().size(), 1u) << run.err;
    EXPECT_NE(run.err.find("display"), std::string::npos) << run.err;
}

} // namespace
} // namespace lodestar::testing

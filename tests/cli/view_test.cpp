// SPDX-License-Identifier: MIT
//
// The viewer in a real window on a virtual display, driven by synthetic input.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <future>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/picture.h"
#include "support/run.h"
#include "support/virtual_display.h"

namespace lodestar::testing {
namespace {

constexpr double kSteps = 2.0 / 255.0; ///< one step of rounding on either side
const std::string kEnvironment = "faces:1/0.1/0.1;0.1/1/0.1;0.2/0.4/1;1/1/0.2;0.2/1/1;1/0.3/1";

/// A tetrahedron, its four triangles facing outwards.
std::string tetrahedron(const TemporaryFolder& folder) {
    const float a[3] = {1, 1, 1}, b[3] = {-1, -1, 1}, c[3] = {-1, 1, -1}, d[3] = {1, -1, -1};
    const float* corners[] = {a, c, b, a, b, d, a, d, c, b, c, d};
    std::ofstream buffer(folder.file("solid.bin"), std::ios::binary);
    for (const float* corner : corners) {
        buffer.write(reinterpret_cast<const char*>(corner), 3 * sizeof(float));
    }
    std::ofstream(folder.file("solid.gltf")) << R"({"asset":{"version":"2.0"},"scene":0,
"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
"materials":[{"pbrMetallicRoughness":{"metallicFactor":1,"roughnessFactor":0.5}}],
"buffers":[{"uri":"solid.bin","byteLength":144}],"bufferViews":[{"buffer":0,"byteLength":144}],
"accessors":[{"bufferView":0,"componentType":5126,"count":12,"type":"VEC3",
"min":[-1,-1,-1],"max":[1,1,1]}]})";
    return folder.file("solid.gltf");
}

/// `lodestar view` of the tetrahedron, running in the folder.
class ViewerRun : public ::testing::Test {
protected:
    void SetUp() override {
        if (const std::string missing = missingPrograms(); !missing.empty()) {
            GTEST_SKIP() << missing;
        }
        display_ = std::make_unique<VirtualDisplay>();
        ASSERT_TRUE(display_->isReady()) << "Xvfb or openbox did not start";
        scene_ = tetrahedron(folder_);
        before_ = std::filesystem::current_path();
        std::filesystem::current_path(folder_.file("."));
        run_ = std::async(std::launch::async, [this] {
            return runLodestar({"view", scene_, "--environment", kEnvironment, "--size", "320x240",
                                "--stats", folder_.file("stats.json")},
                               {"DISPLAY=" + display_->name()}, 400.0);
        });
        ASSERT_TRUE(soon([this] {
            window_ = output("xdotool search --onlyvisible --class lodestar");
            window_ = window_.substr(0, window_.find('\n'));
            return !window_.empty();
        })) << "no window";
    }
    void TearDown() override {
        display_.reset(); // whoever still shows a window there ends
        if (run_.valid()) {
            run_.wait();
        }
        if (!before_.empty()) {
            std::filesystem::current_path(before_);
        }
    }
    void key(const std::string& name) { output("xdotool key --window " + window_ + " " + name); }
    /// What the window shows.
    core::Image shown() {
        const std::string path = folder_.file("shown.png");
        output("import -window " + window_ + " -depth 8 png24:" + path);
        return std::filesystem::exists(path) ? readPicture(path) : core::Image();
    }
    /// Waits for a picture that differs from another on so much of its area.
    bool differsSoon(const core::Image& picture, double atLeast, double atMost) {
        return soon([&] {
            const core::Image now = shown();
            if (now.width() != picture.width() || now.height() != picture.height()) {
                return false;
            }
            const double fraction = compare(now, picture, kSteps).failingFraction;
            return fraction >= atLeast && fraction <= atMost;
        });
    }
    core::Image rendered(const std::string& size) {
        const RunResult run = runLodestar({"render", scene_, "--environment", kEnvironment,
                                           "--size", size, "-o", folder_.file("rendered.png")});
        EXPECT_EQ(run.status, 0) << run.err;
        return readPicture(folder_.file("rendered.png"));
    }

    TemporaryFolder folder_;
    std::unique_ptr<VirtualDisplay> display_;
    std::filesystem::path before_;
    std::string scene_;
    std::string window_;
    std::future<RunResult> run_;
};

TEST_F(ViewerRun, ShowsOrbitsChoosesResizesSavesAndCloses) {
    const core::Image still = rendered("320x240");
    key("Tab"); // no text over the picture
    EXPECT_TRUE(differsSoon(still, 0.0, 0.001)) << "the window does not show what render gives";
    key("p");
    ASSERT_TRUE(soon([] { return std::filesystem::exists("solid-001.png"); }));
    EXPECT_LT(compare(readPicture("solid-001.png"), still, kSteps).failingFraction, 0.001);

    output("xdotool mousemove --window " + window_ + " 160 120 mousedown 1 sleep 0.1 " +
           "mousemove_relative --sync 50 20 sleep 0.1 mousemove_relative --sync 30 0 sleep 0.1 "
           "mouseup 1");
    EXPECT_TRUE(differsSoon(still, 0.1, 1.0)) << "a drag did not orbit";
    std::this_thread::sleep_for(std::chrono::milliseconds(1500)); // idle

    const core::Image orbited = shown();
    key("2"); // mip
    EXPECT_TRUE(differsSoon(orbited, 0.01, 1.0)) << "another estimator looks the same";
    key("Home");
    key("1");
    EXPECT_TRUE(differsSoon(still, 0.0, 0.001)) << "Home and 1 do not lead back";
    key("F1");
    EXPECT_TRUE(differsSoon(still, 0.1, 1.0)) << "no help is shown";
    key("F1");
    EXPECT_TRUE(differsSoon(still, 0.0, 0.001)) << "the help stays";
    key("2");
    output("xdotool windowsize " + window_ + " 400 260");
    EXPECT_TRUE(soon([this] { return shown().width() == 400; })) << "not resized";
    key("Escape");

    const RunResult run = run_.get();
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err, "");
    std::ifstream file(folder_.file("stats.json"));
    const nlohmann::json stats = nlohmann::json::parse(file);
    EXPECT_EQ(stats.at("estimators").at("specular"), "mip");
    EXPECT_EQ(stats.at("counters").at("gl_errors"), 0);
    EXPECT_EQ(stats.at("screenshots"), 1);
    double longest = 0.0;
    for (std::size_t i = 1; i < stats.at("frames").size(); ++i) {
        longest = std::max(longest, stats.at("frames")[i].at("at_s").get<double>() -
                                        stats.at("frames")[i - 1].at("at_s").get<double>());
    }
    EXPECT_GT(longest, 1.0) << "frames were drawn while nothing happened";
    // Some 20 events were sent, each of which may ask for two frames and a finer one behind; a
    // viewer that redraws while it waits draws more than these in the idle second and a half alone.
    EXPECT_LT(stats.at("frames_drawn").get<int>(), 60);
    EXPECT_GT(stats.at("times_ms").at("draw"), 0.0);
    EXPECT_FALSE(std::filesystem::exists("imgui.ini"));
}

TEST_F(ViewerRun, TheWindowManagersCloseEndsItWithStatusZero) {
    output("xdotool windowactivate --sync " + window_);
    // On a busy machine the window manager may not have grabbed its keys yet: asked until it
    // answers.
    do {
        output("xdotool key alt+F4");
    } while (run_.wait_for(std::chrono::seconds(2)) != std::future_status::ready);
    const RunResult run = run_.get();
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_TRUE(std::filesystem::exists(folder_.file("stats.json")));
}

TEST(Viewer, WithoutADisplayItSaysSoAndIsStatusFour) {
    const TemporaryFolder folder;
    const RunResult run = runLodestar({"view", tetrahedron(folder)}, {"DISPLAY="});
    EXPECT_EQ(run.status, 4);
    ASSERT_EQ(run.errorLines().size(), 1u) << run.err;
    EXPECT_NE(run.err.find("display"), std::string::npos) << run.err;
}

/// The rows above a picture's legend.
core::Image upperPart(const core::Image& picture) {
    core::Image part(320, 190, picture.channels());
    std::copy_n(picture.pixels().begin(), part.pixels().size(), part.pixels().begin());
    return part;
}

TEST_F(ViewerRun, ShowsTheErrorThatRenderWrites) {
    const RunResult run =
        runLodestar({"render", scene_, "--environment", kEnvironment, "--size", "320x240", "-o",
                     folder_.file("rendered.png"), "--error-view", folder_.file("error.png")});
    ASSERT_EQ(run.status, 0) << run.err;
    const core::Image error = upperPart(readPicture(folder_.file("error.png")));
    const core::Image still = readPicture(folder_.file("rendered.png"));
    key("Tab"); // no text over the picture
    EXPECT_TRUE(differsSoon(still, 0.0, 0.001)) << "the window does not show what render gives";
    key("v");
    EXPECT_TRUE(soon([&] {
        const core::Image now = shown();
        return now.width() == 320 && now.height() == 240 &&
               compare(upperPart(now), error, kSteps).failingFraction <= 0.001;
    })) << "the passes do not come to what render draws";
    key("v");
    EXPECT_TRUE(differsSoon(still, 0.0, 0.001)) << "V does not lead back";
    key("Escape");
    EXPECT_EQ(run_.get().status, 0);
}

} // namespace
} // namespace lodestar::testing

// SPDX-License-Identifier: MIT
//
// The viewer without its window: what it answers to events.
#include <algorithm>
#include <fstream>

#include <nlohmann/json.hpp>

#include "app/viewer.h"
#include "support/gl_fixture.h"
#include "support/run.h"

namespace lodestar::app {
namespace {

using platform::Key;
using platform::PointerButton;

class ViewerTest : public testing::GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        if (IsSkipped() || HasFatalFailure()) {
            return;
        }
        ViewerOptions options;
        options.scene.scene = sceneFile("first.gltf", "First");
        options.scene.environment = "gradient:0.1,1";
        options.scene.size = "64x48";
        auto loaded = load(options.scene);
        ASSERT_TRUE(loaded.ok()) << loaded.error().message();
        auto viewer = Viewer::make(device(), std::move(*loaded), options);
        ASSERT_TRUE(viewer.ok()) << viewer.error().message();
        viewer_ = std::move(*viewer);
    }
    void TearDown() override {
        viewer_.reset();
        GlTest::TearDown();
    }
    std::string sceneFile(const std::string& file, const std::string& name) {
        const std::string path = folder_.file(file);
        std::ofstream(path) << R"({"asset":{"version":"2.0"},"scenes":[{"name":")" + name +
                                   R"(","nodes":[0,1]},{"name":"Other","nodes":[1]}],"scene":0,
"cameras":[{"type":"perspective","perspective":{"yfov":0.5,"znear":0.1}}],
"nodes":[{"camera":0,"name":"left","translation":[-3,0,0]},
{"camera":0,"name":"right","translation":[3,0,0]}]})";
        return path;
    }
    /// A camera that three animations move along x: "far" 0 to 100 in 2 s, "near" 1 to 2 in 1 s,
    /// "pose" to 7 by its only key.
    std::string movingFile() {
        const float numbers[] = {0, 2, 0, 1, 0, 0, 0, 0, 100, 0, 0, 1, 0, 0, 2, 0, 0, 7, 0, 0};
        const std::string bytes(reinterpret_cast<const char*>(numbers), sizeof numbers);
        std::ofstream(folder_.file("moving.bin"), std::ios::binary) << bytes;
        const auto animation = [](const char* name, int input, int output) {
            return std::string(R"({"name":")") + name +
                   R"(","channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}],)" +
                   R"("samplers":[{"input":)" + std::to_string(input) + R"(,"output":)" +
                   std::to_string(output) + "}]}";
        };
        const std::string path = folder_.file("moving.gltf");
        std::ofstream(path) << R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"scene":0,
"cameras":[{"type":"perspective","perspective":{"yfov":0.5,"znear":0.1}}],
"nodes":[{"camera":0,"translation":[-5,0,0]}],
"buffers":[{"uri":"moving.bin","byteLength":80}],
"bufferViews":[{"buffer":0,"byteLength":8},{"buffer":0,"byteOffset":8,"byteLength":8},
{"buffer":0,"byteOffset":20,"byteLength":24},{"buffer":0,"byteOffset":44,"byteLength":24},
{"buffer":0,"byteOffset":68,"byteLength":12},{"buffer":0,"byteLength":4}],
"accessors":[{"bufferView":0,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[2]},
{"bufferView":1,"componentType":5126,"count":2,"type":"SCALAR","min":[0],"max":[1]},
{"bufferView":2,"componentType":5126,"count":2,"type":"VEC3"},
{"bufferView":3,"componentType":5126,"count":2,"type":"VEC3"},
{"bufferView":4,"componentType":5126,"count":1,"type":"VEC3"},
{"bufferView":5,"componentType":5126,"count":1,"type":"SCALAR","min":[0],"max":[0]}],
"animations":[)" << animation("far", 0, 2)
                            << "," << animation("near", 1, 3) << "," << animation("pose", 5, 4)
                            << "]}";
        return path;
    }
    void press(Key key, platform::Modifiers modifiers = {}) {
        viewer_->handle(platform::KeyEvent{key, true, false, modifiers});
        viewer_->handle(platform::KeyEvent{key, false, false, modifiers});
    }
    void drop(const std::string& path) { viewer_->handle(platform::DropEvent{{path}}); }

    testing::TemporaryFolder folder_;
    std::unique_ptr<Viewer> viewer_;
};

TEST_F(ViewerTest, ABrokenFileIsSaidInOneLineAndNothingIsLost) {
    const std::string title = viewer_->title();
    std::ofstream(folder_.file("broken.glb")) << "glTF, but not really";
    std::ofstream(folder_.file("broken.hdr")) << "#?RADIANCE and nothing more";
    for (const char* name : {"broken.glb", "broken.hdr", "missing.gltf", "notes.txt"}) {
        drop(folder_.file(name));
        const OverlayText text = viewer_->text();
        EXPECT_TRUE(text.messageIsError) << name;
        EXPECT_NE(text.message.find(name), std::string::npos) << text.message;
        EXPECT_EQ(text.message.find('\n'), std::string::npos) << text.message;
        EXPECT_EQ(viewer_->title(), title);
        EXPECT_EQ(viewer_->stats().at("environment"), "gradient:0.1,1");
        EXPECT_TRUE(viewer_->wantsFrame());
        EXPECT_FALSE(viewer_->closing());
    }
}

TEST_F(ViewerTest, ADroppedSceneIsShown) {
    drop(sceneFile("second.gltf", "Second"));
    EXPECT_FALSE(viewer_->text().messageIsError) << viewer_->text().message;
    EXPECT_EQ(viewer_->title().rfind("second.gltf", 0), 0u);
    EXPECT_EQ(viewer_->text().lines.front(), "second.gltf: Second");
}

TEST_F(ViewerTest, CamerasAndScenesGoRound) {
    EXPECT_FLOAT_EQ(viewer_->view().position.x, -3.0f);
    press(Key::C);
    EXPECT_FLOAT_EQ(viewer_->view().position.x, 3.0f) << "of two without names of their own";
    press(Key::C);
    EXPECT_FLOAT_EQ(viewer_->view().position.x, -3.0f);
    press(Key::C, {true, false, false});
    EXPECT_FLOAT_EQ(viewer_->view().position.x, 3.0f);
    press(Key::PageDown);
    EXPECT_EQ(viewer_->text().lines.front(), "first.gltf: Other");
    press(Key::PageDown);
    EXPECT_EQ(viewer_->text().lines.front(), "first.gltf: First");
    press(Key::PageUp);
    EXPECT_EQ(viewer_->text().lines.front(), "first.gltf: Other");
}

TEST_F(ViewerTest, AnimationsPlayScrubAndGoRound) {
    drop(movingFile());
    ASSERT_FALSE(viewer_->text().messageIsError) << viewer_->text().message;
    const scene::View rest = viewer_->view();
    press(Key::Space); // "far", of 2 seconds: a camera that goes to x = 100
    EXPECT_EQ(viewer_->patience(), 0.0);
    viewer_->advance(0.5);
    EXPECT_FLOAT_EQ(viewer_->view().position.x, 25.0f);
    viewer_->advance(1.75); // round its end
    EXPECT_FLOAT_EQ(viewer_->view().position.x, 12.5f);
    press(Key::Space);
    viewer_->advance(0.5);
    EXPECT_FLOAT_EQ(viewer_->view().position.x, 12.5f) << "it is paused";
    press(Key::Period);
    EXPECT_FLOAT_EQ(viewer_->view().position.x, 15.0f);
    press(Key::Comma);
    press(Key::Comma);
    EXPECT_FLOAT_EQ(viewer_->view().position.x, 10.0f);
    press(Key::N); // "near" begins at its start
    EXPECT_FLOAT_EQ(viewer_->view().position.x, 1.0f);
    press(Key::N); // of one key: a pose, which does not play
    press(Key::Space);
    viewer_->setSize(0, 0, 1.0f); // takes the frames that are still wanted out of the question
    viewer_->advance(1.0);
    EXPECT_FLOAT_EQ(viewer_->view().position.x, 7.0f);
    const std::vector<std::string> lines = viewer_->text().lines;
    EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const std::string& line) {
        return line.find("paused") != std::string::npos;
    }));
    press(Key::N);
    press(Key::PageDown); // read again: at rest
    EXPECT_EQ(viewer_->view().position, rest.position);
}

TEST_F(ViewerTest, GoesOnFromTheSceneAndCameraOfTheCommandLine) {
    ViewerOptions options;
    options.scene.scene = folder_.file("first.gltf");
    options.scene.sceneName = "Other";
    options.scene.camera = "right";
    options.scene.size = "64x48";
    auto loaded = load(options.scene);
    ASSERT_TRUE(loaded.ok()) << loaded.error().message();
    viewer_.reset(); // one overlay at a time
    viewer_ = std::move(*Viewer::make(device(), std::move(*loaded), options));
    EXPECT_EQ(viewer_->text().lines.front(), "first.gltf: Other");
    press(Key::PageDown);
    EXPECT_EQ(viewer_->text().lines.front(), "first.gltf: First");
    options.scene.sceneName.clear();
    loaded = load(options.scene);
    ASSERT_TRUE(loaded.ok());
    viewer_.reset(); // one overlay at a time
    viewer_ = std::move(*Viewer::make(device(), std::move(*loaded), options));
    EXPECT_FLOAT_EQ(viewer_->view().position.x, 3.0f);
    press(Key::C);
    EXPECT_FLOAT_EQ(viewer_->view().position.x, -3.0f);
}

TEST_F(ViewerTest, PointerAndHeldKeysMoveTheCameraAndHomeResetsIt) {
    const scene::View before = viewer_->view();
    viewer_->handle(platform::MotionEvent{30, 20});
    viewer_->handle(platform::MotionEvent{40, 20});
    EXPECT_EQ(viewer_->view().cameraFromWorld, before.cameraFromWorld) << "no button is held";
    for (PointerButton button :
         {PointerButton::Left, PointerButton::Middle, PointerButton::Right}) {
        viewer_->handle(platform::MotionEvent{10, 20});
        viewer_->handle(platform::ButtonEvent{button, true, {}});
        viewer_->handle(platform::MotionEvent{40, 25});
        viewer_->handle(platform::ButtonEvent{button, false, {}});
        EXPECT_NE(viewer_->view().cameraFromWorld, before.cameraFromWorld);
        press(Key::Home);
        EXPECT_EQ(viewer_->view().cameraFromWorld, before.cameraFromWorld);
    }
    viewer_->handle(platform::WheelEvent{1.0});
    EXPECT_NE(viewer_->view().position, before.position);
    press(Key::Home);
    viewer_->handle(platform::KeyEvent{Key::W, true, false, {}});
    viewer_->advance(0.1);
    EXPECT_EQ(viewer_->view().position, before.position) << "without the right button";
    viewer_->handle(platform::ButtonEvent{PointerButton::Right, true, {}});
    viewer_->advance(0.1);
    const float once = before.position.z - viewer_->view().position.z;
    EXPECT_GT(once, 0.0f);
    viewer_->handle(platform::FocusLostEvent{});
    viewer_->advance(0.1);
    EXPECT_FLOAT_EQ(before.position.z - viewer_->view().position.z, once) << "a key got stuck";
}

TEST_F(ViewerTest, TheHourMovesByKeysAndPlays) {
    const auto hourLine = [&] {
        for (const std::string& line : viewer_->text().lines) {
            if (line.find("hour") != std::string::npos) {
                return line;
            }
        }
        return std::string();
    };
    EXPECT_EQ(hourLine(), "no hour: no lighting document");
    press(Key::Y);
    EXPECT_EQ(hourLine(), "no hour: no lighting document");
    std::ofstream(folder_.file("second.lodestar.json"))
        << R"({"lodestar":1,"lights":[{"kind":"sky","keys":[{"hour":6,"gradient":{"stops":[
{"at":90,"color":[1,1,1]}]}},{"hour":18,"gradient":{"stops":[{"at":90,"color":[2,2,2]}]}}]}]})";
    drop(sceneFile("second.gltf", "Second"));
    EXPECT_EQ(hourLine(), "hour      15:00");
    press(Key::T);
    EXPECT_EQ(hourLine(), "hour      15:15");
    press(Key::T, {true, false, false});
    press(Key::T, {true, false, false});
    EXPECT_EQ(hourLine(), "hour      14:45");
    press(Key::Y);
    EXPECT_EQ(viewer_->patience(), 0.0);
    viewer_->advance(25.0); // ten hours at 0.4 a second
    EXPECT_EQ(hourLine(), "hour      00:45, 0.4 hours a second");
    press(Key::Y, {true, false, false});
    viewer_->advance(1.0);
    EXPECT_EQ(hourLine(), "hour      02:21, 1.6 hours a second");
    press(Key::Y);
    EXPECT_EQ(hourLine(), "hour      02:21");
}

TEST_F(ViewerTest, KeysChooseAndClose) {
    press(Key::Digit2);
    press(Key::Digit3, {true, false, false});
    EXPECT_EQ(viewer_->stats().at("estimators").at("specular"), "mip");
    EXPECT_EQ(viewer_->stats().at("estimators").at("diffuse"), "lowest-mip");
    const auto shows = [this](const std::string& line) {
        const std::vector<std::string> lines = viewer_->text().lines;
        return std::find(lines.begin(), lines.end(), line) != lines.end();
    };
    EXPECT_TRUE(shows("forms     lobes power, Fresnel schlick"));
    press(Key::G);
    press(Key::G, {true, false, false});
    EXPECT_TRUE(shows("forms     lobes sg, Fresnel sg"));
    press(Key::G);
    EXPECT_TRUE(shows("forms     lobes power, Fresnel sg"));
    press(Key::F1);
    EXPECT_TRUE(viewer_->text().help);
    press(Key::H);
    EXPECT_FALSE(viewer_->text().help);
    press(Key::F11);
    EXPECT_TRUE(viewer_->fullScreen());
    viewer_->setSize(0, 0, 1.0f); // minimised
    press(Key::P);
    EXPECT_EQ(viewer_->stats().at("screenshots"), 0);
    press(Key::F);
    EXPECT_FALSE(viewer_->closing());
    press(Key::Escape);
    EXPECT_TRUE(viewer_->closing());
}

} // namespace
} // namespace lodestar::app

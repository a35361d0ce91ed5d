// SPDX-License-Identifier: MIT
//
// How scenes are opened beside the frames: by synthetic events, cancelled, refused.
#include <fstream>

#include <epoxy/gl.h>

#include "editor/ui/editor_fixture.h"
#include "support/shared.h"

namespace lodestar::testing {
namespace {

namespace fs = std::filesystem;
using platform::Key;

class OpenSceneTest : public EditorTest {
protected:
    /// Asks for a file, and shows that it is.
    void drop(const fs::path& path) {
        send(platform::DropEvent{{path.string()}});
        draw();
    }
    [[nodiscard]] static fs::path gltf(const std::string& name) {
        return sharedPath(("assets/gltf/" + name).c_str());
    }
    [[nodiscard]] const ui::Surroundings& around() const { return editor_->surroundings(); }
    [[nodiscard]] const ui::LogLine& said() const { return editor_->workspace().log().back(); }
    /// Everything as it was before a file was asked for.
    void expectSpheres(const core::Image& before, const std::string& document,
                       const std::string& what) {
        EXPECT_EQ(around().sceneName, "built-in spheres") << what;
        EXPECT_EQ(document::writeDocument(model().document()), document) << what;
        EXPECT_EQ(difference(viewport(), before), 0.0) << what;
    }
};

/// The whole size of each file, so that every byte of it is looked at.
std::vector<fs::path> filesBelow(const fs::path& folder, const std::string& extension) {
    std::vector<fs::path> found;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.path().extension() == extension) {
            found.push_back(entry.path());
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

TEST_F(OpenSceneTest, AFileIsReadBesideTheFrames) {
    LODESTAR_NEEDS_SHARED();
    for (const char* name : {"khronos/BoomBoxWithAxes/glTF/BoomBoxWithAxes.gltf",
                             "babylon/blenderStudio/studio.gltf"}) {
        drop(gltf(name));
        ASSERT_TRUE(editor_->works()) << name;
        keep("opening");
        using Clock = std::chrono::steady_clock;
        const auto since = [](Clock::time_point begin) {
            return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
        };
        double longest = 0.0;
        std::string slowest;
        int frames = 0;
        while (editor_->works()) {
            const auto before = Clock::now();
            editor_->advance(0.001);
            if (!editor_->works()) { // the next frame is the new scene's first
                break;
            }
            draw();
            glFinish(); // a window's frames wait for their picture
            if (since(before) > longest) {
                longest = since(before);
                slowest = around().work->text;
            }
            ++frames;
        }
        const auto first = Clock::now();
        draw();
        glFinish();
        std::printf("%s: %d frames meanwhile, the longest %.0f ms (%s); its own first %.0f ms\n",
                    name, frames, longest, slowest.c_str(), since(first));
        for (const auto& [step, ms] : around().timesMs) {
            std::printf("  %s %.0f ms\n", step.c_str(), ms);
        }
        EXPECT_GT(frames, 3) << name << ": the frames waited";
        settle();
        EXPECT_EQ(around().sceneName, fs::path(name).filename().string());
        EXPECT_GT(around().materials.size(), 0u);
        keep("opened-" + fs::path(name).stem().string());
    }
}

TEST_F(OpenSceneTest, EscapeAndCancelLeaveTheSceneThatIsShown) {
    LODESTAR_NEEDS_SHARED();
    const core::Image before = viewport();
    const std::string document = document::writeDocument(model().document());
    const fs::path path = gltf("khronos/BoomBoxWithAxes/glTF/BoomBoxWithAxes.gltf");
    // While it is read, and while it goes to the GPU: each by the key and by the button.
    for (const bool uploads : {false, true}) {
        for (const bool key : {false, true}) {
            drop(path);
            for (int i = 0; uploads && i < 3000; ++i) {
                if (around().work && around().work->text.rfind("Uploading", 0) == 0) {
                    break;
                }
                std::this_thread::sleep_for(std::chrono::milliseconds(2));
                editor_->advance(0.002);
            }
            ASSERT_TRUE(editor_->works());
            if (uploads) {
                ASSERT_EQ(around().work->text, "Uploading BoomBoxWithAxes.gltf");
            }
            draw();
            const ImVec2 button = mark("Cancel work").center();
            if (key) {
                send(platform::KeyEvent{Key::Escape, true, false, {}});
                draw();
            } else {
                send(platform::MotionEvent{button.x, button.y});
                draw();
                send(platform::ButtonEvent{platform::PointerButton::Left, true, {}});
                draw();
                send(platform::ButtonEvent{platform::PointerButton::Left, false, {}});
                draw();
            }
            EXPECT_FALSE(editor_->works()) << uploads << key;
            EXPECT_EQ(said().text, "cancelled; nothing was changed");
            if (key) {
                send(platform::KeyEvent{Key::Escape, false, false, {}});
            }
            settle();
            EXPECT_FALSE(around().work.has_value());
            expectSpheres(before, document, "cancelled");
        }
    }
    drop(path);
    finish();
    EXPECT_EQ(around().sceneName, "BoomBoxWithAxes.gltf") << "after all that it still opens";
}

TEST_F(OpenSceneTest, AnotherFileTakesThePlaceOfTheOneOnItsWay) {
    LODESTAR_NEEDS_SHARED();
    drop(gltf("khronos/BoomBoxWithAxes/glTF/BoomBoxWithAxes.gltf"));
    drop(gltf("vulkan-samples/teapot.gltf"));
    finish();
    EXPECT_EQ(around().sceneName, "teapot.gltf");
}

TEST_F(OpenSceneTest, HostileFilesAreALineOrAScene) {
    LODESTAR_NEEDS_SHARED();
    const core::Image before = viewport();
    const std::string document = document::writeDocument(model().document());
    std::vector<fs::path> hostile = filesBelow(sharedPath("assets/invalid-gltf"), ".gltf");
    for (const fs::path& file : filesBelow(sharedPath("assets/invalid-gltf"), ".glb")) {
        hostile.push_back(file);
    }
    ASSERT_GT(hostile.size(), 20u);
    fs::create_directory(folder_.file("folder.gltf"));
    std::ofstream(folder_.file("empty.glb"));
    std::ofstream(folder_.file("noise.glb")) << "glTF\x02\xff\xff\xff\x7fnoise";
    for (const char* name : {"folder.gltf", "empty.glb", "noise.glb", "absent.gltf"}) {
        hostile.push_back(folder_.file(name));
    }
    int refused = 0;
    for (const fs::path& path : hostile) {
        drop(path);
        EXPECT_EQ(said().text, "opening " + path.filename().string());
        EXPECT_FALSE(said().isError) << "what the file before was refused for stands there still";
        finish();
        if (said().isError) {
            ++refused;
            EXPECT_EQ(said().text.find('\n'), std::string::npos) << said().text;
            EXPECT_NE(said().text.find(path.filename().string()), std::string::npos) << said().text;
            expectSpheres(before, document, path.string());
        } else { // what a validator minds need not stop a loader
            EXPECT_EQ(around().sceneName, path.filename().string());
            open({}); // the spheres again
        }
    }
    std::printf("%d of %zu files were refused\n", refused, hostile.size());
    EXPECT_GE(refused, 5);
    keep("refused");
}

// The scene's own light stands in for an environment that is not there.
TEST_F(OpenSceneTest, AnEnvironmentThatIsNotThereIsALine) {
    app::EditorOptions options;
    options.lighting = folder_.file("dark.lodestar.json");
    std::ofstream(options.lighting) << R"({"lodestar": 1, "environment": {"source": "no.hdr"}})";
    open(options);
    EXPECT_NE(said().text.find("no.hdr"), std::string::npos) << said().text;
    EXPECT_TRUE(said().isError);
    const core::Image picture = viewport();
    EXPECT_GT(*std::max_element(picture.pixels().begin(), picture.pixels().end()), 0.1f);
}

TEST_F(OpenSceneTest, ASceneOfTheCommandLineOpensBesideTheSpheres) {
    LODESTAR_NEEDS_SHARED();
    app::EditorOptions options;
    options.scene = gltf("vulkan-samples/teapot.gltf").string();
    options.lighting = folder_.file("teapot.lodestar.json");
    options.beside = true;
    auto editor = app::Editor::make(device(), options, {});
    ASSERT_TRUE(editor.ok());
    editor_ = std::move(*editor);
    EXPECT_EQ(around().sceneName, "built-in spheres");
    EXPECT_TRUE(editor_->works());
    draw();
    finish();
    EXPECT_EQ(around().sceneName, "teapot.gltf");
    options.scene = folder_.file("absent.gltf");
    EXPECT_FALSE(app::Editor::make(device(), options, {}).ok()) << "as every command says";
}

} // namespace
} // namespace lodestar::testing

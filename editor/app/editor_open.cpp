// SPDX-License-Identifier: MIT
//
// How the editor's scene is opened: read beside the frames, brought to the GPU between them.
#include "app/command.h"
#include "app/editor.h"
#include "app/scene_options.h"
#include "app/starter_scene.h"

namespace lodestar::app {
namespace {

/// Of a frame's time while a scene goes to the GPU; a single texture may take longer.
constexpr double kUploadMs = 8.0;

} // namespace

core::Result<Editor::Shown> Editor::readScene(const std::string& path, const std::string& root,
                                              Background::Progress& progress) {
    SceneOptions options;
    options.scene = path;
    options.assetRoot = root;
    OpenedFile opened;
    if (path.empty()) {
        opened = {starterScene(), 0};
    } else {
        auto file = openFile(options);
        if (!file) {
            return file.error();
        }
        opened = std::move(*file);
    }
    ++progress.stage;
    Shown shown;
    if (progress.cancelled) {
        return shown; // nobody looks at it
    }
    auto own = distantLight(options, opened, std::nullopt);
    if (!own) {
        return own.error();
    }
    shown.own = std::move(*own);
    const int index = opened.sceneIndex;
    shown.scene = std::make_unique<scene::Scene>(scene::buildScene(std::move(opened.file), index));
    shown.materials = shown.scene->materials;
    shown.bounds = shown.scene->worldBounds();
    return shown;
}

core::Result<void> Editor::openScene(const std::string& path, const std::string& root) {
    Background::Progress alone;
    auto shown = readScene(path, root, alone);
    if (!shown) {
        return shown.error();
    }
    warn(shown->scene->warnings, path);
    auto renderer = scene::Renderer::make(*device_, *shown->scene);
    if (!renderer) {
        return core::inFile(renderer.error(), path);
    }
    shown->renderer = std::move(*renderer);
    hasEnvironment_ = false; // it has a light of its own
    show(path, root, std::move(*shown));
    return {};
}

void Editor::askForScene(const std::string& path) {
    workspace_.say("opening " + std::filesystem::path(path).filename().string());
    openSceneBeside(path, {});
}

void Editor::openSceneBeside(const std::string& path, const std::string& root) {
    opening_.reset();
    const auto read = [this, path,
                       root](Background::Progress& progress) -> core::Result<Background::Finish> {
        auto loaded = readScene(path, root, progress);
        if (!loaded) {
            return loaded.error();
        }
        auto shown = std::make_shared<Shown>(std::move(*loaded));
        return Background::Finish([this, path, root, shown] {
            warn(shown->scene->warnings, path);
            opening_ = std::make_unique<Opening>(*device_, path, root, std::move(*shown),
                                                 shown_.renderer.get());
        });
    };
    const std::string name = std::filesystem::path(path).filename().string();
    work_.start({"Reading " + name, "Placing what is in " + name}, read);
    describeWork();
    session_.wake(kWindowFrames);
}

void Editor::uploadOpening() {
    if (!opening_) {
        return;
    }
    const auto start = Clock::now();
    while (std::chrono::duration<double, std::milli>(Clock::now() - start).count() < kUploadMs) {
        auto step = opening_->upload.step();
        if (!step) {
            workspace_.say(core::inFile(step.error(), opening_->path).message(), true);
            opening_.reset();
            break;
        }
        if (*step) {
            const std::unique_ptr<Opening> done = std::move(opening_);
            done->shown.renderer = std::move(*step);
            show(done->path, done->root, std::move(done->shown));
            break;
        }
    }
    describeWork();
    session_.wake(opening_ ? 1 : kWindowFrames);
}

void Editor::show(const std::string& path, const std::string& root, Shown shown) {
    if (path != scenePath_) {
        pose_.reset();
    }
    scenePath_ = path;
    assetRoot_ = root;
    preview_.reset();
    previewed_.reset();
    shown.scene->images.clear();
    shown_ = std::move(shown);
    everSynced_ = false;
    around_.low = shown_.bounds.empty() ? glm::vec3(-1.0f) : shown_.bounds.low;
    around_.high = shown_.bounds.empty() ? glm::vec3(1.0f) : shown_.bounds.high;
    workspace_.view().node = -1;
    describeScene();
    stale();
    session_.wake();
}

void Editor::cancelWork() {
    if (!works()) {
        return;
    }
    work_.cancel();
    opening_.reset();
    workspace_.say("cancelled; nothing was changed");
    describeWork();
    session_.wake(kWindowFrames);
}

void Editor::pollWork() {
    const bool ran = work_.runs();
    auto polled = work_.poll();
    if (!polled) {
        workspace_.say(polled.error().message(), true);
    }
    if (!polled || *polled) {
        session_.wake(kWindowFrames);
    }
    if (ran || work_.runs()) {
        describeWork();
    }
    uploadOpening();
}

void Editor::describeWork() {
    around_.work.reset();
    if (work_.runs()) {
        around_.work = ui::WorkLine{work_.stage(), work_.share()};
    } else if (opening_) {
        around_.work =
            ui::WorkLine{"Uploading " + std::filesystem::path(opening_->path).filename().string(),
                         opening_->upload.share()};
    }
}

} // namespace lodestar::app

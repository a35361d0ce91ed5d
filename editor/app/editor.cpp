// SPDX-License-Identifier: MIT
#include "app/editor.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <epoxy/gl.h>

#include "io/document_file.h"
#include "lighting/day.h"

namespace lodestar::app {
namespace {

/// Samples a pixel's side of a still picture, and so long after a change it is still.
constexpr int kFineSamples = 2;
constexpr double kStillSeconds = 0.25;
/// A picture that takes longer than this, milliseconds, is coarse while it changes.
constexpr double kSmoothMs = 25.0;
/// So often news of what is measured are looked for.
constexpr double kMeterSeconds = 0.02;

double msSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
        .count();
}

} // namespace

Editor::Editor(gl::Device& device, ui::Clipboard clipboard)
    : device_(&device), session_(ui::Session::Drawing::OpenGl, std::move(clipboard)) {
    settings_.waitForForecast = false;
    settings_.faceBudget = 2;
    around_.drawsProbes = true;
    around_.estimators = {"tent", "ring:3", "ring:7", "taps:32", "taps:64", "auto:0.05"};
}

core::Result<std::unique_ptr<Editor>> Editor::make(gl::Device& device, const EditorOptions& options,
                                                   ui::Clipboard clipboard) {
    std::unique_ptr<Editor> editor(new Editor(device, std::move(clipboard)));
    std::filesystem::path lighting = options.lighting;
    if (lighting.empty() && !options.scene.empty()) {
        lighting = io::sidecarPath(options.scene);
    }
    if (auto opened = editor->openLightingFile(lighting); !opened) {
        return opened.error();
    }
    std::error_code ignored;
    const bool beside = options.beside && std::filesystem::exists(options.scene, ignored);
    if (auto opened = editor->openScene(beside ? std::string() : options.scene, options.assetRoot);
        !opened) {
        return opened.error();
    }
    if (beside) {
        editor->openSceneBeside(options.scene, options.assetRoot);
    }
    return editor;
}

double Editor::now() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
}

void Editor::stale() {
    forgetErrors();
    pictureStale_ = true;
    lastChange_ = Clock::now();
}

bool Editor::wantsFrame() const {
    return session_.wantsFrame() || pictureStale_ || errorDue() ||
           (coarse_ &&
            std::chrono::duration<double>(Clock::now() - lastChange_).count() >= kStillSeconds);
}

double Editor::patience() const {
    if (wantsFrame() || workspace_.view().playing || move_.fly != glm::vec3(0.0f) || opening_) {
        return 0.0;
    }
    double seconds = std::numeric_limits<double>::infinity();
    if (coarse_) {
        seconds = kStillSeconds;
    }
    if (meter_.busy()) {
        seconds = std::min(seconds, kMeterSeconds);
    }
    if (model_.dirty() && !file_.path().empty()) {
        seconds = std::min(seconds, model::kAutosaveSeconds);
    }
    if (!file_.path().empty()) {
        seconds = std::min(seconds, kWatchSeconds);
    }
    if (work_.runs()) {
        seconds = std::min(seconds, kWorkSeconds);
    }
    return seconds;
}

void Editor::advance(double seconds) {
    sinceFrame_ += seconds;
    watchFile(seconds);
    pollWork();
    if (!file_.path().empty()) {
        if (auto written = file_.autosave(model_, now()); !written) {
            workspace_.say(written.error().message(), true);
            session_.wake();
        }
    }
    syncAccuracy();
    ui::ViewState& view = workspace_.view();
    if (view.playing) {
        view.hour = lighting::wrappedHour(view.hour + seconds * view.hoursASecond);
        session_.wake();
    }
    if (move_.fly != glm::vec3(0.0f)) {
        ui::CameraMove move;
        move.fly = move_.fly * static_cast<float>(std::min(seconds, 0.1));
        move.fast = move_.fast;
        moveCamera(move);
        session_.wake();
    }
}

float Editor::aspect() const {
    return static_cast<float>(std::max(settings_.width, 1)) /
           static_cast<float>(std::max(settings_.height, 1));
}

scene::View Editor::view() const {
    if (pose_) {
        return scene::viewFromPose(*pose_, shown_.bounds, aspect());
    }
    auto chosen = scene::chooseView(*shown_.scene, request_, aspect());
    return chosen ? *chosen : *scene::chooseView(*shown_.scene, {}, aspect());
}

void Editor::moveCamera(const ui::CameraMove& move) {
    if (move.reset) {
        pose_.reset();
        stale();
    }
    ui::CameraMove rest = move;
    rest.reset = false;
    rest.fast = false;
    if (rest == ui::CameraMove{}) {
        return;
    }
    if (!pose_) {
        pose_ = scene::poseFromView(view(), shown_.bounds);
    }
    const auto height = static_cast<float>(std::max(settings_.height, 1));
    const float radians = 3.14159265f / height;
    if (move.orbit != glm::vec2(0.0f)) {
        scene::orbit(*pose_, move.orbit * radians);
    }
    if (move.look != glm::vec2(0.0f)) {
        scene::look(*pose_, glm::vec2(0.5f, -0.5f) * move.look * radians);
    }
    if (move.pan != glm::vec2(0.0f)) {
        scene::pan(*pose_, move.pan, height);
    }
    if (move.dolly != 0.0f) {
        scene::dolly(*pose_, std::clamp(move.dolly, -50.0f, 50.0f), shown_.bounds);
    }
    if (move.fly != glm::vec3(0.0f)) {
        scene::fly(*pose_, move.fly * scene::flySpeed(shown_.bounds, move.fast));
    }
    if (move.frameAll || move.frameSelection) {
        scene::frameAll(*pose_, move.frameAll ? shown_.bounds : selectedBounds(), aspect());
    }
    stale();
}

void Editor::answer(const ui::Wishes& wishes) {
    ui::CameraMove move = wishes.camera;
    move.fly = glm::vec3(0.0f); // by the time that passes, in `advance`
    moveCamera(move);
    move_ = wishes.camera;
    if (wishes.pick) {
        pick(*wishes.pick);
    }
    answerPhotograph(wishes);
    answerFiles(wishes);
    if (wishes.save) {
        save();
    }
    core::Result<void> done;
    if (wishes.saveAs) {
        done = file_.saveAs(model_, *wishes.saveAs);
    } else if (wishes.openLighting) {
        done = openLightingFile(*wishes.openLighting);
    } else if (wishes.openScene) {
        askForScene(*wishes.openScene);
    }
    if (!done) {
        workspace_.say(done.error().message(), true);
    } else if (wishes.saveAs) {
        workspace_.say("saved " + file_.path().string());
    }
    if (wishes.select) {
        select(*wishes.select, wishes.selectMore);
    }
    if (wishes.captureProbe) {
        const auto which = std::find(shownProbes_.begin(), shownProbes_.end(),
                                     static_cast<int>(*wishes.captureProbe));
        if (which != shownProbes_.end()) {
            shown_.renderer->requestProbe(static_cast<std::size_t>(which - shownProbes_.begin()));
            stale();
        }
    }
    if (wishes.quit && !(wishes.save && model_.dirty())) {
        file_.discardAutosave();
        closing_ = true;
    }
}

void Editor::pick(const glm::ivec2& pixel) {
    scene::RenderSettings settings = settings_;
    settings.hour = workspace_.view().hour;
    settings.samplesPerSide = 1;
    auto frame = shown_.renderer->render(view(), settings);
    if (!frame) {
        workspace_.say(frame.error().message(), true);
        return;
    }
    const core::Image& image = frame->radiance;
    const float* texel = image.at(std::clamp(pixel.x, 0, image.width() - 1),
                                  std::clamp(pixel.y, 0, image.height() - 1));
    const double alpha = texel[3] > 0.0f ? static_cast<double>(texel[3]) : 1.0;
    workspace_.givePicked(model_, glm::dvec3(texel[0], texel[1], texel[2]) / alpha);
}

void Editor::save() {
    auto saved =
        file_.path().empty() ? file_.saveAs(model_, "untitled.lodestar.json") : file_.save(model_);
    if (!saved) {
        workspace_.say(saved.error().message(), true);
    } else {
        workspace_.say("saved " + file_.path().string());
    }
    session_.wake();
}

core::Result<void> Editor::buildPanels(int width, int height, float scale) {
    refreshPhotograph();
    // A first pass tells where the viewport is; where that has another size, its picture is made
    // anew, and the panels show it.
    for (int pass = 0; pass < 2; ++pass) {
        around_.picture = picture_.color().id();
        around_.documentName = file_.path().empty() ? "untitled" : file_.path().filename().string();
        ui::Wishes wishes;
        session_.frame(width, height, scale, sinceFrame_,
                       [&] { wishes = workspace_.draw(model_, around_); });
        sinceFrame_ = 0.0;
        if (!session_.failure().empty()) {
            workspace_.say("the panels were begun anew: " + session_.failure(), true);
            return {};
        }
        answer(wishes);
        const int pictureWidth = std::max(wishes.viewport[2], 1);
        const int pictureHeight = std::max(wishes.viewport[3], 1);
        if (picture_.framebuffer() != 0 && picture_.width() == pictureWidth &&
            picture_.height() == pictureHeight) {
            break;
        }
        auto made = gl::DisplayTarget::make(*device_, pictureWidth, pictureHeight);
        if (!made) {
            return made.error();
        }
        picture_ = std::move(*made);
        settings_.width = pictureWidth;
        settings_.height = pictureHeight;
        stale();
    }
    return {};
}

core::Result<void> Editor::drawPicture() {
    scene::RenderSettings settings = settings_;
    settings.hour = workspace_.view().hour;
    const bool moving =
        std::chrono::duration<double>(Clock::now() - lastChange_).count() < kStillSeconds;
    coarse_ = moving && fineMs_ > kSmoothMs;
    settings.samplesPerSide = coarse_ ? 1 : kFineSamples;
    const auto start = Clock::now();
    auto frame = shown_.renderer->draw(view(), settings,
                                       static_cast<float>(std::exp2(workspace_.view().exposure)),
                                       picture_.framebuffer());
    if (!frame) {
        return frame.error();
    }
    if (!coarse_) {
        fineMs_ = msSince(start);
    }
    ++picturesDrawn_;
    pictureStale_ = false;
    seen_ = workspace_.view();
    if (!frame->plan->probeFaces.empty() || !frame->plan->probeWork.empty() ||
        shown_.renderer->awaitsForecast()) {
        pictureStale_ = true; // more may be due
    }
    for (const auto& [step, ms] : frame->timesMs) {
        around_.timesMs[step] = ms;
    }
    around_.counters = frame->counters;
    describeProbes();
    if (around_.plan != frame->plan) {
        around_.plan = frame->plan;
        session_.wake();
    }
    return {};
}

core::Result<void> Editor::drawFrame(int width, int height, float scale, unsigned framebuffer) {
    const auto start = Clock::now();
    if (auto built = buildPanels(width, height, scale); !built) {
        return built;
    }
    around_.timesMs["panels"] = msSince(start);
    const auto built = Clock::now();
    const bool due = syncDocument();
    if (due) {
        around_.timesMs["document"] = msSince(built);
        stale();
    }
    const ui::ViewState& view = workspace_.view();
    if (view.hour != seen_.hour || view.exposure != seen_.exposure) {
        stale();
    }
    if (wantsFrame() && (pictureStale_ || coarse_)) {
        const bool first = picturesDrawn_ == 0;
        if (auto drawn = drawPicture(); !drawn) {
            if (first) {
                return drawn;
            }
            pictureStale_ = false;
            workspace_.say(drawn.error().message(), true);
        }
    }
    syncPreview();
    if (errorDue()) {
        drawErrorPass();
    } else if (error_ && !view.errorView) {
        forgetErrors();
    }
    gl::beginWindowPass(*device_, framebuffer, 0, 0, width, height);
    glDisable(GL_SCISSOR_TEST);
    glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    session_.render();
    device_->forgetProgram(0);
    retired_.clear();
    ++framesDrawn_;
    return {};
}

std::string Editor::title() const {
    const std::string name = file_.path().empty() ? "untitled" : file_.path().filename().string();
    return name + (model_.dirty() ? " *" : "") + " - Lodestar";
}

} // namespace lodestar::app

// SPDX-License-Identifier: MIT
#include "app/viewer.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>

#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/display_image.h"
#include "app/plan_json.h"
#include "app/scene_lighting.h"
#include "io/gltf.h"
#include "io/image_file.h"

namespace lodestar::app {
namespace {

/// For so long after the last motion frames may be coarse, seconds.
constexpr double kMotionSeconds = 0.2;
/// A still frame slower than this is drawn with one sample a pixel while the camera moves.
constexpr double kSmoothMs = 25.0;
constexpr std::size_t kReadings = 15;
constexpr std::size_t kFramesKept = 10000;

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

std::string formatted(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// Faces of light probes drawn in a frame, where the command line says nothing.
constexpr int kFacesAFrame = 2;

std::string nameOf(const std::string& path) {
    return std::filesystem::path(path).filename().string();
}

} // namespace

Viewer::Viewer(gl::Device& device, const ViewerOptions& options)
    : device_(&device), options_(options), exposure_(options.exposure) {}

core::Result<std::unique_ptr<Viewer>> Viewer::make(gl::Device& device, LoadedScene loaded,
                                                   const ViewerOptions& options) {
    std::unique_ptr<Viewer> viewer(new Viewer(device, options));
    viewer->lightChosen_ = !options.scene.environment.empty();
    viewer->settings_ = loaded.settings;
    viewer->settings_.waitForForecast = false;
    viewer->settings_.faceBudget = options.scene.faceBudget.value_or(
        options.scene.probeBudgetMs ? viewer->settings_.faceBudget : kFacesAFrame);
    viewer->request_ = loaded.camera;
    viewer->sceneIndex_ = loaded.sceneIndex;
    viewer->sceneCount_ = loaded.sceneCount;
    if (const auto camera = scene::findCamera(loaded.scene, loaded.camera.name)) {
        viewer->cameraIndex_ = *camera;
    }
    auto document = viewer->documentOf(options.scene.scene, std::move(loaded.scene));
    if (!document) {
        return document.error();
    }
    viewer->document_ = std::move(*document);
    warn(loaded.lightWarnings, loaded.lightsName);
    viewer->lightsEstimator_ = loaded.lightsEstimator;
    viewer->ownMaps_ = loaded.ownMaps;
    viewer->takeLights(std::move(loaded.lights));
    viewer->takeLight(std::move(loaded.light));
    viewer->animation_ = loaded.animation;
    viewer->time_ = loaded.time;
    return viewer;
}

core::Result<Viewer::Document> Viewer::documentOf(std::string path, scene::Scene scene) {
    Document document{
        std::move(path), std::make_unique<scene::Scene>(std::move(scene)), nullptr, {}, true};
    auto renderer = scene::Renderer::make(*device_, *document.scene);
    if (!renderer) {
        return core::inFile(renderer.error(), document.path);
    }
    document.renderer = std::move(*renderer);
    document.scene->images.clear();
    document.bounds = document.scene->worldBounds();
    return document;
}

void Viewer::setSize(int width, int height, float contentScale) {
    if (width != settings_.width || height != settings_.height || contentScale != contentScale_) {
        settings_.width = width;
        settings_.height = height;
        contentScale_ = contentScale;
        changed(true);
    }
}

float Viewer::aspect() const {
    return static_cast<float>(std::max(settings_.width, 1)) /
           static_cast<float>(std::max(settings_.height, 1));
}

scene::View Viewer::view() const {
    if (pose_) {
        return scene::viewFromPose(*pose_, document_.bounds, aspect());
    }
    auto chosen = scene::chooseView(*document_.scene, request_, aspect());
    return chosen ? *chosen : *scene::chooseView(*document_.scene, {}, aspect());
}

void Viewer::changed(bool measureAgain) {
    error_.reset();
    framesWanted_ = std::max(framesWanted_, measureAgain ? 2 : 1);
    if (measureAgain) {
        measured_ = false;
        readings_.clear();
    }
}

void Viewer::say(std::string message, bool isError) {
    message_ = std::move(message);
    messageIsError_ = isError;
    changed(false);
}

void Viewer::openScene(const std::string& path, std::optional<int> number) {
    const bool same = path == document_.path;
    SceneOptions wanted = options_.scene;
    wanted.scene = path;
    wanted.sceneName.clear();
    // A file of the command line keeps its root, whatever was shown in between.
    wanted.assetRoot = path == options_.scene.scene ? options_.scene.assetRoot : std::string();
    auto opened = openFile(wanted, number);
    if (!opened) {
        say(opened.error().message(), true);
        return;
    }
    auto lighting = openDocument(wanted);
    if (!lighting) {
        say(lighting.error().message(), true);
        return;
    }
    std::optional<DistantLight> own;
    if (!lightChosen_) {
        auto light = distantLight(wanted, *opened, *lighting);
        if (!light) {
            say(light.error().message(), true);
            return;
        }
        own = std::move(*light);
    }
    const int index = opened->sceneIndex;
    const int count = std::max(1, static_cast<int>(opened->file.scenes.size()));
    scene::Scene built = scene::buildScene(std::move(opened->file), index);
    warn(built.warnings, path);
    if (*lighting) {
        core::Tally warnings = (*lighting)->warnings;
        applyMaterials((*lighting)->document, built, warnings);
        ProbeMaps maps;
        if (auto set = setDocumentProbes(**lighting, built, maps, warnings); !set) {
            say(set.error().message(), true);
            return;
        }
        warn(warnings, (*lighting)->file);
    }
    auto document = documentOf(path, std::move(built));
    if (!document) {
        say(document.error().message(), true);
        return;
    }
    document_ = std::move(*document);
    ownMaps_ = *lighting ? document::mapLayout((*lighting)->document) : lighting::kRsrm;
    takeLights(*lighting ? std::move((*lighting)->lights) : std::vector<lighting::DayLight>());
    own ? takeLight(std::move(*own)) : showEnvironment();
    sceneIndex_ = index;
    sceneCount_ = count;
    cameraIndex_ = 0;
    animation_ = scene::kRestPose;
    time_ = 0.0;
    playing_ = false;
    request_ = {};
    pose_.reset();
    say(same ? "read again: " + path : path, false);
    changed(true);
}

void Viewer::takeLight(DistantLight light) {
    warn(light.environment.warnings, light.name);
    lightWarnings_ = light.environment.warnings;
    environment_ = std::move(light.environment.base);
    environmentName_ = std::move(light.name);
    showEnvironment();
}

void Viewer::showEnvironment() {
    if (!environment_.empty()) {
        document_.renderer->setEnvironment(environmentName_, environment_);
    }
}

void Viewer::openEnvironment(const std::string& path) {
    auto loaded = io::loadEnvironment(path, options_.scene.cubeWidth);
    if (!loaded) {
        say(core::inFile(loaded.error(), path).message(), true);
        return;
    }
    takeLight({path, std::move(*loaded)});
    lightChosen_ = true;
    dropReplacingSkies();
    say("lit by " + path, false);
    changed(true);
}

bool Viewer::moving() const {
    const double since = std::chrono::duration<double>(Clock::now() - lastMotion_).count();
    return since < kMotionSeconds;
}

bool Viewer::wantsFrame() const {
    return framesWanted_ > 0 || ((coarse_ || errorPending()) && !moving());
}

double Viewer::patience() const {
    if (wantsFrame() || playing_ || dayPlaying_ || flyDirection() != glm::vec3(0.0f)) {
        return 0.0;
    }
    return coarse_ || errorPending() ? kMotionSeconds : std::numeric_limits<double>::infinity();
}

core::Result<void> Viewer::drawFrame() {
    if (framesWanted_ == 0 && !coarse_ && errorPending()) {
        return drawErrorPass();
    }
    error_.reset();
    scene::RenderSettings settings = settings_;
    const bool coarse = moving() && fineMs_ > kSmoothMs && options_.samplesPerSide > 1;
    settings.samplesPerSide = coarse ? 1 : options_.samplesPerSide;
    if (document_.firstFrame) { // what a scene opens with is whole
        settings.faceBudget = std::max(settings.faceBudget, scene::RenderSettings().faceBudget);
        settings.probeBudgetMs = scene::RenderSettings().probeBudgetMs;
        document_.firstFrame = false;
    }
    auto frame =
        document_.renderer->draw(view(), settings, static_cast<float>(std::exp2(exposure_)));
    if (!frame && framesDrawn_ == 0) {
        return frame.error();
    }
    framesWanted_ = std::max(framesWanted_ - 1, 0);
    coarse_ = coarse;
    if (frame) {
        note(*frame, settings.samplesPerSide);
    } else {
        framesWanted_ = 0;
        message_ = frame.error().message();
        messageIsError_ = true;
    }
    showOverlay();
    return {};
}

void Viewer::showOverlay() {
    if (const OverlayText shown = text();
        !shown.lines.empty() || shown.help || !shown.message.empty() || shown.picture != 0) {
        overlay_.draw(shown, settings_.width, settings_.height, contentScale_);
    }
}

void Viewer::note(const scene::Frame& frame, int samplesPerSide) {
    const double ms = frame.timesMs.at("draw");
    const int samples = samplesPerSide * samplesPerSide;
    ++framesDrawn_;
    if (drawn_.size() < kFramesKept) {
        drawn_.push_back({std::chrono::duration<double>(Clock::now() - start_).count(), samples,
                          frame.timesMs, frame.counters});
    }
    plan_ = frame.plan;
    if (!plan_->probeFaces.empty() || !plan_->probeWork.empty() ||
        document_.renderer->awaitsForecast()) {
        framesWanted_ = std::max(framesWanted_, 1); // more may be due
    }
    if (samplesPerSide == options_.samplesPerSide) {
        fineMs_ = ms;
    }
    if (samples != readingSamples_) {
        readingSamples_ = samples;
        readings_.clear();
        measured_ = false;
    }
    // The first reading after a change holds what the driver put off until then.
    if (measured_) {
        readings_.push_back(ms);
        if (readings_.size() > kReadings) {
            readings_.erase(readings_.begin());
        }
    }
    measured_ = true;
}

std::string Viewer::timeText() const {
    const std::string size = std::to_string(settings_.width) + " x " +
                             std::to_string(settings_.height) + ", " +
                             std::to_string(readingSamples_) +
                             (readingSamples_ == 1 ? " sample a pixel" : " samples a pixel");
    return (readings_.empty() ? std::string("- ms") : formatted("%.2f ms", median(readings_))) +
           " on the GPU, " + size;
}

bool Viewer::onlyLights() const {
    return environment_.empty() && !lights_.empty();
}

/// What the last frame did for light probes, and what waits: not what was not called for.
std::vector<std::string> Viewer::probeLines() const {
    constexpr std::size_t kMost = 8;
    std::vector<std::string> lines;
    std::size_t left = 0;
    for (const plan::Effect& effect : plan_ ? plan_->effects : std::vector<plan::Effect>()) {
        if (effect.effect != "probe-capture") {
            continue;
        }
        if (lines.size() == kMost) {
            ++left;
            continue;
        }
        lines.push_back("Probe '" + effect.subject +
                        "': " + (effect.decision == plan::Decision::Run ? "" : "skipped: ") +
                        effect.reason);
    }
    if (left > 0) {
        lines.push_back(std::to_string(left) + " more probes");
    }
    return lines;
}

OverlayText Viewer::text() const {
    OverlayText text;
    text.help = help_;
    text.picture = error_ && error_->passes() > 0 ? errorPicture_.id() : 0;
    if (!textShown_ && !help_) {
        return text;
    }
    text.lines = {
        nameOf(document_.path) +
            (document_.scene->name.empty() ? "" : ": " + document_.scene->name),
        onlyLights() ? "light     the lighting document" : "light     " + nameOf(environmentName_),
        "glossy    " +
            (onlyLights() ? lightsEstimator_ : lighting::estimatorName(settings_.specular)),
        "diffuse   " +
            (onlyLights() ? lightsEstimator_ : lighting::estimatorName(settings_.diffuse)),
        "forms     lobes " + lighting::nameOf(settings_.lobes) + ", Fresnel " +
            lighting::nameOf(settings_.fresnel),
        "exposure  " + formatted("%+.2f EV", exposure_),
        animationText(),
        lights_.empty() ? "no hour: no lighting document" : hourText(),
        timeText()};
    if (error_) {
        text.lines.push_back("error of " + std::to_string(error_->passes()) + " / " +
                             std::to_string(kReferencePasses) + " passes");
    }
    for (std::string& line : probeLines()) {
        text.lines.push_back(std::move(line));
    }
    text.lines.emplace_back("F1 help");
    text.message = message_;
    text.messageIsError = messageIsError_;
    return text;
}

std::string Viewer::title() const {
    return nameOf(document_.path) + " - Lodestar";
}

void Viewer::saveScreenshot() {
    if (settings_.width < 1 || settings_.height < 1) {
        return;
    }
    core::Image picture;
    if (error_ && error_->passes() > 0) {
        picture = error_->picture(kErrorScale, ErrorView::Legend::Beneath);
    } else {
        scene::RenderSettings settings = settings_;
        settings.samplesPerSide = options_.samplesPerSide;
        auto frame = document_.renderer->render(view(), settings);
        if (!frame) {
            say(frame.error().message(), true);
            return;
        }
        picture = toDisplay(frame->radiance, exposure_);
    }
    const std::string stem = std::filesystem::path(document_.path).stem().string();
    std::string path;
    std::error_code ignored;
    int number = 0;
    do {
        char digits[16];
        std::snprintf(digits, sizeof digits, "%03d", ++number);
        path = stem + "-" + digits + ".png";
    } while (std::filesystem::exists(path, ignored) && number < 1000000);
    if (auto written = io::writeImage(path, picture); !written) {
        say(written.error().message(), true);
        return;
    }
    ++screenshots_;
    say("saved " + path, false);
}

nlohmann::json Viewer::stats() const {
    nlohmann::json frames = nlohmann::json::array();
    for (const DrawnFrame& frame : drawn_) {
        frames.push_back({{"at_s", frame.at},
                          {"samples", frame.samples},
                          {"times_ms", frame.timesMs},
                          {"counters", toJson(frame.counters)}});
    }
    core::Tally warnings = lightWarnings_;
    warnings.merge(document_.scene->warnings);
    nlohmann::json times = nlohmann::json::object();
    if (!readings_.empty()) {
        times["draw"] = median(readings_);
    }
    return {{"scene", document_.path},
            {"environment", environmentName_},
            {"estimators",
             {{"specular", lighting::estimatorName(settings_.specular)},
              {"diffuse", lighting::estimatorName(settings_.diffuse)},
              {"lights", lights_.empty() ? "" : lightsEstimator_},
              {"lobes", lighting::nameOf(settings_.lobes)},
              {"fresnel", lighting::nameOf(settings_.fresnel)}}},
            {"plan", toJson(plan_ ? *plan_ : plan::EffectPlan{})},
            {"warnings", warnings.counts()},
            {"counters", toJson(device_->counters())},
            {"frames_drawn", framesDrawn_},
            {"frames", frames},
            {"screenshots", screenshots_},
            {"times_ms", times},
            {"renderer", device_->capabilities().renderer}};
}

} // namespace lodestar::app

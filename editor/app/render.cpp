// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/commands.h"
#include "app/display_image.h"
#include "app/error_view.h"
#include "app/plan_json.h"
#include "app/scene_options.h"
#include "io/file.h"
#include "io/image_file.h"
#include "platform/headless_context.h"

namespace lodestar::app {
namespace {

struct RenderOptions {
    SceneOptions scene;
    std::string output;
    std::string stats;
    double exposure = 0.0; ///< EV
    int samples = 0;       ///< a pixel; 0: 4 for PNG, 1 for EXR
    int frames = 1;
    double fps = 0.0;                        ///< 0: not given, all frames show one time
    double hoursPerSecond = 0.0;             ///< with fps
    std::string errorView;                   ///< a PNG; empty: none
    double errorScale = 100.0 * kErrorScale; ///< per cent that have the last colour
    int errorTaps = kErrorTaps;
};

enum class OutputKind { Png, Exr };

core::Result<OutputKind> outputKind(const std::string& path) {
    const std::string extension = std::filesystem::path(path).extension().string();
    if (extension == ".png" || extension == ".PNG") {
        return OutputKind::Png;
    }
    if (extension == ".exr" || extension == ".EXR") {
        return OutputKind::Exr;
    }
    return usage("'" + path + "' ends in neither .png nor .exr", "-o");
}

/// The file of one frame: %04d is its number.
std::string framePath(const std::string& output, int frame) {
    const std::size_t at = output.find("%04d");
    if (at == std::string::npos) {
        return output;
    }
    char number[16];
    std::snprintf(number, sizeof number, "%04d", frame);
    return output.substr(0, at) + number + output.substr(at + 4);
}

nlohmann::json stats(const std::vector<scene::Frame>& frames, const gl::WorkCounters& total,
                     const LoadedScene& loaded, const core::Tally& probeWarnings,
                     const gl::Device& device) {
    nlohmann::json perFrame = nlohmann::json::array();
    for (const scene::Frame& frame : frames) {
        perFrame.push_back({{"counters", toJson(frame.counters)},
                            {"times_ms", frame.timesMs},
                            {"effects", toJson(*frame.plan)["effects"]}});
    }
    core::Tally warnings = loaded.light.environment.warnings;
    warnings.merge(loaded.scene.warnings);
    warnings.merge(loaded.lightWarnings);
    warnings.merge(probeWarnings);
    warnings.add("pixel not finite, set to 0", frames.back().repairedPixels);
    return {{"plan", toJson(*frames.back().plan)},
            {"counters", toJson(total)},
            {"times_ms", frames.back().timesMs},
            {"frames", perFrame},
            {"warnings", warnings.counts()},
            {"renderer", device.capabilities().renderer},
            {"estimators",
             {{"specular", lighting::estimatorName(loaded.settings.specular)},
              {"diffuse", lighting::estimatorName(loaded.settings.diffuse)},
              {"lights", loaded.lights.empty() ? "" : loaded.lightsEstimator},
              {"lobes", lighting::nameOf(loaded.settings.lobes)},
              {"fresnel", lighting::nameOf(loaded.settings.fresnel)}}}};
}

/// Draws the last frame again, by its own estimators and by many taps, and writes how they differ.
core::Result<nlohmann::json> compare(const RenderOptions& options, const LoadedScene& loaded,
                                     const scene::Frame& frame, scene::Renderer& renderer) {
    if (!litFromAfar(*frame.plan)) {
        return usage("no surface in the picture is lit by an environment, a sky or a sun, whose "
                     "light is compared",
                     "--error-view");
    }
    auto again = renderer.redraw(loaded.view, loaded.settings, {});
    if (!again) {
        return again.error();
    }
    ErrorView view(std::move(*again));
    const bool watched = isatty(STDERR_FILENO) != 0;
    for (int pass = 0; pass < kReferencePasses; ++pass) {
        if (watched) {
            std::fprintf(stderr, "\rreference: %d of %d passes", pass, kReferencePasses);
        }
        auto drawn =
            renderer.redraw(loaded.view, loaded.settings,
                            scene::ReferenceTaps{pass, kReferencePasses, options.errorTaps});
        if (!drawn) {
            return drawn.error();
        }
        view.add(*drawn);
    }
    if (watched) {
        std::fprintf(stderr, "\r%*s\r", 40, "");
    }
    const core::Image picture =
        view.picture(options.errorScale / 100.0, ErrorView::Legend::Beneath);
    if (auto written = io::writeImage(options.errorView, picture); !written) {
        return written.error();
    }
    nlohmann::json figures = toJson(view.figures(), options.errorTaps);
    figures["file"] = options.errorView;
    std::printf("%s\n", nlohmann::json{{"error_view", figures}}.dump().c_str());
    return figures;
}

core::Result<void> renderAll(const RenderOptions& options, OutputKind kind, LoadedScene& loaded) {
    auto context = platform::HeadlessContext::create();
    if (!context) {
        return context.error();
    }
    auto device = gl::Device::create();
    if (!device) {
        return device.error();
    }
    auto renderer = scene::Renderer::make(**device, loaded.scene);
    if (!renderer) {
        return renderer.error();
    }
    loaded.scene.images.clear();
    if (!loaded.light.environment.base.empty()) {
        (*renderer)->setEnvironment(loaded.light.name, std::move(loaded.light.environment.base));
    }
    (*renderer)->setLights(loaded.lights, layoutOf(loaded.lightsEstimator, loaded.ownMaps));
    warn((*renderer)->lightWarnings(), loaded.lightsName);
    std::vector<scene::Frame> frames;
    const bool sequence = options.output.find("%04d") != std::string::npos;
    for (int i = 0; i < options.frames; ++i) {
        if (options.fps > 0.0) {
            const double seconds = options.scene.time.value_or(0.0) + i / options.fps;
            loaded.settings.hour = lighting::wrappedHour(
                loaded.settings.hour + (i > 0 ? options.hoursPerSecond / options.fps : 0.0));
            if (auto posed = loaded.poseAt(seconds); !posed) {
                return posed;
            }
        }
        auto frame = (*renderer)->render(loaded.view, loaded.settings);
        if (!frame) {
            return frame.error();
        }
        if (sequence || i + 1 == options.frames) {
            const core::Image image = kind == OutputKind::Png
                                          ? toDisplay(frame->radiance, options.exposure)
                                          : frame->radiance;
            if (auto written = io::writeImage(framePath(options.output, i), image); !written) {
                return written;
            }
        }
        frame->radiance = {};
        frames.push_back(std::move(*frame));
    }
    warn((*renderer)->probeWarnings(), loaded.lightsName);
    nlohmann::json all =
        stats(frames, (*device)->counters(), loaded, (*renderer)->probeWarnings(), **device);
    if (!options.errorView.empty()) {
        auto compared = compare(options, loaded, frames.back(), **renderer);
        if (!compared) {
            return compared.error();
        }
        all["error_view"] = std::move(*compared);
    }
    if (!options.stats.empty()) {
        const std::string text = all.dump(2) + "\n";
        if (auto written = io::writeFile(options.stats, text.data(), text.size()); !written) {
            return written;
        }
    }
    for (const std::string& message : (*device)->messages()) {
        std::fprintf(stderr, "lodestar: warning: OpenGL: %s\n", message.c_str());
    }
    return {};
}

int runRender(const RenderOptions& options) {
    auto kind = outputKind(options.output);
    if (!kind) {
        return fail(kind.error());
    }
    if (!std::isfinite(options.exposure) || std::abs(options.exposure) > 64.0) {
        return fail(usage("an exposure is a number of stops within +-64", "--exposure"));
    }
    if (!options.errorView.empty()) {
        auto picture = outputKind(options.errorView);
        if (!picture || *picture != OutputKind::Png) {
            return fail(usage("'" + options.errorView + "' does not end in .png", "--error-view"));
        }
    }
    SceneOptions asked = options.scene;
    if (options.fps > 0.0 && asked.animation.empty()) {
        asked.animation = "0";
    }
    auto loaded = load(asked);
    if (!loaded) {
        return fail(loaded.error());
    }
    warn(loaded->light.environment.warnings, loaded->light.name);
    warn(loaded->scene.warnings, options.scene.scene);
    warn(loaded->lightWarnings, loaded->lightsName);
    const int samples = options.samples > 0 ? options.samples : (*kind == OutputKind::Png ? 4 : 1);
    loaded->settings.samplesPerSide = static_cast<int>(std::lround(std::sqrt(samples)));
    if (auto rendered = renderAll(options, *kind, *loaded); !rendered) {
        return fail(rendered.error());
    }
    return 0;
}

} // namespace

void addRender(CLI::App& app, int& status) {
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command =
        app.add_subcommand("render", "Render a scene to a picture, without a window");
    addSceneOptions(*command, options->scene);
    command
        ->add_option("-o,--output", options->output,
                     "OUT.png (exposure and filmic tone map) or OUT.exr (linear radiance)")
        ->required();
    command->add_option("--exposure", options->exposure, "Stops by which a PNG is brightened")
        ->capture_default_str();
    command
        ->add_option("--samples", options->samples,
                     "Samples a pixel: 1, 4, 9 or 16 (default 4 for PNG; 1 for EXR, so that every\n"
                     "pixel holds a radiance and not a blend)")
        ->check(CLI::IsMember({1, 4, 9, 16}));
    command
        ->add_option("--frames", options->frames,
                     "Frames drawn in one process; with %04d in OUT each is kept, else the last")
        ->check(CLI::Range(1, 100000))
        ->capture_default_str();
    command
        ->add_option("--fps", options->fps,
                     "Frame I shows the animation (default: the first) at --time + I/FPS seconds")
        ->check(CLI::Range(1e-3, 1e6));
    command
        ->add_option("--hours-per-second", options->hoursPerSecond,
                     "With --fps, by how many hours the day goes on in a second of the animation")
        ->check(CLI::Range(-24.0, 24.0));
    command->add_option(
        "--error-view", options->errorView,
        "ERROR.png: the last frame against its light from afar by many taps a pixel,\n"
        "in false colour with a legend in per cent; the figures go to standard output");
    command->add_option("--error-scale", options->errorScale, "Per cent that have the last colour")
        ->check(CLI::Range(1e-3, 1e6))
        ->capture_default_str();
    command
        ->add_option(
            "--error-taps", options->errorTaps,
            "Taps a pixel of the reference, each a lookup by the lobe and one by the light")
        ->check(CLI::Range(kReferencePasses, 16384))
        ->capture_default_str();
    command->add_option("--stats", options->stats, "Write the plan, counters and times as JSON");
    command->footer(
        "Example: a model in a studio, one stop brighter\n"
        "  lodestar render helmet.glb --environment studio.hdr --exposure 1 -o helmet.png");
    command->callback([options, &status] { status = runRender(*options); });
}

} // namespace lodestar::app

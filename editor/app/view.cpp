// SPDX-License-Identifier: MIT
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "app/commands.h"
#include "app/viewer.h"
#include "io/file.h"

namespace lodestar::app {
namespace {

struct ViewOptions {
    ViewerOptions viewer;
    std::string stats;
    int samples = 4;
};

/// Draws while there is something to draw and sleeps while there is not.
core::Result<void> run(platform::Window& window, Viewer& viewer) {
    using Clock = std::chrono::steady_clock;
    auto last = Clock::now();
    std::string title;
    while (!viewer.closing()) {
        viewer.setSize(window.width(), window.height(), window.contentScale());
        const bool drawable = window.width() > 0 && window.height() > 0;
        if (drawable && viewer.wantsFrame()) {
            if (auto drawn = viewer.drawFrame(); !drawn) {
                return drawn;
            }
            window.present();
        }
        const double patience =
            drawable ? viewer.patience() : std::numeric_limits<double>::infinity();
        const std::vector<platform::Event> events =
            patience > 0.0 ? window.wait(patience) : window.poll();
        // What moved did so until now; what an event sets going has not yet.
        const auto now = Clock::now();
        viewer.advance(std::chrono::duration<double>(now - last).count());
        last = now;
        for (const platform::Event& event : events) {
            viewer.handle(event);
        }
        window.setFullScreen(viewer.fullScreen());
        if (title != viewer.title()) {
            title = viewer.title();
            window.setTitle(title);
        }
    }
    return {};
}

core::Result<void> show(const ViewOptions& options, LoadedScene loaded) {
    auto window =
        platform::Window::create("Lodestar", loaded.settings.width, loaded.settings.height);
    if (!window) {
        return window.error();
    }
    auto device = gl::Device::create();
    if (!device) {
        return device.error();
    }
    auto viewer = Viewer::make(**device, std::move(loaded), options.viewer);
    if (!viewer) {
        return viewer.error();
    }
    if (auto ended = run(*window, **viewer); !ended) {
        return ended;
    }
    if (!options.stats.empty()) {
        const std::string text = (*viewer)->stats().dump(2) + "\n";
        if (auto written = io::writeFile(options.stats, text.data(), text.size()); !written) {
            return written;
        }
    }
    for (const std::string& message : (*device)->messages()) {
        std::fprintf(stderr, "lodestar: warning: OpenGL: %s\n", message.c_str());
    }
    return {};
}

int runView(ViewOptions options) {
    if (!std::isfinite(options.viewer.exposure) || std::abs(options.viewer.exposure) > 20.0) {
        return fail(usage("an exposure is a number of stops within +-20", "--exposure"));
    }
    auto loaded = load(options.viewer.scene);
    if (!loaded) {
        return fail(loaded.error());
    }
    warn(loaded->scene.warnings, options.viewer.scene.scene);
    options.viewer.samplesPerSide = static_cast<int>(std::lround(std::sqrt(options.samples)));
    if (auto shown = show(options, std::move(*loaded)); !shown) {
        return fail(shown.error());
    }
    return 0;
}

} // namespace

void addView(CLI::App& app, int& status) {
    auto options = std::make_shared<ViewOptions>();
    CLI::App* command =
        app.add_subcommand("view", "Show a scene in a window: orbit, fly, compare estimators");
    addSceneOptions(*command, options->viewer.scene);
    command->add_option("--exposure", options->viewer.exposure, "Stops by which it is brightened")
        ->capture_default_str();
    command
        ->add_option("--samples", options->samples,
                     "Samples a pixel of a still picture: 1, 4, 9 or 16; where frames are slow, a\n"
                     "moving one has 1")
        ->check(CLI::IsMember({1, 4, 9, 16}))
        ->capture_default_str();
    command->add_option("--stats", options->stats,
                        "Write counters and the times of frames as JSON at the end");
    std::string keys = "Keys:\n";
    for (const HelpLine& line : helpLines()) {
        std::string left = line.keys;
        left.resize(32, ' ');
        keys += "  " + left + line.does + "\n";
    }
    command->footer("Example: a model in a studio, one stop brighter\n"
                    "  lodestar view helmet.glb --environment studio.hdr --exposure 1\n\n" +
                    keys);
    command->callback([options, &status] { status = runView(*options); });
}

} // namespace lodestar::app

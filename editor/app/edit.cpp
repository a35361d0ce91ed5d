// SPDX-License-Identifier: MIT
#include <chrono>
#include <cstdio>
#include <limits>
#include <memory>

#include <CLI/CLI.hpp>

#include "app/command.h"
#include "app/commands.h"
#include "app/editor.h"

namespace lodestar::app {
namespace {

struct EditOptions {
    EditorOptions editor;
    int width = 1400;
    int height = 860;
};

/// Draws while there is something to draw and sleeps while there is not.
core::Result<void> run(platform::Window& window, Editor& editor) {
    using Clock = std::chrono::steady_clock;
    auto last = Clock::now();
    std::string title;
    while (!editor.closing()) {
        const bool drawable = window.width() > 0 && window.height() > 0;
        if (drawable && editor.wantsFrame()) {
            if (auto drawn =
                    editor.drawFrame(window.width(), window.height(), window.contentScale());
                !drawn) {
                return drawn;
            }
            window.present();
        }
        if (title != editor.title()) {
            title = editor.title();
            window.setTitle(title);
        }
        const double patience =
            drawable ? editor.patience() : std::numeric_limits<double>::infinity();
        const std::vector<platform::Event> events =
            patience > 0.0 ? window.wait(patience) : window.poll();
        const auto now = Clock::now();
        editor.advance(std::chrono::duration<double>(now - last).count());
        last = now;
        for (const platform::Event& event : events) {
            editor.handle(event);
        }
    }
    return {};
}

core::Result<void> show(const EditOptions& options) {
    auto window = platform::Window::create("Lodestar", options.width, options.height);
    if (!window) {
        return window.error();
    }
    auto device = gl::Device::create();
    if (!device) {
        return device.error();
    }
    ui::Clipboard clipboard{[&] { return window->clipboard(); },
                            [&](const std::string& text) { window->setClipboard(text); }};
    EditorOptions opened = options.editor;
    opened.beside = true;
    auto editor = Editor::make(**device, opened, std::move(clipboard));
    if (!editor) {
        return editor.error();
    }
    if (auto ended = run(*window, **editor); !ended) {
        return ended;
    }
    for (const std::string& message : (*device)->messages()) {
        std::fprintf(stderr, "lodestar: warning: OpenGL: %s\n", message.c_str());
    }
    return {};
}

} // namespace

void addEdit(CLI::App& app, int& status) {
    auto options = std::make_shared<EditOptions>();
    CLI::App* command = app.add_subcommand(
        "edit", "Paint a scene's light in a window: gradients of the hours of a day, exponents");
    command->add_option("SCENE", options->editor.scene,
                        "The scene, .gltf or .glb (default: spheres that are built in)");
    command->add_option("--lighting", options->editor.lighting,
                        "The lighting document that is edited (default: SCENE-stem.lodestar.json\n"
                        "beside the scene); made at the first save where it is not there");
    command->add_option("--asset-root", options->editor.assetRoot,
                        "Folder that the scene's files may not leave (default: the scene's own)");
    command->footer("Example: paint the sky of a model\n"
                    "  lodestar edit helmet.glb\n\n"
                    "Ctrl+S saves, Ctrl+Z undoes, F1 shows all keys; what is not saved when the\n"
                    "window closes is there again at the next start (docs/editor.md).");
    command->callback([options, &status] {
        const auto shown = show(*options);
        status = shown ? 0 : fail(shown.error());
    });
}

} // namespace lodestar::app

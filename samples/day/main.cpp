// SPDX-License-Identifier: MIT
//
// lodestar-day: one scene through the hours, under lighting documents. It teaches the loop of a
// host whose sun moves: load once, set the lights once, then change the hour and draw. Nothing is
// captured and nothing filtered again; a frame blends what was baked.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "io/document_file.h"
#include "io/gltf.h"
#include "io/image_file.h"
#include "lodestar/display.glsl"
#include "platform/headless_context.h"
#include "scene/renderer.h"

namespace lodestar::samples {
namespace {

constexpr const char* kUsage =
    "usage: lodestar-day SCENE FOLDER WxH CAMERA HOUR,HOUR,.. DOCUMENT...\n"
    "Renders the scene at each hour under each lighting document, to FOLDER/STEM-HOUR.png.\n"
    "Example: lodestar-day terrace.gltf out 320x180 terrace 6,12,18 clear.lodestar.json\n";

int fail(const core::Error& error) {
    std::fprintf(stderr, "lodestar: %s\n", error.message().c_str());
    return static_cast<int>(error.code);
}

core::Image toDisplay(core::Image radiance) {
    for (std::size_t i = 0; i < radiance.pixels().size(); ++i) {
        float& value = radiance.pixels()[i];
        value =
            i % 4 == 3 ? value : shader::lodestar_srgbFromLinear(shader::lodestar_filmic(value));
    }
    return radiance;
}

struct Call {
    std::string scene, folder, camera;
    scene::RenderSettings settings;
    std::vector<std::string> hours;
    std::vector<std::string> documents;
};

bool parse(int argc, char** argv, Call& call) {
    char rest = 0;
    if (argc < 7 ||
        std::sscanf(argv[3], "%dx%d%c", &call.settings.width, &call.settings.height, &rest) != 2) {
        return false;
    }
    call.scene = argv[1];
    call.folder = argv[2];
    call.camera = argv[4];
    call.documents.assign(argv + 6, argv + argc);
    std::string hour;
    for (const char* c = argv[5];; ++c) {
        if (*c == ',' || *c == '\0') {
            char* end = nullptr;
            if (hour.empty() || !std::isfinite(std::strtod(hour.c_str(), &end)) || *end != '\0') {
                return false;
            }
            call.hours.push_back(hour);
            hour.clear();
        } else {
            hour += *c;
        }
        if (*c == '\0') {
            return call.settings.width > 0 && call.settings.height > 0;
        }
    }
}

core::Result<void> renderDay(const Call& call, const std::string& document,
                             scene::Renderer& renderer, const scene::View& view) {
    core::Tally warnings;
    const auto loaded = io::loadDocument(document, warnings);
    if (!loaded) {
        return loaded.error();
    }
    auto lights = document::dayLights(*loaded, warnings);
    if (!lights) {
        return core::inFile(lights.error(), document);
    }
    renderer.setLights(std::move(*lights));
    std::string stem = document.substr(document.rfind('/') + 1);
    stem = stem.substr(0, stem.find('.'));
    scene::RenderSettings settings = call.settings;
    settings.samplesPerSide = 2;
    for (const std::string& hour : call.hours) {
        settings.hour = std::strtod(hour.c_str(), nullptr);
        auto frame = renderer.render(view, settings);
        if (!frame) {
            return frame.error();
        }
        const std::string path = call.folder + "/" + stem + "-" + hour + ".png";
        if (auto written = io::writeImage(path, toDisplay(std::move(frame->radiance))); !written) {
            return written;
        }
    }
    return {};
}

int run(const Call& call) {
    auto file = io::loadGltf(call.scene, {});
    if (!file) {
        return fail(core::inFile(file.error(), call.scene));
    }
    const int shown = file->defaultScene;
    const scene::Scene scene = scene::buildScene(std::move(*file), shown);
    scene::CameraRequest request;
    request.name = call.camera;
    const auto view = scene::chooseView(scene, request,
                                        static_cast<float>(call.settings.width) /
                                            static_cast<float>(call.settings.height));
    if (!view) {
        return fail(core::inFile(view.error(), call.scene));
    }
    auto context = platform::HeadlessContext::create();
    if (!context) {
        return fail(context.error());
    }
    auto device = gl::Device::create();
    if (!device) {
        return fail(device.error());
    }
    auto renderer = scene::Renderer::make(**device, scene);
    if (!renderer) {
        return fail(renderer.error());
    }
    for (const std::string& document : call.documents) {
        if (auto rendered = renderDay(call, document, **renderer, *view); !rendered) {
            return fail(rendered.error());
        }
    }
    return 0;
}

} // namespace
} // namespace lodestar::samples

int main(int argc, char** argv) {
    lodestar::samples::Call call;
    if (!lodestar::samples::parse(argc, argv, call)) {
        const bool asked = argc == 2 && std::string(argv[1]) == "--help";
        std::fputs(lodestar::samples::kUsage, asked ? stdout : stderr);
        return asked ? 0 : 2;
    }
    return lodestar::samples::run(call);
}

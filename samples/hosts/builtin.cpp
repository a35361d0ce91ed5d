// SPDX-License-Identifier: MIT
//
// lodestar-host-builtin: the built-in renderer as a host among others, whose pictures are compared
// with theirs: a scene under a lighting document, its shadows left to nobody.
#include "call.h"
#include "io/document_file.h"
#include "io/environment_file.h"
#include "lodestar/display.glsl"
#include "platform/headless_context.h"
#include "scene/renderer.h"

namespace lodestar::samples {
namespace {

core::Result<void> setEnvironment(const document::Document& document, const std::string& file,
                                  scene::Renderer& renderer) {
    if (!document.environment) {
        return {};
    }
    const auto source = io::environmentSource(document.environment->source, file);
    if (!source) {
        return source.error();
    }
    auto loaded = io::loadEnvironment(*source);
    if (!loaded) {
        return core::inFile(loaded.error(), *source);
    }
    const document::Environment& wanted = *document.environment;
    renderer.setEnvironment(
        *source,
        lighting::placed(std::move(loaded->base), lighting::aboutUp(wanted.rotation), wanted.ev));
    return {};
}

core::Result<core::Image> draw(const HostCall& call, const HostScene& loaded) {
    core::Tally warnings;
    const auto document = io::loadDocument(call.lighting, warnings);
    if (!document) {
        return document.error();
    }
    auto lights = document::dayLights(*document, warnings);
    if (!lights) {
        return core::inFile(lights.error(), call.lighting);
    }
    if (lights->empty() && !document->environment) {
        return core::inFile(core::refused("has neither a light nor an environment", "/lights"),
                            call.lighting);
    }
    for (lighting::DayLight& light : *lights) {
        light.visibility = false;
    }
    auto context = platform::HeadlessContext::create();
    if (!context) {
        return context.error();
    }
    auto device = gl::Device::create();
    if (!device) {
        return device.error();
    }
    const scene::Scene scene = scene::buildScene(loaded.file, loaded.file.defaultScene);
    auto renderer = scene::Renderer::make(**device, scene);
    if (!renderer) {
        return renderer.error();
    }
    if (auto set = setEnvironment(*document, call.lighting, **renderer); !set) {
        return set.error();
    }
    (*renderer)->setLights(std::move(*lights));
    scene::RenderSettings settings;
    settings.width = call.width;
    settings.height = call.height;
    settings.hour = call.hour;
    settings.backdrop = false;
    auto frame = (*renderer)->render(loaded.view, settings);
    if (!frame) {
        return frame.error();
    }
    for (std::size_t i = 0; i < frame->radiance.pixels().size(); ++i) {
        float& value = frame->radiance.pixels()[i];
        value =
            i % 4 == 3 ? value : shader::lodestar_srgbFromLinear(shader::lodestar_filmic(value));
    }
    return std::move(frame->radiance);
}

} // namespace
} // namespace lodestar::samples

int main(int argc, char** argv) {
    return lodestar::samples::runHost("lodestar-host-builtin", argc, argv, lodestar::samples::draw);
}

// SPDX-License-Identifier: MIT
//
// From a stroke of the brush to what the next frame is lit by, without drawing it: the command, the
// document's lights, the plan, baking and uploading. Medians of strokes that each add to the last,
// as a drag does. Usage: bench-edit
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <map>
#include <vector>

#include "app/starter_scene.h"
#include "gl/device.h"
#include "model/model.h"
#include "model/presets.h"
#include "platform/headless_context.h"
#include "scene/renderer.h"

namespace {

using namespace lodestar;
using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Milliseconds of processors that this process has had.
double cpu() {
    return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

int measure(gl::Device& device) {
    const scene::Scene shown = scene::buildScene(app::starterScene());
    auto renderer = scene::Renderer::make(device, shown);
    document::Document document;
    document.lights = model::builtInPresets().front().lights;
    model::Model model(document);
    const model::Id key = model.ids().lights[0].keys[0].id;
    scene::RenderSettings settings;
    settings.width = settings.height = 16;
    const scene::View view = *scene::chooseView(shown, {}, 1.0f);
    std::map<std::string, std::vector<double>> times;
    const model::MergeToken stroke = model.newToken();
    std::vector<double> path;
    for (int i = 0; i < 220; ++i) {
        path.push_back(80.0 - 0.5 * i);
        std::map<std::string, double> ms;
        const double before = cpu();
        auto start = Clock::now();
        if (!model.execute(model::BrushStroke{key, {}, path}, stroke)) {
            return 1;
        }
        ms["1 command"] = since(start);
        start = Clock::now();
        core::Tally warnings;
        auto lights = document::dayLights(model.document(), warnings);
        (*renderer)->setLights(std::move(*lights));
        ms["2 lights"] = since(start);
        ms["2 lights, processor"] = cpu() - before;
        auto frame = (*renderer)->draw(view, settings, 1.0f);
        if (!frame) {
            std::fprintf(stderr, "%s\n", frame.error().message().c_str());
            return 1;
        }
        ms["3 plan"] = frame->timesMs["plan"];
        ms["4 bake and upload"] = frame->timesMs["prepare"];
        double sum = 0.0;
        for (const auto& [step, value] : ms) {
            sum += value;
            if (i >= 20) { // the kernel, shaders and pages of the first ones
                times[step].push_back(value);
            }
        }
        if (i >= 20) {
            times["all"].push_back(sum);
        }
    }
    for (const auto& [step, values] : times) {
        std::printf("%-18s %7.3f ms\n", step.c_str(), median(values));
    }
    return 0;
}

} // namespace

int main() {
    auto context = platform::HeadlessContext::create();
    if (!context) {
        std::fprintf(stderr, "%s\n", context.error().message().c_str());
        return 1;
    }
    auto device = gl::Device::create();
    return device ? measure(**device) : 1;
}

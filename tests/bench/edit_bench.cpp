// SPDX-License-Identifier: MIT
//
// From a stroke of the brush, or a row of the maps that is dragged, to what the next frame is lit
// by, without drawing it: the command, the document's lights, the plan, baking and uploading.
// Medians of strokes that each add to the last, as a drag does. Usage: bench-edit
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <functional>
#include <map>
#include <string>
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

/// The command of a drag's step.
using Step = std::function<model::Command(int step)>;

/// In a context of its own: drawing to none leaves errors behind.
int measure(const char* name, int steps, const Step& commandOf) {
    auto context = platform::HeadlessContext::create();
    auto made = gl::Device::create();
    if (!context || !made) {
        std::fprintf(stderr, "no OpenGL\n");
        return 1;
    }
    gl::Device& device = **made;
    const scene::Scene shown = scene::buildScene(app::starterScene());
    auto renderer = scene::Renderer::make(device, shown);
    document::Document document;
    document.lights = model::builtInPresets().front().lights;
    model::Model model(document);
    scene::RenderSettings settings;
    settings.width = settings.height = 16;
    const scene::View view = *scene::chooseView(shown, {}, 1.0f);
    std::map<std::string, std::vector<double>> times;
    const model::MergeToken stroke = model.newToken();
    double first = 0.0;
    for (int i = 0; i < steps; ++i) {
        std::map<std::string, double> ms;
        const double before = cpu();
        auto start = Clock::now();
        if (!model.execute(commandOf(i), stroke)) {
            return 1;
        }
        ms["1 command"] = since(start);
        start = Clock::now();
        core::Tally warnings;
        auto lights = document::dayLights(model.document(), warnings);
        (*renderer)->setLights(std::move(*lights), document::mapLayout(model.document()));
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
        first = i == 0 ? ms["4 bake and upload"] : first;
        if (i >= 20) {
            times["all"].push_back(sum);
        }
    }
    std::printf("%s: the first bake and upload %.0f ms, then\n", name, first);
    for (const auto& [step, values] : times) {
        std::printf("%-18s %7.3f ms\n", step.c_str(), median(values));
    }
    return 0;
}

int measureAll() {
    document::Document document;
    document.lights = model::builtInPresets().front().lights;
    const model::Id key = model::Model(document).ids().lights[0].keys[0].id;
    std::vector<double> path;
    int failed = measure("a stroke", 220, [&](int i) {
        path.push_back(80.0 - 0.5 * i);
        return model::BrushStroke{key, {}, path};
    });
    const std::vector<double> rows = lighting::rowExponents(lighting::kRsrm);
    for (const std::size_t row : {2u, 12u, 22u}) {
        const std::string name = "row " + std::to_string(row);
        failed += measure(name.c_str(), 60, [&](int i) {
            return model::SetMapRow{row, rows[row] * (1.0 + 0.002 * (i + 1))};
        });
    }
    return failed;
}

} // namespace

int main() {
    return measureAll();
}

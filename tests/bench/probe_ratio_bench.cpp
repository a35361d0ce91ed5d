// SPDX-License-Identifier: MIT
//
// A light probe that keeps the sky's part apart (`relight`: `ratio`) against one that composes:
// what shading takes, which reads two chains for one, and what a change of the sky's intensity
// takes. A ball that fills the picture, diffuse and glossy, lit by one probe. CPU time of all
// threads of the process, between two pictures that are read back; all in turn, medians.
//
//   build/bench-probe-ratio [repeats]        LP_NUM_THREADS=0: llvmpipe draws on the calling thread
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "lighting/environment.h"
#include "platform/headless_context.h"
#include "scene/probe_observer.h"
#include "scene/renderer.h"
#include "support/shapes.h"

namespace {

using namespace lodestar;

double cpuMilliseconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

scene::Scene worldOf(int width, lighting::ProbeRelight relight) {
    scene::Scene scene = scene::buildScene(testing::fileOf(
        testing::sphere(), testing::blinnPhong(glm::vec3(0.5f), glm::vec3(0.1f), 30.0f)));
    lighting::Probe probe;
    probe.name = "here";
    probe.capture.resolution = width;
    probe.relight = relight;
    core::Tally warnings;
    scene::setProbes(scene, {&probe, 1}, {}, warnings);
    scene::updateTransforms(scene);
    return scene;
}

/// One gradient that is twice as bright at 18 h as at 6 h.
lighting::DayLight day() {
    const lighting::Gradient gradient{{{90, {0.2, 0.4, 0.9}, 0}, {-90, {0.3, 0.2, 0.1}, 0}}};
    lighting::DayLight sky;
    sky.keys = {{6.0, gradient, glm::dvec3(1.0), {}}, {18.0, gradient, glm::dvec3(2.0), {}}};
    core::Tally warnings;
    return *lighting::repaired(sky, warnings);
}

class Side {
public:
    Side(gl::Device& device, int width, lighting::ProbeRelight relight)
        : scene_(worldOf(width, relight)),
          renderer_(std::move(*scene::Renderer::make(device, scene_))) {
        renderer_->setLights({day()});
        view_ = testing::frontView(scene_, 1.2f);
    }
    double milliseconds(double hour, int pixels) {
        scene::RenderSettings settings;
        settings.width = settings.height = pixels;
        settings.backdrop = false;
        settings.lightThreshold = 1e9;
        settings.hour = hour;
        const double before = cpuMilliseconds();
        const auto frame = renderer_->render(view_, settings);
        const double took = cpuMilliseconds() - before;
        passes = frame.ok() ? frame->counters.passes - 1 : 0;
        return took;
    }
    std::uint64_t passes = 0; ///< of the last frame, besides the picture's

private:
    scene::Scene scene_;
    std::unique_ptr<scene::Renderer> renderer_;
    scene::View view_;
};

} // namespace

int main(int argc, char** argv) {
    const int repeats = argc > 1 ? std::max(std::atoi(argv[1]), 1) : 31;
    auto context = platform::HeadlessContext::create();
    if (!context) {
        std::fprintf(stderr, "%s\n", context.error().message().c_str());
        return 4;
    }
    auto device = gl::Device::create();
    if (!device) {
        std::fprintf(stderr, "%s\n", device.error().message().c_str());
        return 4;
    }
    const char* threads = std::getenv("LP_NUM_THREADS");
    std::printf("%s, LP_NUM_THREADS %s; CPU ms, medians of %d\n",
                (*device)->capabilities().renderer.c_str(), threads ? threads : "not set", repeats);
    std::printf("face           picture of a megapixel   a new intensity, passes   memory, MB\n");
    for (const int width : {64, 128, 256}) {
        Side sides[] = {{**device, width, lighting::ProbeRelight::Compose},
                        {**device, width, lighting::ProbeRelight::Ratio}};
        const char* names[] = {"compose", "ratio"};
        std::vector<double> shading[2], change[2];
        std::uint64_t passes[2] = {};
        for (int i = -1; i < repeats; ++i) { // the first captures and compiles
            for (int side = 0; side < 2; ++side) {
                sides[side].milliseconds(6.0, 1024);
                const double shaded = sides[side].milliseconds(6.0, 1024);
                sides[side].milliseconds(6.0, 16); // targets of another size
                sides[side].milliseconds(6.0, 16);
                const double still = sides[side].milliseconds(6.0, 16);
                const double changed = sides[side].milliseconds(7.0 + 0.1 * i, 16);
                passes[side] = sides[side].passes;
                if (i >= 0) {
                    shading[side].push_back(shaded);
                    change[side].push_back(changed - still);
                }
            }
        }
        for (int side = 0; side < 2; ++side) {
            // A captured level, and one chain or two of four thirds of it, 8 bytes a texel.
            const double level = 6.0 * 8.0 * width * width / 1e6;
            std::printf("%4d  %-8s %20.2f %20.3f %7llu %12.2f\n", width, names[side],
                        median(shading[side]), median(change[side]),
                        static_cast<unsigned long long>(passes[side]),
                        level * (1.0 + 4.0 / 3.0 * (side + 1)));
        }
    }
    return 0;
}

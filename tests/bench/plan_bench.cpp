// SPDX-License-Identifier: MIT
//
// What deciding a frame takes on the CPU: draws and probes scattered at one density, so that a draw
// touches a few probes. Everything changed: draws are described, all that probes see has moved, the
// plan is made. Nothing changed: probes are observed and the inputs compared, as the renderer does.
//
//   build/bench-plan [repeats]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "plan/effect_plan.h"
#include "plan/probe_history.h"

namespace {

using namespace lodestar;
using namespace lodestar::plan;
using Clock = std::chrono::steady_clock;

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double timed(const std::function<void()>& work) {
    const auto start = Clock::now();
    work();
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

struct World {
    PlanInput input;
    std::vector<ProbeHistory> histories;
    std::vector<Moved> moved;
};

/// Probes of 10 m, about 1.5 of them at any place, on a ground that grows with their number.
World scattered(int probes, int draws) {
    std::mt19937 random(17);
    const float side = std::sqrt(static_cast<float>(probes) * 100.0f / 1.5f);
    std::uniform_real_distribution<float> place(0.0f, side);
    World world;
    lighting::ProbeVolume volume;
    volume.blend.fill(1.0);
    for (int i = 0; i < probes; ++i) {
        ProbeView view;
        view.subject = "probe " + std::to_string(i);
        glm::mat4 at(1.0f);
        at[3] = glm::vec4(place(random), 0.0f, place(random), 1.0f);
        view.influence = lighting::place(volume, at, false);
        view.position = glm::vec3(at[3]);
        view.capture.farPlane = 30.0;
        world.input.probes.push_back(view);
    }
    world.histories.resize(static_cast<std::size_t>(probes));
    for (int i = 0; i < draws; ++i) {
        DrawView draw;
        draw.subject = "draw " + std::to_string(i);
        const glm::vec3 at(place(random), 0.0f, place(random));
        draw.low = at - 0.5f;
        draw.high = at + 0.5f;
        draw.features = bit(Feature::Normals);
        draw.geometry = static_cast<std::uint64_t>(i % 50);
        draw.material = static_cast<std::uint32_t>(i % 20);
        draw.screenShare = 1e-4f;
        draw.visible = i % 2 == 0;
        world.input.draws.push_back(draw);
        world.moved.push_back({draw.subject, draw.low, draw.high, 0.1});
    }
    world.input.environment = {"sky", 128, false};
    world.input.faceBudget = 12;
    return world;
}

void measure(int probes, int draws, int repeats) {
    World world = scattered(probes, draws);
    LightState light;
    std::vector<double> changed, decided, rested;
    const auto observeAll = [&](const std::vector<Moved>& things) {
        const MovedIndex moved(things);
        for (std::size_t i = 0; i < world.histories.size(); ++i) {
            observe(world.histories[i], world.input.probes[i], moved, light, 0.1);
        }
    };
    const auto note = [&](const EffectPlan& made) {
        const std::vector<ProbeDone> done = doneFor(made, world.histories.size());
        for (std::size_t i = 0; i < world.histories.size(); ++i) {
            executed(world.histories[i], done[i], light);
        }
    };
    for (ProbeHistory& history : world.histories) {
        history.ready = true;
        history.stale.fill(false);
    }
    for (int i = 0; i < repeats; ++i) {
        EffectPlan made;
        const double observing = timed([&] { observeAll(world.moved); });
        const double planning = timed([&] { made = plan::plan(world.input); });
        const double noting = timed([&] { note(made); });
        decided.push_back(planning);
        changed.push_back(observing + planning + noting);
    }
    for (ProbeHistory& history : world.histories) {
        history = {};
        history.ready = true;
        history.stale.fill(false);
        history.position =
            world.input.probes[static_cast<std::size_t>(&history - world.histories.data())]
                .position;
    }
    PlanInput before = world.input;
    bool same = false;
    for (int i = 0; i < repeats; ++i) {
        rested.push_back(timed([&] {
            observeAll({});
            std::vector<DrawView> draws_ = std::move(world.input.draws);
            world.input.draws.clear();
            before.draws.clear();
            same = world.input == before;
            before = world.input;
            world.input.draws = std::move(draws_);
            note({});
        }));
    }
    std::printf("%7d %8d   %9.3f   %9.3f   %9.3f%s\n", probes, draws, median(changed),
                median(decided), median(rested), same ? "" : " (not the same)");
}

} // namespace

int main(int argc, char** argv) {
    const int repeats = argc > 1 ? std::max(std::atoi(argv[1]), 1) : 21;
    std::printf("medians of %d, ms\n", repeats);
    std::printf(" probes    draws   all changed   plan alone   nothing changed\n");
    for (const auto& [probes, draws] :
         {std::pair(0, 10000), std::pair(100, 1000), std::pair(300, 3000), std::pair(1000, 10000),
          std::pair(3000, 30000), std::pair(10000, 100000)}) {
        measure(probes, draws, repeats);
    }
    return 0;
}

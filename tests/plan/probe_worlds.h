// SPDX-License-Identifier: MIT
//
// Worlds of probes and draws that go on from frame to frame, planned without a GPU.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <glm/mat4x4.hpp>

#include "plan/effect_plan.h"
#include "plan/probe_history.h"

namespace lodestar::plan {

inline DrawView drawAt(const glm::vec3& center, float half = 0.5f) {
    DrawView draw;
    draw.subject = "ball";
    draw.low = center - half;
    draw.high = center + half;
    draw.bluntest = 4.0;
    draw.sharpest = 300.0;
    return draw;
}

inline lighting::Probe probeAt(const std::string& name, const glm::dvec3& at, double size,
                               double blend) {
    lighting::Probe probe;
    probe.name = name;
    probe.position = at;
    probe.influence.size = glm::dvec3(size);
    probe.influence.blend.fill(blend);
    return probe;
}

inline ProbeView viewOf(const lighting::Probe& probe) {
    ProbeView view;
    view.subject = probe.name;
    glm::mat4 world(1.0f);
    world[3] = glm::vec4(glm::vec3(probe.position), 1.0f);
    view.influence = lighting::place(probe.influence, world, !probe.exterior);
    view.position = glm::vec3(probe.position);
    view.capture = probe.capture;
    view.update = probe.update;
    view.every = probe.every;
    view.priority = probe.priority;
    view.interior = !probe.exterior;
    view.ratio = probe.relight == lighting::ProbeRelight::Ratio;
    return view;
}

/// A world that goes on from frame to frame.
class World {
public:
    explicit World(std::vector<lighting::Probe> probes)
        : probes_(std::move(probes)), histories_(probes_.size()) {}
    PlanInput input;
    LightState light;
    std::vector<Moved> moved;
    double threshold = 0.1;
    std::function<void(std::size_t, ProbeView&)> describe; ///< what else is known of a probe
    std::vector<ProbeHistory>& histories() { return histories_; }
    std::vector<lighting::Probe>& probes() { return probes_; }

    EffectPlan frame() {
        input.probes.clear();
        const MovedIndex index(std::exchange(moved, {}));
        for (std::size_t i = 0; i < probes_.size(); ++i) {
            input.probes.push_back(viewOf(probes_[i]));
            observe(histories_[i], input.probes.back(), index, light, threshold);
            if (describe) {
                describe(i, input.probes.back());
            }
        }
        EffectPlan result = plan(input);
        const std::vector<ProbeDone> done = doneFor(result, probes_.size());
        for (std::size_t i = 0; i < probes_.size(); ++i) {
            executed(histories_[i], done[i], light);
        }
        return result;
    }

private:
    std::vector<lighting::Probe> probes_;
    std::vector<ProbeHistory> histories_;
};

inline World lobby(lighting::ProbeUpdate update = lighting::ProbeUpdate::OnChange) {
    lighting::Probe probe = probeAt("Lobby", {0, 0, 0}, 10.0, 1.0);
    probe.update = update;
    World world({probe});
    world.input.draws = {drawAt({0, 0, 2})};
    world.input.faceBudget = 6;
    return world;
}

inline std::string captureText(const EffectPlan& plan, const std::string& subject) {
    for (const Effect& effect : plan.effects) {
        if (effect.effect == "probe-capture" && effect.subject == subject) {
            return effect.decision == Decision::Run
                       ? effect.reason
                       : std::string("skipped: ").append(effect.reason);
        }
    }
    return "none";
}

inline const ProbeWork* workOf(const EffectPlan& plan, std::size_t probe) {
    const auto at = std::find_if(plan.probeWork.begin(), plan.probeWork.end(),
                                 [&](const ProbeWork& work) { return work.probe == probe; });
    return at == plan.probeWork.end() ? nullptr : &*at;
}

} // namespace lodestar::plan

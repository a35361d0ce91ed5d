// SPDX-License-Identifier: MIT
#include "scene/probe_observer.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "scene/draw_list.h"

namespace lodestar::scene {
namespace {

/// A punctual light is felt as far as it gives that irradiance, where it has no range.
constexpr float kFeltIrradiance = 0.05f;

float reachOf(const io::GltfLight& light) {
    const float brightest =
        std::max({light.color.r, light.color.g, light.color.b}) * light.intensity;
    return std::min(light.range, std::sqrt(std::max(brightest, 0.0f) / kFeltIrradiance));
}

plan::Moved movedFromTo(std::string subject, const Bounds& before, const Bounds& now) {
    Bounds both = before;
    both.add(now);
    const double way = before.empty() || now.empty()
                           ? 0.0
                           : static_cast<double>(std::max(glm::length(now.low - before.low),
                                                          glm::length(now.high - before.high)));
    return {std::move(subject), both.low, both.high, way};
}

} // namespace

ProbeObserver::ProbeObserver(const Scene& scene) : scene_(scene) {
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        for (std::size_t c = 0; c < scene.nodes[n].components.size(); ++c) {
            if (std::holds_alternative<ProbeComponent>(scene.nodes[n].components[c])) {
                places_.push_back({n, c});
            }
        }
    }
    histories_.resize(places_.size());
}

const ProbeComponent& ProbeObserver::component(std::size_t index) const {
    const Place& place = places_[index];
    return std::get<ProbeComponent>(scene_.nodes[place.node].components[place.component]);
}

const lighting::Probe& ProbeObserver::probe(std::size_t index) const {
    return component(index).probe;
}

/// The frame of a probe: its node's, moved to where it captures.
glm::mat4 ProbeObserver::worldFromProbe(std::size_t index) const {
    return glm::translate(scene_.nodes[places_[index].node].worldFromNode,
                          glm::vec3(probe(index).position));
}

std::optional<lighting::PlacedVolume> ProbeObserver::proxy(std::size_t index) const {
    const std::optional<lighting::ProbeVolume>& proxy = probe(index).proxy;
    return proxy ? lighting::place(*proxy, worldFromProbe(index), false) : std::nullopt;
}

plan::ProbeView ProbeObserver::view(std::size_t index) const {
    const lighting::Probe& probe = this->probe(index);
    const glm::mat4 world = worldFromProbe(index);
    plan::ProbeView view;
    view.subject = probe.name;
    view.influence = lighting::place(probe.influence, world, !probe.exterior);
    view.position = glm::vec3(world[3]);
    view.capture = probe.capture;
    view.update = probe.update;
    view.every = probe.every;
    view.priority = probe.priority;
    view.interior = !probe.exterior;
    view.fromFile = component(index).map != nullptr;
    return view;
}

std::vector<plan::Moved> ProbeObserver::moved(const plan::PlanInput& input) {
    std::vector<plan::Moved> moved;
    const bool first = boxes_.size() != input.draws.size();
    boxes_.resize(input.draws.size());
    for (std::size_t i = 0; i < input.draws.size(); ++i) {
        const plan::DrawView& draw = input.draws[i];
        const Box now{draw.low, draw.high};
        const bool morphs = draw.morphBytes > 0 && draw.weightsChanged;
        if (!first && (boxes_[i] != now || morphs)) {
            moved.push_back(movedFromTo(draw.subject, Bounds{boxes_[i].low, boxes_[i].high},
                                        Bounds{now.low, now.high}));
        }
        boxes_[i] = now;
    }
    addMovedLights(moved);
    return moved;
}

void ProbeObserver::addMovedLights(std::vector<plan::Moved>& moved) {
    const std::vector<PlacedLight> placed = placedLights(scene_);
    const bool first = lights_.size() != placed.size();
    lights_.resize(placed.size());
    for (std::size_t i = 0; i < placed.size(); ++i) {
        const glm::mat4& now = placed[i].node->worldFromNode;
        if (!first && lights_[i] != now) {
            const bool directional = placed[i].light->kind == io::LightKind::Directional;
            const glm::vec3 reach(directional ? std::numeric_limits<float>::max() / 4
                                              : reachOf(*placed[i].light));
            const glm::vec3 from(lights_[i][3]);
            const glm::vec3 to(now[3]);
            moved.push_back(
                movedFromTo(placed[i].node->name.empty() ? "a lamp" : placed[i].node->name,
                            {from - reach, from + reach}, {to - reach, to + reach}));
        }
        lights_[i] = now;
    }
}

void ProbeObserver::describe(const plan::LightState& light, bool drawsKept, double lightThreshold,
                             plan::PlanInput& input) {
    light_ = light;
    const plan::MovedIndex moved(drawsKept ? std::vector<plan::Moved>() : this->moved(input));
    input.probes.resize(places_.size());
    for (std::size_t i = 0; i < places_.size(); ++i) {
        plan::ProbeView& view = input.probes[i];
        view = this->view(i);
        plan::observe(histories_[i], view, moved, light, lightThreshold);
    }
}

void ProbeObserver::executed(const plan::EffectPlan& plan) {
    const std::vector<plan::ProbeDone> done = plan::doneFor(plan, places_.size());
    for (std::size_t i = 0; i < places_.size(); ++i) {
        plan::executed(histories_[i], done[i], light_);
    }
}

void addProbes(Scene& scene, std::span<const lighting::Probe> probes,
               std::span<const lighting::Cubemap> maps, core::Tally& warnings) {
    for (std::size_t i = 0; i < probes.size(); ++i) {
        const lighting::Probe& probe = probes[i];
        auto node = scene.nodes.end();
        if (!probe.node.empty()) {
            node = std::find_if(scene.nodes.begin(), scene.nodes.end(),
                                [&](const Node& n) { return n.name == probe.node; });
            if (node == scene.nodes.end()) {
                warnings.add("light probe at a node that the scene lacks, left out");
                continue;
            }
        } else {
            scene.nodes.push_back(Node{probe.name, -1, glm::mat4(1.0f), glm::mat4(1.0f), {}, {}});
            node = scene.nodes.end() - 1;
        }
        std::shared_ptr<const lighting::Cubemap> map;
        if (i < maps.size() && !maps[i].empty()) {
            map = std::make_shared<const lighting::Cubemap>(maps[i]);
        }
        node->components.emplace_back(ProbeComponent{probe, std::move(map)});
    }
}

} // namespace lodestar::scene

// SPDX-License-Identifier: MIT
#include "scene/probe_observer.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>

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

/// Whether a probe's light is the only thing at a node that was made for it.
bool isOwnNode(const Node& node) {
    const auto* probe = node.components.size() == 1
                            ? std::get_if<ProbeComponent>(&node.components.front())
                            : nullptr;
    return probe != nullptr && probe->probe.node.empty();
}

bool capturesAs(const ProbeComponent& a, const ProbeComponent& b) {
    return a.map == b.map && a.probe.capture == b.probe.capture &&
           a.probe.relight == b.probe.relight; // its chains
}

/// Which of `before` each of `now` is, or -1: one that is equal, else one that captures alike at
/// its place.
std::vector<int> sameProbes(const std::vector<ProbeComponent>& before,
                            const std::vector<ProbeComponent>& now) {
    std::unordered_multimap<std::string_view, std::size_t> byName;
    for (std::size_t i = before.size(); i-- > 0;) {
        byName.emplace(before[i].probe.name, i);
    }
    std::vector<int> which(now.size(), -1);
    std::vector<bool> taken(before.size(), false);
    const auto take = [&](std::size_t i, std::size_t was) {
        which[i] = static_cast<int>(was);
        taken[was] = true;
    };
    for (std::size_t i = 0; i < now.size(); ++i) {
        const auto [first, end] = byName.equal_range(now[i].probe.name);
        const auto same = std::find_if(first, end, [&](const auto& named) {
            const ProbeComponent& was = before[named.second];
            return !taken[named.second] && was.map == now[i].map && was.probe == now[i].probe;
        });
        if (same != end) {
            take(i, same->second);
        }
    }
    for (std::size_t i = 0; i < std::min(now.size(), before.size()); ++i) {
        if (which[i] < 0 && !taken[i] && capturesAs(before[i], now[i])) {
            take(i, i);
        }
    }
    return which;
}

} // namespace

ProbeObserver::ProbeObserver(const Scene& scene) : scene_(scene) {
    findPlaces();
    histories_.resize(places_.size());
}

void ProbeObserver::findPlaces() {
    places_.clear();
    known_.clear();
    for (std::size_t n = 0; n < scene_.nodes.size(); ++n) {
        for (std::size_t c = 0; c < scene_.nodes[n].components.size(); ++c) {
            if (const auto* probe = std::get_if<ProbeComponent>(&scene_.nodes[n].components[c])) {
                places_.push_back({n, c, probe->probe.relight == lighting::ProbeRelight::Ratio});
                known_.push_back(*probe);
            }
        }
    }
}

std::vector<int> ProbeObserver::rescan() {
    const std::vector<ProbeComponent> before = std::move(known_);
    std::vector<plan::ProbeHistory> histories = std::move(histories_);
    findPlaces();
    const std::vector<int> which = sameProbes(before, known_);
    histories_.assign(places_.size(), {});
    for (std::size_t i = 0; i < which.size(); ++i) {
        if (which[i] < 0) {
            continue;
        }
        const auto was = static_cast<std::size_t>(which[i]);
        histories_[i] = std::move(histories[was]);
        const lighting::Probe& then = before[was].probe;
        const lighting::Probe& now = known_[i].probe;
        if (then.position != now.position || then.node != now.node) {
            histories_[i].requested = true;
        }
    }
    return which;
}

const ProbeComponent& ProbeObserver::component(std::size_t index) const {
    const Place& place = places_[index];
    return std::get<ProbeComponent>(scene_.nodes[place.node].components[place.component]);
}

const lighting::Probe& ProbeObserver::probe(std::size_t index) const {
    return component(index).probe;
}

bool ProbeObserver::ratios() const {
    for (std::size_t i = 0; i < count(); ++i) {
        if (ratio(i)) {
            return true;
        }
    }
    return false;
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
    view.ratio = ratio(index);
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

void setProbes(Scene& scene, std::span<const lighting::Probe> probes,
               std::span<const ProbeMap> maps, core::Tally& warnings) {
    while (!scene.nodes.empty() && isOwnNode(scene.nodes.back())) {
        scene.nodes.pop_back();
    }
    for (Node& node : scene.nodes) {
        std::erase_if(node.components, [](const Component& component) {
            return std::holds_alternative<ProbeComponent>(component);
        });
    }
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
        node->components.emplace_back(ProbeComponent{probe, i < maps.size() ? maps[i] : nullptr});
    }
}

} // namespace lodestar::scene

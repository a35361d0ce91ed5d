// SPDX-License-Identifier: MIT
//
// What the planner is told of a scene's light probes: where they are, what has moved before them,
// under what light they were captured.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "plan/effect_plan.h"
#include "plan/probe_history.h"
#include "scene/scene.h"

namespace lodestar::scene {

class ProbeObserver {
public:
    explicit ProbeObserver(const Scene& scene);

    /// Finds the scene's probes anew. One that captures as one did before goes on from what is kept
    /// of that: the same in all its values, else the one that stood at its place among them. Where
    /// it stands elsewhere it is asked to capture again.
    /// @return of each probe which it was, or -1
    std::vector<int> rescan();

    [[nodiscard]] bool empty() const { return places_.empty(); }
    [[nodiscard]] std::size_t count() const { return places_.size(); }
    [[nodiscard]] const lighting::Probe& probe(std::size_t index) const;
    [[nodiscard]] const ProbeComponent& component(std::size_t index) const;

    /// Whether a probe's sky may change by a factor alone; whether some probe's may.
    [[nodiscard]] bool ratio(std::size_t index) const { return places_[index].ratio; }
    [[nodiscard]] bool ratios() const;

    /// Its proxy in the world; nothing where it has none, or one without an inside.
    [[nodiscard]] std::optional<lighting::PlacedVolume> proxy(std::size_t index) const;

    /// Fills the input's probes from the scene's pose and the draws that it holds already.
    /// @param light of this frame  @param drawsKept no draw has changed since the last call
    void describe(const plan::LightState& light, bool drawsKept, double lightThreshold,
                  plan::PlanInput& input);
    /// Notes what has been done for the input last described.
    void executed(const plan::EffectPlan& plan);
    /// Asks for a capture of one whose update is on demand.
    void request(std::size_t index) { histories_[index].requested = true; }
    [[nodiscard]] bool isReady(std::size_t index) const { return histories_[index].ready; }
    /// How far its round of faces has come, plan::progressOf.
    [[nodiscard]] double progress(std::size_t index) const {
        return plan::progressOf(histories_[index]);
    }
    /// What is kept of a probe is lost: it is captured anew.
    void forget(std::size_t index) { histories_[index] = {}; }

private:
    struct Place {
        std::size_t node = 0, component = 0;
        bool ratio = false; ///< its chains are made for it: as it was at first
    };
    struct Box {
        glm::vec3 low{0.0f}, high{0.0f};
        bool operator==(const Box&) const = default;
    };

    void findPlaces();
    [[nodiscard]] glm::mat4 worldFromProbe(std::size_t index) const;
    [[nodiscard]] plan::ProbeView view(std::size_t index) const;
    [[nodiscard]] std::vector<plan::Moved> moved(const plan::PlanInput& input);
    void addMovedLights(std::vector<plan::Moved>& moved);

    const Scene& scene_;
    std::vector<Place> places_;
    std::vector<ProbeComponent> known_; ///< by probe, as when the places were found
    std::vector<plan::ProbeHistory> histories_;
    std::vector<Box> boxes_;        ///< of the draws, when last described
    std::vector<glm::mat4> lights_; ///< the punctual lights' frames
    plan::LightState light_;
};

/// A file's light that a probe holds, level 0; null: the probe is captured.
using ProbeMap = std::shared_ptr<const lighting::Cubemap>;

/// Gives the scene light probes in place of those that it had: at the nodes that they name, else
/// at nodes of their own behind the others. Those whose node the scene lacks are counted and left
/// out. A renderer of the scene wants Renderer::probesChanged.
/// @param maps in the probes' order; may be shorter
void setProbes(Scene& scene, std::span<const lighting::Probe> probes,
               std::span<const ProbeMap> maps, core::Tally& warnings);

} // namespace lodestar::scene

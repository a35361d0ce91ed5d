// SPDX-License-Identifier: MIT
//
// Which probes light a draw, and what a frame does for them: faces captured, skies composed behind
// them, mips and irradiance made.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "lighting/probe.h"

namespace lodestar::plan {

struct PlanInput;
struct EffectPlan;
struct ProbeWork;

/// A probe as the planner sees it.
struct ProbeView {
    std::string subject;
    /// Absent: it has no inside, or its node is gone; it lights nothing and costs nothing.
    std::optional<lighting::PlacedVolume> influence;
    glm::vec3 position{0.0f}; ///< where it captures, in the world
    lighting::ProbeCapture capture;
    lighting::ProbeUpdate update = lighting::ProbeUpdate::OnChange;
    int every = 1;
    int priority = 0;
    bool interior = false;
    bool fromFile = false;       ///< holds a file's light: nothing is captured
    bool ready = false;          ///< it has been published: it can light
    std::array<bool, 6> stale{}; ///< faces that no longer show what is there, or never did
    std::array<bool, 6> drawn{}; ///< faces drawn anew since it was last published
    /// Those of the drawn that earlier plans asked for and that are not there yet, where faces come
    /// later than the plan: PlanInput::facesComeLater.
    std::array<bool, 6> awaited{};
    std::string because;      ///< what made them stale: "the lift moved"
    int waiting = 0;          ///< frames since its first stale face became so
    double speed = 0.0;       ///< of the fastest thing that made it so, metres a frame
    double lightChange = 0.0; ///< relative change of what lights its geometry since captured
    bool requested = false;   ///< asked for, of ProbeUpdate::OnDemand
    /// What stands behind its geometry, since it was composed; with `ratio`, by more than a factor.
    bool skyChanged = false;
    bool ratio = false;        ///< lighting::ProbeRelight::Ratio
    glm::vec3 skyFactor{1.0f}; ///< of `ratio`: the sky over the one composed, [0, kGreatestFactor]
    int madeLevel = 0;         ///< the deepest that its light has
    bool madeIrradiance = false; ///< whether it has any
    int fadeLeft = 0;            ///< frames until what was published last shows fully
    int drawnFor = 0;            ///< frames that the faces drawn have taken
    /// What each face takes, milliseconds; 0: not known yet.
    std::array<double, 6> faceMs{};
    double lightMs = 0.0; ///< what making its light takes: composition, mips, irradiance
    bool operator==(const ProbeView&) const = default;
};

/// The two probes that light a draw, the one in front first; what shaders/lodestar/probes.glsl
/// calls w0, w1 belong to them point by point.
struct ProbeChoice {
    static constexpr int kNone = -1;
    std::array<int, 2> probe{kNone, kNone}; ///< into PlanInput::probes
    std::array<bool, 2> dark{};             ///< it keeps the sky out and gives no light
    std::array<float, 2> factor{};          ///< f0, f1 of lodestar_probeShares
    float open = 1.0f;                      ///< the same's
    bool operator==(const ProbeChoice&) const = default;
};

/// Finds the probes about a box quickly. Refers to the views that it was made of.
class ProbeIndex {
public:
    explicit ProbeIndex(std::span<const ProbeView> probes);
    ~ProbeIndex();
    ProbeIndex(const ProbeIndex&) = delete;
    ProbeIndex& operator=(const ProbeIndex&) = delete;

    /// The choice for a draw. Probes stand in order of priority, the smaller volume, the list: each
    /// hides those behind it by its mean weight over the box. The two that show most are taken; a
    /// third that shows as much as the second drives its factor to 0, so that nothing jumps when it
    /// takes its place.
    /// @param lights by probe, whether it can; an interior that cannot keeps the sky out all the
    /// same
    /// @param except one that does not, whose own capture it is
    [[nodiscard]] ProbeChoice choose(const glm::vec3& low, const glm::vec3& high,
                                     const std::vector<bool>& lights,
                                     int except = ProbeChoice::kNone) const;
    /// The probes whose influence a box touches, in the order that `choose` uses.
    void touching(const glm::vec3& low, const glm::vec3& high, std::vector<int>& out) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Whether each probe could light when the frame began.
[[nodiscard]] std::vector<bool> readyProbes(const PlanInput& input);

/// Decides which faces are drawn and what is made of them, and says so. The faces' draws are those
/// that they see, in the input's order. @return the probes that light each draw of the picture;
/// empty where there are none
[[nodiscard]] std::vector<ProbeChoice> planProbes(const PlanInput& input, const ProbeIndex& index,
                                                  EffectPlan& result);

} // namespace lodestar::plan

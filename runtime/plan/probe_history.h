// SPDX-License-Identifier: MIT
//
// What is known of probes from the frames before: which faces have gone stale and why, what has
// been drawn and not been published, under what light it was captured. Values only; a renderer
// keeps one history a probe, describes it to the planner, and tells it what was done.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "plan/box_tree.h"
#include "plan/probe_plan.h"
#include "plan/sky_factor.h"

namespace lodestar::plan {

/// Something that has moved, appeared or gone since the frame before.
struct Moved {
    std::string subject;
    glm::vec3 low{0.0f}, high{0.0f}; ///< world box about where it was and where it is
    double speed = 0.0;              ///< metres this frame
};

/// All that has moved, found by the faces that see it.
class MovedIndex {
public:
    explicit MovedIndex(std::vector<Moved> moved = {});
    /// What faces see of it.
    struct Seen {
        unsigned faces = 0;           ///< a set of bits, in OpenGL's order
        const Moved* first = nullptr; ///< the fastest of those that told
        bool more = false;            ///< there are others
    };
    [[nodiscard]] Seen from(const glm::vec3& position, double nearPlane, double farPlane) const;

private:
    std::vector<Moved> moved_;
    BoxTree tree_;
};

/// What lights the world at a frame.
struct LightState {
    /// Of each source the irradiance that a surface facing it gets, times the unit direction
    /// towards it (a sky's: its irradiance about +Y, with +Y), rgb a row. Sources keep their
    /// places.
    std::vector<std::array<glm::dvec3, 3>> sources;
    std::uint64_t sky = 0; ///< another value where what stands behind captured geometry has changed
    /// The same to be compared by its factor; null where no probe asks for that.
    std::shared_ptr<const SkyRadiance> radiance{};
    bool operator==(const LightState&) const = default;
};

/// A source of LightState::sources.
[[nodiscard]] inline std::array<glm::dvec3, 3> along(const glm::dvec3& irradiance,
                                                     const glm::dvec3& axis) {
    return {irradiance.r * axis, irradiance.g * axis, irradiance.b * axis};
}

/// By how much light bounced off a matt surface may differ between two states, relative to the
/// earlier's sum: the sum over sources of the vectors' differences bounds it for any normal.
[[nodiscard]] double lightChange(const LightState& then, const LightState& now);

/// Faces are drawn in rounds: once all that are stale have been drawn, they are published together.
struct ProbeHistory {
    std::array<bool, 6> stale{true, true, true, true, true, true};
    std::array<bool, 6> drawn{}; ///< in this round
    std::array<bool, 6> again{}; ///< changed since they were drawn: stale in the next round
    bool ready = false;
    bool requested = false;
    bool asked = false; ///< this round is a request's
    int madeLevel = 0;  ///< the deepest that its light has
    bool madeIrradiance = false;
    std::string because = "it shows nothing yet";
    int waiting = 0;      ///< frames
    int drawnFor = 0;     ///< frames that this round has taken
    int sinceCapture = 0; ///< frames since the last was published
    double speed = 0.0;   ///< metres a frame
    int fadeLeft = 0;     ///< frames
    std::optional<glm::vec3> position;
    LightState capturedUnder; ///< when the first of the six faces that show was drawn
    LightState drawingUnder;  ///< when the first of this round was
    std::uint64_t composedUnder = 0;
    std::shared_ptr<const SkyRadiance> composedRadiance; ///< the same
    glm::vec3 skyFactor{1.0f}; ///< of the last sky that was the composed one times a factor
    bool operator==(const ProbeHistory&) const = default;
};

/// How far a probe's round of faces has come, [0, 1]: 1 where nothing is stale and all that was
/// drawn shows.
[[nodiscard]] double progressOf(const ProbeHistory& history);

/// Marks what has changed since the frame before and fills the view's part that comes of it.
/// `view`'s influence, position, capture, update, every, fromFile are set already.
void observe(ProbeHistory& history, ProbeView& view, const MovedIndex& moved,
             const LightState& light, double lightThreshold);

/// What a plan has had done for a probe.
struct ProbeDone {
    std::array<bool, 6> faces{};     ///< those drawn
    const ProbeWork* work = nullptr; ///< of the plan; none where it has none
};

/// What a plan has for each of so many probes. Refers to the plan.
[[nodiscard]] std::vector<ProbeDone> doneFor(const EffectPlan& plan, std::size_t probes);

/// Notes what has been done. @param light the frame's
void executed(ProbeHistory& history, const ProbeDone& done, const LightState& light);

} // namespace lodestar::plan

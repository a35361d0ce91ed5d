// SPDX-License-Identifier: MIT
//
// Light probes as a host makes them, or a document has them: where they are, what the host has
// drawn of them, and the light that is made of it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <glm/mat4x4.hpp>

#include "core/result.h"
#include "core/tally.h"
#include "lighting/cube_texels.h"
#include "lighting/cubemap.h"
#include "lighting/probe.h"
#include "lodestar/lodestar_probes.h"
#include "plan/probe_history.h"

namespace lodestar::plugin {

/// What plans change of a probe; a plan that fails leaves it as it was.
struct ProbeState {
    plan::ProbeHistory history;
    /// By face, the plan that asked for it and still awaits it; 0: none does.
    std::array<LodestarPlan, 6> askedBy{};
    std::shared_ptr<const lighting::Cubemap> captured;     ///< premultiplied by coverage
    std::shared_ptr<const lighting::Cubemap> lit;          ///< the sky behind it, with tent mips
    std::shared_ptr<const lighting::CubeTexels> texels[2]; ///< of lit; of its irradiance
    std::uint64_t version = 0;                             ///< of lit
    std::uint64_t shown = 0; ///< the version that a plan's draws or jobs were last lit by
    int lastLevel = 0;       ///< of lit, that lookups read
};

class PlacedProbe {
public:
    /// @errors InputRefused with a JSON pointer of the member
    [[nodiscard]] static core::Result<PlacedProbe> make(const LodestarProbeDesc& desc);
    /// One of a document's: at a node it is nowhere until it is moved.
    PlacedProbe(lighting::Probe probe, const glm::dmat3& hostFromDocument, core::Tally& warnings);

    [[nodiscard]] const lighting::Probe& probe() const { return probe_; }
    [[nodiscard]] glm::dvec3 position() const;
    [[nodiscard]] std::optional<lighting::PlacedVolume> proxy() const;
    [[nodiscard]] int width() const { return held_ ? held_->width() : probe_.capture.resolution; }
    void move(const glm::dmat4& worldFromProbe) { frame_ = worldFromProbe; }
    /// It holds a cube's level 0 from here on.
    void hold(lighting::Cubemap base);
    void request();

    /// The planner's view, but for what history says.
    [[nodiscard]] plan::ProbeView view() const;
    /// A face that a plan asked for, width^2 pixels of four channels. @return whether it is awaited
    bool setFace(LodestarPlan plan, int face, const float* pixels, core::Tally& warnings);
    /// Faces that were asked for so long ago that they will not come are to be drawn again.
    /// @param next the plan that is being made
    static void giveUp(ProbeState& state, LodestarPlan next);
    /// What was captured, with the faces of the round in their places.
    [[nodiscard]] std::shared_ptr<const lighting::Cubemap> published(const ProbeState& state) const;
    /// Forgets the faces that a plan has published.
    void clearStaged() noexcept;

    ProbeState state;

private:
    PlacedProbe() = default;

    lighting::Probe probe_;
    std::optional<glm::dmat4> frame_; ///< world from the probe's frame; absent: it is nowhere
    std::shared_ptr<const lighting::Cubemap> held_;
    std::array<std::vector<glm::vec4>, 6> staged_; ///< drawn and not yet published
};

/// Radiance of what is behind everything in a unit direction; suns are no part of it.
using SkyRadiance = std::function<glm::vec3(const glm::vec3&)>;

/// Composes what a probe lights with into the state, a new version of it.
/// @param fadeLeft frames, this one too, until it shows fully
/// @param lastLevel that lookups read, at most the chain's
void compose(ProbeState& state, const SkyRadiance& sky, int fadeLeft, int lastLevel);

} // namespace lodestar::plugin

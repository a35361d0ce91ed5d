// SPDX-License-Identifier: MIT
//
// Plans of frames, immutable once they are made: what the [gl] thread executes while the [main] one
// goes on.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "core/result.h"
#include "lighting/cube_texels.h"
#include "lighting/light_map.h"
#include "lodestar/lodestar.h"
#include "plan/effect_plan.h"
#include "plugin/uniforms.glsl"
#include "probe_plans.h"

namespace lodestar::plugin {

/// A frame's plan, and all that executing it needs.
struct Packet {
    struct Light {
        LodestarPlannedLight shown{};
        std::shared_ptr<const lighting::LightMap::Blend> blend;
    };
    struct Cube {
        LodestarEnvironment of = 0;
        std::uint64_t version = 0;
        std::shared_ptr<const lighting::CubeTexels> texels; ///< null: nothing reads it
    };
    plan::EffectPlan plan;
    lighting::RsrmLayout maps = lighting::kRsrm; ///< of the lights
    std::vector<LodestarLight> layers;           ///< what the layers of the arrays are of
    std::vector<Light> lights;                   ///< those that the frame is lit by
    Cube environment, irradiance;
    std::vector<LodestarFaceJob> jobs;
    ProbePacket probes;
    std::vector<std::uint32_t> features; ///< LODESTAR_FEATURE_*, of each draw of the host's
    blocks::LodestarLighting uniforms{};
    LodestarWork work{};
};

/// A plan's features as LODESTAR_FEATURE_*.
[[nodiscard]] std::uint32_t featureBits(plan::Features features);

/// The last plans of a context; found from any thread.
class PlanRing {
public:
    [[nodiscard]] LodestarPlan add(std::shared_ptr<const Packet> packet) {
        const std::scoped_lock lock(mutex_);
        ++last_;
        kept_[last_ % kept_.size()] = {last_, std::move(packet)};
        return last_;
    }
    /// The number of the plan that is added next.
    [[nodiscard]] LodestarPlan next() const {
        const std::scoped_lock lock(mutex_);
        return last_ + 1;
    }
    /// Null: it is stale, or none.
    [[nodiscard]] std::shared_ptr<const Packet> find(LodestarPlan plan) const {
        const std::scoped_lock lock(mutex_);
        const auto& [number, packet] = kept_[plan % kept_.size()];
        return plan != 0 && number == plan ? packet : nullptr;
    }

private:
    mutable std::mutex mutex_;
    LodestarPlan last_ = 0;
    std::array<std::pair<LodestarPlan, std::shared_ptr<const Packet>>, 4> kept_{};
};

/// What earlier plans have asked for of the distant environment.
struct PlannedEnvironment {
    LodestarEnvironment environment = 0;
    std::uint64_t version = 0;
    lighting::PreparedParts parts;
};

/// Decides a frame at the context's hour. @errors InputRefused with a JSON pointer into the frame
[[nodiscard]] core::Result<std::shared_ptr<const Packet>> makePacket(LodestarContext& context,
                                                                     const LodestarFrame& frame);

} // namespace lodestar::plugin

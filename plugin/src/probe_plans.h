// SPDX-License-Identifier: MIT
//
// Light probes in plans: what the planner is told of them, what is made of what it decides.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "lighting/day.h"
#include "lighting/light_map.h"
#include "plan/effect_plan.h"
#include "probes.h"

struct LodestarContext;

namespace lodestar::plugin {

/// Where a draw is, as the host says.
struct DrawBox {
    std::uint64_t id = 0;
    glm::vec3 low{0.0f}, high{0.0f};
    std::uint32_t layers = 0xffffffffu;
    float share = 0.0f;
    bool changed = false;
};

/// The boxes of a frame.
struct BoxedFrame {
    std::vector<DrawBox> draws;
    double lightThreshold = 0.1;
};

/// Where a thing was in the plan before, for people too.
struct SeenBox {
    std::uint64_t id = 0;
    glm::vec3 low{0.0f}, high{0.0f};
    bool changed = false; ///< it looks otherwise than before
    std::string subject;
};

/// What a plan knows of probes, immutable.
struct ProbePacket {
    struct Light {
        LodestarProbe of = 0;
        std::uint64_t version = 0;
        std::shared_ptr<const lighting::CubeTexels> texels[2];
        std::array<glm::vec4, LODESTAR_PROBE_VECTORS> vectors{};
        bool shines = false; ///< on a draw or a job of the plan
    };
    std::vector<LodestarProbe> all; ///< probes that there are, in a plan without boxes too
    std::vector<Light> lights;
    std::vector<LodestarProbeJob> jobs;
    std::vector<std::vector<LodestarDrawProbes>> jobDraws;
    std::vector<LodestarDrawProbes> drawProbes;

    [[nodiscard]] const Light* find(LodestarProbe probe) const;
};

/// A plan's part of probes while it is made: nothing of the context changes until it is kept.
class ProbePlanning {
public:
    /// Tells the planner of the context's probes. Without boxes it has none.
    /// @pre the input holds its draws, as many as boxes  @param moments of the lights at the hour
    ProbePlanning(LodestarContext& context, const std::vector<lighting::DayMoment>& moments,
                  plan::PlanInput& input);

    /// Makes what the plan asks for. @param work that executing it will do, to which uploads are
    /// added
    void execute(const plan::EffectPlan& plan, const plan::PlanInput& input, ProbePacket& packet,
                 LodestarWork& work);
    /// The context holds it from here on.
    void keep() noexcept;

private:
    void markMoved(const plan::PlanInput& input);
    void make(const plan::EffectPlan& plan);
    [[nodiscard]] glm::vec3 sky(const glm::vec3& direction, int width) const;
    void prepareSky();
    void describe(const plan::PlanInput& input, ProbePacket& packet) const;
    void foresee(ProbePacket& packet, LodestarWork& work);
    void askFaces(const plan::EffectPlan& plan, ProbePacket& packet);

    LodestarContext& context_;
    const std::vector<lighting::DayMoment>& moments_;
    bool active_ = false;
    LodestarPlan number_ = 0; ///< of the plan that is made
    std::vector<ProbeState> states_;
    std::vector<bool> published_;
    std::vector<plan::Moved> moved_;
    std::vector<SeenBox> seen_; ///< sorted by id
    plan::LightState light_;

    struct Sky {
        glm::dvec3 axis{0.0};
        std::shared_ptr<const lighting::LightMap::Blend> blend;
    };
    std::vector<Sky> skies_;
    const lighting::Cubemap* distant_ = nullptr; ///< tent mips; null: none is seen
};

} // namespace lodestar::plugin

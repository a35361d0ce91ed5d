// SPDX-License-Identifier: MIT
//
// What a renderer's plans are made of, kept from frame to frame: draws are described anew where a
// node, the view or the settings have changed, and a plan is made where its input is another.
#pragma once

#include <memory>
#include <vector>

#include <glm/mat4x4.hpp>

#include "plan/effect_plan.h"
#include "scene/renderer.h"

namespace lodestar::scene {

class FramePlanner {
public:
    /// Describes the draws where they may have changed.
    /// @param deforms whether joints or morph weights may have moved vertices too
    void describeDraws(const Scene& scene, const View& view, const RenderSettings& settings,
                       bool deforms);
    /// The input, whose parts beside the draws are the caller's to fill.
    [[nodiscard]] plan::PlanInput& input() { return input_; }
    /// Describes the draws anew the next time, whatever has changed.
    void forgetDraws() { plan_ = nullptr; }
    /// Whether the last description found nothing changed.
    [[nodiscard]] bool drawsKept() const { return drawsKept_; }
    /// The plan made last; none: there was no frame yet.
    [[nodiscard]] const std::shared_ptr<const plan::EffectPlan>& last() const { return plan_; }
    /// The plan of the input.
    [[nodiscard]] const std::shared_ptr<const plan::EffectPlan>& plan();

private:
    View view_;
    RenderSettings settings_;
    std::vector<glm::mat4> nodes_; ///< where they stood
    bool drawsKept_ = false;
    plan::PlanInput input_;
    plan::PlanInput besideDraws_; ///< of the last plan; no draws
    std::shared_ptr<const plan::EffectPlan> plan_;
};

} // namespace lodestar::scene

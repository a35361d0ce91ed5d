// SPDX-License-Identifier: MIT
#include "scene/frame_planner.h"

#include <algorithm>
#include <utility>

namespace lodestar::scene {

void FramePlanner::describeDraws(const Scene& scene, const View& view,
                                 const RenderSettings& settings, bool deforms) {
    const bool stand = scene.nodes.size() == nodes_.size() &&
                       std::equal(scene.nodes.begin(), scene.nodes.end(), nodes_.begin(),
                                  [](const Node& node, const glm::mat4& stood) {
                                      return node.worldFromNode == stood;
                                  });
    drawsKept_ = plan_ != nullptr && !deforms && stand && view == view_ && settings == settings_;
    if (drawsKept_) {
        return;
    }
    if (!stand) {
        nodes_.clear();
        for (const Node& node : scene.nodes) {
            nodes_.push_back(node.worldFromNode);
        }
    }
    view_ = view;
    settings_ = settings;
    input_ = planInput(scene, view, settings, plan::EnvironmentView{});
}

const std::shared_ptr<const plan::EffectPlan>& FramePlanner::plan() {
    std::vector<plan::DrawView> draws = std::exchange(input_.draws, {});
    const bool same = drawsKept_ && input_ == besideDraws_;
    besideDraws_ = input_;
    input_.draws = std::move(draws);
    if (!same) {
        plan_ = std::make_shared<const plan::EffectPlan>(plan::plan(input_));
    }
    return plan_;
}

} // namespace lodestar::scene

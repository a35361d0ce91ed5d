// SPDX-License-Identifier: MIT
//
// In which order and in how few calls draws are drawn, and what their shaders must do.
#pragma once

#include <vector>

#include "plan/effect_plan.h"

namespace lodestar::plan {

/// Sorts by what draws share: features, so that programs switch seldom, then material, geometry and
/// probes, so that neighbours are batches. @param choices of each draw; empty where none matter
void sortByShared(const PlanInput& input, const std::vector<ProbeChoice>& choices,
                  std::vector<std::size_t>& order);

/// @param before instances that stand before the order's first
[[nodiscard]] std::vector<Batch> batchesOf(const PlanInput& input,
                                           const std::vector<ProbeChoice>& choices,
                                           const std::vector<std::size_t>& order,
                                           std::size_t before);

/// The picture's draws, with an effect for each. @param choices of each draw; empty: no probes
void planDraws(const PlanInput& input, const std::vector<ProbeChoice>& choices, EffectPlan& result);

/// The same of the faces of probes, whose draws are known. @pre the casters are planned
void planFaces(const PlanInput& input, const ProbeIndex& index, EffectPlan& result);

} // namespace lodestar::plan

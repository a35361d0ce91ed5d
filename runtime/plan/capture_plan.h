// SPDX-License-Identifier: MIT
//
// Which faces of captured environments a frame draws.
#pragma once

#include "plan/effect_plan.h"

namespace lodestar::plan {

/// Shares the frame's budget of faces out in the captures' order, and says so.
void planCaptures(const PlanInput& input, EffectPlan& result);

} // namespace lodestar::plan

// SPDX-License-Identifier: MIT
//
// Plans, counters and times as JSON; the keys are a contract (docs/command-line.md).
#pragma once

#include <map>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "gl/device.h"
#include "plan/effect_plan.h"

namespace lodestar::app {

[[nodiscard]] nlohmann::json toJson(const plan::Effect& effect);
[[nodiscard]] nlohmann::json toJson(const plan::EffectPlan& plan);
[[nodiscard]] nlohmann::json toJson(const gl::WorkCounters& counters);

} // namespace lodestar::app

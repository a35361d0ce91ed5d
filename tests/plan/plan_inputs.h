// SPDX-License-Identifier: MIT
//
// What plans are made of in tests.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "plan/effect_plan.h"

namespace lodestar::plan {

inline DrawView ball() {
    DrawView draw;
    draw.subject = "ball";
    draw.features = bit(Feature::Normals);
    return draw;
}

inline PlanInput scene(std::vector<DrawView> draws) {
    PlanInput input;
    input.draws = std::move(draws);
    input.environment = {"studio.hdr", 64, true};
    input.backdrop = false;
    return input;
}

inline const Effect& effect(const EffectPlan& plan, const std::string& name) {
    for (const Effect& candidate : plan.effects) {
        if (candidate.effect == name) {
            return candidate;
        }
    }
    ADD_FAILURE() << "no effect " << name;
    static const Effect none;
    return none;
}

} // namespace lodestar::plan

// SPDX-License-Identifier: MIT
#include "plan/capture_plan.h"

#include <algorithm>

namespace lodestar::plan {

void planCaptures(const PlanInput& input, EffectPlan& result) {
    int left = std::max(input.faceBudget, 0);
    for (std::size_t i = 0; i < input.captures.size(); ++i) {
        const CaptureView& capture = input.captures[i];
        const auto missing = std::count(capture.missing.begin(), capture.missing.end(), true);
        std::uint64_t drawn = 0;
        for (int face = 0; face < 6 && left > 0; ++face) {
            if (capture.missing[static_cast<std::size_t>(face)]) {
                result.captureFaces.push_back({i, face});
                ++drawn;
                --left;
            }
        }
        Effect effect{"probe-capture", capture.subject, Decision::Skip, {}, {}};
        if (missing == 0) {
            effect.reason = "it shows what it has captured, and nothing asks for it anew";
        } else if (drawn == 0) {
            effect.reason = std::to_string(missing) + (missing == 1 ? " face is" : " faces are") +
                            " missing, and the frame has no face left";
        } else {
            effect.decision = Decision::Run;
            effect.reason = std::to_string(drawn) + " of " + std::to_string(missing) +
                            " missing faces: " +
                            (capture.complete ? "it is asked for anew" : "it shows nothing yet");
            effect.cost.passes = drawn;
        }
        result.effects.push_back(std::move(effect));
    }
}

std::string planText(const EffectPlan& plan) {
    std::string text;
    for (const Effect& effect : plan.effects) {
        const bool probe = effect.effect.compare(0, 6, "probe-") == 0;
        text += (probe ? std::string("Probe") : effect.effect) + " '" + effect.subject +
                (effect.decision == Decision::Run ? "': " : "': skipped: ") + effect.reason + "\n";
    }
    return text;
}

} // namespace lodestar::plan

// SPDX-License-Identifier: MIT
#include "app/plan_json.h"
#include <nlohmann/json.hpp>

#include <set>

namespace lodestar::app {

nlohmann::json toJson(const plan::Effect& effect) {
    nlohmann::json json = {{"effect", effect.effect},
                           {"subject", effect.subject},
                           {"decision", effect.decision == plan::Decision::Run ? "run" : "skip"},
                           {"reason", effect.reason},
                           {"cost",
                            {{"draws", effect.cost.draws},
                             {"passes", effect.cost.passes},
                             {"texels_written", effect.cost.texelsWritten},
                             {"upload_bytes", effect.cost.uploadBytes}}}};
    if (!effect.faces.empty()) {
        json["faces"] = effect.faces;
    }
    return json;
}

nlohmann::json toJson(const plan::EffectPlan& plan) {
    nlohmann::json effects = nlohmann::json::array();
    for (const plan::Effect& effect : plan.effects) {
        effects.push_back(toJson(effect));
    }
    std::set<std::string> features;
    for (plan::Features set : plan.drawFeatures) {
        for (std::string& name : plan::featureNames(set)) {
            features.insert(std::move(name));
        }
    }
    return {{"effects", effects}, {"features", features}};
}

nlohmann::json toJson(const gl::WorkCounters& counters) {
    return {{"draws", counters.draws},
            {"passes", counters.passes},
            {"texels_written", counters.texelsWritten},
            {"uploads", counters.uploads},
            {"upload_bytes", counters.uploadBytes},
            {"program_switches", counters.programSwitches},
            {"shader_compilations", counters.shaderCompilations},
            {"state_queries", counters.stateQueries},
            {"probe_faces", counters.probeFaces},
            {"texture_bytes", counters.textureBytes},
            {"gl_errors", counters.glErrors}};
}

} // namespace lodestar::app

// SPDX-License-Identifier: MIT
#include "plan/effect_plan.h"

#include <algorithm>
#include <array>

#include "lighting/lookup.h"
#include "plan/capture_plan.h"
#include "plan/draw_plan.h"

namespace lodestar::plan {
namespace {

using lighting::PreparedParts;

constexpr std::array<const char*, 34> kFeatureNames = {"normals",
                                                       "tangents",
                                                       "vertex-colors",
                                                       "base-color-texture",
                                                       "metallic-roughness-texture",
                                                       "normal-texture",
                                                       "occlusion-texture",
                                                       "emissive-texture",
                                                       "blinn-phong",
                                                       "exponent-texture",
                                                       "alpha-mask",
                                                       "alpha-blend",
                                                       "punctual-lights",
                                                       "environment",
                                                       "texture-transform",
                                                       "unlit",
                                                       "specular-texture",
                                                       "specular-color-texture",
                                                       "skinning",
                                                       "second-joints",
                                                       "rsrm-lights",
                                                       "shadows",
                                                       "rsrm-mirror",
                                                       "probe",
                                                       "second-probe",
                                                       "tent",
                                                       "ring-3",
                                                       "ring-7",
                                                       "taps-32",
                                                       "taps-64",
                                                       "sg-lobes",
                                                       "sg-fresnel",
                                                       "probe-skies",
                                                       "rsrm-rows"};

/// Texels of a whole chain of six faces.
std::uint64_t chainTexels(int width) {
    std::uint64_t texels = 0;
    for (int w = width; w > 0; w /= 2) {
        texels += std::uint64_t{6} * static_cast<std::uint64_t>(w) * static_cast<std::uint64_t>(w);
    }
    return texels;
}

/// Bytes a texel of a half-float cube takes on its way to the GPU (as floats).
constexpr std::uint64_t kUploadBytesPerTexel = 16;

struct Receivers {
    bool any = false;
    bool lit = false;
    bool diffuse = false;
    bool glossy = false;
};

/// By draw, whether a face of a probe sees it in this frame.
std::vector<bool> capturedDraws(const PlanInput& input, const EffectPlan& result) {
    std::vector<bool> captured(input.draws.size());
    for (const ProbeFace& face : result.probeFaces) {
        for (const std::size_t draw : face.drawOrder) {
            captured[draw] = true;
        }
    }
    return captured;
}

/// Of the picture and the faces of probes.
Receivers receiversOf(const PlanInput& input, const EffectPlan& result) {
    Receivers receivers;
    const std::vector<bool> captured = capturedDraws(input, result);
    for (std::size_t i = 0; i < input.draws.size(); ++i) {
        const DrawView& draw = input.draws[i];
        if (draw.visible || captured[i]) {
            receivers.any = true;
            receivers.lit = receivers.lit || draw.lit;
            receivers.diffuse = receivers.diffuse || (draw.lit && draw.diffuse);
            receivers.glossy = receivers.glossy || (draw.lit && draw.glossy);
        }
    }
    return receivers;
}

/// One part of the environment: whether it is asked for, and what is said of it.
struct Part {
    const char* effect;
    bool PreparedParts::*member;
    std::uint64_t texels;
    std::string askedBecause;
};

Effect decidePart(const PlanInput& input, const Part& part, bool wanted,
                  const std::string& unwanted, PreparedParts& prepare) {
    Effect effect{part.effect, input.environment.source, Decision::Skip, {}, {}};
    const bool kept = !input.environment.changed && input.alreadyPrepared.*part.member;
    if (!wanted) {
        effect.reason = unwanted;
    } else if (kept) {
        effect.reason = "made in an earlier frame, and the environment has not changed";
    } else {
        effect.decision = Decision::Run;
        effect.reason = part.askedBecause;
        effect.cost.texelsWritten = part.texels;
        effect.cost.uploadBytes = part.texels * kUploadBytesPerTexel;
        prepare.*part.member = true;
    }
    return effect;
}

std::string absence(const EnvironmentView& environment) {
    return environment.replacedBy.empty()
               ? "there is no environment"
               : "the sky light '" + environment.replacedBy + "' stands in its place";
}

void planEnvironment(const PlanInput& input, const Receivers& receivers, EffectPlan& result) {
    const PreparedParts forSpecular = lighting::partsFor(input.specular);
    const PreparedParts forDiffuse = lighting::partsFor(input.diffuse);
    const std::string specular =
        "visible glossy surfaces, and '" + lighting::estimatorName(input.specular) + "' reads it";
    const std::string diffuse =
        "visible diffuse surfaces, and '" + lighting::estimatorName(input.diffuse) + "' reads it";
    const std::uint64_t chain = chainTexels(input.environment.width);
    const std::uint64_t small =
        std::uint64_t{6} * lighting::kIrradianceWidth * lighting::kIrradianceWidth;
    const std::array<Part, 5> parts = {{
        {"tent-mips", &PreparedParts::tentMips, chain, {}},
        {"box-mips", &PreparedParts::boxMips, chain, {}},
        {"prefiltered-mips", &PreparedParts::prefilteredMips, chain, {}},
        {"irradiance", &PreparedParts::irradiance, small, {}},
        {"sh9", &PreparedParts::sh9, 0, {}},
    }};
    for (Part part : parts) {
        const bool present = input.environment.present;
        const bool glossy = present && receivers.glossy && forSpecular.*part.member;
        const bool lambert = present && receivers.diffuse && forDiffuse.*part.member;
        // The backdrop and compositions read whichever chain there is; they ask for one only alone.
        const bool composes = !result.probeWork.empty();
        const bool seenOnly =
            present && part.member == &PreparedParts::tentMips && (input.backdrop || composes) &&
            !(receivers.glossy && (forSpecular.boxMips || forSpecular.prefilteredMips));
        if (glossy || lambert) {
            part.askedBecause = glossy ? specular : diffuse;
        } else if (seenOnly) {
            part.askedBecause =
                input.backdrop ? "the backdrop shows it" : "light probes are composed before it";
        }
        const bool estimated = forSpecular.*part.member || forDiffuse.*part.member;
        const std::string unwanted = !present         ? absence(input.environment)
                                     : !estimated     ? "no chosen estimator reads it"
                                     : !receivers.any ? "nothing is visible"
                                     : !receivers.lit ? "all that is visible is unlit"
                                                      : "no visible surface reflects that way";
        result.effects.push_back(
            decidePart(input, part, glossy || lambert || seenOnly, unwanted, result.prepare));
    }
}

Effect blendEffect(const PlanInput& input, const Receivers& receivers, const RsrmLightView& light) {
    Effect effect{"rsrm-blend", light.subject, Decision::Skip, {}, {}};
    if (!light.shines) {
        effect.reason = "the sun is below the horizon";
    } else if (!receivers.lit && !input.backdrop) {
        effect.reason = receivers.any ? "all that is visible is unlit" : "nothing is visible";
    } else if (!light.changed) {
        effect.reason = "its keys are blended as in an earlier frame";
    } else {
        effect.decision = Decision::Run;
        effect.reason = receivers.lit ? "visible surfaces receive it, and its keys blend anew"
                                      : "the backdrop shows it, and its keys blend anew";
        effect.cost.texelsWritten = light.texels;
        effect.cost.uploadBytes = light.uploadBytes;
    }
    return effect;
}

Effect shadowEffect(const PlanInput& input, const Receivers& receivers, const RsrmLightView& light,
                    std::size_t casters) {
    Effect effect{"shadow-map", light.subject, Decision::Skip, {}, {}};
    if (!light.shines) {
        effect.reason = "the sun is below the horizon";
    } else if (!receivers.lit) {
        effect.reason = receivers.any ? "all that is visible is unlit" : "nothing is visible";
    } else if (casters == 0) {
        effect.reason = "nothing casts a shadow";
    } else if (!light.shadowChanged) {
        effect.reason = "neither the sun nor a caster has moved since it was drawn";
    } else {
        effect.decision = Decision::Run;
        effect.reason = "visible surfaces receive the sun, and it or a caster has moved";
        effect.cost = {casters, 1, input.shadowTexels, 0};
    }
    return effect;
}

/// Skies and suns: blended when their hour asks for it; suns that are up are hidden by casters.
void planRsrmLights(const PlanInput& input, const Receivers& receivers, EffectPlan& result) {
    const bool shadows = std::any_of(input.rsrmLights.begin(), input.rsrmLights.end(),
                                     [](const RsrmLightView& light) { return light.shadow >= 0; });
    std::vector<std::size_t> casters;
    for (std::size_t i = 0; shadows && i < input.draws.size(); ++i) {
        if (input.draws[i].casts) {
            casters.push_back(i);
        }
    }
    sortByShared(input, {}, casters);
    const auto visible = std::count_if(input.draws.begin(), input.draws.end(),
                                       [](const DrawView& draw) { return draw.visible; });
    const std::vector<Batch> casterBatches =
        batchesOf(input, {}, casters, static_cast<std::size_t>(visible));
    for (std::size_t i = 0; i < input.rsrmLights.size(); ++i) {
        const RsrmLightView& light = input.rsrmLights[i];
        LitLight lit{i, false, -1, false, light.sky};
        Effect blend = blendEffect(input, receivers, light);
        lit.blend = blend.decision == Decision::Run;
        result.effects.push_back(std::move(blend));
        if (light.shadow >= 0) {
            Effect shadow = shadowEffect(input, receivers, light, casterBatches.size());
            lit.drawShadow = shadow.decision == Decision::Run;
            lit.shadow = receivers.lit && !casters.empty() ? light.shadow : -1;
            result.effects.push_back(std::move(shadow));
        }
        if (lit.drawShadow) {
            result.casters = casters;
            result.casterBatches = casterBatches;
        }
        if (light.shines && (receivers.lit || input.backdrop)) {
            result.rsrmLights.push_back(lit);
        }
    }
    const auto place = [](const LitLight& lit) { return lit.sky ? 2 : lit.shadow >= 0 ? 0 : 1; };
    std::stable_sort(result.rsrmLights.begin(), result.rsrmLights.end(),
                     [&](const LitLight& a, const LitLight& b) { return place(a) < place(b); });
    result.rsrmPublished = input.rsrmPublished;
}

/// Joints and morphed vertices: asked for by what is visible, made when they changed.
void planDeformation(const PlanInput& input, EffectPlan& result) {
    std::size_t skinned = 0, morphed = 0, changed = 0;
    std::uint64_t morphBytes = 0;
    const std::vector<bool> captured = capturedDraws(input, result);
    for (std::size_t i = 0; i < input.draws.size(); ++i) {
        const DrawView& draw = input.draws[i];
        const bool needed = draw.visible || captured[i] || (draw.casts && !result.casters.empty());
        if (needed) {
            result.deformed.push_back(i);
        }
        const bool morphs = needed && draw.morphBytes > 0;
        skinned += needed && has(draw.features, Feature::Skinning) ? 1U : 0U;
        morphed += morphs ? 1U : 0U;
        changed += morphs && draw.weightsChanged ? 1U : 0U;
        morphBytes += morphs && draw.weightsChanged ? draw.morphBytes : 0U;
    }
    Effect skinning{"skinning", std::to_string(skinned) + " draws", Decision::Skip, {}, {}};
    if (skinned == 0) {
        skinning.reason = "nothing visible follows joints";
    } else if (!input.jointsMoved) {
        skinning.reason = "no joint has moved since they were uploaded";
    } else {
        skinning.decision = Decision::Run;
        skinning.reason = "visible meshes follow joints";
        skinning.cost.uploadBytes = input.jointBytes;
    }
    result.effects.push_back(std::move(skinning));
    Effect morphs{"morphs", std::to_string(morphed) + " draws", Decision::Skip, {}, {}};
    if (morphed == 0) {
        morphs.reason = "nothing visible has morph targets";
    } else if (changed == 0) {
        morphs.reason = "no weight has changed since the vertices were made";
    } else {
        morphs.decision = Decision::Run;
        morphs.reason = std::to_string(changed) + " visible draws with new weights";
        morphs.cost.uploadBytes = morphBytes;
    }
    result.effects.push_back(std::move(morphs));
}

/// The environment, the lights' gradients, or both; nothing is drawn where there is neither.
void planBackdrop(const PlanInput& input, EffectPlan& result) {
    const bool cube = input.environment.present;
    const bool lights = !result.rsrmLights.empty();
    result.backdrop = input.backdrop && (cube || lights);
    result.skyFeatures =
        (cube ? bit(Feature::Environment) : 0u) | (lights ? bit(Feature::RsrmLights) : 0u);
    result.backdropFeatures = result.skyFeatures;
    const char* reason = !input.backdrop  ? "switched off"
                         : cube && lights ? "the environment and the lights are the background"
                         : cube           ? "the environment is the background"
                         : lights         ? "the lights are the background"
                                          : "no light shines";
    result.effects.push_back({"backdrop",
                              cube ? input.environment.source : "lights",
                              result.backdrop ? Decision::Run : Decision::Skip,
                              reason,
                              {result.backdrop ? 1u : 0u, 0, 0, 0}});
}

struct OwnEstimator {
    Feature feature;
    lighting::Estimator estimator;
};
constexpr OwnEstimator kOwnEstimators[] = {
    {Feature::Tent, {lighting::EstimatorKind::Tent}},
    {Feature::Ring3, {lighting::EstimatorKind::Ring3}},
    {Feature::Ring7, {lighting::EstimatorKind::Ring7}},
    {Feature::Taps32, {lighting::EstimatorKind::Taps, 0.0f, 32}},
    {Feature::Taps64, {lighting::EstimatorKind::Taps, 0.0f, 64}},
};

} // namespace

std::optional<Feature> estimatorFeature(const lighting::Estimator& estimator) {
    for (const OwnEstimator& own : kOwnEstimators) {
        if (own.estimator == estimator) {
            return own.feature;
        }
    }
    return std::nullopt;
}

std::optional<lighting::Estimator> estimatorOf(Features set) {
    for (const OwnEstimator& own : kOwnEstimators) {
        if (has(set, own.feature)) {
            return own.estimator;
        }
    }
    return std::nullopt;
}

std::vector<std::string> featureNames(Features set) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < kFeatureNames.size(); ++i) {
        if ((set & (Features{1} << i)) != 0) {
            names.emplace_back(kFeatureNames[i]);
        }
    }
    return names;
}

std::size_t EffectPlan::shadowedLights() const {
    return static_cast<std::size_t>(std::count_if(
        rsrmLights.begin(), rsrmLights.end(), [](const LitLight& lit) { return lit.shadow >= 0; }));
}

std::size_t EffectPlan::suns() const {
    return static_cast<std::size_t>(std::count_if(rsrmLights.begin(), rsrmLights.end(),
                                                  [](const LitLight& lit) { return !lit.sky; }));
}

bool EffectPlan::runs(const std::string& effect) const {
    return std::any_of(effects.begin(), effects.end(), [&](const Effect& e) {
        return e.effect == effect && e.decision == Decision::Run;
    });
}

EffectPlan plan(const PlanInput& input) {
    EffectPlan result;
    planCaptures(input, result);
    const ProbeIndex index(input.probes);
    const std::vector<ProbeChoice> choices = planProbes(input, index, result);
    const Receivers receivers = receiversOf(input, result);
    planEnvironment(input, receivers, result);
    planRsrmLights(input, receivers, result);
    planDeformation(input, result);
    planDraws(input, choices, result);
    planFaces(input, index, result);
    result.effects.push_back(
        {"punctual-lights",
         std::to_string(input.lightCount) + " lights",
         input.lightCount > 0 && receivers.lit ? Decision::Run : Decision::Skip,
         input.lightCount == 0 ? "the scene has none"
         : !receivers.lit ? receivers.any ? "all that is visible is unlit" : "nothing is visible"
         : input.lobes == lighting::LobeForm::Sg
             ? "visible surfaces receive them, highlights as spherical Gaussians"
             : "visible surfaces receive them",
         {}});
    planBackdrop(input, result);
    return result;
}

} // namespace lodestar::plan

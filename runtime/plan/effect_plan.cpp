// SPDX-License-Identifier: MIT
#include "plan/effect_plan.h"

#include <algorithm>
#include <array>

#include "lighting/lookup.h"

namespace lodestar::plan {
namespace {

using lighting::PreparedParts;

constexpr std::array<const char*, 20> kFeatureNames = {"normals",
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
                                                       "second-joints"};

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

Receivers visibleReceivers(const PlanInput& input) {
    Receivers receivers;
    for (const DrawView& draw : input.draws) {
        if (draw.visible) {
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
    const std::array<Part, 4> parts = {{
        {"tent-mips", &PreparedParts::tentMips, chain, {}},
        {"box-mips", &PreparedParts::boxMips, chain, {}},
        {"irradiance", &PreparedParts::irradiance, small, {}},
        {"sh9", &PreparedParts::sh9, 0, {}},
    }};
    for (Part part : parts) {
        const bool glossy = receivers.glossy && forSpecular.*part.member;
        const bool lambert = receivers.diffuse && forDiffuse.*part.member;
        // The backdrop reads level 0 of whichever chain there is; it asks for one only alone.
        const bool backdropOnly = part.member == &PreparedParts::tentMips && input.backdrop &&
                                  !(receivers.glossy && forSpecular.boxMips);
        if (glossy || lambert) {
            part.askedBecause = glossy ? specular : diffuse;
        } else if (backdropOnly) {
            part.askedBecause = "the backdrop shows it";
        }
        const bool estimated = forSpecular.*part.member || forDiffuse.*part.member;
        const std::string unwanted = !estimated       ? "no chosen estimator reads it"
                                     : !receivers.any ? "nothing is visible"
                                     : !receivers.lit ? "all that is visible is unlit"
                                                      : "no visible surface reflects that way";
        result.effects.push_back(
            decidePart(input, part, glossy || lambert || backdropOnly, unwanted, result.prepare));
    }
}

/// Joints and morphed vertices: asked for by what is visible, made when they changed.
void planDeformation(const PlanInput& input, EffectPlan& result) {
    std::size_t skinned = 0, morphed = 0, changed = 0;
    std::uint64_t morphBytes = 0;
    for (const DrawView& draw : input.draws) {
        const bool morphs = draw.visible && draw.morphBytes > 0;
        skinned += draw.visible && has(draw.features, Feature::Skinning) ? 1U : 0U;
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

void planDraws(const PlanInput& input, EffectPlan& result) {
    std::vector<std::size_t> blended;
    for (std::size_t i = 0; i < input.draws.size(); ++i) {
        const DrawView& draw = input.draws[i];
        if (draw.visible) {
            (draw.blended ? blended : result.drawOrder).push_back(i);
        }
        result.effects.push_back({"draw",
                                  draw.subject,
                                  draw.visible ? Decision::Run : Decision::Skip,
                                  draw.visible ? "inside the view" : "outside the view",
                                  {draw.visible ? 1u : 0u, 0, 0, 0}});
    }
    // Opaque draws that share features follow each other, so that programs switch seldom.
    std::stable_sort(result.drawOrder.begin(), result.drawOrder.end(),
                     [&](std::size_t a, std::size_t b) {
                         return input.draws[a].features < input.draws[b].features;
                     });
    std::stable_sort(blended.begin(), blended.end(), [&](std::size_t a, std::size_t b) {
        return input.draws[a].distance > input.draws[b].distance;
    });
    result.drawOrder.insert(result.drawOrder.end(), blended.begin(), blended.end());
    for (std::size_t index : result.drawOrder) {
        const bool lit = input.draws[index].lit;
        Features features = input.draws[index].features | (lit ? bit(Feature::Environment) : 0u);
        if (lit && input.lightCount > 0) {
            features |= bit(Feature::PunctualLights);
        }
        result.drawFeatures.push_back(features);
    }
}

} // namespace

std::vector<std::string> featureNames(Features set) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < kFeatureNames.size(); ++i) {
        if ((set & (1u << i)) != 0) {
            names.emplace_back(kFeatureNames[i]);
        }
    }
    return names;
}

bool EffectPlan::runs(const std::string& effect) const {
    return std::any_of(effects.begin(), effects.end(), [&](const Effect& e) {
        return e.effect == effect && e.decision == Decision::Run;
    });
}

EffectPlan plan(const PlanInput& input) {
    EffectPlan result;
    const Receivers receivers = visibleReceivers(input);
    planEnvironment(input, receivers, result);
    planDeformation(input, result);
    planDraws(input, result);
    result.effects.push_back(
        {"punctual-lights",
         std::to_string(input.lightCount) + " lights",
         input.lightCount > 0 && receivers.lit ? Decision::Run : Decision::Skip,
         input.lightCount == 0 ? "the scene has none"
         : receivers.lit       ? "visible surfaces receive them"
         : receivers.any       ? "all that is visible is unlit"
                               : "nothing is visible",
         {}});
    result.backdrop = input.backdrop;
    result.effects.push_back({"backdrop",
                              input.environment.source,
                              input.backdrop ? Decision::Run : Decision::Skip,
                              input.backdrop ? "the environment is the background" : "switched off",
                              {input.backdrop ? 1u : 0u, 0, 0, 0}});
    return result;
}

} // namespace lodestar::plan

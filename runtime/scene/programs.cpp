// SPDX-License-Identifier: MIT
#include "scene/programs.h"

#include <algorithm>
#include <string>
#include <utility>

#include "scene/gpu_scene.h"

namespace lodestar::scene {
namespace {

using lighting::EstimatorKind;

int specularMacro(EstimatorKind kind) {
    switch (kind) {
    case EstimatorKind::Mip:
        return 0;
    case EstimatorKind::MipFloor:
        return 1;
    case EstimatorKind::Bias:
    case EstimatorKind::BiasVertex:
        return 2;
    case EstimatorKind::Ring3:
        return 4;
    case EstimatorKind::Ring7:
        return 5;
    case EstimatorKind::Taps:
        return 6;
    case EstimatorKind::Prefiltered:
        return 7;
    default:
        return 3;
    }
}

int diffuseMacro(EstimatorKind kind) {
    switch (kind) {
    case EstimatorKind::Sh9:
        return 1;
    case EstimatorKind::LowestMip:
        return 2;
    case EstimatorKind::Bias:
    case EstimatorKind::BiasVertex:
        return 3;
    default:
        return 0;
    }
}

/// The lights of a frame are named by their number, so that loops over them unroll.
gl::Defines lightDefines(plan::Features features, const plan::EffectPlan& plan) {
    const auto number = [&](plan::Feature feature, std::size_t count) {
        return std::to_string(plan::has(features, feature) ? count : 0);
    };
    const bool lit = plan::has(features, plan::Feature::RsrmLights);
    return {{"LODESTAR_RSRM_LIGHTS", number(plan::Feature::RsrmLights, plan.rsrmLights.size())},
            {"LODESTAR_SUNS", number(plan::Feature::RsrmLights, plan.suns())},
            {"LODESTAR_SHADOWS", number(plan::Feature::Shadows, plan.shadowedLights())},
            {"LODESTAR_RSRM_LAYOUT", lit && plan.rsrmPublished ? "1" : "0"}};
}

gl::Defines definesFor(plan::Features features, const plan::EffectPlan& plan,
                       const RenderSettings& settings) {
    using plan::Feature;
    gl::Defines defines = lightDefines(features, plan);
    const std::pair<const char*, Feature> macros[] = {
        {"LODESTAR_NORMALS", Feature::Normals},
        {"LODESTAR_TANGENTS", Feature::Tangents},
        {"LODESTAR_VERTEX_COLORS", Feature::VertexColors},
        {"LODESTAR_BASE_COLOR_TEXTURE", Feature::BaseColorTexture},
        {"LODESTAR_METALLIC_ROUGHNESS_TEXTURE", Feature::MetallicRoughnessTexture},
        {"LODESTAR_NORMAL_TEXTURE", Feature::NormalTexture},
        {"LODESTAR_OCCLUSION_TEXTURE", Feature::OcclusionTexture},
        {"LODESTAR_EMISSIVE_TEXTURE", Feature::EmissiveTexture},
        {"LODESTAR_BLINN_PHONG", Feature::BlinnPhong},
        {"LODESTAR_EXPONENT_TEXTURE", Feature::ExponentTexture},
        {"LODESTAR_ALPHA_MASK", Feature::AlphaMask},
        {"LODESTAR_ALPHA_BLEND", Feature::AlphaBlend},
        {"LODESTAR_PUNCTUAL_LIGHTS", Feature::PunctualLights},
        {"LODESTAR_ENVIRONMENT", Feature::Environment},
        {"LODESTAR_TEXTURE_TRANSFORM", Feature::TextureTransform},
        {"LODESTAR_UNLIT", Feature::Unlit},
        {"LODESTAR_SPECULAR_TEXTURE", Feature::SpecularTexture},
        {"LODESTAR_SPECULAR_COLOR_TEXTURE", Feature::SpecularColorTexture},
        {"LODESTAR_SKINNING", Feature::Skinning},
        {"LODESTAR_SECOND_JOINTS", Feature::SecondJoints},
        {"LODESTAR_RSRM_MIRROR", Feature::RsrmMirror},
        {"LODESTAR_RSRM_ROWS", Feature::RsrmRows},
        {"LODESTAR_LOBES", Feature::SgLobes},
        {"LODESTAR_FRESNEL", Feature::SgFresnel},
        {"LODESTAR_PROBE_SKIES", Feature::ProbeSkies},
    };
    for (const auto& [name, feature] : macros) {
        defines.emplace_back(name, plan::has(features, feature) ? "1" : "0");
    }
    defines.emplace_back("LODESTAR_PROBES", plan::has(features, Feature::SecondProbe) ? "2"
                                            : plan::has(features, Feature::Probe)     ? "1"
                                                                                      : "0");
    const gl::Defines chosen =
        estimatorDefines(plan::estimatorOf(features).value_or(settings.specular), settings.diffuse);
    defines.insert(defines.end(), chosen.begin(), chosen.end());
    return defines;
}

/// Irradiance is the fine cube's, whatever the settings' estimator of it.
gl::Defines referenceDefines(plan::Features features, const plan::EffectPlan& plan,
                             const RenderSettings& settings) {
    RenderSettings fine = settings;
    fine.diffuse = lighting::kDefaultDiffuse;
    gl::Defines defines = definesFor(features, plan, fine);
    defines.emplace_back("LODESTAR_REFERENCE", "1");
    return defines;
}

/// What of a draw's features its depth depends on.
plan::Features depthFeatures(plan::Features features) {
    using plan::bit;
    using plan::Feature;
    plan::Features kept = bit(Feature::Skinning) | bit(Feature::SecondJoints);
    if (plan::has(features, Feature::AlphaMask)) {
        kept |= bit(Feature::AlphaMask) | bit(Feature::VertexColors) |
                bit(Feature::BaseColorTexture) | bit(Feature::TextureTransform);
    }
    return features & kept;
}

/// @param features which of the environment and the lights are behind everything
gl::Defines skyDefines(plan::Features features, const plan::EffectPlan& plan) {
    gl::Defines defines = lightDefines(features, plan);
    const bool cube = plan::has(features, plan::Feature::Environment);
    defines.emplace_back("LODESTAR_ENVIRONMENT", cube ? "1" : "0");
    return defines;
}

gl::Defines compositionDefines(const plan::EffectPlan& plan, CompositionPart part) {
    gl::Defines defines = skyDefines(plan.skyFeatures, plan);
    defines.emplace_back("LODESTAR_COMPOSED", std::to_string(static_cast<int>(part)));
    return defines;
}

} // namespace

std::vector<CompositionPart> partsOf(bool ratio) {
    return ratio ? std::vector{CompositionPart::Geometry, CompositionPart::Sky}
                 : std::vector{CompositionPart::Whole};
}

gl::Defines estimatorDefines(const lighting::Estimator& specular,
                             const lighting::Estimator& diffuse) {
    gl::Defines defines = {
        {"LODESTAR_SPECULAR", std::to_string(specularMacro(specular.kind))},
        {"LODESTAR_DIFFUSE", std::to_string(diffuseMacro(diffuse.kind))},
        {"LODESTAR_BIAS_VERTEX", specular.kind == EstimatorKind::BiasVertex ? "1" : "0"}};
    if (specular.kind == EstimatorKind::Taps) {
        defines.emplace_back("LODESTAR_TAPS", std::to_string(specular.taps));
    }
    return defines;
}

core::Result<void> Programs::add(Variants& variants, const char* vertexFile,
                                 const char* fragmentFile, const gl::Defines& defines) {
    if (variants.count(defines) > 0) {
        return {};
    }
    auto made = gl::Program::make(*device_, vertexFile, fragmentFile, defines);
    if (!made) {
        return made.error();
    }
    for (std::size_t unit = 0; unit < kSamplerNames.size(); ++unit) {
        made->setSampler(kSamplerNames[unit], static_cast<int>(unit));
    }
    made->setBlock("LodestarFrame", kFrameBinding);
    made->setBlock("LodestarMaterial", kMaterialBinding);
    made->setBlock("LodestarRsrmLights", kRsrmBinding);
    made->setBlock("LodestarProbe[0]", kFirstProbeBinding);
    made->setBlock("LodestarProbe[1]", kSecondProbeBinding);
    const int firstInstance = made->uniform("uFirstInstance");
    variants.emplace(defines, MeshProgram{std::move(*made), firstInstance});
    return {};
}

core::Result<void> Programs::compile(const plan::PlanInput& input, const plan::EffectPlan& plan,
                                     const RenderSettings& settings) {
    const auto addMeshes = [&](const std::vector<plan::Features>& wanted) -> core::Result<void> {
        for (const plan::Features features : wanted) {
            if (auto made = add(meshes_, "host/mesh.vert", "host/mesh.frag",
                                definesFor(features, plan, settings));
                !made) {
                return made;
            }
        }
        return {};
    };
    auto meshes = addMeshes(plan.drawFeatures);
    for (std::size_t i = 0; meshes && i < plan.probeFaces.size(); ++i) {
        meshes = addMeshes(plan.probeFaces[i].drawFeatures);
    }
    if (!meshes) {
        return meshes;
    }
    for (const std::size_t caster : plan.casters) {
        const plan::Features features = depthFeatures(input.draws[caster].features);
        if (auto made = add(depths_, "host/mesh.vert", "host/depth.frag",
                            definesFor(features, plan, settings));
            !made) {
            return made;
        }
    }
    for (const plan::ProbeWork& work : plan.probeWork) {
        for (const CompositionPart part : partsOf(input.probes[work.probe].ratio)) {
            if (auto made = add(compositions_, "host/present.vert", "host/probe_compose.frag",
                                compositionDefines(plan, part));
                !made) {
                return made;
            }
        }
        if (!plan.rsrmLights.empty()) {
            if (auto made = add(suns_, "host/present.vert", "host/probe_suns.frag", {}); !made) {
                return made;
            }
        }
    }
    if (plan.backdrop) {
        return add(backdrops_, "host/backdrop.vert", "host/backdrop.frag",
                   skyDefines(plan.backdropFeatures, plan));
    }
    return {};
}

const MeshProgram& Programs::mesh(plan::Features features, const plan::EffectPlan& plan,
                                  const RenderSettings& settings) const {
    return meshes_.at(definesFor(features, plan, settings));
}

core::Result<void> Programs::compileReferences(const plan::EffectPlan& plan,
                                               const RenderSettings& settings) {
    for (const plan::Features features : plan.drawFeatures) {
        if (auto made = add(references_, "host/mesh.vert", "host/mesh.frag",
                            referenceDefines(features, plan, settings));
            !made) {
            return made;
        }
    }
    return {};
}

const MeshProgram& Programs::reference(plan::Features features, const plan::EffectPlan& plan,
                                       const RenderSettings& settings) const {
    return references_.at(referenceDefines(features, plan, settings));
}

const MeshProgram& Programs::depth(plan::Features features, const plan::EffectPlan& plan,
                                   const RenderSettings& settings) const {
    return depths_.at(definesFor(depthFeatures(features), plan, settings));
}

const gl::Program& Programs::backdrop(const plan::EffectPlan& plan) const {
    return backdrops_.at(skyDefines(plan.backdropFeatures, plan)).program;
}

const gl::Program& Programs::seenSuns() const {
    return suns_.at({}).program;
}

const gl::Program& Programs::composition(const plan::EffectPlan& plan, CompositionPart part) const {
    return compositions_.at(compositionDefines(plan, part)).program;
}

} // namespace lodestar::scene

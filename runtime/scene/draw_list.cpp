// SPDX-License-Identifier: MIT
#include "scene/draw_list.h"

#include <algorithm>
#include <limits>

#include "lodestar/lobes.glsl"

namespace lodestar::scene {
namespace {

using plan::bit;
using plan::Feature;

bool isBlack(const glm::vec3& color) {
    return color.r <= 0.0f && color.g <= 0.0f && color.b <= 0.0f;
}

/// The least exponent a material has anywhere, under the settings.
float leastExponent(const io::GltfMaterial& material, const RenderSettings& settings) {
    if (settings.materialOverride) {
        return settings.materialOverride->exponent;
    }
    if (material.blinnPhong) {
        return material.blinnPhong->exponentTexture.texture != io::kNone
                   ? 0.0f
                   : material.blinnPhong->exponent.value_or(0.0f);
    }
    return material.exponent.value_or(shader::lodestar_exponentFromRoughness(material.roughness));
}

/// Whether a material's exponent is a texture's.
bool hasExponentTexture(const io::GltfMaterial& material, const RenderSettings& settings) {
    const io::GltfTextureRef& texture = material.blinnPhong ? material.blinnPhong->exponentTexture
                                                            : material.metallicRoughnessTexture;
    const bool given = !material.blinnPhong && material.exponent;
    return !settings.materialOverride && !given && texture.texture != io::kNone;
}

/// The Phong exponent of the sharpest lookup a material makes: seen along the surface.
double sharpestLookup(const io::GltfMaterial& material, const RenderSettings& settings) {
    if (hasExponentTexture(material, settings)) {
        return std::numeric_limits<double>::infinity();
    }
    return static_cast<double>(
        shader::lodestar_lookupExponent(leastExponent(material, settings), 0.0f));
}

/// The Phong exponent of the bluntest lookup a material makes: seen from above.
double bluntestLookup(const io::GltfMaterial& material, const RenderSettings& settings) {
    if (hasExponentTexture(material, settings)) {
        return 0.0;
    }
    return static_cast<double>(
        shader::lodestar_lookupExponent(leastExponent(material, settings), 1.0f));
}

/// Which of the two terms a material reflects anywhere on its surface.
void setTerms(plan::DrawView& draw, const io::GltfMaterial& material,
              const RenderSettings& settings) {
    if (settings.materialOverride) {
        const MaterialOverride& values = *settings.materialOverride;
        draw.diffuse = !isBlack(values.diffuse);
        draw.glossy = !isBlack(values.f0) || values.exponent > 0.0f;
    } else if (material.blinnPhong) {
        const io::GltfBlinnPhong& given = *material.blinnPhong;
        draw.diffuse = !given.diffuse || !isBlack(*given.diffuse);
        draw.glossy = !given.f0 || !isBlack(*given.f0) || given.exponent.value_or(1.0f) > 0.0f ||
                      given.exponentTexture.texture != io::kNone;
    } else {
        const bool textured = material.metallicRoughnessTexture.texture != io::kNone;
        draw.diffuse = material.diffuse ? !isBlack(*material.diffuse)
                                        : (material.metallic < 1.0f || textured) &&
                                              !isBlack(glm::vec3(material.baseColor));
        draw.glossy = true; // Fresnel's rise at grazing angles, whatever F0 is
    }
    // Below an exponent of 1 the glossy lobe by estimators that follow it blends into Lambert's.
    draw.diffuse = draw.diffuse || (draw.glossy && lighting::followsLobe(settings.specular.kind) &&
                                    leastExponent(material, settings) < 1.0f);
}

/// Which share of the picture a box may cover: its sphere's square, 1 about the eye.
float screenShare(const Bounds& bounds, const View& view) {
    const glm::vec3 center(view.cameraFromWorld * glm::vec4(bounds.center(), 1.0f));
    const float radius = bounds.radius();
    const float depth = view.perspective ? std::max(-center.z, radius) : 1.0f;
    const float x = radius * view.clipFromCamera[0][0] / depth;
    const float y = radius * view.clipFromCamera[1][1] / depth;
    return std::min(std::abs(x * y), 1.0f);
}

/// @param index of the item among all
plan::DrawView drawView(const Scene& scene, const DrawItem& item, std::size_t index,
                        const View& view, const glm::mat4& clipFromWorld,
                        const RenderSettings& settings) {
    const Node& node = scene.nodes[static_cast<std::size_t>(item.node)];
    const auto mesh = static_cast<std::size_t>(item.mesh);
    const auto part = static_cast<std::size_t>(item.primitive);
    const io::GltfPrimitive& primitive = scene.meshes[mesh].primitives[part];
    const auto& component =
        std::get<MeshComponent>(node.components[static_cast<std::size_t>(item.component)]);
    const Bounds bounds = primitiveWorldBounds(scene, node, component, part);
    plan::DrawView draw;
    draw.subject = (node.name.empty() ? "node " + std::to_string(item.node) : node.name) + "/" +
                   std::to_string(item.primitive);
    draw.features = featuresOf(scene, primitive, settings);
    const bool skinned = component.skin != io::kNone && !primitive.joints[0].empty();
    draw.features |= skinned ? bit(Feature::Skinning) : 0u;
    draw.features |= skinned && !primitive.joints[1].empty() ? bit(Feature::SecondJoints) : 0u;
    draw.morphBytes = primitive.targets.empty() ? 0
                                                : primitive.positions.size() * sizeof(glm::vec3) +
                                                      primitive.normals.size() * sizeof(glm::vec3) +
                                                      primitive.tangents.size() * sizeof(glm::vec4);
    // Morphed vertices are a draw's own.
    draw.geometry = primitive.targets.empty()
                        ? static_cast<std::uint64_t>(mesh) << 32 | static_cast<std::uint64_t>(part)
                        : ~static_cast<std::uint64_t>(index);
    draw.material = static_cast<std::uint32_t>(primitive.material + 1);
    draw.mirrored = glm::determinant(glm::mat3(node.worldFromNode)) < 0.0f;
    draw.visible = mayBeSeen(bounds, clipFromWorld);
    draw.blended = plan::has(draw.features, Feature::AlphaBlend);
    draw.indexCount = static_cast<int>(primitive.indices.size());
    draw.layers = node.layers;
    if (!bounds.empty()) {
        draw.low = bounds.low;
        draw.high = bounds.high;
        draw.screenShare = screenShare(bounds, view);
        draw.distance = -glm::vec3(view.cameraFromWorld * glm::vec4(bounds.center(), 1.0f)).z;
    }
    // Estimators that read other mips are the frame's alone: one chain is bound.
    const bool own = lighting::readsTentMips(settings.specular.kind) && !settings.materialOverride;
    draw.specular = own ? materialOf(scene, primitive).specularEstimator.value_or(settings.specular)
                        : settings.specular;
    draw.toleratedError = draw.specular.kind == lighting::EstimatorKind::Auto
                              ? static_cast<double>(draw.specular.tolerance)
                              : 0.0;
    setTerms(draw, materialOf(scene, primitive), settings);
    draw.sharpest = sharpestLookup(materialOf(scene, primitive), settings);
    draw.bluntest = bluntestLookup(materialOf(scene, primitive), settings);
    draw.lit = !plan::has(draw.features, Feature::Unlit);
    draw.casts = primitive.topology == io::Topology::Triangles &&
                 !plan::has(draw.features, Feature::AlphaBlend);
    return draw;
}

} // namespace

std::vector<DrawItem> drawItems(const Scene& scene) {
    std::vector<DrawItem> items;
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        const std::vector<Component>& components = scene.nodes[n].components;
        for (std::size_t c = 0; c < components.size(); ++c) {
            if (const auto* mesh = std::get_if<MeshComponent>(&components[c])) {
                const auto& parts = scene.meshes[static_cast<std::size_t>(mesh->mesh)].primitives;
                for (std::size_t p = 0; p < parts.size(); ++p) {
                    items.push_back({static_cast<int>(n), mesh->mesh, static_cast<int>(p),
                                     static_cast<int>(c)});
                }
            }
        }
    }
    return items;
}

std::vector<bool> wornSkins(const Scene& scene) {
    std::vector<bool> worn(scene.skins.size());
    for (const Node& node : scene.nodes) {
        for (const Component& component : node.components) {
            const auto* mesh = std::get_if<MeshComponent>(&component);
            if (mesh != nullptr && mesh->skin != io::kNone) {
                worn[static_cast<std::size_t>(mesh->skin)] = true;
            }
        }
    }
    return worn;
}

std::vector<PlacedLight> placedLights(const Scene& scene) {
    std::vector<PlacedLight> lights;
    for (const Node& node : scene.nodes) {
        for (const Component& component : node.components) {
            if (const auto* light = std::get_if<LightComponent>(&component)) {
                lights.push_back({&node, &light->light});
            }
        }
    }
    return lights;
}

const io::GltfMaterial& materialOf(const Scene& scene, const io::GltfPrimitive& primitive) {
    static const io::GltfMaterial defaultMaterial{};
    return primitive.material == io::kNone
               ? defaultMaterial
               : scene.materials[static_cast<std::size_t>(primitive.material)];
}

plan::Features featuresOf(const Scene& scene, const io::GltfPrimitive& primitive,
                          const RenderSettings& settings) {
    const io::GltfMaterial& material = materialOf(scene, primitive);
    plan::Features features = 0;
    const auto add = [&](Feature feature, bool wanted) { features |= wanted ? bit(feature) : 0u; };
    const auto textured = [](const io::GltfTextureRef& reference) {
        return reference.texture != io::kNone;
    };
    const auto transformed = [&](const io::GltfTextureRef& reference) {
        return textured(reference) && reference.uvTransform.has_value();
    };
    const bool unlit = material.unlit && !settings.materialOverride;
    const bool normals = !primitive.normals.empty() && !unlit;
    add(Feature::Normals, normals);
    add(Feature::NormalTexture,
        normals && textured(material.normalTexture) &&
            !primitive.uvs[material.normalTexture.uvSet > 0 ? 1 : 0].empty());
    add(Feature::Tangents,
        plan::has(features, Feature::NormalTexture) && !primitive.tangents.empty());
    add(Feature::TextureTransform,
        plan::has(features, Feature::NormalTexture) && transformed(material.normalTexture));
    if (settings.materialOverride) {
        return features | bit(Feature::BlinnPhong);
    }
    add(Feature::VertexColors, !primitive.colors.empty());
    add(Feature::BaseColorTexture, textured(material.baseColorTexture));
    add(Feature::AlphaMask, material.alphaMode == io::AlphaMode::Mask);
    add(Feature::AlphaBlend, material.alphaMode == io::AlphaMode::Blend);
    add(Feature::TextureTransform, transformed(material.baseColorTexture));
    if (unlit) {
        return features | bit(Feature::Unlit);
    }
    add(Feature::OcclusionTexture, textured(material.occlusionTexture));
    add(Feature::EmissiveTexture, textured(material.emissiveTexture));
    add(Feature::BlinnPhong, material.blinnPhong.has_value());
    add(Feature::ExponentTexture,
        material.blinnPhong && textured(material.blinnPhong->exponentTexture));
    add(Feature::MetallicRoughnessTexture,
        !material.blinnPhong && textured(material.metallicRoughnessTexture));
    add(Feature::SpecularTexture, !material.blinnPhong && textured(material.specularTexture));
    add(Feature::SpecularColorTexture,
        !material.blinnPhong && textured(material.specularColorTexture));
    for (const io::GltfTextureRef* reference :
         {&material.occlusionTexture, &material.emissiveTexture, &material.metallicRoughnessTexture,
          &material.specularTexture, &material.specularColorTexture}) {
        add(Feature::TextureTransform, transformed(*reference));
    }
    add(Feature::TextureTransform,
        material.blinnPhong && transformed(material.blinnPhong->exponentTexture));
    return features;
}

plan::PlanInput planInput(const Scene& scene, const View& view, const RenderSettings& settings,
                          const plan::EnvironmentView& environment) {
    plan::PlanInput input;
    const glm::mat4 clipFromWorld = view.clipFromWorld();
    for (const DrawItem& item : drawItems(scene)) {
        input.draws.push_back(
            drawView(scene, item, input.draws.size(), view, clipFromWorld, settings));
    }
    const std::vector<bool> worn = wornSkins(scene);
    for (std::size_t s = 0; s < worn.size(); ++s) {
        input.jointBytes +=
            worn[s] ? scene.skins[s].joints.size() * kTexelsPerJoint * sizeof(glm::vec4) : 0U;
    }
    input.environment = environment;
    input.lightCount = static_cast<int>(placedLights(scene).size());
    input.specular = settings.specular;
    input.diffuse = settings.diffuse;
    input.lobes = settings.lobes;
    input.fresnel = settings.fresnel;
    input.backdrop = settings.backdrop;
    input.pixels = static_cast<std::uint64_t>(settings.width) *
                   static_cast<std::uint64_t>(settings.height) *
                   static_cast<std::uint64_t>(settings.samplesPerSide * settings.samplesPerSide);
    return input;
}

bool hasChoices(const plan::PlanInput& input) {
    return std::any_of(input.draws.begin(), input.draws.end(), [](const plan::DrawView& draw) {
        return draw.specular.kind == lighting::EstimatorKind::Auto;
    });
}

void chooseEstimators(const lighting::ErrorForecast& forecast, plan::PlanInput& input) {
    for (plan::DrawView& draw : input.draws) {
        if (draw.specular.kind == lighting::EstimatorKind::Auto) {
            const lighting::ErrorForecast::Choice choice =
                forecast.choose(draw.toleratedError, draw.bluntest, draw.sharpest);
            draw.specular = choice.estimator;
            draw.foreseenError = choice.error;
        }
    }
}

} // namespace lodestar::scene

// SPDX-License-Identifier: MIT
//
// A scene's meshes, materials and textures as GL objects.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "gl/texture.h"
#include "host/blocks.glsl"
#include "scene/gpu_geometry.h"
#include "scene/renderer.h"
#include "scene/scene.h"

namespace lodestar::scene {

/// Texture units of the renderer, shared with its programs' samplers.
enum TextureUnit : int {
    kBaseColorUnit = LODESTAR_BASE_COLOR_UNIT,
    kMetallicRoughnessUnit = LODESTAR_METALLIC_ROUGHNESS_UNIT,
    kNormalUnit = LODESTAR_NORMAL_UNIT,
    kOcclusionUnit = LODESTAR_OCCLUSION_UNIT,
    kEmissiveUnit = LODESTAR_EMISSIVE_UNIT,
    kExponentUnit = LODESTAR_EXPONENT_UNIT,
    kSpecularUnit = LODESTAR_SPECULAR_UNIT,
    kSpecularColorUnit = LODESTAR_SPECULAR_COLOR_UNIT,
    kMaterialUnitCount = LODESTAR_MATERIAL_TEXTURES,
    kEnvironmentUnit = kMaterialUnitCount,
    kIrradianceUnit,
    kJointUnit,
    kRsrmMapUnit,
    kRsrmLambertUnit,
    kRsrmGradientUnit,
    kShadowUnit,
    kInstanceUnit,
    kFirstProbeUnit,
    kSecondProbeUnit,
    kFirstProbeSkyUnit,
    kSecondProbeSkyUnit,
    kProbeIrradianceUnit,
    kReferenceUnit,
    kReferenceLightsUnit,
};

/// The names of the samplers, by unit.
inline constexpr std::array<const char*, 23> kSamplerNames = {
    "uBaseColorTexture", "uMetallicRoughnessTexture",
    "uNormalTexture",    "uOcclusionTexture",
    "uEmissiveTexture",  "uExponentTexture",
    "uSpecularTexture",  "uSpecularColorTexture",
    "uEnvironment",      "uIrradiance",
    "uJoints",           "uRsrmMaps",
    "uRsrmLamberts",     "uRsrmGradients",
    "uShadows",          "uInstances",
    "uFirstProbe",       "uSecondProbe",
    "uFirstProbeSky",    "uSecondProbeSky",
    "uProbeIrradiance",  "uReferenceLights",
    "uDrawnLights"};

/// A texture of a scene and how its numbers are stored: one image may be both.
struct TextureUse {
    int texture = 0; ///< of the scene's
    gl::TexelEncoding encoding = gl::TexelEncoding::Linear;
};
/// Those that a scene's materials name, some twice.
[[nodiscard]] std::vector<TextureUse> texturesOf(const Scene& scene);

class GpuScene {
public:
    GpuScene() = default;
    /// The vertices alone: textures are added before anything is drawn.
    GpuScene(gl::Device& device, const Scene& scene) : geometry_(device, scene) {}
    /// Uploads a texture that is not there yet. @errors NoOpenGl if the driver has no memory for it
    [[nodiscard]] core::Result<void> addTexture(gl::Device& device, const Scene& scene,
                                                const TextureUse& use);
    /// With the textures of another scene, which the materials' references name.
    [[nodiscard]] static GpuScene makeBeside(gl::Device& device, const Scene& scene,
                                             const GpuScene& other);

    [[nodiscard]] const GpuGeometry& geometry() const { return geometry_; }
    /// Binds the textures of a material to the material units; unused units are left as they are.
    void bindTextures(const io::GltfMaterial& material) const;

private:
    GpuGeometry geometry_;
    using Textures = std::map<std::pair<int, gl::TexelEncoding>, gl::Texture>;
    std::shared_ptr<Textures> textures_ = std::make_shared<Textures>();
};

/// The uniform block of a material, or of the override.
[[nodiscard]] blocks::LodestarMaterial materialBlock(const io::GltfMaterial& material,
                                                     const std::optional<MaterialOverride>& values);

} // namespace lodestar::scene

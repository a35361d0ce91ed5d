// SPDX-License-Identifier: MIT
#include "scene/gpu_scene.h"

namespace lodestar::scene {
namespace {

struct TextureSlot {
    TextureUnit unit;
    const io::GltfTextureRef* reference;
    gl::TexelEncoding encoding;
};

std::vector<TextureSlot> slotsOf(const io::GltfMaterial& material) {
    using gl::TexelEncoding;
    std::vector<TextureSlot> slots = {
        {kBaseColorUnit, &material.baseColorTexture, TexelEncoding::Srgb},
        {kMetallicRoughnessUnit, &material.metallicRoughnessTexture, TexelEncoding::Linear},
        {kNormalUnit, &material.normalTexture, TexelEncoding::Linear},
        {kOcclusionUnit, &material.occlusionTexture, TexelEncoding::Linear},
        {kEmissiveUnit, &material.emissiveTexture, TexelEncoding::Srgb},
        {kSpecularUnit, &material.specularTexture, TexelEncoding::Linear},
        {kSpecularColorUnit, &material.specularColorTexture, TexelEncoding::Srgb},
    };
    if (material.blinnPhong) {
        slots.push_back(
            {kExponentUnit, &material.blinnPhong->exponentTexture, TexelEncoding::Linear});
    }
    return slots;
}

gl::Wrap wrapOf(io::Wrap wrap) {
    switch (wrap) {
    case io::Wrap::MirroredRepeat:
        return gl::Wrap::MirroredRepeat;
    case io::Wrap::ClampToEdge:
        return gl::Wrap::ClampToEdge;
    case io::Wrap::Repeat:
        break;
    }
    return gl::Wrap::Repeat;
}

gl::SamplerState samplerOf(const io::GltfTexture& texture) {
    return {wrapOf(texture.wrapS),
            wrapOf(texture.wrapT),
            texture.magnification == io::Filter::Linear,
            texture.minification == io::Filter::Linear,
            texture.mip != io::MipFilter::None,
            texture.mip == io::MipFilter::Linear};
}

/// F0 of a dielectric: ((n - 1) / (n + 1))^2 times the specular colour. An index of 0 gives 1.
glm::vec3 dielectricF0(const io::GltfMaterial& material) {
    const float ratio = (material.ior - 1.0f) / (material.ior + 1.0f);
    return ratio * ratio * material.specularColor;
}

} // namespace

std::vector<TextureUse> texturesOf(const Scene& scene) {
    std::vector<TextureUse> uses;
    for (const io::GltfMaterial& material : scene.materials) {
        for (const TextureSlot& slot : slotsOf(material)) {
            if (slot.reference->texture != io::kNone) {
                uses.push_back({slot.reference->texture, slot.encoding});
            }
        }
    }
    return uses;
}

GpuScene GpuScene::makeBeside(gl::Device& device, const Scene& scene, const GpuScene& other) {
    GpuScene result(device, scene);
    result.textures_ = other.textures_;
    return result;
}

core::Result<void> GpuScene::addTexture(gl::Device& device, const Scene& scene,
                                        const TextureUse& use) {
    if (textures_->count({use.texture, use.encoding}) > 0) {
        return {};
    }
    const io::GltfTexture& texture = scene.textures[static_cast<std::size_t>(use.texture)];
    core::Texels white(1, 1);
    white.bytes().assign(4, 255);
    const core::Texels& image =
        texture.image == io::kNone ? white : scene.images[static_cast<std::size_t>(texture.image)];
    const std::string label = "texture " + std::to_string(use.texture);
    auto made = gl::Texture::make2D(device, image, use.encoding, samplerOf(texture), label.c_str());
    if (!made) {
        return made.error();
    }
    textures_->emplace(std::pair(use.texture, use.encoding), std::move(*made));
    return {};
}

void GpuScene::bindTextures(const io::GltfMaterial& material) const {
    for (const TextureSlot& slot : slotsOf(material)) {
        if (slot.reference->texture != io::kNone) {
            textures_->at({slot.reference->texture, slot.encoding}).bind(slot.unit);
        }
    }
}

blocks::LodestarMaterial materialBlock(const io::GltfMaterial& material,
                                       const std::optional<MaterialOverride>& values) {
    blocks::LodestarMaterial block{};
    block.baseColor = values ? glm::vec4(1.0f) : material.baseColor;
    block.emissive = glm::vec4(values ? glm::vec3(0.0f) : material.emissive, material.normalScale);
    block.surface = {material.metallic, material.roughness, material.occlusionStrength,
                     material.alphaCutoff};
    block.specular = {dielectricF0(material), material.specular};
    for (const TextureSlot& slot : slotsOf(material)) {
        const glm::mat3x2 m = slot.reference->uvTransform.value_or(glm::mat3x2(1.0f));
        const auto set = static_cast<float>(slot.reference->uvSet);
        block.uvRows[2 * slot.unit] = {m[0].x, m[1].x, m[2].x, set};
        block.uvRows[2 * slot.unit + 1] = {m[0].y, m[1].y, m[2].y, 0.0f};
    }
    if (values) {
        block.diffuse = {values->diffuse, values->exponent};
        block.f0 = {values->f0, 1.0f};
    } else if (material.blinnPhong && !material.unlit) {
        const io::GltfBlinnPhong& given = *material.blinnPhong;
        block.diffuse = {given.diffuse.value_or(glm::vec3(material.baseColor)),
                         given.exponent.value_or(0.0f)};
        block.f0 = {given.f0.value_or(glm::vec3(0.04f)), given.exponentScale};
        block.more.x = given.exponentEncoding == io::ExponentEncoding::Log2 ? 1.0f : 0.0f;
        // The shader multiplies k_L by the base colour, whose factor k_L replaces.
        block.baseColor = glm::vec4(glm::vec3(1.0f), material.baseColor.a);
    } else {
        block.diffuse = {material.diffuse.value_or(glm::vec3(0.0f)),
                         material.exponent.value_or(0.0f)};
        block.f0 = glm::vec4(material.f0.value_or(glm::vec3(0.0f)), 1.0f);
        block.more = {0.0f, material.exponent ? 1.0f : 0.0f, material.diffuse ? 1.0f : 0.0f,
                      material.f0 ? 1.0f : 0.0f};
    }
    return block;
}

} // namespace lodestar::scene

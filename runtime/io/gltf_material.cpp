// SPDX-License-Identifier: MIT
//
// Materials, textures and samplers. Source: glTF 2.0 specification, sections 3.8, 3.9, 5.26, and
// KHR_materials_emissive_strength; further extensions in gltf_extensions.cpp.
#include <algorithm>
#include <cmath>

#include "io/gltf_internal.h"

namespace lodestar::io::detail {
namespace {

constexpr float kMaxEmission = 1e9f;
constexpr double kMaxExponent = 1e7;

/// A value brought into [low, high], counted where it was not.
float within(double value, double low, double high, const char* rule, core::Tally& warnings) {
    const double repaired = value >= low ? std::min(value, high) : low; // NaN too
    warnings.add(rule, repaired == value ? 0 : 1);
    return static_cast<float>(repaired);
}

class MaterialReader {
public:
    MaterialReader(GltfContext& context, std::string at) : context_(context), at_(std::move(at)) {}

    core::Result<GltfMaterial> read(const tinygltf::Material& source, const Json& json) {
        core::Tally& warnings = context_.file.warnings;
        const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
        GltfMaterial material;
        material.name = source.name;
        for (int c = 0; c < 4; ++c) {
            material.baseColor[c] =
                within(pbr.baseColorFactor[static_cast<std::size_t>(c)], 0.0, 1.0,
                       "baseColorFactor outside [0, 1], clamped", warnings);
        }
        material.metallic = within(pbr.metallicFactor, 0.0, 1.0,
                                   "metallicFactor outside [0, 1], clamped", warnings);
        material.roughness = within(pbr.roughnessFactor, 0.0, 1.0,
                                    "roughnessFactor outside [0, 1], clamped", warnings);
        readEmission(source, json, material);
        material.normalScale = static_cast<float>(source.normalTexture.scale);
        material.occlusionStrength = within(source.occlusionTexture.strength, 0.0, 1.0,
                                            "occlusion strength outside [0, 1], clamped", warnings);
        readAlpha(source, material);
        material.doubleSided = source.doubleSided;
        const core::Result<void> extended =
            readMaterialExtensions(json, at_, material, context_.file.warnings);
        if (!extended) {
            return extended.error();
        }
        const core::Result<void> textures = readTextures(json, material);
        if (!textures) {
            return textures.error();
        }
        const Json* extras = member(json, "extras");
        const Json* own = extras == nullptr ? nullptr : member(*extras, "lodestar");
        if (own != nullptr) {
            at_ += "/extras/lodestar";
            core::Result<GltfBlinnPhong> blinnPhong = readBlinnPhong(*own);
            if (!blinnPhong) {
                return blinnPhong.error();
            }
            material.blinnPhong = *blinnPhong;
        }
        const core::Result<void> chosen = chooseUvSources(material);
        if (!chosen) {
            return chosen.error();
        }
        return material;
    }

private:
    void readEmission(const tinygltf::Material& source, const Json& json, GltfMaterial& material) {
        double strength = 1.0;
        const Json* own = extensionOf(json, "KHR_materials_emissive_strength");
        const Json* given = own == nullptr ? nullptr : member(*own, "emissiveStrength");
        if (given != nullptr) {
            strength = given->get<double>();
        }
        for (int c = 0; c < 3; ++c) {
            const double factor = source.emissiveFactor[static_cast<std::size_t>(c)];
            context_.file.warnings.add("emissiveFactor above 1, kept", factor > 1.0 ? 1 : 0);
            material.emissive[c] =
                within(factor * strength, 0.0, static_cast<double>(kMaxEmission),
                       "emission outside [0, 1e9], clamped", context_.file.warnings);
        }
    }

    void readAlpha(const tinygltf::Material& source, GltfMaterial& material) {
        material.alphaMode = source.alphaMode == "MASK"    ? AlphaMode::Mask
                             : source.alphaMode == "BLEND" ? AlphaMode::Blend
                                                           : AlphaMode::Opaque;
        const bool known = material.alphaMode != AlphaMode::Opaque || source.alphaMode == "OPAQUE";
        context_.file.warnings.add("alphaMode unknown, taken as OPAQUE", known ? 0 : 1);
        material.alphaCutoff = within(source.alphaCutoff, 0.0, 3.0e38,
                                      "alphaCutoff negative, set to 0", context_.file.warnings);
    }

    core::Result<void> readTextures(const Json& json, GltfMaterial& material) {
        const Json* pbr = member(json, "pbrMetallicRoughness");
        const Json* specular = extensionOf(json, "KHR_materials_specular");
        const std::string pbrAt = at_ + "/pbrMetallicRoughness/";
        const std::string specularAt = at_ + "/extensions/KHR_materials_specular/";
        const auto in = [](const Json* object, const char* key) {
            return object == nullptr ? nullptr : member(*object, key);
        };
        struct Slot {
            const Json* info;
            std::string at;
            GltfTextureRef& reference;
        };
        const Slot slots[] = {
            {in(pbr, "baseColorTexture"), pbrAt + "baseColorTexture", material.baseColorTexture},
            {in(pbr, "metallicRoughnessTexture"), pbrAt + "metallicRoughnessTexture",
             material.metallicRoughnessTexture},
            {in(&json, "normalTexture"), at_ + "/normalTexture", material.normalTexture},
            {in(&json, "occlusionTexture"), at_ + "/occlusionTexture", material.occlusionTexture},
            {in(&json, "emissiveTexture"), at_ + "/emissiveTexture", material.emissiveTexture},
            {in(specular, "specularTexture"), specularAt + "specularTexture",
             material.specularTexture},
            {in(specular, "specularColorTexture"), specularAt + "specularColorTexture",
             material.specularColorTexture}};
        for (const Slot& slot : slots) {
            if (slot.info == nullptr) {
                continue;
            }
            core::Result<GltfTextureRef> read = reference(*slot.info, slot.at);
            if (!read) {
                return read.error();
            }
            slot.reference = *read;
        }
        return {};
    }

    /// A textureInfo: its index, set and transform. The set is the file's until chooseUvSources.
    core::Result<GltfTextureRef> reference(const Json& info, const std::string& at) {
        const Json* index = member(info, "index");
        const Json* set = member(info, "texCoord");
        if (index == nullptr || !index->is_number_integer()) {
            return core::refused("must be an object with the index of a texture", at);
        }
        const auto isSet = [](const Json& j) {
            return j.is_number_unsigned() && j.get<std::uint64_t>() < 0x7fffffff;
        };
        if (set != nullptr && !isSet(*set)) {
            return core::refused("must be the number of a set of texture coordinates",
                                 at + "/texCoord");
        }
        GltfTextureRef result;
        result.uvSet = set == nullptr ? 0 : set->get<int>();
        core::Result<std::optional<glm::mat3x2>> transform =
            readTextureTransform(info, at, result.uvSet);
        if (!transform) {
            return transform.error();
        }
        result.uvTransform = *transform;
        const bool absent = index->is_number_integer() && !index->is_number_unsigned() &&
                            index->get<std::int64_t>() == kNone;
        if (!index->is_number_unsigned() ||
            index->get<std::uint64_t>() >= context_.model.textures.size()) {
            context_.file.warnings.add("texture that does not exist, left out", absent ? 0 : 1);
            return GltfTextureRef();
        }
        result.texture = index->get<int>();
        return result;
    }

    /// A vertex carries two sets. Where a material names a third or a later one, the two that it
    /// uses are loaded instead; more than two are refused.
    core::Result<void> chooseUvSources(GltfMaterial& material) const {
        std::vector<GltfTextureRef*> references = {
            &material.baseColorTexture,    &material.metallicRoughnessTexture,
            &material.normalTexture,       &material.occlusionTexture,
            &material.emissiveTexture,     &material.specularTexture,
            &material.specularColorTexture};
        if (material.blinnPhong) {
            references.push_back(&material.blinnPhong->exponentTexture);
        }
        std::vector<int> sets;
        for (const GltfTextureRef* reference : references) {
            if (reference->texture != kNone &&
                std::find(sets.begin(), sets.end(), reference->uvSet) == sets.end()) {
                sets.push_back(reference->uvSet);
            }
        }
        std::sort(sets.begin(), sets.end());
        if (sets.empty() || sets.back() <= 1) {
            return {};
        }
        if (sets.size() > 2) {
            return core::refused("its textures use " + std::to_string(sets.size()) +
                                     " sets of texture coordinates; two are supported",
                                 at_);
        }
        sets.resize(2, 0);
        material.uvSources = {sets[0], sets[1]};
        for (GltfTextureRef* reference : references) {
            reference->uvSet = reference->uvSet == sets[0] ? 0 : 1;
        }
        return {};
    }

    [[nodiscard]] core::Error wrong(const std::string& what, const std::string& key) const {
        return core::refused(what, key.empty() ? at_ : at_ + "/" + key);
    }

    /// Three numbers in [0, 1].
    core::Result<std::optional<glm::vec3>> reflectance(const Json& json, const char* key) const {
        const Json* value = member(json, key);
        if (value == nullptr) {
            return std::optional<glm::vec3>();
        }
        glm::vec3 color(0.0f);
        bool good = value->is_array() && value->size() == 3;
        for (std::size_t c = 0; good && c < 3; ++c) {
            good = (*value)[c].is_number() && (*value)[c].get<double>() >= 0.0 &&
                   (*value)[c].get<double>() <= 1.0;
            if (good) {
                color[static_cast<glm::length_t>(c)] = (*value)[c].get<float>();
            }
        }
        if (!good) {
            return wrong("must be three numbers in [0, 1]", key);
        }
        return std::optional<glm::vec3>(color);
    }

    core::Result<void> readExponent(const Json& json, GltfBlinnPhong& result) const {
        const Json* value = member(json, "exponent");
        if (value == nullptr) {
            return {};
        }
        const bool mirror = value->is_string() && value->get<std::string>() == "mirror";
        const bool number = value->is_number() && value->get<double>() >= 0.0 &&
                            value->get<double>() <= kMaxExponent;
        if (!mirror && !number) {
            return wrong("must be a number in [0, 1e7] or \"mirror\"", "exponent");
        }
        result.exponent = mirror ? static_cast<float>(kMaxExponent) : value->get<float>();
        return {};
    }

    core::Result<void> readExponentTexture(const Json& json, GltfBlinnPhong& result) {
        if (const Json* value = member(json, "exponentTexture")) {
            core::Result<GltfTextureRef> read = reference(*value, at_ + "/exponentTexture");
            if (!read) {
                return read.error();
            }
            result.exponentTexture = *read;
        }
        if (const Json* value = member(json, "exponentEncoding")) {
            const std::string name = value->is_string() ? value->get<std::string>() : std::string();
            if (name != "exponent" && name != "log2") {
                return wrong("must be \"exponent\" or \"log2\"", "exponentEncoding");
            }
            result.exponentEncoding =
                name == "log2" ? ExponentEncoding::Log2 : ExponentEncoding::Exponent;
        }
        if (const Json* value = member(json, "exponentScale")) {
            if (!value->is_number() ||
                !(value->get<double>() >= 0.0 && value->get<double>() <= kMaxExponent)) {
                return wrong("must be a number in [0, 1e7]", "exponentScale");
            }
            result.exponentScale = value->get<float>();
        }
        return {};
    }

    core::Result<GltfBlinnPhong> readBlinnPhong(const Json& json) {
        if (!json.is_object()) {
            return wrong("must be an object", "");
        }
        GltfBlinnPhong result;
        core::Result<std::optional<glm::vec3>> diffuse = reflectance(json, "diffuse");
        if (!diffuse) {
            return diffuse.error();
        }
        core::Result<std::optional<glm::vec3>> f0 = reflectance(json, "f0");
        if (!f0) {
            return f0.error();
        }
        result.diffuse = *diffuse;
        result.f0 = *f0;
        core::Result<void> exponent = readExponent(json, result);
        if (!exponent) {
            return exponent.error();
        }
        core::Result<void> texture = readExponentTexture(json, result);
        if (!texture) {
            return texture.error();
        }
        return result;
    }

    GltfContext& context_;
    std::string at_;
};

Wrap wrapOf(int value, core::Tally& warnings) {
    switch (value) {
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
        return Wrap::ClampToEdge;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
        return Wrap::MirroredRepeat;
    default:
        warnings.add("wrap mode unknown, taken as repeat",
                     value == TINYGLTF_TEXTURE_WRAP_REPEAT ? 0 : 1);
        return Wrap::Repeat;
    }
}

void applyFilters(const tinygltf::Sampler& sampler, GltfTexture& texture, core::Tally& warnings) {
    const int magnification = sampler.magFilter;
    texture.magnification =
        magnification == TINYGLTF_TEXTURE_FILTER_NEAREST ? Filter::Nearest : Filter::Linear;
    bool known = magnification == -1 || magnification == TINYGLTF_TEXTURE_FILTER_NEAREST ||
                 magnification == TINYGLTF_TEXTURE_FILTER_LINEAR;
    const auto set = [&](Filter filter, MipFilter mip) {
        texture.minification = filter;
        texture.mip = mip;
    };
    switch (sampler.minFilter) {
    case TINYGLTF_TEXTURE_FILTER_NEAREST:
        set(Filter::Nearest, MipFilter::None);
        break;
    case TINYGLTF_TEXTURE_FILTER_LINEAR:
        set(Filter::Linear, MipFilter::None);
        break;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_NEAREST:
        set(Filter::Nearest, MipFilter::Nearest);
        break;
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_NEAREST:
        set(Filter::Linear, MipFilter::Nearest);
        break;
    case TINYGLTF_TEXTURE_FILTER_NEAREST_MIPMAP_LINEAR:
        set(Filter::Nearest, MipFilter::Linear);
        break;
    case TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR:
    case -1:
        set(Filter::Linear, MipFilter::Linear);
        break;
    default:
        known = false;
        break;
    }
    warnings.add("texture filter unknown, taken as linear", known ? 0 : 1);
}

} // namespace

void convertMaterials(GltfContext& context) {
    for (std::size_t i = 0; i < context.model.materials.size(); ++i) {
        MaterialReader reader(context, pointer("/materials", i));
        core::Result<GltfMaterial> material =
            reader.read(context.model.materials[i], context.document["materials"][i]);
        if (!material) {
            context.problems.refuse(material.error());
        }
        context.file.materials.push_back(material ? std::move(*material) : GltfMaterial());
    }
}

void convertTextures(GltfContext& context) {
    core::Tally& warnings = context.file.warnings;
    const std::size_t images = memberSize(context.document, "images");
    for (const tinygltf::Texture& source : context.model.textures) {
        GltfTexture texture;
        if (source.source >= 0 && static_cast<std::size_t>(source.source) < images) {
            texture.image = source.source;
        } else {
            warnings.add(source.source == -1
                             ? "texture without an image, taken as white"
                             : "texture whose image does not exist, taken as white");
        }
        if (source.sampler >= 0) {
            const tinygltf::Sampler& sampler =
                context.model.samplers[static_cast<std::size_t>(source.sampler)];
            texture.wrapS = wrapOf(sampler.wrapS, warnings);
            texture.wrapT = wrapOf(sampler.wrapT, warnings);
            applyFilters(sampler, texture, warnings);
        }
        context.file.textures.push_back(texture);
    }
}

} // namespace lodestar::io::detail

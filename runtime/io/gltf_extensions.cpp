// SPDX-License-Identifier: MIT
//
// Extensions' own values: KHR_texture_transform, KHR_materials_unlit, KHR_materials_ior,
// KHR_materials_specular and EXT_lights_image_based.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "io/gltf_internal.h"

namespace lodestar::io::detail {
namespace {

constexpr double kFloatMax = std::numeric_limits<float>::max();
constexpr double kMaxIntensity = 1e9;

bool isFinite(const Json& value) {
    return value.is_number() && std::abs(value.get<double>()) <= kFloatMax;
}

/// The six faces of the first level; further levels must be six indices each too.
core::Result<std::array<int, 6>> readFaces(const Json& light, std::size_t images,
                                           const std::string& at) {
    const std::size_t levels = memberSize(light, "specularImages");
    if (levels == 0) {
        return core::refused("must be an array of levels of six images", at);
    }
    std::array<int, 6> faces{};
    for (std::size_t level = 0; level < levels; ++level) {
        const Json& list = light["specularImages"][level];
        if (!list.is_array() || list.size() != 6) {
            return core::refused("must be an array of six images", pointer(at, level));
        }
        for (std::size_t face = 0; face < 6; ++face) {
            if (!list[face].is_number_unsigned() || list[face].get<std::uint64_t>() >= images) {
                return core::refused("index " + list[face].dump() +
                                         " points at nothing: there are " + std::to_string(images) +
                                         " images",
                                     pointer(pointer(at, level), face));
            }
            if (level == 0) {
                faces[face] = list[face].get<int>();
            }
        }
    }
    return faces;
}

core::Result<GltfEnvironment> readEnvironment(const Json& json, std::size_t images,
                                              const std::string& at, core::Tally& warnings) {
    if (!json.is_object()) {
        return core::refused("must be an object", at);
    }
    GltfEnvironment environment;
    if (const Json* name = member(json, "name"); name != nullptr && name->is_string()) {
        environment.name = name->get<std::string>();
    }
    ExtensionReader reader(&json, at);
    const double intensity = reader.number("intensity", 1.0);
    std::array<double, 4> q = {0.0, 0.0, 0.0, 1.0};
    reader.numbers("rotation", q);
    if (!reader.status()) {
        return reader.status().error();
    }
    const double clamped = std::clamp(intensity, 0.0, kMaxIntensity);
    warnings.add("environment intensity outside [0, 1e9], clamped", clamped == intensity ? 0 : 1);
    environment.intensity = static_cast<float>(clamped);
    const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    warnings.add("environment rotation zero, left out", length > 0.0 ? 0 : 1);
    if (length > 0.0) {
        environment.rotation =
            glm::quat(glm::dquat(q[3] / length, q[0] / length, q[1] / length, q[2] / length));
    }
    core::Result<std::array<int, 6>> faces = readFaces(json, images, at + "/specularImages");
    if (!faces) {
        return faces.error();
    }
    environment.faces = *faces;
    return environment;
}

} // namespace

ExtensionReader::ExtensionReader(const Json* object, std::string at)
    : object_(object), at_(std::move(at)) {
    if (object_ != nullptr && !object_->is_object()) {
        refuse("must be an object", "");
    }
}

const Json* ExtensionReader::find(const char* key) const {
    return object_ == nullptr || !status_ ? nullptr : member(*object_, key);
}

void ExtensionReader::refuse(const std::string& what, const std::string& key) {
    if (status_) {
        status_ = core::refused(what, key.empty() ? at_ : at_ + "/" + key);
    }
}

double ExtensionReader::number(const char* key, double otherwise) {
    const Json* value = find(key);
    if (value == nullptr) {
        return otherwise;
    }
    if (!isFinite(*value)) {
        refuse("must be a number in single precision's range", key);
        return otherwise;
    }
    return value->get<double>();
}

void ExtensionReader::numbers(const char* key, std::span<double> values) {
    const Json* value = find(key);
    if (value == nullptr) {
        return;
    }
    if (!value->is_array() || value->size() != values.size() ||
        !std::all_of(value->begin(), value->end(), isFinite)) {
        refuse("must be " + std::to_string(values.size()) + " numbers in single precision's range",
               key);
        return;
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
        values[i] = (*value)[i].get<double>();
    }
}

std::optional<int> ExtensionReader::index(const char* key, std::size_t size, const char* what) {
    const Json* value = find(key);
    if (value == nullptr) {
        return std::nullopt;
    }
    if (!value->is_number_unsigned() || value->get<std::uint64_t>() >= size) {
        refuse("index " + value->dump() + " points at nothing: there are " + std::to_string(size) +
                   " " + what,
               key);
        return std::nullopt;
    }
    return value->get<int>();
}

const Json* extensionOf(const Json& object, const char* name) {
    const Json* extensions = member(object, "extensions");
    return extensions == nullptr ? nullptr : member(*extensions, name);
}

core::Result<std::optional<glm::mat3x2>> readTextureTransform(const Json& info,
                                                              const std::string& at, int& set) {
    const Json* own = extensionOf(info, "KHR_texture_transform");
    ExtensionReader reader(own, at + "/extensions/KHR_texture_transform");
    std::array<double, 2> offset = {0.0, 0.0};
    std::array<double, 2> scale = {1.0, 1.0};
    reader.numbers("offset", offset);
    reader.numbers("scale", scale);
    const double rotation = reader.number("rotation", 0.0);
    set = reader.index("texCoord", 0x7fffffff, "sets of texture coordinates").value_or(set);
    if (!reader.status()) {
        return reader.status().error();
    }
    const bool changes = offset[0] != 0.0 || offset[1] != 0.0 || scale[0] != 1.0 ||
                         scale[1] != 1.0 || rotation != 0.0;
    if (!changes) {
        return std::optional<glm::mat3x2>();
    }
    // v runs down the image, so that a turn against the clock has its minus sign in v's row.
    const double c = std::cos(rotation);
    const double s = std::sin(rotation);
    return std::optional(glm::mat3x2(glm::dmat3x2(c * scale[0], -s * scale[0], s * scale[1],
                                                  c * scale[1], offset[0], offset[1])));
}

core::Result<void> readMaterialExtensions(const Json& json, const std::string& at,
                                          GltfMaterial& material, core::Tally& warnings) {
    const std::string under = at + "/extensions/";
    ExtensionReader unlit(extensionOf(json, "KHR_materials_unlit"), under + "KHR_materials_unlit");
    material.unlit = unlit.present();
    ExtensionReader index(extensionOf(json, "KHR_materials_ior"), under + "KHR_materials_ior");
    const double ior = index.number("ior", 1.5);
    const bool possible = ior == 0.0 || ior >= 1.0;
    warnings.add("ior below 1, set to 1", possible ? 0 : 1);
    material.ior = possible ? static_cast<float>(ior) : 1.0f;
    ExtensionReader specular(extensionOf(json, "KHR_materials_specular"),
                             under + "KHR_materials_specular");
    const double factor = specular.number("specularFactor", 1.0);
    std::array<double, 3> color = {1.0, 1.0, 1.0};
    specular.numbers("specularColorFactor", color);
    warnings.add("specularFactor outside [0, 1], clamped", factor >= 0.0 && factor <= 1.0 ? 0 : 1);
    material.specular = static_cast<float>(std::clamp(factor, 0.0, 1.0));
    for (std::size_t c = 0; c < 3; ++c) {
        warnings.add("specularColorFactor negative, set to 0", color[c] < 0.0 ? 1 : 0);
        material.specularColor[static_cast<glm::length_t>(c)] =
            static_cast<float>(std::max(color[c], 0.0));
    }
    for (const ExtensionReader* reader : {&unlit, &index, &specular}) {
        if (!reader->status()) {
            return reader->status();
        }
    }
    return {};
}

void convertEnvironments(GltfContext& context) {
    const Json* own = extensionOf(context.document, "EXT_lights_image_based");
    const std::string at = "/extensions/EXT_lights_image_based";
    const std::size_t images = memberSize(context.document, "images");
    if (!context.problems.clean("/extensions")) {
        return; // nobody knows what the scenes' indices point at
    }
    if (own != nullptr && (!own->is_object() || memberSize(*own, "lights") == 0)) {
        context.problems.refuse("must be an object with an array of lights", at);
        return;
    }
    for (std::size_t i = 0; own != nullptr && i < memberSize(*own, "lights"); ++i) {
        core::Result<GltfEnvironment> environment = readEnvironment(
            (*own)["lights"][i], images, pointer(at + "/lights", i), context.file.warnings);
        if (!environment) {
            context.problems.refuse(environment.error());
        }
        context.file.environments.push_back(environment ? std::move(*environment)
                                                        : GltfEnvironment());
    }
    for (std::size_t i = 0; i < memberSize(context.document, "scenes"); ++i) {
        ExtensionReader reader(extensionOf(context.document["scenes"][i], "EXT_lights_image_based"),
                               pointer("/scenes", i) + at);
        context.file.scenes[i].environment =
            reader.index("light", context.file.environments.size(), "image-based lights")
                .value_or(kNone);
        if (!reader.status()) {
            context.problems.refuse(reader.status().error());
        }
    }
}

} // namespace lodestar::io::detail

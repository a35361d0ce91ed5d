// SPDX-License-Identifier: MIT
//
// Rules of the standard that loading can do without: the file is read all the same. Source: glTF
// 2.0 specification, sections 3 and 5, and KHR_lights_punctual.
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <string_view>

#include "io/gltf_rules.h"

namespace lodestar::io::detail {
namespace {

using Names = std::set<std::string>;

Names namesIn(const Json& document, const char* key) {
    Names names;
    for (std::size_t i = 0; i < memberSize(document, key); ++i) {
        if (document[key][i].is_string()) {
            names.insert(document[key][i].get<std::string>());
        }
    }
    return names;
}

/// A step of a walk. Its pointer is made only where there is something to say of it, and no longer
/// than people read: keys may be long, and each would be copied for everything below it.
struct Place {
    const Place* parent = nullptr;
    std::string_view key;

    [[nodiscard]] std::string pointer() const {
        std::string text;
        append(text);
        return text;
    }

private:
    static constexpr std::size_t kMaxPointer = 512;

    void append(std::string& text) const {
        if (parent != nullptr) {
            parent->append(text);
        }
        if (text.size() < kMaxPointer) {
            text += '/';
            text += key.substr(0, kMaxPointer);
        }
    }
};

/// What holds everywhere: no empty array, no extension that is not declared.
void checkEverywhere(const Json& value, const Place* at, const Names& used,
                     GltfProblems& problems) {
    for (const auto& [key, entry] : value.items()) {
        const Place here{at, key};
        if (key == "extras" || !entry.is_structured()) {
            continue;
        }
        if (entry.empty() && (entry.is_array() || key == "attributes")) {
            problems.repaired("must not be empty", here.pointer());
        }
        if (key == "extensions" && entry.is_object()) {
            for (const auto& [name, content] : entry.items()) {
                if (used.count(name) == 0) {
                    problems.repaired("extension is not named in extensionsUsed",
                                      Place{&here, name}.pointer());
                }
            }
        }
        checkEverywhere(entry, &here, used, problems);
    }
}

/// Arrays whose elements must differ.
void checkDuplicates(const Json& array, const std::string& at, GltfProblems& problems) {
    std::set<Json> seen;
    for (std::size_t i = 0; i < array.size(); ++i) {
        if (!seen.insert(array[i]).second) {
            problems.repaired("is listed twice", pointer(at, i));
        }
    }
}

void checkDocument(const Json& document, GltfProblems& problems) {
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
        if (document.contains(key) && document[key].is_array()) {
            checkDuplicates(document[key], std::string("/") + key, problems);
        }
    }
    const Names used = namesIn(document, "extensionsUsed");
    for (std::size_t i = 0; i < memberSize(document, "extensionsRequired"); ++i) {
        const Json& name = document["extensionsRequired"][i];
        if (name.is_string() && used.count(name.get<std::string>()) == 0) {
            problems.repaired("required extension is not named in extensionsUsed",
                              pointer("/extensionsRequired", i));
        }
    }
    if (used.count("KHR_mesh_quantization") > 0 &&
        namesIn(document, "extensionsRequired").count("KHR_mesh_quantization") == 0) {
        problems.repaired("KHR_mesh_quantization must be required where it is used",
                          "/extensionsUsed");
    }
    eachClean(document, "scenes", problems, [&](const Json& scene, const std::string& at) {
        if (scene.contains("nodes")) {
            checkDuplicates(scene["nodes"], at + "/nodes", problems);
        }
    });
}

void inRange(const Json& object, const char* key, double low, double high, const std::string& at,
             GltfProblems& problems) {
    const Json* value = member(object, key);
    if (value == nullptr) {
        return;
    }
    const auto check = [&](const Json& number, const std::string& where) {
        if (number.is_number() && !(number.get<double>() >= low && number.get<double>() <= high)) {
            problems.repaired(number.dump() + " is out of range", where);
        }
    };
    const std::string here = at + "/" + key;
    if (!value->is_array()) {
        check(*value, here);
        return;
    }
    for (std::size_t i = 0; i < value->size(); ++i) {
        check((*value)[i], pointer(here, i));
    }
}

/// Textures that a material, or an extension of it, names.
void checkTextureRefs(const Json& value, const Place* at, std::size_t textures,
                      GltfProblems& problems) {
    for (const auto& [key, entry] : value.items()) {
        const Place here{at, key};
        if (key == "extras" || !entry.is_object()) {
            continue;
        }
        const Json* index = member(entry, "index");
        if (key.ends_with("Texture") && index != nullptr && index->is_number_integer() &&
            !(index->is_number_unsigned() && index->get<std::uint64_t>() < textures)) {
            problems.repaired("index " + index->dump() + " points at nothing: there are " +
                                  std::to_string(textures) + " textures",
                              here.pointer() + "/index");
        }
        checkTextureRefs(entry, &here, textures, problems);
    }
}

void checkMaterials(const Json& document, GltfProblems& problems) {
    const std::size_t textures = memberSize(document, "textures");
    const double most = std::numeric_limits<double>::max();
    eachClean(document, "materials", problems, [&](const Json& material, const std::string& at) {
        const Place here{nullptr, std::string_view(at).substr(1)}; // without the slash
        checkTextureRefs(material, &here, textures, problems);
        inRange(material, "emissiveFactor", 0.0, 1.0, at, problems);
        inRange(material, "alphaCutoff", 0.0, most, at, problems);
        if (const Json* pbr = member(material, "pbrMetallicRoughness")) {
            for (const char* key : {"baseColorFactor", "metallicFactor", "roughnessFactor"}) {
                inRange(*pbr, key, 0.0, 1.0, at + "/pbrMetallicRoughness", problems);
            }
        }
        if (const Json* occlusion = member(material, "occlusionTexture")) {
            inRange(*occlusion, "strength", 0.0, 1.0, at + "/occlusionTexture", problems);
        }
        if (const Json* strength = extensionOf(material, "KHR_materials_emissive_strength")) {
            inRange(*strength, "emissiveStrength", 0.0, most,
                    at + "/extensions/KHR_materials_emissive_strength", problems);
        }
    });
}

void checkTexturesAndImages(const Json& document, GltfProblems& problems) {
    const std::size_t images = memberSize(document, "images");
    eachClean(document, "textures", problems, [&](const Json& texture, const std::string& at) {
        const Json* source = member(texture, "source");
        if (source != nullptr &&
            !(source->is_number_unsigned() && source->get<std::uint64_t>() < images)) {
            problems.repaired("index " + source->dump() + " points at nothing: there are " +
                                  std::to_string(images) + " images",
                              at + "/source");
        }
    });
    eachClean(document, "images", problems, [&](const Json& image, const std::string& at) {
        const bool view = image.contains("bufferView");
        if (view == image.contains("uri")) {
            problems.repaired("must have exactly one of uri and bufferView", at);
        }
        if (view && !image.contains("mimeType")) {
            problems.repaired("'mimeType' is missing beside bufferView", at);
        }
    });
}

/// The upper 3x3's columns at right angles, the last row 0 0 0 1.
bool isDecomposable(const Json& matrix) {
    const auto m = [&](std::size_t i) { return matrix[i].get<double>(); };
    if (m(3) != 0.0 || m(7) != 0.0 || m(11) != 0.0 || m(15) != 1.0) {
        return false;
    }
    for (std::size_t a = 0; a < 3; ++a) {
        const std::size_t b = (a + 1) % 3;
        double dot = 0.0;
        double lengthA = 0.0;
        double lengthB = 0.0;
        for (std::size_t r = 0; r < 3; ++r) {
            dot += m(4 * a + r) * m(4 * b + r);
            lengthA += m(4 * a + r) * m(4 * a + r);
            lengthB += m(4 * b + r) * m(4 * b + r);
        }
        // Single precision leaves rotations some 1e-6 off; exporters' text with 4 digits 1e-4.
        if (dot * dot > 1e-6 * lengthA * lengthB) {
            return false;
        }
    }
    return true;
}

void checkNodes(const Json& document, GltfProblems& problems) {
    eachClean(document, "nodes", problems, [&](const Json& node, const std::string& at) {
        const bool trs =
            node.contains("translation") || node.contains("rotation") || node.contains("scale");
        if (const Json* matrix = member(node, "matrix")) {
            if (trs) {
                problems.repaired("a matrix beside translation, rotation or scale: it alone counts",
                                  at + "/matrix");
            }
            if (!isDecomposable(*matrix)) {
                problems.repaired("matrix is not made of translation, rotation and scale",
                                  at + "/matrix");
            }
        }
        if (const Json* rotation = member(node, "rotation")) {
            double sum = 0.0;
            for (const Json& value : *rotation) {
                sum += value.get<double>() * value.get<double>();
            }
            if (!(std::abs(std::sqrt(sum) - 1.0) <= kUnitTolerance4)) {
                problems.repaired("rotation is not of unit length", at + "/rotation");
            }
        }
    });
}

void checkLights(const Json& document, GltfProblems& problems) {
    const std::string path = "/extensions/KHR_lights_punctual";
    const Json* punctual = extensionOf(document, "KHR_lights_punctual");
    if (punctual == nullptr || !problems.clean(path)) {
        return;
    }
    const double most = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < memberSize(*punctual, "lights"); ++i) {
        const Json& light = (*punctual)["lights"][i];
        const std::string at = pointer(path + "/lights", i);
        inRange(light, "color", 0.0, 1.0, at, problems);
        inRange(light, "intensity", 0.0, most, at, problems);
        inRange(light, "range", std::numeric_limits<double>::min(), most, at, problems);
        const Json* spot = member(light, "spot");
        if (light["type"] != "spot" || spot == nullptr) {
            if (light["type"] == "spot") {
                problems.repaired("'spot' is missing", at);
            }
            continue;
        }
        const double inner = spot->value("innerConeAngle", 0.0);
        const double outer = spot->value("outerConeAngle", std::numbers::pi / 4.0);
        inRange(*spot, "innerConeAngle", 0.0, std::numbers::pi / 2.0, at + "/spot", problems);
        // As a float, half of pi is larger than as a double.
        inRange(*spot, "outerConeAngle", std::numeric_limits<double>::min(),
                std::numbers::pi_v<float> / 2.0f, at + "/spot", problems);
        if (!(outer > inner)) {
            problems.repaired("outerConeAngle must be larger than innerConeAngle",
                              at + "/spot/outerConeAngle");
        }
    }
}

void checkBufferUris(const Json& document, GltfProblems& problems) {
    eachClean(document, "buffers", problems, [&](const Json& buffer, const std::string& at) {
        const Json* uri = member(buffer, "uri");
        const std::string text = uri == nullptr ? std::string() : uri->get<std::string>();
        if (text.starts_with("data:") && !text.starts_with("data:application/octet-stream") &&
            !text.starts_with("data:application/gltf-buffer")) {
            problems.repaired("data: URI of a buffer must be application/octet-stream or "
                              "application/gltf-buffer",
                              at + "/uri");
        }
    });
}

} // namespace

void checkRules(const Json& document, const std::vector<Bytes>& buffers, GltfProblems& problems) {
    checkEverywhere(document, nullptr, namesIn(document, "extensionsUsed"), problems);
    for (const auto check : {checkDocument, checkMaterials, checkTexturesAndImages, checkNodes,
                             checkLights, checkBufferUris, checkMeshRules}) {
        check(document, problems);
    }
    checkDataRules(document, buffers, problems);
}

} // namespace lodestar::io::detail

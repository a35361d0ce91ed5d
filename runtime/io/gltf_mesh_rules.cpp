// SPDX-License-Identifier: MIT
//
// Rules on what primitives use: names, formats, alignment, bounds; and on views by their use.
// Source: glTF 2.0 specification, sections 3.6.2.4 and 3.7.2.
#include <algorithm>
#include <array>
#include <map>
#include <string_view>

#include "io/gltf_rules.h"

namespace lodestar::io::detail {
namespace {

/// What an attribute may be stored as; integers are normalised unless they are joints.
struct Format {
    std::string_view name; ///< without the number of the set
    std::string_view types;
    std::string_view componentTypes;
};

constexpr std::array<Format, 7> kFormats{{{"POSITION", "VEC3", "5126"},
                                          {"NORMAL", "VEC3", "5126"},
                                          {"TANGENT", "VEC4", "5126"},
                                          {"TEXCOORD", "VEC2", "5126 5121 5123"},
                                          {"COLOR", "VEC3 VEC4", "5126 5121 5123"},
                                          {"JOINTS", "VEC4", "5121 5123"},
                                          {"WEIGHTS", "VEC4", "5126 5121 5123"}}};

enum class Use { Vertices, Indices, Image, Matrices, Animation, Sparse };

class MeshRules {
public:
    MeshRules(const Json& document, GltfProblems& problems)
        : document_(document), problems_(problems) {
        for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
            for (std::size_t i = 0; i < memberSize(document, list); ++i) {
                quantized_ = quantized_ || document[list][i] == "KHR_mesh_quantization";
            }
        }
    }

    void check() {
        eachClean(document_, "meshes", problems_, [&](const Json& mesh, const std::string& at) {
            const Json& primitives = mesh["primitives"];
            for (std::size_t p = 0; p < primitives.size(); ++p) {
                checkPrimitive(primitives[p], pointer(at + "/primitives", p));
            }
        });
        eachClean(
            document_, "accessors", problems_,
            [&](const Json& accessor, const std::string& at) { checkAccessor(accessor, at); });
        noteOtherUses();
        checkViews();
    }

private:
    const Json* accessorOf(const Json& index) const {
        const std::string at = pointer("/accessors", index.get<std::size_t>());
        return problems_.clean(at) ? &document_["accessors"][index.get<std::size_t>()] : nullptr;
    }

    void checkPrimitive(const Json& primitive, const std::string& at) {
        std::map<std::string, std::size_t> sets;
        for (const auto& [name, index] : primitive["attributes"].items()) {
            const std::string here = at + "/attributes/" + name;
            const std::size_t bar = name.find('_');
            if (bar != 0) {
                ++sets[name.substr(0, bar)];
                checkAttribute(name, index, here);
            }
            if (const Json* accessor = accessorOf(index)) {
                checkAlignment(*accessor, here);
                use(*accessor, Use::Vertices, index, here);
            }
        }
        for (const auto& [name, count] : sets) {
            for (std::size_t set = 0; set < count; ++set) {
                const bool numbered =
                    name == "TEXCOORD" || name == "COLOR" || name == "JOINTS" || name == "WEIGHTS";
                if (numbered &&
                    !primitive["attributes"].contains(name + "_" + std::to_string(set))) {
                    problems_.repaired(name + " sets must be numbered from 0 without a gap",
                                       at + "/attributes");
                    break;
                }
            }
        }
        checkInfluenceSets(primitive["attributes"], sets, at);
        checkTexCoords(primitive, sets["TEXCOORD"], at);
        if (const Json* index = member(primitive, "indices")) {
            if (const Json* accessor = accessorOf(*index)) {
                use(*accessor, Use::Indices, *index, at + "/indices");
            }
        }
        checkTargets(primitive, at);
    }

    /// JOINTS without WEIGHTS among the first sets are refused in loading.
    void checkInfluenceSets(const Json& attributes, std::map<std::string, std::size_t>& sets,
                            const std::string& at) {
        for (std::size_t set = 0; set < kInfluenceSets; ++set) {
            std::size_t found = 0;
            for (const char* name : {"JOINTS", "WEIGHTS"}) {
                const bool has =
                    attributes.contains(std::string(name).append("_").append(std::to_string(set)));
                sets[name] -= has ? 1U : 0U;
                found += has ? 1U : 0U;
            }
            if (found == 0) {
                break; // nor are later ones looked at
            }
        }
        if (sets["JOINTS"] != sets["WEIGHTS"]) {
            problems_.repaired("must have as many sets of JOINTS as of WEIGHTS",
                               at + "/attributes");
        }
    }

    void checkAttribute(const std::string& name, const Json& index, const std::string& here) {
        const std::size_t bar = name.find('_');
        const std::string base = name.substr(0, bar);
        const auto* format = std::find_if(kFormats.begin(), kFormats.end(),
                                          [&](const Format& f) { return f.name == base; });
        const bool digits = bar != std::string::npos && bar + 1 < name.size() &&
                            name.find_first_not_of("0123456789", bar + 1) == std::string::npos;
        const bool numbered = format >= kFormats.begin() + 3;
        if (format == kFormats.end() || (numbered ? !digits : bar != std::string::npos)) {
            problems_.repaired("is no attribute of the standard, and has no leading underscore",
                               here);
            return;
        }
        const Json* accessor = accessorOf(index);
        if (accessor == nullptr) {
            return;
        }
        const int componentType = (*accessor)["componentType"].get<int>();
        const bool mayQuantize = quantized_ && format < kFormats.begin() + 4;
        const bool goodType =
            format->types.find((*accessor)["type"].get<std::string>()) != std::string_view::npos;
        const bool goodComponent =
            mayQuantize
                ? componentType != 5125
                : format->componentTypes.find(std::to_string(componentType)) != std::string::npos;
        const bool wantsNormalized = !mayQuantize && componentType != 5126 && base != "JOINTS";
        if (!goodType || !goodComponent ||
            (wantsNormalized && !accessor->value("normalized", false))) {
            problems_.repaired("accessor's format is none that the standard has for " + base, here);
        }
        if (base == "POSITION" && !(accessor->contains("min") && accessor->contains("max"))) {
            problems_.repaired("accessor of POSITION must have min and max", here);
        }
    }

    void checkAlignment(const Json& accessor, const std::string& here) {
        const Json* index = member(accessor, "bufferView");
        ElementLayout layout;
        static_cast<void>(elementLayout(accessor["componentType"].get<int>(),
                                        accessor["type"].get<std::string>(), layout));
        const bool stride =
            index != nullptr &&
            document_["bufferViews"][index->get<std::size_t>()].contains("byteStride");
        if (accessor.value("byteOffset", std::size_t{0}) % 4 != 0 ||
            (index != nullptr && !stride && layout.bytes % 4 != 0)) {
            problems_.repaired("vertex data must be aligned to 4 bytes", here);
        }
    }

    /// Sets of texture coordinates that the material names.
    void checkTexCoords(const Json& primitive, std::size_t sets, const std::string& at) {
        const Json* index = member(primitive, "material");
        if (index == nullptr ||
            !problems_.clean(pointer("/materials", index->get<std::size_t>()))) {
            return;
        }
        const Json& material = document_["materials"][index->get<std::size_t>()];
        std::size_t needed = 0;
        const auto look = [&](const Json& object, const char* key) {
            const Json* info = member(object, key);
            if (info == nullptr || !info->is_object()) {
                return;
            }
            const Json* transform = extensionOf(*info, "KHR_texture_transform");
            const Json* set = transform == nullptr ? nullptr : member(*transform, "texCoord");
            set = set == nullptr ? member(*info, "texCoord") : set;
            // What is no index is refused with its material.
            const bool given = set != nullptr && set->is_number_unsigned() &&
                               set->get<std::uint64_t>() < 0x7fffffff;
            needed = std::max(needed, 1 + (given ? set->get<std::size_t>() : 0));
        };
        for (const char* key : {"normalTexture", "occlusionTexture", "emissiveTexture"}) {
            look(material, key);
        }
        if (const Json* pbr = member(material, "pbrMetallicRoughness")) {
            look(*pbr, "baseColorTexture");
            look(*pbr, "metallicRoughnessTexture");
        }
        if (const Json* specular = extensionOf(material, "KHR_materials_specular")) {
            look(*specular, "specularTexture");
            look(*specular, "specularColorTexture");
        }
        const Json* extras = member(material, "extras");
        if (const Json* own = extras == nullptr ? nullptr : member(*extras, "lodestar")) {
            look(*own, "exponentTexture");
        }
        if (needed > sets) {
            problems_.repaired("material needs TEXCOORD_" + std::to_string(needed - 1) +
                                   ", which the primitive lacks",
                               at + "/material");
        }
    }

    /// Whether loading reads an attribute of a target, and refuses another count.
    static bool isDelta(const std::string& name) {
        return name == "POSITION" || name == "NORMAL" || name == "TANGENT";
    }

    void checkTargets(const Json& primitive, const std::string& at) {
        for (std::size_t t = 0; t < memberSize(primitive, "targets"); ++t) {
            for (const auto& [name, index] : primitive["targets"][t].items()) {
                const std::string here = pointer(at + "/targets", t) + "/" + name;
                const Json* base = member(primitive["attributes"], name.c_str());
                const Json* accessor = accessorOf(index);
                const Json* baseAccessor = base == nullptr ? nullptr : accessorOf(*base);
                if (base == nullptr) {
                    problems_.repaired("the primitive itself has no " + name, here);
                } else if (accessor != nullptr && baseAccessor != nullptr && !isDelta(name) &&
                           (*accessor)["count"] != (*baseAccessor)["count"]) {
                    problems_.repaired("has another count than the primitive's " + name, here);
                }
                if (accessor != nullptr) {
                    use(*accessor, Use::Vertices, index, here);
                }
            }
        }
    }

    void checkAccessor(const Json& accessor, const std::string& at) {
        const int componentType = accessor["componentType"].get<int>();
        const std::string type = accessor["type"].get<std::string>();
        ElementLayout layout;
        static_cast<void>(elementLayout(componentType, type, layout));
        if (accessor.value("normalized", false) && componentType >= 5125) {
            problems_.repaired("only bytes and shorts can be normalised", at + "/normalized");
        }
        const Json* index = member(accessor, "bufferView");
        if (index == nullptr) {
            return;
        }
        const Json& view = document_["bufferViews"][index->get<std::size_t>()];
        const auto offset = accessor.value("byteOffset", std::size_t{0});
        const std::size_t unit = layout.componentBytes;
        if (offset % unit != 0 || (view.value("byteOffset", std::size_t{0}) + offset) % unit != 0) {
            problems_.repaired("data are not aligned to their " + std::to_string(unit) + " bytes",
                               at + "/byteOffset");
        } else if (type.starts_with("MAT") && offset % 4 != 0) {
            problems_.repaired("matrices must be aligned to 4 bytes", at + "/byteOffset");
        }
    }

    void use(const Json& part, Use use, const Json& accessor, const std::string& at) {
        const Json* view = member(part, "bufferView");
        if (view == nullptr) {
            return;
        }
        Views& uses = views_[view->get<std::size_t>()];
        if (uses.empty() || std::none_of(uses.begin(), uses.end(), [&](const ViewUse& u) {
                return u.use == use && u.accessor == accessor;
            })) {
            // More than a few uses of one view say nothing new, but would cost time squared.
            if (uses.size() < kMaxUses) {
                uses.push_back({use, accessor, at});
            }
        }
    }

    void noteOtherUses() {
        eachClean(document_, "images", problems_, [&](const Json& image, const std::string& at) {
            use(image, Use::Image, at, at + "/bufferView");
        });
        eachClean(document_, "skins", problems_, [&](const Json& skin, const std::string& at) {
            if (const Json* index = member(skin, "inverseBindMatrices")) {
                if (const Json* accessor = accessorOf(*index)) {
                    use(*accessor, Use::Matrices, *index, at + "/inverseBindMatrices");
                }
            }
        });
        eachClean(document_, "animations", problems_, [&](const Json& one, const std::string& at) {
            for (std::size_t s = 0; s < one["samplers"].size(); ++s) {
                for (const char* key : {"input", "output"}) {
                    const Json& index = one["samplers"][s][key];
                    if (const Json* accessor = accessorOf(index)) {
                        use(*accessor, Use::Animation, index,
                            pointer(at + "/samplers", s) + "/" + key);
                    }
                }
            }
        });
        eachAccessor([&](const Json& accessor, const std::string& at) {
            for (const char* part : {"indices", "values"}) {
                if (const Json* sparse = member(accessor, "sparse")) {
                    use((*sparse)[part], Use::Sparse, at, at + "/sparse/" + part + "/bufferView");
                }
            }
        });
    }

    template <class Act>
    void eachAccessor(Act act) {
        // Refused ones too, as long as their sparse parts are in shape.
        for (std::size_t i = 0; i < memberSize(document_, "accessors"); ++i) {
            const std::string at = pointer("/accessors", i);
            const Json& accessor = document_["accessors"][i];
            const Json* sparse = member(accessor, "sparse");
            bool shaped = sparse != nullptr;
            for (const char* part : {"indices", "values"}) {
                const Json* found = shaped ? member(*sparse, part) : nullptr;
                const Json* view = found == nullptr ? nullptr : member(*found, "bufferView");
                shaped = view != nullptr && view->is_number_unsigned() &&
                         view->get<std::uint64_t>() < memberSize(document_, "bufferViews");
            }
            if (shaped) {
                act(accessor, at);
            }
        }
    }

    void checkViews() {
        for (const auto& [index, uses] : views_) {
            const std::string at = pointer("/bufferViews", index);
            if (!problems_.clean(at)) {
                continue;
            }
            const Json& view = document_["bufferViews"][index];
            const bool stride = view.contains("byteStride");
            const int target = view.value("target", 0);
            std::size_t vertexAccessors = 0;
            for (const ViewUse& one : uses) {
                const bool vertices = one.use == Use::Vertices;
                vertexAccessors += vertices ? 1U : 0U;
                const int wanted = vertices ? 34962 : (one.use == Use::Indices ? 34963 : 0);
                if (stride && !vertices) {
                    problems_.repaired("buffer view must have no byteStride: it holds no vertices",
                                       one.at);
                }
                if ((target != 0 && target != wanted) || one.use != uses.front().use) {
                    problems_.repaired("buffer view has another target or use", one.at);
                }
            }
            if (vertexAccessors > 1 && !stride) {
                problems_.repaired("buffer view of several vertex accessors must have a byteStride",
                                   at);
            }
        }
        eachClean(
            document_, "bufferViews", problems_, [&](const Json& view, const std::string& at) {
                if (view.contains("byteStride") && view["byteStride"] > view["byteLength"]) {
                    problems_.repaired("byteStride is larger than byteLength", at + "/byteStride");
                }
            });
    }

    struct ViewUse {
        Use use;
        Json accessor;
        std::string at;
    };
    using Views = std::vector<ViewUse>;
    static constexpr std::size_t kMaxUses = 64;

    const Json& document_;
    GltfProblems& problems_;
    bool quantized_ = false;
    std::map<std::size_t, Views> views_;
};

} // namespace

void checkMeshRules(const Json& document, GltfProblems& problems) {
    MeshRules(document, problems).check();
}

} // namespace lodestar::io::detail

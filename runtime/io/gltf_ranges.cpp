// SPDX-License-Identifier: MIT
//
// Version, extensions, and whether views and accessors lie inside their data. Sums are never
// formed: what is left is divided, so that nothing wraps. Source: glTF 2.0 specification,
// section 3.6.
#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include "io/gltf_internal.h"

namespace lodestar::io {
namespace {

constexpr std::array<std::string_view, 8> kSupportedExtensions{
    "EXT_lights_image_based", "KHR_lights_punctual",    "KHR_materials_emissive_strength",
    "KHR_materials_ior",      "KHR_materials_specular", "KHR_materials_unlit",
    "KHR_mesh_quantization",  "KHR_texture_transform"};

} // namespace

bool isSupportedExtension(std::string_view name) {
    return std::find(kSupportedExtensions.begin(), kSupportedExtensions.end(), name) !=
           kSupportedExtensions.end();
}

namespace detail {
namespace {

/// "2.1" as {2, 1}; false where it is no such text.
bool parseVersion(const std::string& text, int& major, int& minor) {
    const char* end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, major);
    if (first.ec != std::errc() || first.ptr == end || *first.ptr != '.') {
        return false;
    }
    const auto second = std::from_chars(first.ptr + 1, end, minor);
    return second.ec == std::errc() && second.ptr == end && major >= 0 && minor >= 0;
}

std::size_t sizeMember(const Json& object, const char* key) {
    const Json* found = member(object, key);
    return found == nullptr ? 0 : found->get<std::size_t>();
}

/// Bytes of a view's content, or of what is left of it behind an offset.
bool remaining(std::size_t whole, std::size_t offset, std::size_t& left) {
    if (offset > whole) {
        return false;
    }
    left = whole - offset;
    return true;
}

/// Whether `count` elements of `bytes`, `stride` apart, fit into `available`. @pre count, stride >=
/// 1
bool fits(std::size_t count, std::size_t stride, std::size_t bytes, std::size_t available) {
    return bytes <= available && count - 1 <= (available - bytes) / stride;
}

void checkView(const Json& view, const std::vector<Bytes>& buffers, const std::string& at,
               GltfProblems& problems) {
    std::size_t left = 0;
    const Bytes& buffer = buffers[view["buffer"].get<std::size_t>()];
    if (!remaining(buffer.size(), sizeMember(view, "byteOffset"), left) ||
        sizeMember(view, "byteLength") > left) {
        problems.refuse("buffer view ends behind its buffer of " + std::to_string(buffer.size()) +
                            " bytes",
                        at + "/byteLength");
    }
    const std::size_t stride = sizeMember(view, "byteStride");
    if (stride % 4 != 0) {
        problems.refuse("byteStride " + std::to_string(stride) + " is no multiple of 4",
                        at + "/byteStride");
    }
}

/// Accessors beside their views.
class AccessorRanges {
public:
    AccessorRanges(const Json& document, GltfProblems& problems)
        : document_(document), problems_(problems) {}

    void check(std::size_t index) {
        const Json& accessor = document_["accessors"][index];
        const std::string at = pointer("/accessors", index);
        ElementLayout layout;
        const int componentType = accessor["componentType"].get<int>();
        const std::string type = accessor["type"].get<std::string>();
        if (!elementLayout(5126, type, layout)) {
            problems_.refuse("accessor type '" + type.substr(0, 32) + "' does not exist",
                             at + "/type");
            return;
        }
        if (!elementLayout(componentType, type, layout)) {
            problems_.refuse("componentType " + std::to_string(componentType) +
                                 " is none of 5120, 5121, 5122, 5123, 5125, 5126",
                             at + "/componentType");
            return;
        }
        const std::size_t count = sizeMember(accessor, "count");
        if (member(accessor, "bufferView") == nullptr && count > kMaxZeroElements) {
            problems_.refuse("accessor without data of " + std::to_string(count) +
                                 " elements; the limit is " + std::to_string(kMaxZeroElements),
                             at + "/count");
        }
        if (const Json* view = viewOf(accessor, at)) {
            checkInView(accessor, *view, layout, at);
        }
        if (member(accessor, "sparse") != nullptr) {
            checkSparse(accessor, layout, at);
        }
    }

private:
    /// The view that a part names; null where it names none or one that was refused.
    const Json* viewOf(const Json& part, const std::string& at) {
        const Json* index = member(part, "bufferView");
        if (index == nullptr) {
            return nullptr;
        }
        const auto i = index->get<std::size_t>();
        if (!problems_.clean(pointer("/bufferViews", i))) {
            problems_.taint(at);
            return nullptr;
        }
        return &document_["bufferViews"][i];
    }

    void checkInView(const Json& accessor, const Json& view, const ElementLayout& layout,
                     const std::string& at) {
        const std::size_t given = sizeMember(view, "byteStride");
        const std::size_t count = sizeMember(accessor, "count");
        if (given != 0 && given < layout.bytes) {
            problems_.refuse("elements of " + std::to_string(layout.bytes) +
                                 " bytes do not fit a byteStride of " + std::to_string(given),
                             at);
        }
        std::size_t left = 0;
        if (!remaining(sizeMember(view, "byteLength"), sizeMember(accessor, "byteOffset"), left) ||
            !fits(count, given == 0 ? layout.bytes : given, layout.bytes, left)) {
            problems_.refuse(std::to_string(count) + " elements end behind their buffer view",
                             at + "/count");
        }
    }

    void checkSparse(const Json& accessor, const ElementLayout& layout, const std::string& at) {
        const Json& sparse = accessor["sparse"];
        const std::size_t count = sizeMember(sparse, "count");
        if (count > sizeMember(accessor, "count")) {
            problems_.refuse("more sparse values than the accessor has elements",
                             at + "/sparse/count");
        }
        const int indexType = sparse["indices"]["componentType"].get<int>();
        ElementLayout index;
        if ((indexType != 5121 && indexType != 5123 && indexType != 5125) ||
            !elementLayout(indexType, "SCALAR", index)) {
            problems_.refuse("componentType " + std::to_string(indexType) +
                                 " is no unsigned integer (5121, 5123, 5125)",
                             at + "/sparse/indices/componentType");
            return;
        }
        for (const char* part : {"indices", "values"}) {
            const Json* view = viewOf(sparse[part], at);
            const std::size_t bytes =
                part == std::string_view("indices") ? index.bytes : layout.bytes;
            std::size_t left = 0;
            if (view != nullptr && !(remaining(sizeMember(*view, "byteLength"),
                                               sizeMember(sparse[part], "byteOffset"), left) &&
                                     fits(count, bytes, bytes, left))) {
                problems_.refuse(std::string("sparse ") + part + " end behind their buffer view",
                                 at + "/sparse/" + part);
            }
        }
    }

    const Json& document_;
    GltfProblems& problems_;
};

} // namespace

void checkRequired(const Json& document, GltfProblems& problems) {
    for (std::size_t i = 0; i < memberSize(document, "extensionsRequired"); ++i) {
        const Json& name = document["extensionsRequired"][i];
        if (name.is_string() && !isSupportedExtension(name.get<std::string>())) {
            problems.refuse("requires the extension " + name.get<std::string>().substr(0, 128) +
                                ", which is not read",
                            pointer("/extensionsRequired", i));
        }
    }
}

core::Result<void> checkAsset(const Json& document) {
    const Json* asset = member(document, "asset");
    const Json* version = asset == nullptr ? nullptr : member(*asset, "version");
    if (version == nullptr || !version->is_string()) {
        return core::refused("is not glTF 2: asset.version is missing", "/asset/version");
    }
    int major = 0;
    int minor = 0;
    if (!parseVersion(version->get<std::string>(), major, minor) || major != 2) {
        return core::refused("glTF version '" + version->get<std::string>().substr(0, 32) +
                                 "'; 2.x is read",
                             "/asset/version");
    }
    if (const Json* least = member(*asset, "minVersion"); least != nullptr) {
        if (!least->is_string() || !parseVersion(least->get<std::string>(), major, minor) ||
            major != 2 || minor != 0) {
            return core::refused("minVersion is " + least->dump().substr(0, 32) +
                                     "; version 2.0 is read",
                                 "/asset/minVersion");
        }
    }
    return {};
}

bool elementLayout(int componentType, const std::string& type, ElementLayout& layout) {
    switch (componentType) {
    case 5120:
    case 5121:
        layout.componentBytes = 1;
        break;
    case 5122:
    case 5123:
        layout.componentBytes = 2;
        break;
    case 5125:
    case 5126:
        layout.componentBytes = 4;
        break;
    default:
        return false;
    }
    constexpr std::array<std::pair<std::string_view, std::size_t>, 7> kTypes{{{"SCALAR", 1},
                                                                              {"VEC2", 2},
                                                                              {"VEC3", 3},
                                                                              {"VEC4", 4},
                                                                              {"MAT2", 4},
                                                                              {"MAT3", 9},
                                                                              {"MAT4", 16}}};
    const auto found = std::find_if(kTypes.begin(), kTypes.end(),
                                    [&](const auto& entry) { return entry.first == type; });
    if (found == kTypes.end()) {
        return false;
    }
    layout.components = found->second;
    layout.bytes = layout.components * layout.componentBytes;
    // Columns of a matrix begin at multiples of 4 bytes.
    if (type == "MAT2" || type == "MAT3") {
        const std::size_t rows = type == "MAT2" ? 2 : 3;
        layout.bytes = rows * ((rows * layout.componentBytes + 3) / 4 * 4);
    }
    return true;
}

void checkRanges(const Json& document, const std::vector<Bytes>& buffers, GltfProblems& problems) {
    for (std::size_t i = 0; i < memberSize(document, "bufferViews"); ++i) {
        const std::string at = pointer("/bufferViews", i);
        if (!problems.clean(at)) {
            continue;
        }
        const Json& view = document["bufferViews"][i];
        if (problems.clean(pointer("/buffers", view["buffer"].get<std::size_t>()))) {
            checkView(view, buffers, at, problems);
        } else {
            problems.taint(at);
        }
    }
    AccessorRanges accessors(document, problems);
    for (std::size_t i = 0; i < memberSize(document, "accessors"); ++i) {
        if (problems.clean(pointer("/accessors", i))) {
            accessors.check(i);
        }
    }
}

} // namespace detail
} // namespace lodestar::io

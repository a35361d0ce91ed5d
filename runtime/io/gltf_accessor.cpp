// SPDX-License-Identifier: MIT
//
// Accessors as numbers. Ranges were checked by checkRanges; sparse indices are data and are checked
// here. Source: glTF 2.0 specification, sections 3.6.2 and 3.11 (normalised integers).
#include <algorithm>
#include <cstring>

#include "io/gltf_internal.h"

namespace lodestar::io::detail {
namespace {

const unsigned char* dataOf(const tinygltf::Model& model, int view, std::size_t offset) {
    const tinygltf::BufferView& bufferView = model.bufferViews[static_cast<std::size_t>(view)];
    const Bytes& buffer = model.buffers[static_cast<std::size_t>(bufferView.buffer)].data;
    return buffer.data() + bufferView.byteOffset + offset;
}

template <class T>
T load(const unsigned char* from) {
    T value;
    std::memcpy(&value, from, sizeof value);
    return value;
}

/// One component; normalised signed integers are max(c / max, -1) [glTF 2.0, 3.11].
float component(const unsigned char* from, int type, bool normalized) {
    switch (type) {
    case 5120: {
        const auto value = static_cast<float>(load<std::int8_t>(from));
        return normalized ? std::max(value / 127.0f, -1.0f) : value;
    }
    case 5121: {
        const auto value = static_cast<float>(load<std::uint8_t>(from));
        return normalized ? value / 255.0f : value;
    }
    case 5122: {
        const auto value = static_cast<float>(load<std::int16_t>(from));
        return normalized ? std::max(value / 32767.0f, -1.0f) : value;
    }
    case 5123: {
        const auto value = static_cast<float>(load<std::uint16_t>(from));
        return normalized ? value / 65535.0f : value;
    }
    case 5125: {
        const auto value = load<std::uint32_t>(from);
        return normalized ? static_cast<float>(value / 4294967295.0) : static_cast<float>(value);
    }
    default:
        return load<float>(from);
    }
}

std::uint32_t integer(const unsigned char* from, int type) {
    return type == 5121 ? load<std::uint8_t>(from)
                        : (type == 5123 ? load<std::uint16_t>(from) : load<std::uint32_t>(from));
}

std::string typeName(int type) {
    switch (type) {
    case TINYGLTF_TYPE_SCALAR:
        return "SCALAR";
    case TINYGLTF_TYPE_VEC2:
        return "VEC2";
    case TINYGLTF_TYPE_VEC3:
        return "VEC3";
    case TINYGLTF_TYPE_VEC4:
        return "VEC4";
    case TINYGLTF_TYPE_MAT2:
        return "MAT2";
    case TINYGLTF_TYPE_MAT3:
        return "MAT3";
    default:
        return "MAT4";
    }
}

core::Error geometryLimit(const std::string& at) {
    return core::refused(
        "geometry decodes to more than " + std::to_string(kMaxGeometryBytes >> 20) + " MiB", at);
}

/// Calls take(element, bytes) for every element with data, plain ones first, then sparse ones.
template <class Take>
core::Result<void> visit(const tinygltf::Model& model, const tinygltf::Accessor& accessor,
                         const ElementLayout& layout, const std::string& at, Take take) {
    if (accessor.bufferView >= 0) {
        const std::size_t given =
            model.bufferViews[static_cast<std::size_t>(accessor.bufferView)].byteStride;
        const std::size_t stride = given == 0 ? layout.bytes : given;
        const unsigned char* from = dataOf(model, accessor.bufferView, accessor.byteOffset);
        for (std::size_t i = 0; i < accessor.count; ++i) {
            take(i, from + i * stride);
        }
    }
    if (!accessor.sparse.isSparse) {
        return {};
    }
    const auto& sparse = accessor.sparse;
    ElementLayout index;
    static_cast<void>(elementLayout(sparse.indices.componentType, "SCALAR", index));
    const unsigned char* indices = dataOf(model, sparse.indices.bufferView,
                                          static_cast<std::size_t>(sparse.indices.byteOffset));
    const unsigned char* values =
        dataOf(model, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset));
    for (std::size_t i = 0; i < static_cast<std::size_t>(sparse.count); ++i) {
        const std::uint32_t element =
            integer(indices + i * index.bytes, sparse.indices.componentType);
        if (element >= accessor.count) {
            return core::refused("sparse index " + std::to_string(element) + " is not below the " +
                                     std::to_string(accessor.count) + " elements",
                                 at + "/sparse/indices");
        }
        take(element, values + i * layout.bytes);
    }
    return {};
}

} // namespace

core::Result<std::vector<float>> readFloats(GltfContext& context, int index, bool forceNormalized) {
    const tinygltf::Accessor& accessor = context.model.accessors[static_cast<std::size_t>(index)];
    const std::string at = pointer("/accessors", static_cast<std::size_t>(index));
    ElementLayout layout;
    static_cast<void>(elementLayout(accessor.componentType, typeName(accessor.type), layout));
    if (!context.geometry.spend(accessor.count * layout.components * sizeof(float))) {
        return geometryLimit(at);
    }
    const bool normalized = accessor.normalized || forceNormalized;
    std::vector<float> values(accessor.count * layout.components);
    core::Result<void> visited = visit(
        context.model, accessor, layout, at, [&](std::size_t element, const unsigned char* from) {
            for (std::size_t c = 0; c < layout.components; ++c) {
                values[element * layout.components + c] =
                    component(from + c * layout.componentBytes, accessor.componentType, normalized);
            }
        });
    if (!visited) {
        return visited.error();
    }
    return values;
}

core::Result<std::vector<std::uint32_t>> readIndices(GltfContext& context, int index) {
    const tinygltf::Accessor& accessor = context.model.accessors[static_cast<std::size_t>(index)];
    const std::string at = pointer("/accessors", static_cast<std::size_t>(index));
    const int type = accessor.componentType;
    if (accessor.type != TINYGLTF_TYPE_SCALAR || (type != 5121 && type != 5123 && type != 5125)) {
        return core::refused("indices must be SCALAR of unsigned integers (5121, 5123, 5125)", at);
    }
    ElementLayout layout;
    static_cast<void>(elementLayout(type, "SCALAR", layout));
    if (!context.geometry.spend(accessor.count * sizeof(std::uint32_t))) {
        return geometryLimit(at);
    }
    std::vector<std::uint32_t> values(accessor.count);
    core::Result<void> visited = visit(context.model, accessor, layout, at,
                                       [&](std::size_t element, const unsigned char* from) {
                                           values[element] = integer(from, type);
                                       });
    if (!visited) {
        return visited.error();
    }
    return values;
}

} // namespace lodestar::io::detail

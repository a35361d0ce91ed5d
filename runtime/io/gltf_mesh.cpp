// SPDX-License-Identifier: MIT
//
// Primitives from accessors, everything finite and every index in range.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "io/gltf_internal.h"

namespace lodestar::io::detail {
namespace {

constexpr std::size_t kBytesPerFlatVertex =
    2 * sizeof(glm::vec3) + 2 * sizeof(glm::vec2) + sizeof(glm::vec4) + sizeof(std::uint32_t) +
    kInfluenceSets * (sizeof(glm::u16vec4) + sizeof(glm::vec4));

/// One primitive on its way.
class PrimitiveReader {
public:
    PrimitiveReader(GltfContext& context, const tinygltf::Primitive& source, const Json& json,
                    std::string at)
        : context_(context), source_(source), json_(json), at_(std::move(at)) {}

    /// False in the value: the primitive holds nothing to draw and is left out.
    core::Result<bool> read(GltfPrimitive& primitive) {
        core::Result<void> known = refuseCompressed();
        if (!known) {
            return known.error();
        }
        if (!source_.attributes.contains("POSITION")) {
            context_.file.warnings.add("primitive without POSITION, left out");
            return false;
        }
        primitive.material = source_.material;
        for (const auto step : {&PrimitiveReader::readPositions, &PrimitiveReader::readNormals,
                                &PrimitiveReader::readTangents, &PrimitiveReader::readUvs,
                                &PrimitiveReader::readColors, &PrimitiveReader::readDeformation,
                                &PrimitiveReader::readTopology, &PrimitiveReader::finish}) {
            core::Result<void> done = (this->*step)(primitive);
            if (!done) {
                return done.error();
            }
        }
        return !primitive.indices.empty();
    }

private:
    /// Data that live only in an extension that is not read: the plain accessor says zeros.
    core::Result<void> refuseCompressed() const {
        const Json* extensions = member(json_, "extensions");
        const auto position = source_.attributes.find("POSITION");
        if (extensions == nullptr || !extensions->is_object()) {
            return {};
        }
        const bool empty =
            position == source_.attributes.end() || (accessorOf(position->second).bufferView < 0 &&
                                                     !accessorOf(position->second).sparse.isSparse);
        for (const auto& [name, value] : extensions->items()) {
            if (empty && !isSupportedExtension(name)) {
                return core::refused("primitive's data lie only in the extension " +
                                         name.substr(0, 128) + ", which is not read",
                                     at_ + "/extensions");
            }
        }
        return {};
    }

    [[nodiscard]] const tinygltf::Accessor& accessorOf(int index) const {
        return context_.model.accessors[static_cast<std::size_t>(index)];
    }

    /// Values of an attribute; empty where the primitive lacks it.
    /// @param type, otherType the accessor types allowed
    core::Result<std::vector<float>> attribute(const char* name, int type, int otherType,
                                               bool forceNormalized = false) {
        const auto found = source_.attributes.find(name);
        if (found == source_.attributes.end()) {
            return std::vector<float>();
        }
        const tinygltf::Accessor& accessor = accessorOf(found->second);
        const std::string at = at_ + "/attributes/" + name;
        if (accessor.type != type && accessor.type != otherType) {
            return core::refused(std::string(name) + " has an accessor of the wrong type", at);
        }
        if (vertexCount_ != 0 && accessor.count != vertexCount_) {
            return core::refused(std::string(name) + " has " + std::to_string(accessor.count) +
                                     " elements, POSITION has " + std::to_string(vertexCount_),
                                 at);
        }
        if (core::Result<void> allowed = checkComponents(context_, name, accessor, at, false);
            !allowed) {
            return allowed.error();
        }
        vertexCount_ = accessor.count;
        return readFloats(context_, found->second, forceNormalized);
    }

    core::Result<void> readPositions(GltfPrimitive& primitive) {
        core::Result<std::vector<float>> values =
            attribute("POSITION", TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC3);
        if (!values) {
            return values.error();
        }
        primitive.positions.resize(vertexCount_);
        badPosition_.resize(vertexCount_);
        for (std::size_t i = 0; i < vertexCount_; ++i) {
            const float* v = values->data() + 3 * i;
            const bool good = std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
            badPosition_[i] = !good;
            primitive.positions[i] = good ? glm::vec3(v[0], v[1], v[2]) : glm::vec3(0.0f);
        }
        return {};
    }

    core::Result<void> readNormals(GltfPrimitive& primitive) {
        core::Result<std::vector<float>> values =
            attribute("NORMAL", TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC3);
        if (!values) {
            return values.error();
        }
        primitive.normals.reserve(values->size() / 3);
        for (std::size_t i = 0; i < values->size(); i += 3) {
            primitive.normals.emplace_back((*values)[i], (*values)[i + 1], (*values)[i + 2]);
        }
        return {};
    }

    core::Result<void> readTangents(GltfPrimitive& primitive) {
        core::Result<std::vector<float>> values =
            attribute("TANGENT", TINYGLTF_TYPE_VEC4, TINYGLTF_TYPE_VEC4);
        if (!values) {
            return values.error();
        }
        primitive.tangents.reserve(values->size() / 4);
        for (std::size_t i = 0; i < values->size(); i += 4) {
            primitive.tangents.emplace_back((*values)[i], (*values)[i + 1], (*values)[i + 2],
                                            (*values)[i + 3]);
        }
        return {};
    }

    core::Result<void> readUvs(GltfPrimitive& primitive) {
        for (int set = 0; set < 2; ++set) {
            const int from =
                source_.material == kNone
                    ? set
                    : context_.file.materials[static_cast<std::size_t>(source_.material)]
                          .uvSources[static_cast<std::size_t>(set)];
            core::Result<std::vector<float>> values =
                attribute(("TEXCOORD_" + std::to_string(from)).c_str(), TINYGLTF_TYPE_VEC2,
                          TINYGLTF_TYPE_VEC2);
            if (!values) {
                return values.error();
            }
            repairTo(*values, 0.0f, "texture coordinate not finite, set to 0");
            primitive.uvs[set].reserve(values->size() / 2);
            for (std::size_t i = 0; i < values->size(); i += 2) {
                primitive.uvs[set].emplace_back((*values)[i], (*values)[i + 1]);
            }
        }
        return {};
    }

    core::Result<void> readColors(GltfPrimitive& primitive) {
        // Integer colours are always normalised; files that forget to say so mean it.
        core::Result<std::vector<float>> values =
            attribute("COLOR_0", TINYGLTF_TYPE_VEC3, TINYGLTF_TYPE_VEC4, true);
        if (!values) {
            return values.error();
        }
        repairTo(*values, 1.0f, "vertex colour not finite, set to 1");
        const std::size_t n = vertexCount_ == 0 ? 0 : values->size() / vertexCount_;
        for (std::size_t i = 0; i < values->size(); i += n) {
            const float* v = values->data() + i;
            primitive.colors.emplace_back(std::max(v[0], 0.0f), std::max(v[1], 0.0f),
                                          std::max(v[2], 0.0f),
                                          n == 4 ? std::clamp(v[3], 0.0f, 1.0f) : 1.0f);
        }
        return {};
    }

    core::Result<void> readDeformation(GltfPrimitive& primitive) {
        core::Result<void> done = readInfluences(context_, source_, at_, primitive);
        return done ? readTargets(context_, json_, at_, primitive) : done;
    }

    void repairTo(std::vector<float>& values, float replacement, const char* rule) {
        std::uint64_t count = 0;
        for (float& value : values) {
            if (!std::isfinite(value)) {
                value = replacement;
                ++count;
            }
        }
        context_.file.warnings.add(rule, count);
    }

    core::Result<std::vector<std::uint32_t>> indices() {
        const auto found = source_.attributes.find(kIndicesAttribute);
        if (found == source_.attributes.end() || !json_.contains("indices")) {
            std::vector<std::uint32_t> all(vertexCount_);
            std::iota(all.begin(), all.end(), 0U);
            return all;
        }
        core::Result<std::vector<std::uint32_t>> read = readIndices(context_, found->second);
        if (read) {
            const auto bad = std::find_if(read->begin(), read->end(), [&](std::uint32_t index) {
                return index >= vertexCount_;
            });
            if (bad != read->end()) {
                return core::refused("index " + std::to_string(*bad) + " is not below the " +
                                         std::to_string(vertexCount_) + " vertices",
                                     at_ + "/indices");
            }
        }
        return read;
    }

    core::Result<void> readTopology(GltfPrimitive& primitive) {
        core::Result<std::vector<std::uint32_t>> listed = indices();
        if (!listed) {
            return listed.error();
        }
        const int mode = source_.mode;
        primitive.topology = mode == TINYGLTF_MODE_POINTS     ? Topology::Points
                             : mode < TINYGLTF_MODE_TRIANGLES ? Topology::Lines
                                                              : Topology::Triangles;
        if (!context_.geometry.spend(3 * listed->size() * sizeof(std::uint32_t))) {
            return core::refused("geometry decodes to too much", at_);
        }
        const std::size_t corners = mode == TINYGLTF_MODE_LINE        ? 2
                                    : mode == TINYGLTF_MODE_TRIANGLES ? 3
                                                                      : 1;
        context_.file.warnings.add("index left over at the end of a list, ignored",
                                   listed->size() % corners);
        primitive.indices = unrolled(*listed, mode);
        dropBadPositions(primitive);
        return {};
    }

    /// Points, lines and triangles that touch a position which is not finite.
    void dropBadPositions(GltfPrimitive& primitive) {
        if (std::find(badPosition_.begin(), badPosition_.end(), true) == badPosition_.end()) {
            return;
        }
        const std::size_t corners = static_cast<std::size_t>(primitive.topology) + 1;
        std::vector<std::uint32_t> kept;
        for (std::size_t i = 0; i + corners <= primitive.indices.size(); i += corners) {
            const auto first = primitive.indices.begin() + static_cast<std::ptrdiff_t>(i);
            const auto last = first + static_cast<std::ptrdiff_t>(corners);
            if (std::none_of(first, last,
                             [&](std::uint32_t index) { return badPosition_[index]; })) {
                kept.insert(kept.end(), first, last);
            }
        }
        context_.file.warnings.add("triangle, line or point with a position not finite, dropped",
                                   (primitive.indices.size() - kept.size()) / corners);
        primitive.indices = std::move(kept);
    }

    core::Result<void> finish(GltfPrimitive& primitive) {
        if (primitive.topology == Topology::Triangles && primitive.normals.empty()) {
            const std::size_t perVertex =
                kBytesPerFlatVertex + 3 * sizeof(glm::vec3) * primitive.targets.size();
            if (!context_.geometry.spend(primitive.indices.size() * perVertex)) {
                return core::refused("geometry decodes to too much", at_);
            }
            makeFlat(primitive);
        }
        repairNormals(primitive, context_.file.warnings);
        repairTangents(primitive, context_.file.warnings);
        return {};
    }

    GltfContext& context_;
    const tinygltf::Primitive& source_;
    const Json& json_;
    std::string at_;
    std::size_t vertexCount_ = 0;
    std::vector<bool> badPosition_;
};

static_assert(static_cast<int>(Topology::Points) == 0 && static_cast<int>(Topology::Triangles) == 2,
              "dropBadPositions counts corners by these");

} // namespace

core::Result<void> checkComponents(const GltfContext& context, const std::string& name,
                                   const tinygltf::Accessor& accessor, const std::string& at,
                                   bool delta) {
    const int type = accessor.componentType;
    const bool isFloat = type == TINYGLTF_COMPONENT_TYPE_FLOAT;
    const bool isUnsigned = type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                            type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
    const bool isSigned =
        type == TINYGLTF_COMPONENT_TYPE_BYTE || type == TINYGLTF_COMPONENT_TYPE_SHORT;
    const bool direction = name == "NORMAL" || name == "TANGENT";
    const bool plain =
        isFloat || (isUnsigned &&
                    (name == "COLOR_0" || (name.starts_with("TEXCOORD_") && accessor.normalized)));
    const bool quantized = direction ? isSigned && accessor.normalized
                                     : (isSigned || (isUnsigned && !delta)) && name != "COLOR_0";
    if (plain || (quantized && context.file.extensionListed("KHR_mesh_quantization"))) {
        return {};
    }
    const std::string form = std::string(accessor.normalized ? "normalised " : "") +
                             "components of type " + std::to_string(type);
    const std::string thing = name + (delta ? " of a morph target" : "");
    return core::refused(quantized
                             ? thing + " in " + form + " needs the extension KHR_mesh_quantization"
                             : thing + " cannot have " + form,
                         at);
}

void convertMeshes(GltfContext& context) {
    for (std::size_t m = 0; m < context.model.meshes.size(); ++m) {
        const tinygltf::Mesh& source = context.model.meshes[m];
        const Json& primitives = context.document["meshes"][m]["primitives"];
        GltfMesh mesh;
        mesh.name = source.name;
        for (std::size_t p = 0; p < source.primitives.size(); ++p) {
            const std::string at = pointer(pointer("/meshes", m) + "/primitives", p);
            GltfPrimitive primitive;
            core::Result<bool> drawable =
                PrimitiveReader(context, source.primitives[p], primitives[p], at).read(primitive);
            if (!drawable) {
                context.problems.refuse(drawable.error());
                continue;
            }
            if (*drawable) {
                mesh.primitives.push_back(std::move(primitive));
            }
        }
        readTargetWeights(context, m, mesh);
        context.file.meshes.push_back(std::move(mesh));
    }
    checkNodeWeights(context);
}

} // namespace lodestar::io::detail

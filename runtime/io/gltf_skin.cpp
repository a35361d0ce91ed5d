// SPDX-License-Identifier: MIT
//
// Skins, and the joints and weights of vertices. Source: glTF 2.0 specification, section 3.7.3.
#include <algorithm>
#include <cmath>

#include "io/gltf_internal.h"

namespace lodestar::io::detail {
namespace {

/// Sum of weights beyond which "not 1" is worth a word: unsigned bytes of eight influences round
/// that much.
constexpr float kWeightTolerance = 8.0f * 0.5f / 255.0f;

core::Result<bool> readSet(GltfContext& context, const tinygltf::Primitive& source, std::size_t set,
                           const std::string& at, GltfPrimitive& primitive) {
    const std::string names[] = {"JOINTS_" + std::to_string(set), "WEIGHTS_" + std::to_string(set)};
    const auto joints = source.attributes.find(names[0]);
    const auto weights = source.attributes.find(names[1]);
    if (joints == source.attributes.end() && weights == source.attributes.end()) {
        return false;
    }
    if (joints == source.attributes.end() || weights == source.attributes.end()) {
        const bool lacksJoints = joints == source.attributes.end();
        return core::refused(names[lacksJoints ? 1 : 0] + " without " + names[lacksJoints ? 0 : 1],
                             at + "/attributes/" + names[lacksJoints ? 1 : 0]);
    }
    auto indices = readTyped(context, joints->second, "VEC4", {5121, 5123}, false,
                             at + "/attributes/" + names[0]);
    if (!indices) {
        return indices.error();
    }
    // Integer weights are always normalised.
    const bool integers =
        context.model.accessors[static_cast<std::size_t>(weights->second)].componentType != 5126;
    auto shares = readTyped(context, weights->second, "VEC4", {5121, 5123, 5126}, integers,
                            at + "/attributes/" + names[1]);
    if (!shares) {
        return shares.error();
    }
    const std::size_t count = primitive.positions.size();
    for (const auto* list : {&*indices, &*shares}) {
        if (list->size() != 4 * count) {
            const std::string& name = names[list == &*indices ? 0 : 1];
            return core::refused(name + " has " + std::to_string(list->size() / 4) +
                                     " elements, POSITION has " + std::to_string(count),
                                 at + "/attributes/" + name);
        }
    }
    for (std::size_t i = 0; i < 4 * count; i += 4) {
        const float* j = indices->data() + i;
        const float* w = shares->data() + i;
        primitive.joints[set].emplace_back(j[0], j[1], j[2], j[3]);
        primitive.weights[set].emplace_back(w[0], w[1], w[2], w[3]);
    }
    return true;
}

/// Weights of all sets at one vertex: >= 0 and 1 in all.
void repairVertex(GltfPrimitive& primitive, std::size_t vertex, core::Tally& warnings) {
    double sum = 0.0;
    std::uint64_t bad = 0;
    for (std::vector<glm::vec4>& set : primitive.weights) {
        for (glm::length_t k = 0; !set.empty() && k < 4; ++k) {
            float& weight = set[vertex][k];
            if (!(weight >= 0.0f) || !std::isfinite(weight)) {
                weight = 0.0f;
                ++bad;
            }
            sum += weight;
        }
    }
    warnings.add("joint weight negative or not finite, set to 0", bad);
    if (sum == 0.0) {
        primitive.weights[0][vertex].x = 1.0f;
        warnings.add("vertex whose joint weights are all 0, given to its first joint");
        sum = 1.0;
    }
    warnings.add("joint weights of a vertex do not add up to 1, scaled",
                 std::abs(sum - 1.0) > kWeightTolerance ? 1 : 0);
    for (std::size_t set = 0; set < kInfluenceSets; ++set) {
        for (glm::length_t k = 0; !primitive.weights[set].empty() && k < 4; ++k) {
            float& weight = primitive.weights[set][vertex][k];
            weight = static_cast<float>(weight / sum);
            if (weight == 0.0f) {
                primitive.joints[set][vertex][k] = 0; // whatever it was, nothing reads it
            }
        }
    }
}

core::Result<void> readInverseBind(GltfContext& context, const Json& json, const std::string& at,
                                   GltfSkin& skin) {
    skin.inverseBind.assign(skin.joints.size(), glm::mat4(1.0f));
    const Json* accessor = member(json, "inverseBindMatrices");
    if (accessor == nullptr) {
        return {};
    }
    const std::string here = at + "/inverseBindMatrices";
    auto values = readTyped(context, accessor->get<int>(), "MAT4", {5126}, false, here);
    if (!values) {
        return values.error();
    }
    if (values->size() < 16 * skin.joints.size()) {
        return core::refused(std::to_string(values->size() / 16) + " matrices for " +
                                 std::to_string(skin.joints.size()) + " joints",
                             here);
    }
    for (std::size_t i = 0; i < skin.joints.size(); ++i) {
        for (std::size_t k = 0; k < 16; ++k) {
            const float value = (*values)[16 * i + k];
            if (!std::isfinite(value)) {
                return core::refused("inverse bind matrix " + std::to_string(i) + " is not finite",
                                     here);
            }
            skin.inverseBind[i][static_cast<glm::length_t>(k / 4)]
                            [static_cast<glm::length_t>(k % 4)] = value;
        }
        glm::mat4& m = skin.inverseBind[i];
        if (glm::vec4(m[0][3], m[1][3], m[2][3], m[3][3]) != glm::vec4(0.0f, 0.0f, 0.0f, 1.0f)) {
            m[0][3] = m[1][3] = m[2][3] = 0.0f;
            m[3][3] = 1.0f;
            context.file.warnings.add(
                "inverse bind matrix with a last row other than 0 0 0 1, set to that");
        }
    }
    return {};
}

/// The largest joint that a vertex follows; -1 where none has joints.
int largestJoint(const GltfMesh& mesh) {
    int largest = -1;
    for (const GltfPrimitive& primitive : mesh.primitives) {
        for (const auto& set : primitive.joints) {
            for (const glm::u16vec4& four : set) {
                largest = std::max({largest, int{four.x}, int{four.y}, int{four.z}, int{four.w}});
            }
        }
    }
    return largest;
}

core::Result<GltfSkin> readSkin(GltfContext& context, const Json& json, const std::string& at) {
    GltfSkin skin;
    if (const Json* name = member(json, "name")) {
        skin.name = name->get<std::string>();
    }
    skin.joints = json["joints"].get<std::vector<int>>();
    if (skin.joints.empty()) {
        return core::refused("a skin has at least one joint", at + "/joints");
    }
    std::vector<int> sorted = skin.joints;
    std::sort(sorted.begin(), sorted.end());
    const bool twice = std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
    context.file.warnings.add("skin that names a joint twice", twice ? 1 : 0);
    if (const Json* skeleton = member(json, "skeleton")) {
        skin.skeleton = skeleton->get<int>();
    }
    core::Result<void> read = readInverseBind(context, json, at, skin);
    if (!read) {
        return read.error();
    }
    return skin;
}

/// @param largest the largest joint of each mesh
void checkSkinOf(GltfContext& context, std::size_t index, const std::vector<int>& largest) {
    GltfNode& node = context.file.nodes[index];
    if (node.skin == kNone) {
        return;
    }
    if (node.mesh == kNone) {
        context.file.warnings.add("node with a skin but no mesh, skin ignored");
        node.skin = kNone;
        return;
    }
    const auto skin = static_cast<std::size_t>(node.skin);
    const int follows = largest[static_cast<std::size_t>(node.mesh)];
    const auto joints = static_cast<int>(context.file.skins[skin].joints.size());
    if (follows < 0) {
        context.file.warnings.add("node with a skin whose mesh has no joints, skin ignored");
        node.skin = kNone;
    } else if (follows >= joints && context.problems.clean(pointer("/skins", skin))) {
        context.problems.refuse("a vertex of mesh " + std::to_string(node.mesh) +
                                    " follows joint " + std::to_string(follows) +
                                    ", the skin has " + std::to_string(joints),
                                pointer("/nodes", index) + "/skin");
    }
}

} // namespace

core::Result<std::vector<float>> readTyped(GltfContext& context, int accessor, const char* type,
                                           std::initializer_list<int> types, bool forceNormalized,
                                           const std::string& at) {
    const Json& json = context.document["accessors"][static_cast<std::size_t>(accessor)];
    if (json["type"] != type) {
        return core::refused(std::string("accessor must be ") + type, at);
    }
    const int given = json["componentType"].get<int>();
    if (std::find(types.begin(), types.end(), given) == types.end()) {
        std::string allowed;
        for (const int one : types) {
            allowed += (allowed.empty() ? "" : ", ") + std::to_string(one);
        }
        return core::refused(
            "accessor has componentType " + std::to_string(given) + "; allowed: " + allowed, at);
    }
    return readFloats(context, accessor, forceNormalized);
}

core::Result<void> readInfluences(GltfContext& context, const tinygltf::Primitive& source,
                                  const std::string& at, GltfPrimitive& primitive) {
    for (std::size_t set = 0; set < kInfluenceSets; ++set) {
        core::Result<bool> read = readSet(context, source, set, at, primitive);
        if (!read) {
            return read.error();
        }
        if (!*read) {
            break;
        }
    }
    const std::string next = std::to_string(kInfluenceSets);
    const bool more = source.attributes.contains("JOINTS_" + next);
    context.file.warnings.add("joints beyond eight a vertex, ignored", more ? 1 : 0);
    for (std::size_t i = 0; i < primitive.weights[0].size(); ++i) {
        repairVertex(primitive, i, context.file.warnings);
    }
    return {};
}

void convertSkins(GltfContext& context) {
    for (std::size_t i = 0; i < memberSize(context.document, "skins"); ++i) {
        const std::string at = pointer("/skins", i);
        GltfSkin& skin = context.file.skins.emplace_back();
        if (!context.problems.clean(at)) {
            continue;
        }
        core::Result<GltfSkin> read = readSkin(context, context.document["skins"][i], at);
        if (read) {
            skin = std::move(*read);
        } else {
            context.problems.refuse(read.error());
        }
    }
    std::vector<int> largest(context.file.meshes.size());
    std::transform(context.file.meshes.begin(), context.file.meshes.end(), largest.begin(),
                   largestJoint);
    for (std::size_t n = 0; n < context.file.nodes.size(); ++n) {
        checkSkinOf(context, n, largest);
    }
}

} // namespace lodestar::io::detail

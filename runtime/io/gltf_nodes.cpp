// SPDX-License-Identifier: MIT
//
// Nodes as a forest, and scenes. Source: glTF 2.0 specification, section 3.5.
#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

#include "io/gltf_internal.h"

namespace lodestar::io::detail {
namespace {

bool finite(const glm::mat4& m) {
    for (glm::length_t c = 0; c < 4; ++c) {
        for (glm::length_t r = 0; r < 4; ++r) {
            if (!std::isfinite(m[c][r])) {
                return false;
            }
        }
    }
    return true;
}

/// In double: scales near the ends of float leave a float determinant at 0 or infinity.
bool singular(const glm::mat4& m) {
    return std::abs(glm::determinant(glm::dmat3(glm::dmat4(m)))) == 0.0;
}

glm::vec3 vectorOr(const std::vector<double>& values, const glm::vec3& otherwise) {
    return values.size() == 3
               ? glm::vec3(static_cast<float>(values[0]), static_cast<float>(values[1]),
                           static_cast<float>(values[2]))
               : otherwise;
}

void readMatrix(const std::vector<double>& values, GltfNode& node, core::Tally& warnings) {
    node.hasMatrix = true;
    for (std::size_t i = 0; i < 16; ++i) {
        node.matrix[static_cast<glm::length_t>(i / 4)][static_cast<glm::length_t>(i % 4)] =
            static_cast<float>(values[i]);
    }
    const glm::vec4 bottom(node.matrix[0][3], node.matrix[1][3], node.matrix[2][3],
                           node.matrix[3][3]);
    if (bottom != glm::vec4(0.0f, 0.0f, 0.0f, 1.0f)) {
        warnings.add("node matrix with a last row other than 0 0 0 1, set to that");
        for (glm::length_t c = 0; c < 4; ++c) {
            node.matrix[c][3] = c == 3 ? 1.0f : 0.0f;
        }
    }
}

void readRotation(const std::vector<double>& values, GltfNode& node, core::Tally& warnings) {
    if (values.size() != 4) {
        return;
    }
    const double length = std::sqrt(values[0] * values[0] + values[1] * values[1] +
                                    values[2] * values[2] + values[3] * values[3]);
    if (!(length > 1e-20) || !std::isfinite(length)) {
        warnings.add("node rotation of no length, taken as none");
        return;
    }
    warnings.add("node rotation not of unit length, normalised",
                 std::abs(length - 1.0) > kUnitTolerance4 ? 1 : 0);
    node.rotation =
        glm::quat(static_cast<float>(values[3] / length), static_cast<float>(values[0] / length),
                  static_cast<float>(values[1] / length), static_cast<float>(values[2] / length));
}

/// `extras.lodestar.layers`: the light probes that capture the node share a bit with it.
std::uint32_t layersOf(const Json& json, core::Tally& warnings) {
    constexpr std::uint32_t kAll = 0xffffffffu;
    const Json* extras = member(json, "extras");
    const Json* own =
        extras == nullptr || !extras->is_object() ? nullptr : member(*extras, "lodestar");
    const Json* layers = own == nullptr || !own->is_object() ? nullptr : member(*own, "layers");
    if (layers == nullptr) {
        return kAll;
    }
    const bool valid = layers->is_number_unsigned() && layers->get<std::uint64_t>() <= kAll;
    warnings.add("node's layers are no 32-bit mask, taken as all", valid ? 0 : 1);
    return valid ? static_cast<std::uint32_t>(layers->get<std::uint64_t>()) : kAll;
}

core::Result<GltfNode> readNode(GltfContext& context, std::size_t index) {
    const tinygltf::Node& source = context.model.nodes[index];
    const Json& json = context.document["nodes"][index];
    core::Tally& warnings = context.file.warnings;
    GltfNode node;
    node.name = source.name;
    node.children.assign(source.children.begin(), source.children.end());
    node.mesh = source.mesh;
    node.camera = source.camera;
    node.skin = source.skin;
    node.layers = layersOf(json, warnings);
    for (std::size_t i = 0; i < memberSize(json, "weights"); ++i) {
        node.weights.push_back(json["weights"][i].get<float>());
    }
    const Json* punctual = extensionOf(json, "KHR_lights_punctual");
    const Json* light = punctual == nullptr ? nullptr : member(*punctual, "light");
    if (light != nullptr) {
        node.light = light->get<int>();
    }
    if (source.matrix.size() == 16) {
        readMatrix(source.matrix, node, warnings);
        const bool both =
            json.contains("translation") || json.contains("rotation") || json.contains("scale");
        warnings.add("node with a matrix and translation, rotation or scale: the matrix counts",
                     both ? 1 : 0);
    } else {
        node.translation = vectorOr(source.translation, glm::vec3(0.0f));
        node.scale = vectorOr(source.scale, glm::vec3(1.0f));
        readRotation(source.rotation, node, warnings);
        node.matrix = glm::translate(glm::mat4(1.0f), node.translation) *
                      glm::mat4_cast(node.rotation) * glm::scale(glm::mat4(1.0f), node.scale);
    }
    if (!finite(node.matrix)) {
        return core::refused("node's transform is not finite", pointer("/nodes", index));
    }
    warnings.add("node transform is singular, kept", singular(node.matrix) ? 1 : 0);
    return node;
}

/// Fills in the parents; refuses a second one and takes it away.
void linkParents(std::vector<GltfNode>& nodes, GltfProblems& problems) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        std::vector<int> kept;
        for (std::size_t c = 0; c < nodes[i].children.size(); ++c) {
            const int child = nodes[i].children[c];
            int& parent = nodes[static_cast<std::size_t>(child)].parent;
            const std::string at = pointer(pointer("/nodes", i) + "/children", c);
            if (child == static_cast<int>(i)) {
                problems.refuse("node is its own child", at);
            } else if (parent != kNone) {
                problems.refuse("node has two parents", at);
            } else {
                parent = static_cast<int>(i);
                kept.push_back(child);
            }
        }
        nodes[i].children = std::move(kept);
    }
}

/// Walks down from every root: what is not reached is on a cycle. Not recursive: a chain of nodes
/// may be as long as the file.
void checkForest(const std::vector<GltfNode>& nodes, GltfProblems& problems) {
    struct Visit {
        int node;
        int depth;
        glm::mat4 worldFromNode;
    };
    std::vector<bool> reached(nodes.size());
    std::vector<Visit> open;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i].parent == kNone) {
            open.push_back({static_cast<int>(i), 1, glm::mat4(1.0f)});
        }
    }
    while (!open.empty()) {
        const Visit visit = open.back();
        open.pop_back();
        const auto index = static_cast<std::size_t>(visit.node);
        const std::string at = pointer("/nodes", index);
        reached[index] = true;
        if (visit.depth == kMaxNodeDepth + 1) {
            problems.refuse("nodes are nested more than " + std::to_string(kMaxNodeDepth) + " deep",
                            at);
        }
        glm::mat4 world = visit.worldFromNode * nodes[index].matrix;
        if (!finite(world)) {
            problems.refuse("node's transform in the world is not finite", at);
            world = glm::mat4(1.0f); // the children are not to blame
        }
        for (const int child : nodes[index].children) {
            open.push_back({child, visit.depth + 1, world});
        }
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (!reached[i]) {
            problems.refuse("node is its own ancestor or hangs on one that is (a cycle)",
                            pointer("/nodes", i));
        }
    }
}

} // namespace

void convertNodes(GltfContext& context) {
    for (std::size_t i = 0; i < context.model.nodes.size(); ++i) {
        core::Result<GltfNode> node = readNode(context, i);
        if (!node) {
            context.problems.refuse(node.error());
        }
        context.file.nodes.push_back(node ? std::move(*node) : GltfNode());
    }
    linkParents(context.file.nodes, context.problems);
    checkForest(context.file.nodes, context.problems);
}

void convertScenes(GltfContext& context) {
    std::vector<std::size_t> usedBy(context.file.nodes.size(), context.model.scenes.size());
    for (std::size_t i = 0; i < context.model.scenes.size(); ++i) {
        const tinygltf::Scene& source = context.model.scenes[i];
        GltfScene scene;
        scene.name = source.name;
        for (std::size_t r = 0; r < source.nodes.size(); ++r) {
            const auto node = static_cast<std::size_t>(source.nodes[r]);
            const std::string at = pointer(pointer("/scenes", i) + "/nodes", r);
            if (context.file.nodes[node].parent != kNone) {
                context.problems.refuse("scene's node has a parent; it must be a root", at);
            }
            if (usedBy[node] == i) {
                context.problems.refuse("scene names a node twice", at);
            }
            usedBy[node] = i;
            scene.roots.push_back(source.nodes[r]);
        }
        context.file.scenes.push_back(std::move(scene));
    }
    const Json* given = member(context.document, "scene");
    context.file.defaultScene = given != nullptr              ? given->get<int>()
                                : context.file.scenes.empty() ? kNone
                                                              : 0;
}

} // namespace lodestar::io::detail

// SPDX-License-Identifier: MIT
#include "scene/scene.h"

#include <algorithm>
#include <utility>

#include <glm/gtc/matrix_transform.hpp>

namespace lodestar::scene {
namespace {

std::optional<Trs> restOf(const io::GltfNode& node) {
    return node.hasMatrix ? std::optional<Trs>()
                          : std::optional<Trs>(Trs{node.translation, node.rotation, node.scale});
}

std::vector<int> rootsOf(const io::GltfFile& file, int scene) {
    const int index = scene >= 0 ? scene : file.defaultScene;
    if (index >= 0) {
        return file.scenes[static_cast<std::size_t>(index)].roots;
    }
    std::vector<int> roots;
    for (std::size_t i = 0; i < file.nodes.size(); ++i) {
        if (file.nodes[i].parent == io::kNone) {
            roots.push_back(static_cast<int>(i));
        }
    }
    return roots;
}

/// The roots above the joints that nodes on the list wear, where those are not on it themselves.
std::vector<int> rootsOfJoints(const io::GltfFile& file, const std::vector<int>& sceneFromFile) {
    std::vector<int> roots;
    for (std::size_t n = 0; n < file.nodes.size(); ++n) {
        if (sceneFromFile[n] == io::kNone || file.nodes[n].skin == io::kNone) {
            continue;
        }
        for (int joint : file.skins[static_cast<std::size_t>(file.nodes[n].skin)].joints) {
            if (sceneFromFile[static_cast<std::size_t>(joint)] != io::kNone) {
                continue;
            }
            while (file.nodes[static_cast<std::size_t>(joint)].parent != io::kNone) {
                joint = file.nodes[static_cast<std::size_t>(joint)].parent;
            }
            if (std::find(roots.begin(), roots.end(), joint) == roots.end()) {
                roots.push_back(joint);
            }
        }
    }
    return roots;
}

/// @param shown false leaves the components out: a node that only moves others
Node makeNode(const io::GltfFile& file, const io::GltfNode& source, int parent, bool shown) {
    const std::optional<Trs> rest = restOf(source);
    Node node{source.name, parent,       rest ? rest->matrix() : source.matrix, glm::mat4(1.0f), {},
              rest,        source.layers};
    if (!shown) {
        return node;
    }
    if (source.mesh != io::kNone) {
        const std::vector<float>& weights =
            source.weights.empty() ? file.meshes[static_cast<std::size_t>(source.mesh)].weights
                                   : source.weights;
        node.components.emplace_back(MeshComponent{source.mesh, source.skin, weights, weights});
    }
    if (source.camera != io::kNone) {
        node.components.emplace_back(
            CameraComponent{file.cameras[static_cast<std::size_t>(source.camera)]});
    }
    if (source.light != io::kNone) {
        node.components.emplace_back(
            LightComponent{file.lights[static_cast<std::size_t>(source.light)]});
    }
    return node;
}

/// Of the vertices that the indices use.
DeformedBounds deformedBounds(const io::GltfPrimitive& primitive) {
    DeformedBounds result;
    for (const io::GltfMorphTarget& target : primitive.targets) {
        Bounds& box = result.deltas.emplace_back();
        for (std::uint32_t index : primitive.indices) {
            box.add(target.positions.empty() ? glm::vec3(0.0f) : target.positions[index]);
        }
    }
    for (std::size_t set = 0; set < io::kInfluenceSets; ++set) {
        for (std::uint32_t index : primitive.indices) {
            for (glm::length_t k = 0; !primitive.joints[set].empty() && k < 4; ++k) {
                const std::size_t joint = primitive.joints[set][index][k];
                if (primitive.weights[set][index][k] > 0.0f) {
                    result.joints.resize(std::max(result.joints.size(), joint + 1));
                    result.joints[joint].add(primitive.positions[index]);
                }
            }
        }
    }
    return result;
}

/// A box that holds `bounds` with every target added at its weight.
Bounds morphed(Bounds bounds, const std::vector<Bounds>& deltas,
               const std::vector<float>& weights) {
    for (std::size_t t = 0; !bounds.empty() && t < deltas.size() && t < weights.size(); ++t) {
        const glm::vec3 a = weights[t] * deltas[t].low;
        const glm::vec3 b = weights[t] * deltas[t].high;
        bounds.low += glm::min(a, b);
        bounds.high += glm::max(a, b);
    }
    return bounds;
}

/// Adds the trees below the roots. Depth first with an explicit stack: children follow their
/// parents in the list.
void addTrees(const io::GltfFile& file, const std::vector<int>& roots, bool shown, Scene& scene,
              std::vector<int>& sceneFromFile) {
    std::vector<std::pair<int, int>> stack;
    for (auto root = roots.rbegin(); root != roots.rend(); ++root) {
        stack.emplace_back(*root, -1);
    }
    while (!stack.empty()) {
        const auto [index, parent] = stack.back();
        stack.pop_back();
        const io::GltfNode& source = file.nodes[static_cast<std::size_t>(index)];
        const int self = static_cast<int>(scene.nodes.size());
        scene.nodes.push_back(makeNode(file, source, parent, shown));
        sceneFromFile[static_cast<std::size_t>(index)] = self;
        for (auto child = source.children.rbegin(); child != source.children.rend(); ++child) {
            stack.emplace_back(*child, self);
        }
    }
}

/// Animations and skins that speak of the scene's nodes.
void takeMotion(io::GltfFile& file, const std::vector<int>& sceneFromFile, Scene& scene) {
    scene.animations = std::move(file.animations);
    for (io::GltfAnimation& animation : scene.animations) {
        for (io::GltfAnimationChannel& channel : animation.channels) {
            channel.node = sceneFromFile[static_cast<std::size_t>(channel.node)];
        }
        std::erase_if(animation.channels, [](const io::GltfAnimationChannel& channel) {
            return channel.node == io::kNone;
        });
    }
    scene.skins = std::move(file.skins);
    for (io::GltfSkin& skin : scene.skins) {
        for (int& joint : skin.joints) {
            joint = sceneFromFile[static_cast<std::size_t>(joint)];
        }
    }
}

} // namespace

glm::mat4 Trs::matrix() const {
    return glm::translate(glm::mat4(1.0f), translation) * glm::mat4_cast(rotation) *
           glm::scale(glm::mat4(1.0f), scale);
}

void Bounds::add(const glm::vec3& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
}

void Bounds::add(const Bounds& other) {
    if (!other.empty()) {
        add(other.low);
        add(other.high);
    }
}

float Bounds::radius() const {
    return empty() ? 0.0f : 0.5f * glm::length(high - low);
}

Bounds transformed(const Bounds& bounds, const glm::mat4& transform) {
    Bounds result;
    if (bounds.empty()) {
        return result;
    }
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 point((corner & 1) != 0 ? bounds.high.x : bounds.low.x,
                              (corner & 2) != 0 ? bounds.high.y : bounds.low.y,
                              (corner & 4) != 0 ? bounds.high.z : bounds.low.z);
        result.add(glm::vec3(transform * glm::vec4(point, 1.0f)));
    }
    return result;
}

Bounds Scene::worldBounds() const {
    Bounds bounds = reach;
    for (const Node& node : nodes) {
        for (const Component& component : node.components) {
            if (const auto* mesh = std::get_if<MeshComponent>(&component)) {
                const auto& parts = primitiveBounds[static_cast<std::size_t>(mesh->mesh)];
                for (std::size_t p = 0; p < parts.size(); ++p) {
                    bounds.add(primitiveWorldBounds(*this, node, *mesh, p));
                }
            }
        }
    }
    return bounds;
}

Bounds primitiveWorldBounds(const Scene& scene, const Node& node, const MeshComponent& component,
                            std::size_t primitive) {
    const auto mesh = static_cast<std::size_t>(component.mesh);
    const Bounds& plain = scene.primitiveBounds[mesh][primitive];
    const DeformedBounds& deformed = scene.deformedBounds[mesh][primitive];
    if (component.skin == io::kNone || deformed.joints.empty()) {
        return transformed(morphed(plain, deformed.deltas, component.weights), node.worldFromNode);
    }
    // A vertex is a convex mixture of where its joints take it, each inside its joint's box.
    Bounds bounds;
    const io::GltfSkin& skin = scene.skins[static_cast<std::size_t>(component.skin)];
    const std::vector<glm::mat4> matrices = jointMatrices(scene, skin);
    for (std::size_t j = 0; j < deformed.joints.size() && j < matrices.size(); ++j) {
        bounds.add(transformed(morphed(deformed.joints[j], deformed.deltas, component.weights),
                               matrices[j]));
    }
    return bounds;
}

std::vector<glm::mat4> jointMatrices(const Scene& scene, const io::GltfSkin& skin) {
    std::vector<glm::mat4> matrices;
    matrices.reserve(skin.joints.size());
    for (std::size_t j = 0; j < skin.joints.size(); ++j) {
        matrices.push_back(scene.nodes[static_cast<std::size_t>(skin.joints[j])].worldFromNode *
                           skin.inverseBind[j]);
    }
    return matrices;
}

Scene buildScene(io::GltfFile file, int sceneIndex) {
    Scene scene;
    std::vector<int> sceneFromFile(file.nodes.size(), io::kNone);
    addTrees(file, rootsOf(file, sceneIndex), true, scene, sceneFromFile);
    const std::vector<int> jointRoots = rootsOfJoints(file, sceneFromFile);
    file.warnings.add("joints outside the scene, taken in unseen", jointRoots.size());
    addTrees(file, jointRoots, false, scene, sceneFromFile);
    takeMotion(file, sceneFromFile, scene);
    for (const io::GltfMesh& mesh : file.meshes) {
        std::vector<Bounds>& bounds = scene.primitiveBounds.emplace_back();
        std::vector<DeformedBounds>& deformed = scene.deformedBounds.emplace_back();
        for (const io::GltfPrimitive& primitive : mesh.primitives) {
            Bounds& box = bounds.emplace_back();
            for (std::uint32_t index : primitive.indices) {
                box.add(primitive.positions[index]);
            }
            deformed.push_back(deformedBounds(primitive));
        }
    }
    const int used = sceneIndex >= 0 ? sceneIndex : file.defaultScene;
    scene.name = used >= 0 ? file.scenes[static_cast<std::size_t>(used)].name : std::string();
    scene.meshes = std::move(file.meshes);
    scene.materials = std::move(file.materials);
    scene.textures = std::move(file.textures);
    scene.images = std::move(file.images);
    scene.warnings = std::move(file.warnings);
    updateTransforms(scene);
    return scene;
}

void updateTransforms(Scene& scene) {
    for (Node& node : scene.nodes) {
        node.worldFromNode =
            node.parent >= 0 ? scene.nodes[static_cast<std::size_t>(node.parent)].worldFromNode *
                                   node.parentFromNode
                             : node.parentFromNode;
    }
}

} // namespace lodestar::scene

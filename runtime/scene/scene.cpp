// SPDX-License-Identifier: MIT
#include "scene/scene.h"

#include <utility>

#include <glm/gtc/matrix_transform.hpp>

namespace lodestar::scene {
namespace {

glm::mat4 localTransform(const io::GltfNode& node) {
    if (node.hasMatrix) {
        return node.matrix;
    }
    return glm::translate(glm::mat4(1.0f), node.translation) * glm::mat4_cast(node.rotation) *
           glm::scale(glm::mat4(1.0f), node.scale);
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

Node makeNode(const io::GltfFile& file, const io::GltfNode& source, int parent) {
    Node node{source.name, parent, localTransform(source), glm::mat4(1.0f), {}};
    if (source.mesh != io::kNone) {
        node.components.emplace_back(MeshComponent{source.mesh});
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

} // namespace

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
    Bounds bounds;
    for (const Node& node : nodes) {
        for (const Component& component : node.components) {
            if (const auto* mesh = std::get_if<MeshComponent>(&component)) {
                for (const Bounds& part : primitiveBounds[static_cast<std::size_t>(mesh->mesh)]) {
                    bounds.add(transformed(part, node.worldFromNode));
                }
            }
        }
    }
    return bounds;
}

Scene buildScene(io::GltfFile file, int sceneIndex) {
    Scene scene;
    // Depth first with an explicit stack: children follow their parents in the list.
    std::vector<std::pair<int, int>> stack;
    const std::vector<int> roots = rootsOf(file, sceneIndex);
    for (auto root = roots.rbegin(); root != roots.rend(); ++root) {
        stack.emplace_back(*root, -1);
    }
    while (!stack.empty()) {
        const auto [index, parent] = stack.back();
        stack.pop_back();
        const io::GltfNode& source = file.nodes[static_cast<std::size_t>(index)];
        scene.nodes.push_back(makeNode(file, source, parent));
        const int self = static_cast<int>(scene.nodes.size()) - 1;
        for (auto child = source.children.rbegin(); child != source.children.rend(); ++child) {
            stack.emplace_back(*child, self);
        }
    }
    for (const io::GltfMesh& mesh : file.meshes) {
        std::vector<Bounds>& bounds = scene.primitiveBounds.emplace_back();
        for (const io::GltfPrimitive& primitive : mesh.primitives) {
            Bounds& box = bounds.emplace_back();
            for (std::uint32_t index : primitive.indices) {
                box.add(primitive.positions[index]);
            }
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

// SPDX-License-Identifier: MIT
//
// The scene graph: nodes with components. Values only; the renderer keeps what belongs to GL.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "core/result.h"
#include "io/gltf.h"

namespace lodestar::scene {

/// Draws a mesh of the scene's file at the node.
struct MeshComponent {
    int mesh = 0;
};
/// A camera looking along the node's -Z.
struct CameraComponent {
    io::GltfCamera camera;
};
/// A punctual light shining along the node's -Z.
struct LightComponent {
    io::GltfLight light;
};

using Component = std::variant<MeshComponent, CameraComponent, LightComponent>;

/// A node; parents stand before their children in Scene::nodes.
struct Node {
    std::string name;
    int parent = -1;
    glm::mat4 parentFromNode{1.0f};
    glm::mat4 worldFromNode{1.0f}; ///< set by updateTransforms
    std::vector<Component> components;
};

/// Axis-aligned box; empty while low > high.
struct Bounds {
    glm::vec3 low{std::numeric_limits<float>::max()};
    glm::vec3 high{std::numeric_limits<float>::lowest()};

    [[nodiscard]] bool empty() const { return low.x > high.x; }
    void add(const glm::vec3& point);
    void add(const Bounds& other);
    [[nodiscard]] glm::vec3 center() const { return 0.5f * (low + high); }
    [[nodiscard]] float radius() const; ///< of the sphere about the box; 0 if empty
};

[[nodiscard]] Bounds transformed(const Bounds& bounds, const glm::mat4& transform);

/// One scene of a file, and what its nodes refer to.
struct Scene {
    std::string name;
    std::vector<Node> nodes;
    std::vector<io::GltfMesh> meshes;
    std::vector<std::vector<Bounds>> primitiveBounds; ///< in mesh space, by mesh and primitive
    std::vector<io::GltfMaterial> materials;
    std::vector<io::GltfTexture> textures;
    std::vector<core::Image> images;
    core::Tally warnings;

    [[nodiscard]] Bounds worldBounds() const;
};

/// Builds a scene of a file, with its transforms up to date. @param scene index, or -1 for the
/// file's default; a file without scenes shows all its root nodes
[[nodiscard]] Scene buildScene(io::GltfFile file, int scene = -1);

/// Recomputes worldFromNode of every node.
void updateTransforms(Scene& scene);

} // namespace lodestar::scene

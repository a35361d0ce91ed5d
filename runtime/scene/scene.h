// SPDX-License-Identifier: MIT
//
// The scene graph: nodes with components. Values only; the renderer keeps what belongs to GL.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "core/result.h"
#include "io/gltf.h"
#include "lighting/cubemap.h"
#include "lighting/probe.h"

namespace lodestar::scene {

/// Draws a mesh of the scene's file at the node, or where its skin's joints are.
struct MeshComponent {
    int mesh = 0;
    int skin = io::kNone;             ///< into Scene::skins
    std::vector<float> weights;       ///< of the mesh's morph targets, now; one each
    std::vector<float> restWeights{}; ///< as in the file
};
/// A camera looking along the node's -Z.
struct CameraComponent {
    io::GltfCamera camera;
};
/// A punctual light shining along the node's -Z.
struct LightComponent {
    io::GltfLight light;
};

/// A light probe in the node's frame.
struct ProbeComponent {
    lighting::Probe probe;
    std::shared_ptr<const lighting::Cubemap> map; ///< a file's light, level 0; null: it is captured
};

using Component = std::variant<MeshComponent, CameraComponent, LightComponent, ProbeComponent>;

/// Translation, rotation and scale of a node in its parent.
struct Trs {
    glm::vec3 translation{0.0f};
    glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};
    glm::vec3 scale{1.0f};

    [[nodiscard]] glm::mat4 matrix() const;
};

/// A node; parents stand before their children in Scene::nodes.
struct Node {
    std::string name;
    int parent = -1;
    glm::mat4 parentFromNode{1.0f};
    glm::mat4 worldFromNode{1.0f}; ///< set by updateTransforms
    std::vector<Component> components;
    std::optional<Trs> rest{};          ///< as in the file; absent where that gives a matrix
    std::uint32_t layers = 0xffffffffu; ///< light probes that share a bit with it capture it
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

/// What bounds a primitive when it is deformed; boxes in mesh space.
struct DeformedBounds {
    std::vector<Bounds> deltas; ///< of each morph target's position deltas
    std::vector<Bounds> joints; ///< by joint: of the vertices that follow it
};

/// One scene of a file, and what its nodes refer to.
struct Scene {
    std::string name;
    std::vector<Node> nodes;
    std::vector<io::GltfMesh> meshes;
    std::vector<std::vector<Bounds>> primitiveBounds; ///< in mesh space, by mesh and primitive
    std::vector<std::vector<DeformedBounds>> deformedBounds; ///< by mesh and primitive
    std::vector<io::GltfAnimation> animations; ///< nodes into `nodes`; those elsewhere left out
    std::vector<io::GltfSkin> skins; ///< joints into `nodes`; kNone only in skins that none wears
    Bounds reach; ///< what worldBounds() holds besides the present pose; empty at first
    std::vector<io::GltfMaterial> materials;
    std::vector<io::GltfTexture> textures;
    std::vector<core::Texels> images; ///< read by Renderer::make; may be emptied after it
    core::Tally warnings;

    /// Of everything in its present pose, and `reach`.
    [[nodiscard]] Bounds worldBounds() const;
};

/// Builds a scene of a file, with its transforms up to date. @param scene index, or -1 for the
/// file's default; a file without scenes shows all its root nodes
[[nodiscard]] Scene buildScene(io::GltfFile file, int scene = -1);

/// A box about a primitive as the node's component draws it, morphed and skinned: never too small.
[[nodiscard]] Bounds primitiveWorldBounds(const Scene& scene, const Node& node,
                                          const MeshComponent& component, std::size_t primitive);

/// Where a skin's joints take the points of a mesh: worldFromMesh, one a joint.
[[nodiscard]] std::vector<glm::mat4> jointMatrices(const Scene& scene, const io::GltfSkin& skin);

/// Recomputes worldFromNode of every node.
void updateTransforms(Scene& scene);

} // namespace lodestar::scene

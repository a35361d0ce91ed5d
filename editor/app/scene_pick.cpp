// SPDX-License-Identifier: MIT
#include "app/scene_pick.h"

#include <algorithm>

#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtx/intersect.hpp>

namespace lodestar::app {
namespace {

/// Where a ray enters a box, or is inside of it: 0; nothing where it passes by.
std::optional<float> entered(const scene::Bounds& box, const glm::vec3& origin,
                             const glm::vec3& direction) {
    if (box.empty()) {
        return std::nullopt;
    }
    float first = 0.0f;
    float last = std::numeric_limits<float>::max();
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0f) {
            if (origin[axis] < box.low[axis] || origin[axis] > box.high[axis]) {
                return std::nullopt;
            }
            continue;
        }
        const float a = (box.low[axis] - origin[axis]) / direction[axis];
        const float b = (box.high[axis] - origin[axis]) / direction[axis];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    return first <= last ? std::optional(first) : std::nullopt;
}

/// The nearest of a primitive's triangles, in the mesh's space.
std::optional<float> nearestTriangle(const io::GltfPrimitive& primitive, const glm::vec3& origin,
                                     const glm::vec3& direction) {
    std::optional<float> nearest;
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const glm::vec3& a = primitive.positions[primitive.indices[i]];
        const glm::vec3& b = primitive.positions[primitive.indices[i + 1]];
        const glm::vec3& c = primitive.positions[primitive.indices[i + 2]];
        glm::vec2 inside;
        float distance = 0.0f;
        if (glm::intersectRayTriangle(origin, direction, a, b, c, inside, distance) &&
            distance > 0.0f && (!nearest || distance < *nearest)) {
            nearest = distance;
        }
    }
    return nearest;
}

} // namespace

std::optional<Met> firstMet(const scene::Scene& scene, const glm::vec3& origin,
                            const glm::vec3& direction) {
    std::optional<Met> first;
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        const scene::Node& node = scene.nodes[n];
        const glm::mat4 meshFromWorld = glm::inverse(node.worldFromNode);
        for (const scene::Component& component : node.components) {
            const auto* mesh = std::get_if<scene::MeshComponent>(&component);
            if (mesh == nullptr) {
                continue;
            }
            const auto& primitives = scene.meshes[static_cast<std::size_t>(mesh->mesh)].primitives;
            for (std::size_t p = 0; p < primitives.size(); ++p) {
                std::optional<float> distance =
                    entered(scene::primitiveWorldBounds(scene, node, *mesh, p), origin, direction);
                if (!distance || (first && *distance > first->distance)) {
                    continue;
                }
                if (mesh->skin == io::kNone) {
                    distance =
                        nearestTriangle(primitives[p], meshFromWorld * glm::vec4(origin, 1.0f),
                                        meshFromWorld * glm::vec4(direction, 0.0f));
                }
                if (distance && (!first || *distance < first->distance)) {
                    first = Met{n, mesh->mesh, p, *distance};
                }
            }
        }
    }
    return first;
}

} // namespace lodestar::app

// SPDX-License-Identifier: MIT
//
// Deformed meshes as static ones: every vertex moved here, in double.
#pragma once

#include <glm/gtc/matrix_inverse.hpp>

#include "scene/scene.h"

namespace lodestar::testing {

inline glm::dmat4 blended(const scene::Scene& scene, const io::GltfSkin& skin,
                          const io::GltfPrimitive& primitive, std::size_t vertex) {
    glm::dmat4 sum(0.0);
    for (std::size_t set = 0; set < io::kInfluenceSets; ++set) {
        for (glm::length_t k = 0; !primitive.joints[set].empty() && k < 4; ++k) {
            const std::size_t j = primitive.joints[set][vertex][k];
            const glm::dmat4 world(
                scene.nodes[static_cast<std::size_t>(skin.joints[j])].worldFromNode);
            sum +=
                double{primitive.weights[set][vertex][k]} * world * glm::dmat4(skin.inverseBind[j]);
        }
    }
    return sum;
}

inline void bakeTargets(io::GltfPrimitive& primitive, const std::vector<float>& weights) {
    for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
        glm::dvec3 position(primitive.positions[i]);
        glm::dvec3 normal(primitive.normals[i]);
        for (std::size_t t = 0; t < primitive.targets.size(); ++t) {
            const io::GltfMorphTarget& target = primitive.targets[t];
            const double weight = weights[t];
            position += target.positions.empty() ? glm::dvec3(0.0)
                                                 : weight * glm::dvec3(target.positions[i]);
            normal +=
                target.normals.empty() ? glm::dvec3(0.0) : weight * glm::dvec3(target.normals[i]);
        }
        primitive.positions[i] = position;
        primitive.normals[i] = glm::normalize(normal);
    }
    for (std::size_t i = 0; i < primitive.tangents.size(); ++i) {
        glm::dvec3 tangent(primitive.tangents[i]);
        for (std::size_t t = 0; t < primitive.targets.size(); ++t) {
            const std::vector<glm::vec3>& deltas = primitive.targets[t].tangents;
            tangent +=
                deltas.empty() ? glm::dvec3(0.0) : double{weights[t]} * glm::dvec3(deltas[i]);
        }
        primitive.tangents[i] = {glm::vec3(glm::normalize(tangent)), primitive.tangents[i].w};
    }
    for (std::size_t i = 0; primitive.flatNormals && i < primitive.indices.size(); i += 3) {
        const std::uint32_t* c = &primitive.indices[i];
        const glm::dvec3 a(primitive.positions[c[0]]);
        const glm::dvec3 n = glm::cross(glm::dvec3(primitive.positions[c[1]]) - a,
                                        glm::dvec3(primitive.positions[c[2]]) - a);
        for (int k = 0; k < 3; ++k) {
            primitive.normals[c[k]] = glm::normalize(n);
        }
    }
    primitive.targets.clear();
}

inline void bakeSkin(const scene::Scene& scene, const io::GltfSkin& skin,
                     io::GltfPrimitive& primitive) {
    for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
        const glm::dmat4 m = blended(scene, skin, primitive, i);
        primitive.positions[i] = glm::dvec3(m * glm::dvec4(primitive.positions[i], 1.0));
        primitive.normals[i] =
            glm::normalize(glm::inverseTranspose(glm::dmat3(m)) * glm::dvec3(primitive.normals[i]));
        if (!primitive.tangents.empty()) { // a mirror image's bitangent is minus normal x tangent
            glm::vec4& tangent = primitive.tangents[i];
            const float side = glm::determinant(glm::dmat3(m)) < 0.0 ? -1.0f : 1.0f;
            tangent = {glm::vec3(glm::normalize(glm::dmat3(m) * glm::dvec3(tangent))),
                       side * tangent.w};
        }
    }
    // A skin that mirrors turns its faces inside out; the static mesh winds them back.
    const bool mirrored = glm::determinant(glm::dmat3(blended(scene, skin, primitive, 0))) < 0.0;
    for (std::size_t i = 0; mirrored && i + 2 < primitive.indices.size(); i += 3) {
        std::swap(primitive.indices[i + 1], primitive.indices[i + 2]);
    }
    for (std::size_t set = 0; set < io::kInfluenceSets; ++set) {
        primitive.joints[set].clear();
        primitive.weights[set].clear();
    }
}

/// The scene in its present pose without a skin or target.
inline scene::Scene baked(const scene::Scene& posed) {
    scene::Scene result = posed;
    for (std::size_t n = 0; n < result.nodes.size(); ++n) {
        for (scene::Component& component : result.nodes[n].components) {
            auto* shown = std::get_if<scene::MeshComponent>(&component);
            if (shown == nullptr) {
                continue;
            }
            io::GltfMesh mesh = posed.meshes[static_cast<std::size_t>(shown->mesh)];
            std::vector<scene::Bounds> bounds;
            for (io::GltfPrimitive& primitive : mesh.primitives) {
                bakeTargets(primitive, shown->weights);
                if (shown->skin != io::kNone) {
                    bakeSkin(posed, posed.skins[static_cast<std::size_t>(shown->skin)], primitive);
                    result.nodes[n].worldFromNode = glm::mat4(1.0f);
                }
                scene::Bounds& box = bounds.emplace_back();
                for (const glm::vec3& position : primitive.positions) {
                    box.add(position);
                }
            }
            mesh.weights.clear();
            shown->mesh = static_cast<int>(result.meshes.size());
            shown->skin = io::kNone;
            shown->weights.clear();
            result.primitiveBounds.push_back(bounds);
            result.deformedBounds.emplace_back(mesh.primitives.size());
            result.meshes.push_back(std::move(mesh));
        }
    }
    return result;
}

} // namespace lodestar::testing

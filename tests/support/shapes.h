// SPDX-License-Identifier: MIT
//
// Small scenes made in memory for tests that render.
#pragma once

#include <cmath>

#include "io/gltf.h"
#include "scene/camera.h"
#include "scene/scene.h"

namespace lodestar::testing {

/// A unit sphere about the origin with exact normals and lat-long uvs.
inline io::GltfPrimitive sphere(int rings = 64, int segments = 128) {
    io::GltfPrimitive primitive;
    constexpr float kPi = 3.14159265358979f;
    for (int j = 0; j <= rings; ++j) {
        for (int i = 0; i <= segments; ++i) {
            const float u = static_cast<float>(i) / static_cast<float>(segments);
            const float v = static_cast<float>(j) / static_cast<float>(rings);
            const glm::vec3 n(std::sin(kPi * v) * std::sin(2.0f * kPi * u), std::cos(kPi * v),
                              std::sin(kPi * v) * std::cos(2.0f * kPi * u));
            primitive.positions.push_back(n);
            primitive.normals.push_back(n);
            primitive.uvs[0].emplace_back(u, v);
        }
    }
    const auto at = [&](int i, int j) {
        return static_cast<std::uint32_t>(j * (segments + 1) + i);
    };
    for (int j = 0; j < rings; ++j) {
        for (int i = 0; i < segments; ++i) {
            for (std::uint32_t index : {at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i, j),
                                        at(i + 1, j + 1), at(i + 1, j)}) {
                primitive.indices.push_back(index);
            }
        }
    }
    return primitive;
}

/// A square of side 2 in the plane z = 0, facing +Z, uv (0, 0) at its upper left.
inline io::GltfPrimitive square() {
    io::GltfPrimitive primitive;
    primitive.positions = {{-1, 1, 0}, {1, 1, 0}, {1, -1, 0}, {-1, -1, 0}};
    primitive.normals.assign(4, {0, 0, 1});
    primitive.uvs[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    primitive.indices = {0, 3, 2, 0, 2, 1};
    return primitive;
}

/// A file with one node that shows one primitive in one material.
inline io::GltfFile fileOf(io::GltfPrimitive primitive, const io::GltfMaterial& material) {
    io::GltfFile file;
    primitive.material = 0;
    std::vector<float> weights(primitive.targets.size(), 0.0f);
    file.meshes.push_back({"mesh", {std::move(primitive)}, std::move(weights)});
    file.materials.push_back(material);
    io::GltfNode node;
    node.name = "node";
    node.mesh = 0;
    file.nodes.push_back(node);
    file.scenes.push_back({"scene", {0}});
    file.defaultScene = 0;
    return file;
}

inline io::GltfMaterial blinnPhong(const glm::vec3& diffuse, const glm::vec3& f0, float exponent) {
    io::GltfMaterial material;
    material.blinnPhong.emplace();
    material.blinnPhong->diffuse = diffuse;
    material.blinnPhong->f0 = f0;
    material.blinnPhong->exponent = exponent;
    return material;
}

/// A view from +Z at a distance, 40 degrees high, square.
inline scene::View frontView(const scene::Scene& scene, float distance = 3.5f) {
    scene::CameraRequest request;
    request.eye = glm::vec3(0.0f, 0.0f, distance);
    request.target = glm::vec3(0.0f);
    request.verticalFov = 0.7f;
    return *scene::chooseView(scene, request, 1.0f);
}

} // namespace lodestar::testing

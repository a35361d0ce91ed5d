// SPDX-License-Identifier: MIT
#include "app/starter_scene.h"

#include <cmath>
#include <string>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace lodestar::app {
namespace {

io::GltfPrimitive sphere(float radius, int material) {
    constexpr int kRings = 48;
    constexpr int kSegments = 96;
    io::GltfPrimitive primitive;
    primitive.material = material;
    for (int j = 0; j <= kRings; ++j) {
        for (int i = 0; i <= kSegments; ++i) {
            const float u =
                glm::two_pi<float>() * static_cast<float>(i) / static_cast<float>(kSegments);
            const float v = glm::pi<float>() * static_cast<float>(j) / static_cast<float>(kRings);
            const glm::vec3 n(std::sin(v) * std::sin(u), std::cos(v), std::sin(v) * std::cos(u));
            primitive.positions.push_back(radius * n);
            primitive.normals.push_back(n);
            primitive.uvs[0].emplace_back(static_cast<float>(i) / static_cast<float>(kSegments),
                                          static_cast<float>(j) / static_cast<float>(kRings));
        }
    }
    primitive.uvs[1] = primitive.uvs[0];
    for (int j = 0; j < kRings; ++j) {
        for (int i = 0; i < kSegments; ++i) {
            const auto at = [](int column, int row) {
                return static_cast<std::uint32_t>(row * (kSegments + 1) + column);
            };
            for (const std::uint32_t index : {at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i, j),
                                              at(i + 1, j + 1), at(i + 1, j)}) {
                primitive.indices.push_back(index);
            }
        }
    }
    return primitive;
}

io::GltfPrimitive disc(float radius, int material) {
    constexpr std::uint32_t kSegments = 96;
    io::GltfPrimitive primitive;
    primitive.material = material;
    primitive.positions.emplace_back(0.0f);
    primitive.normals.emplace_back(0.0f, 1.0f, 0.0f);
    for (std::uint32_t i = 0; i < kSegments; ++i) {
        const float u =
            glm::two_pi<float>() * static_cast<float>(i) / static_cast<float>(kSegments);
        primitive.positions.emplace_back(radius * std::sin(u), 0.0f, radius * std::cos(u));
        primitive.normals.emplace_back(0.0f, 1.0f, 0.0f);
        const std::uint32_t next = i + 1 < kSegments ? i + 2 : 1;
        primitive.indices.insert(primitive.indices.end(), {0, i + 1, next});
    }
    return primitive;
}

io::GltfMaterial material(std::string name, const glm::vec3& diffuse, const glm::vec3& f0,
                          float exponent) {
    io::GltfMaterial made;
    made.name = std::move(name);
    made.blinnPhong.emplace();
    made.blinnPhong->diffuse = diffuse;
    made.blinnPhong->f0 = f0;
    made.blinnPhong->exponent = exponent;
    return made;
}

void add(io::GltfFile& file, io::GltfMaterial made, io::GltfPrimitive shape,
         const glm::vec3& place) {
    io::GltfNode node;
    node.name = made.name;
    node.mesh = static_cast<int>(file.meshes.size());
    node.translation = place;
    node.matrix = glm::translate(glm::mat4(1.0f), place);
    shape.material = static_cast<int>(file.materials.size());
    file.meshes.push_back({made.name, {std::move(shape)}, {}});
    file.materials.push_back(std::move(made));
    file.scenes.front().roots.push_back(static_cast<int>(file.nodes.size()));
    file.nodes.push_back(std::move(node));
}

} // namespace

io::GltfFile starterScene() {
    io::GltfFile file;
    file.scenes.push_back({"spheres", {}});
    file.defaultScene = 0;
    add(file, material("floor", glm::vec3(0.55f, 0.53f, 0.50f), glm::vec3(0.04f), 24.0f),
        disc(9.0f, 0), {0.0f, 0.0f, 0.0f});
    const glm::vec3 varnishes[] = {{0.62f, 0.10f, 0.06f},
                                   {0.70f, 0.36f, 0.05f},
                                   {0.10f, 0.36f, 0.16f},
                                   {0.05f, 0.20f, 0.48f},
                                   {0.70f, 0.68f, 0.64f}};
    const float exponents[] = {4.0f, 32.0f, 256.0f, 2048.0f, 16384.0f};
    for (int i = 0; i < 5; ++i) {
        const float x = 1.25f * static_cast<float>(i - 2);
        const std::string number = std::to_string(static_cast<int>(exponents[i]));
        add(file,
            material("metal " + number, glm::vec3(0.0f), glm::vec3(0.92f, 0.84f, 0.72f),
                     exponents[i]),
            sphere(0.5f, 0), {x, 0.5f, 0.7f});
        add(file, material("varnish " + number, varnishes[i], glm::vec3(0.05f), exponents[i]),
            sphere(0.5f, 0), {x, 0.5f, -0.75f});
    }
    io::GltfNode eye;
    eye.name = "camera";
    eye.camera = 0;
    eye.hasMatrix = true;
    eye.matrix = glm::inverse(glm::lookAt(glm::vec3(1.9f, 2.5f, 9.2f), glm::vec3(0.0f, 0.75f, 0.0f),
                                          glm::vec3(0.0f, 1.0f, 0.0f)));
    file.scenes.front().roots.push_back(static_cast<int>(file.nodes.size()));
    file.nodes.push_back(std::move(eye));
    io::GltfCamera camera;
    camera.verticalFov = 0.62f;
    camera.nearPlane = 0.05f;
    file.cameras.push_back(camera);
    return file;
}

io::GltfFile sphereScene() {
    io::GltfFile file;
    file.scenes.push_back({"sphere", {}});
    file.defaultScene = 0;
    add(file, material("sphere", glm::vec3(0.5f), glm::vec3(0.04f), 1.0f), sphere(1.0f, 0),
        glm::vec3(0.0f));
    return file;
}

} // namespace lodestar::app

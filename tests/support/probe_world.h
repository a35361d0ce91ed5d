// SPDX-License-Identifier: MIT
//
// Worlds of boxes, balls and light probes, made in memory.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "lighting/environment.h"
#include "scene/camera.h"
#include "scene/probe_observer.h"
#include "scene/renderer.h"
#include "scene/scene.h"
#include "support/gl_fixture.h"
#include "support/shapes.h"

namespace lodestar::testing {

/// The outside of a box of half extents 1, six faces with normals.
inline io::GltfPrimitive cube() {
    io::GltfPrimitive primitive;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {1.0f, -1.0f}) {
            const auto first = static_cast<std::uint32_t>(primitive.positions.size());
            glm::vec3 n(0.0f), u(0.0f);
            n[axis] = side;
            u[(axis + 1) % 3] = 1.0f;
            const glm::vec3 v = glm::cross(n, u);
            for (const glm::vec2 at :
                 {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
                primitive.positions.push_back(n + at.x * u + at.y * v);
                primitive.normals.push_back(n);
            }
            for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) {
                primitive.indices.push_back(first + k);
            }
        }
    }
    return primitive;
}

inline io::GltfMaterial glowing(const glm::vec3& radiance) {
    io::GltfMaterial material = blinnPhong(glm::vec3(0.0f), glm::vec3(0.0f), 0.0f);
    material.emissive = radiance;
    return material;
}

class ProbeWorld {
public:
    ProbeWorld() {
        file_.meshes.push_back({"cube", {cube()}, {}});
        file_.meshes.push_back({"ball", {sphere(32, 64)}, {}});
        file_.scenes.push_back({"scene", {}});
        file_.defaultScene = 0;
    }
    /// Every shape is a mesh of its own, since a primitive has one material.
    int add(const std::string& name, bool ball, const glm::vec3& center, const glm::vec3& half,
            const io::GltfMaterial& material, std::uint32_t layers = 0xffffffffu) {
        io::GltfMesh mesh = file_.meshes[ball ? 1 : 0];
        mesh.primitives[0].material = static_cast<int>(file_.materials.size());
        file_.materials.push_back(material);
        io::GltfNode node;
        node.name = name;
        node.mesh = static_cast<int>(file_.meshes.size());
        node.translation = center;
        node.scale = half;
        node.layers = layers;
        file_.meshes.push_back(std::move(mesh));
        const int index = static_cast<int>(file_.nodes.size());
        file_.scenes[0].roots.push_back(index);
        file_.nodes.push_back(node);
        return index;
    }
    int box(const std::string& name, const glm::vec3& low, const glm::vec3& high,
            const io::GltfMaterial& material, std::uint32_t layers = 0xffffffffu) {
        return add(name, false, 0.5f * (low + high), 0.5f * (high - low), material, layers);
    }
    int ball(const std::string& name, const glm::vec3& center, float radius,
             const io::GltfMaterial& material, std::uint32_t layers = 0xffffffffu) {
        return add(name, true, center, glm::vec3(radius), material, layers);
    }
    /// Six slabs of a thickness about the inside of a room.
    void room(const glm::vec3& low, const glm::vec3& high, float thickness,
              const io::GltfMaterial& material) {
        const glm::vec3 outerLow = low - thickness;
        const glm::vec3 outerHigh = high + thickness;
        for (int axis = 0; axis < 3; ++axis) {
            glm::vec3 a = outerLow, b = outerHigh;
            b[axis] = low[axis];
            box("wall", a, b, material);
            a = outerLow;
            a[axis] = high[axis];
            b = outerHigh;
            box("wall", a, b, material);
        }
    }
    lighting::Probe& probe(const std::string& name, const glm::dvec3& position,
                           const glm::dvec3& size, double blend) {
        lighting::Probe& probe = probes_.emplace_back();
        maps_.emplace_back();
        probe.name = name;
        probe.position = position;
        probe.capture.resolution = 32;
        probe.influence.size = size;
        probe.influence.blend.fill(blend);
        return probe;
    }
    /// Gives the last probe a file's light of one radiance.
    void holding(const glm::vec3& radiance, int width = 8) {
        lighting::Cubemap map(width);
        for (glm::vec4& texel : map.level(0)) {
            texel = glm::vec4(radiance, 1.0f);
        }
        maps_.back() = std::make_shared<const lighting::Cubemap>(std::move(map));
    }
    [[nodiscard]] scene::Scene make() const {
        scene::Scene scene = scene::buildScene(file_);
        core::Tally warnings;
        scene::setProbes(scene, probes_, maps_, warnings);
        scene::updateTransforms(scene);
        return scene;
    }

private:
    io::GltfFile file_;
    std::vector<lighting::Probe> probes_;
    std::vector<scene::ProbeMap> maps_;
};

/// Renders worlds.
class ProbeTest : public GlTest {
protected:
    std::unique_ptr<scene::Renderer> rendererOf(const scene::Scene& scene) {
        auto made = scene::Renderer::make(device(), scene);
        EXPECT_TRUE(made.ok()) << made.error().message();
        return std::move(*made);
    }
    static scene::Frame frameOf(scene::Renderer& renderer, const scene::View& view,
                                const scene::RenderSettings& settings) {
        auto frame = renderer.render(view, settings);
        EXPECT_TRUE(frame.ok()) << frame.error().message();
        return std::move(*frame);
    }
    static scene::RenderSettings small(int side) {
        scene::RenderSettings settings;
        settings.width = settings.height = side;
        settings.backdrop = false;
        return settings;
    }
};

inline lighting::Cubemap constantSky(double radiance) {
    return lighting::cubeFromAnalytic(lighting::ConstantEnvironment{glm::dvec3(radiance)}, 16);
}

inline scene::View lookAt(const scene::Scene& scene, const glm::vec3& eye, const glm::vec3& target,
                          float fov = 1.0f) {
    scene::CameraRequest request;
    request.eye = eye;
    request.target = target;
    request.verticalFov = fov;
    return *scene::chooseView(scene, request, 1.0f);
}

} // namespace lodestar::testing

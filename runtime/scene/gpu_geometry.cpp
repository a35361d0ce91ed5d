// SPDX-License-Identifier: MIT
#include "scene/gpu_geometry.h"

#include <map>
#include <span>

namespace lodestar::scene {
namespace {

/// Calls back with each attribute that a primitive has: its place, components, values.
template <class Take>
void forAttributes(const io::GltfPrimitive& primitive, const Take& take) {
    const auto give = [&](gl::Attribute attribute, const auto& values) {
        if (!values.empty()) {
            take(attribute, static_cast<int>(sizeof(values[0]) / sizeof(float)),
                 std::as_bytes(std::span(values)));
        }
    };
    give(gl::Attribute::Position, primitive.positions);
    give(gl::Attribute::Normal, primitive.normals);
    give(gl::Attribute::Tangent, primitive.tangents);
    give(gl::Attribute::Uv0, primitive.uvs[0]);
    give(gl::Attribute::Uv1, primitive.uvs[1]);
    give(gl::Attribute::Color, primitive.colors);
    constexpr gl::Attribute kJoints[] = {gl::Attribute::Joints0, gl::Attribute::Joints1};
    constexpr gl::Attribute kWeights[] = {gl::Attribute::Weights0, gl::Attribute::Weights1};
    for (std::size_t set = 0; set < io::kInfluenceSets; ++set) {
        // As floats: exact for 16 bits.
        const std::vector<glm::vec4> joints(primitive.joints[set].begin(),
                                            primitive.joints[set].end());
        give(kJoints[set], joints);
        give(kWeights[set], primitive.weights[set]);
    }
}

unsigned attributesOf(const io::GltfPrimitive& primitive) {
    unsigned set = 0;
    forAttributes(primitive, [&](gl::Attribute attribute, int, std::span<const std::byte>) {
        set |= 1u << static_cast<unsigned>(attribute);
    });
    return set;
}

gl::DrawMode modeOf(io::Topology topology) {
    return topology == io::Topology::Points  ? gl::DrawMode::Points
           : topology == io::Topology::Lines ? gl::DrawMode::Lines
                                             : gl::DrawMode::Triangles;
}

/// A pool in the making: how much it holds, and how much of that is there.
struct Filling {
    std::size_t pool = 0;
    std::size_t vertices = 0, indices = 0;
    std::size_t vertex = 0, index = 0;
};

GpuGeometry::Pool makePool(gl::Device& device, const io::GltfPrimitive& like,
                           const Filling& filling) {
    GpuGeometry::Pool pool;
    pool.vertices = gl::VertexArray(device);
    forAttributes(like, [&](gl::Attribute attribute, int components, std::span<const std::byte>) {
        const std::size_t each = sizeof(float) * static_cast<std::size_t>(components);
        pool.attributes.push_back(
            {attribute, components,
             gl::Buffer(device, gl::BufferKind::Vertex, each * filling.vertices)});
        pool.vertices.setAttribute(attribute, pool.attributes.back().buffer, components);
    });
    pool.indices =
        gl::Buffer(device, gl::BufferKind::Index, sizeof(std::uint32_t) * filling.indices);
    pool.vertices.setIndices(pool.indices);
    return pool;
}

} // namespace

GpuGeometry::GpuGeometry(gl::Device& device, const Scene& scene) {
    std::map<unsigned, Filling> fillings;
    for (const io::GltfMesh& mesh : scene.meshes) {
        for (const io::GltfPrimitive& primitive : mesh.primitives) {
            Filling& filling = fillings[attributesOf(primitive)];
            filling.vertices += primitive.positions.size();
            filling.indices += primitive.indices.size();
        }
    }
    for (const io::GltfMesh& mesh : scene.meshes) {
        std::vector<GpuPrimitive>& parts = meshes_.emplace_back();
        for (const io::GltfPrimitive& primitive : mesh.primitives) {
            Filling& filling = fillings[attributesOf(primitive)];
            if (filling.vertex == 0 && filling.index == 0) {
                filling.pool = pools_.size();
                pools_.push_back(makePool(device, primitive, filling));
            }
            Pool& pool = pools_[filling.pool];
            std::size_t k = 0;
            forAttributes(
                primitive, [&](gl::Attribute, int components, std::span<const std::byte> values) {
                    const std::size_t each = sizeof(float) * static_cast<std::size_t>(components);
                    pool.attributes[k++].buffer.updatePart(each * filling.vertex, values);
                });
            pool.indices.updatePart(sizeof(std::uint32_t) * filling.index,
                                    std::as_bytes(std::span(primitive.indices)));
            parts.push_back(
                {filling.pool,
                 modeOf(primitive.topology),
                 {static_cast<int>(filling.index), static_cast<int>(primitive.indices.size()),
                  static_cast<int>(filling.vertex)}});
            filling.vertex += primitive.positions.size();
            filling.index += primitive.indices.size();
        }
    }
}

} // namespace lodestar::scene

// SPDX-License-Identifier: MIT
#include "scene/gpu_deformation.h"

#include <algorithm>
#include <span>

#include <epoxy/gl.h>
#include <glm/geometric.hpp>

namespace lodestar::scene {
namespace {

glm::vec3 unitOr(const glm::vec3& v, const glm::vec3& otherwise) {
    const float length = glm::length(v);
    return length > 0.0f ? v / length : otherwise;
}

template <class T>
std::span<const std::byte> bytesOf(const std::vector<T>& values) {
    return std::as_bytes(std::span(values));
}

void makeFlatNormals(const io::GltfPrimitive& primitive, MorphedVertices& vertices) {
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
        const std::uint32_t* corner = &primitive.indices[i];
        const glm::vec3& a = vertices.positions[corner[0]];
        const glm::vec3 normal =
            unitOr(glm::cross(vertices.positions[corner[1]] - a, vertices.positions[corner[2]] - a),
                   primitive.normals[corner[0]]);
        for (int k = 0; k < 3; ++k) {
            vertices.normals[corner[k]] = normal;
        }
    }
}

/// The determinant's sign of the matrix whose rows begin here.
bool mirrors(const glm::vec4* rows) {
    return glm::dot(glm::cross(glm::vec3(rows[0]), glm::vec3(rows[1])), glm::vec3(rows[2])) < 0.0f;
}

/// All joints of all skins that nodes wear; `firstTexels` says where each skin's begin.
std::vector<glm::vec4> jointRows(const Scene& scene, const std::vector<std::size_t>& firstTexels) {
    std::vector<glm::vec4> rows;
    for (std::size_t s = 0; s < scene.skins.size(); ++s) {
        const bool worn = s + 1 < firstTexels.size() && firstTexels[s + 1] > firstTexels[s];
        for (const glm::mat4& m :
             worn ? jointMatrices(scene, scene.skins[s]) : std::vector<glm::mat4>()) {
            for (glm::length_t r = 0; r < 3; ++r) {
                rows.emplace_back(m[0][r], m[1][r], m[2][r], m[3][r]);
            }
        }
    }
    return rows;
}

const MeshComponent& componentOf(const Scene& scene, const DrawItem& item) {
    return std::get<MeshComponent>(scene.nodes[static_cast<std::size_t>(item.node)]
                                       .components[static_cast<std::size_t>(item.component)]);
}

const io::GltfPrimitive& primitiveOf(const Scene& scene, const DrawItem& item) {
    return scene.meshes[static_cast<std::size_t>(item.mesh)]
        .primitives[static_cast<std::size_t>(item.primitive)];
}

/// How much of a primitive follows each joint, in vertices; empty if none does.
std::vector<double> followersOf(const io::GltfPrimitive& primitive) {
    std::vector<double> followers;
    for (std::size_t set = 0; set < io::kInfluenceSets; ++set) {
        for (std::size_t i = 0; i < primitive.joints[set].size(); ++i) {
            for (glm::length_t k = 0; k < 4; ++k) {
                const std::size_t joint = primitive.joints[set][i][k];
                followers.resize(std::max(followers.size(), joint + 1));
                followers[joint] += double{primitive.weights[set][i][k]};
            }
        }
    }
    return followers;
}

} // namespace

MorphedVertices morph(const io::GltfPrimitive& primitive, const std::vector<float>& weights) {
    MorphedVertices result{primitive.positions, primitive.normals, primitive.tangents};
    for (std::size_t t = 0; t < primitive.targets.size(); ++t) {
        const io::GltfMorphTarget& target = primitive.targets[t];
        const float weight = weights[t];
        if (weight == 0.0f) {
            continue;
        }
        for (std::size_t i = 0; i < target.positions.size(); ++i) {
            result.positions[i] += weight * target.positions[i];
        }
        for (std::size_t i = 0; i < target.normals.size(); ++i) {
            result.normals[i] += weight * target.normals[i];
        }
        for (std::size_t i = 0; i < target.tangents.size(); ++i) {
            result.tangents[i] += glm::vec4(weight * target.tangents[i], 0.0f);
        }
    }
    for (std::size_t i = 0; i < result.normals.size(); ++i) {
        result.normals[i] = unitOr(result.normals[i], primitive.normals[i]);
    }
    for (std::size_t i = 0; i < result.tangents.size(); ++i) {
        const glm::vec3 unit =
            unitOr(glm::vec3(result.tangents[i]), glm::vec3(primitive.tangents[i]));
        result.tangents[i] = glm::vec4(unit, primitive.tangents[i].w);
    }
    if (primitive.flatNormals) {
        makeFlatNormals(primitive, result);
    }
    return result;
}

core::Result<GpuDeformation> GpuDeformation::make(gl::Device& device, const Scene& scene,
                                                  const std::vector<DrawItem>& items) {
    GpuDeformation result;
    const std::vector<bool> worn = wornSkins(scene);
    for (const DrawItem& item : items) {
        std::optional<Morph>& morph = result.morphs_.emplace_back();
        if (!primitiveOf(scene, item).targets.empty()) {
            morph.emplace().vertices = gl::VertexArray(device);
        }
        result.followers_.push_back(followersOf(primitiveOf(scene, item)));
    }
    std::size_t texels = 0;
    for (std::size_t s = 0; s < scene.skins.size(); ++s) {
        result.firstTexels_.push_back(texels);
        texels += worn[s] ? kTexelsPerJoint * scene.skins[s].joints.size() : 0;
    }
    result.firstTexels_.push_back(texels);
    if (texels == 0) {
        return result;
    }
    GLint most = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
    if (texels > static_cast<std::size_t>(most)) {
        return core::Error{core::ErrorCode::NoOpenGl,
                           "the skins' joints take " + std::to_string(texels) +
                               " texels of a buffer texture, the driver has " +
                               std::to_string(most),
                           {},
                           {}};
    }
    unsigned id = 0;
    glGenTextures(1, &id);
    result.jointTexture_ = gl::Texture::adopt(device, id, GL_TEXTURE_BUFFER);
    return result;
}

bool GpuDeformation::deforms() const {
    return firstTexels_.back() > 0 ||
           std::any_of(morphs_.begin(), morphs_.end(),
                       [](const auto& morph) { return morph.has_value(); });
}

void GpuDeformation::describe(const Scene& scene, const std::vector<DrawItem>& items,
                              plan::PlanInput& input) {
    joints_ = jointRows(scene, firstTexels_);
    input.jointsMoved = joints_ != uploadedJoints_;
    for (std::size_t i = 0; i < morphs_.size(); ++i) {
        if (plan::has(input.draws[i].features, plan::Feature::Skinning)) {
            input.draws[i].mirrored = mirrored(i, componentOf(scene, items[i]).skin);
        }
        if (morphs_[i]) {
            input.draws[i].weightsChanged =
                morphs_[i]->uploaded != componentOf(scene, items[i]).weights;
        }
    }
}

void GpuDeformation::prepare(gl::Device& device, const Scene& scene,
                             const std::vector<DrawItem>& items, const GpuScene& gpu,
                             const plan::EffectPlan& plan) {
    if (plan.runs("skinning")) {
        if (!jointBuffer_) {
            jointBuffer_.emplace(device, gl::BufferKind::Texel, bytesOf(joints_));
            jointTexture_.bind(kJointUnit);
            glTexBuffer(GL_TEXTURE_BUFFER, GL_RGBA32F, jointBuffer_->id());
        } else {
            jointBuffer_->update(bytesOf(joints_));
        }
        uploadedJoints_ = joints_;
    }
    for (const std::size_t index : plan.deformed) {
        if (!morphs_[index]) {
            continue;
        }
        const DrawItem& item = items[index];
        const std::vector<float>& weights = componentOf(scene, item).weights;
        if (morphs_[index]->uploaded != weights) {
            uploadMorph(device, primitiveOf(scene, item), weights, gpu.geometry(),
                        gpu.geometry().primitive(item.mesh, item.primitive), *morphs_[index]);
        }
    }
}

void GpuDeformation::uploadMorph(gl::Device& device, const io::GltfPrimitive& primitive,
                                 const std::vector<float>& weights, const GpuGeometry& geometry,
                                 const GpuPrimitive& shared, Morph& target) {
    const MorphedVertices vertices = morph(primitive, weights);
    const bool first = target.uploaded.empty();
    const auto put = [&](gl::Attribute attribute, gl::Buffer& buffer, const auto& values) {
        if (values.empty()) {
            return;
        }
        if (!first) {
            buffer.update(bytesOf(values));
            return;
        }
        buffer = gl::Buffer(device, gl::BufferKind::Vertex, bytesOf(values));
        target.vertices.setAttribute(attribute, buffer,
                                     static_cast<int>(sizeof(values[0]) / sizeof(float)));
    };
    if (first) {
        // What is not morphed is the primitive's own.
        const GpuGeometry::Pool& pool = geometry.pool(shared);
        for (const GpuGeometry::Stored& stored : pool.attributes) {
            target.vertices.setAttribute(stored.attribute, stored.buffer, stored.components,
                                         shared.indices.baseVertex);
        }
        target.vertices.setIndices(pool.indices);
    }
    put(gl::Attribute::Position, target.positions, vertices.positions);
    put(gl::Attribute::Normal, target.normals, vertices.normals);
    put(gl::Attribute::Tangent, target.tangents, vertices.tangents);
    target.uploaded = weights;
}

void GpuDeformation::bind() const {
    if (jointTexture_) {
        jointTexture_.bind(kJointUnit);
    }
}

float GpuDeformation::firstTexel(int skin) const {
    return skin == io::kNone ? 0.0f
                             : static_cast<float>(firstTexels_[static_cast<std::size_t>(skin)]);
}

bool GpuDeformation::mirrored(std::size_t item, int skin) const {
    const glm::vec4* rows = &joints_[firstTexels_[static_cast<std::size_t>(skin)]];
    double straight = 0.0;
    for (const double count : followers_[item]) {
        straight += mirrors(rows) ? -count : count;
        rows += kTexelsPerJoint;
    }
    return straight < 0.0;
}

const gl::VertexArray* GpuDeformation::vertices(std::size_t item) const {
    return morphs_[item] ? &morphs_[item]->vertices : nullptr;
}

} // namespace lodestar::scene

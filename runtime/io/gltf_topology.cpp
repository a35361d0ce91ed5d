// SPDX-License-Identifier: MIT
//
// Lists from strips, and normals from triangles. Source: glTF 2.0 specification, section 3.7.2.1.
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "io/gltf_internal.h"

namespace lodestar::io::detail {
namespace {

/// In double: the cross product of edges near the largest float would overflow in float.
glm::dvec3 faceNormal(const GltfPrimitive& primitive, std::size_t triangle) {
    const auto corner = [&](std::size_t k) {
        return glm::dvec3(primitive.positions[primitive.indices[3 * triangle + k]]);
    };
    const glm::dvec3 a = corner(0);
    return glm::cross(corner(1) - a, corner(2) - a);
}

/// Unit, or +Z where there is no direction: a normal is never zero and never NaN.
glm::vec3 unitOr(const glm::dvec3& v, const glm::vec3& fallback) {
    const double length = glm::length(v);
    return length > 0.0 && std::isfinite(length) ? glm::vec3(v / length) : fallback;
}

constexpr glm::vec3 kAnyNormal{0.0f, 0.0f, 1.0f};

template <class T>
std::vector<T> gathered(const std::vector<T>& values, const std::vector<std::uint32_t>& indices) {
    std::vector<T> result;
    if (!values.empty()) {
        result.reserve(indices.size());
        for (const std::uint32_t index : indices) {
            result.push_back(values[index]);
        }
    }
    return result;
}

glm::vec3 perpendicular(const glm::vec3& n) {
    const glm::vec3 other =
        std::abs(n.x) < 0.9f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
    return glm::normalize(glm::cross(n, other));
}

bool finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

} // namespace

std::vector<std::uint32_t> unrolled(const std::vector<std::uint32_t>& in, int mode) {
    const std::size_t n = in.size();
    std::vector<std::uint32_t> out;
    const auto add = [&](std::initializer_list<std::size_t> corners) {
        for (const std::size_t corner : corners) {
            out.push_back(in[corner]);
        }
    };
    switch (mode) {
    case TINYGLTF_MODE_LINE:
    case TINYGLTF_MODE_TRIANGLES: {
        const std::size_t corners = mode == TINYGLTF_MODE_LINE ? 2 : 3;
        out.assign(in.begin(), in.begin() + static_cast<std::ptrdiff_t>(n / corners * corners));
        break;
    }
    case TINYGLTF_MODE_LINE_LOOP:
    case TINYGLTF_MODE_LINE_STRIP:
        for (std::size_t i = 0; i + 1 < n; ++i) {
            add({i, i + 1});
        }
        if (mode == TINYGLTF_MODE_LINE_LOOP && n >= 2) {
            add({n - 1, 0});
        }
        break;
    case TINYGLTF_MODE_TRIANGLE_STRIP:
        for (std::size_t i = 0; i + 2 < n; ++i) {
            add({i, i + 1 + i % 2, i + 2 - i % 2}); // every other one is wound the other way
        }
        break;
    case TINYGLTF_MODE_TRIANGLE_FAN:
        for (std::size_t i = 1; i + 1 < n; ++i) {
            add({i, i + 1, 0});
        }
        break;
    default:
        out = in;
        break;
    }
    return out;
}

void makeFlat(GltfPrimitive& primitive) {
    const std::size_t triangles = primitive.indices.size() / 3;
    std::vector<glm::vec3> normals(primitive.indices.size());
    for (std::size_t t = 0; t < triangles; ++t) {
        std::fill_n(normals.begin() + static_cast<std::ptrdiff_t>(3 * t), 3,
                    unitOr(faceNormal(primitive, t), kAnyNormal));
    }
    primitive.positions = gathered(primitive.positions, primitive.indices);
    primitive.colors = gathered(primitive.colors, primitive.indices);
    for (std::vector<glm::vec2>& uvs : primitive.uvs) {
        uvs = gathered(uvs, primitive.indices);
    }
    for (std::size_t set = 0; set < kInfluenceSets; ++set) {
        primitive.joints[set] = gathered(primitive.joints[set], primitive.indices);
        primitive.weights[set] = gathered(primitive.weights[set], primitive.indices);
    }
    for (GltfMorphTarget& target : primitive.targets) {
        target.positions = gathered(target.positions, primitive.indices);
        target.normals.clear(); // as the tangents: deltas of normals that are not there
        target.tangents.clear();
    }
    primitive.flatNormals = true;
    primitive.normals = std::move(normals);
    primitive.tangents.clear(); // given tangents belong to given normals only
    for (std::size_t i = 0; i < primitive.indices.size(); ++i) {
        primitive.indices[i] = static_cast<std::uint32_t>(i);
    }
}

void repairNormals(GltfPrimitive& primitive, core::Tally& warnings) {
    std::vector<bool> bad(primitive.normals.size());
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < primitive.normals.size(); ++i) {
        glm::vec3& n = primitive.normals[i];
        const double length = glm::length(glm::dvec3(n));
        // Denormal lengths lose their direction to rounding.
        bad[i] = !finite(n) || !(length > 1e-20);
        count += bad[i] ? 1U : 0U;
        n = bad[i] ? glm::vec3(0.0f) : glm::vec3(glm::dvec3(n) / length);
    }
    if (count == 0) {
        return;
    }
    warnings.add("normal zero or not finite, taken from its triangles", count);
    std::vector<glm::dvec3> sums(primitive.normals.size(), glm::dvec3(0.0));
    if (primitive.topology == Topology::Triangles) {
        for (std::size_t t = 0; t < primitive.indices.size() / 3; ++t) {
            const glm::dvec3 normal = faceNormal(primitive, t);
            for (std::size_t k = 0; k < 3; ++k) {
                sums[primitive.indices[3 * t + k]] += normal;
            }
        }
    }
    for (std::size_t i = 0; i < bad.size(); ++i) {
        if (bad[i]) {
            primitive.normals[i] = unitOr(sums[i], kAnyNormal);
        }
    }
}

void repairTangents(GltfPrimitive& primitive, core::Tally& warnings) {
    std::uint64_t count = 0;
    for (std::size_t i = 0; i < primitive.tangents.size(); ++i) {
        glm::vec4& tangent = primitive.tangents[i];
        const glm::vec3 t(tangent);
        const double length = glm::length(glm::dvec3(t));
        const bool good = finite(t) && length > 1e-20;
        count += good && std::isfinite(tangent.w) ? 0U : 1U;
        const glm::vec3 unit =
            good ? glm::vec3(glm::dvec3(t) / length)
                 : perpendicular(primitive.normals.empty() ? kAnyNormal : primitive.normals[i]);
        tangent = glm::vec4(unit, tangent.w < 0.0f ? -1.0f : 1.0f);
    }
    warnings.add("tangent zero or not finite, replaced", count);
}

} // namespace lodestar::io::detail

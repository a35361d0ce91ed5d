// SPDX-License-Identifier: MIT
//
// Shapes by parametric surfaces. Metres, +Y up; u runs to the right and v downwards as an image
// laid on the front of the surface does, triangles are counter-clockwise seen from the front.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace lodestar::samples {

struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec4> tangents; ///< along +u; w: the handedness of (normal, tangent, image up)
    std::vector<glm::vec2> uvs;
    std::vector<glm::vec2> uvs1; ///< second set; empty or one a vertex
    std::vector<std::uint32_t> indices;

    /// Adds another mesh, moved.
    void append(const Mesh& other, const glm::vec3& offset = glm::vec3(0.0f));
};

/// A point of a surface for (u, v) in [0, 1].
using Surface = std::function<glm::vec3(float u, float v)>;

/// Tessellates a surface into columns x rows quads; uvs are (u, v) times repeat. Normals are those
/// of the surface; where it has a pole, the limit along v. Triangles without area are left out.
[[nodiscard]] Mesh tessellate(const Surface& surface, int columns, int rows,
                              const glm::vec2& repeat = glm::vec2(1.0f));

/// A smooth curve through points, t in [0, 1] (Catmull-Rom, ends repeated).
[[nodiscard]] glm::vec2 splinePoint(const std::vector<glm::vec2>& points, float t);

/// A profile (radius, height), listed from the top downwards, turned about +Y.
[[nodiscard]] Mesh lathe(const std::vector<glm::vec2>& profile, int columns, int rows,
                         const glm::vec2& repeat = glm::vec2(1.0f));

/// A tube along a spline in the plane z = 0, with rounded ends.
[[nodiscard]] Mesh tube(const std::vector<glm::vec2>& path, const std::vector<glm::vec2>& radii,
                        int columns, int rows);

[[nodiscard]] Mesh sphere(float radius, int columns = 96, int rows = 48);

/// A box with rounded edges, each side with the whole image on it.
/// @param half half extents  @param round radius of the edges, < the least half extent
[[nodiscard]] Mesh roundedBox(const glm::vec3& half, float round,
                              const glm::vec2& repeat = glm::vec2(1.0f));

/// Our test shape: a lidded ewer with spout (+X) and handle (-X), standing on y = 0, 1.4 high, some
/// 20,000 triangles.
[[nodiscard]] Mesh ewer();

/// A fluted column standing on y = 0.
[[nodiscard]] Mesh column(float height, float radius);

} // namespace lodestar::samples

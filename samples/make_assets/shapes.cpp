// SPDX-License-Identifier: MIT
#include "shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace lodestar::samples {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
/// Step of the difference quotients: large enough for float positions of metres.
constexpr float kStep = 2e-3f;

/// Derivative by central differences, one-sided at the ends.
glm::vec3 slope(const Surface& surface, float u, float v, bool alongU) {
    const float at = alongU ? u : v;
    const float lo = std::max(at - kStep, 0.0f);
    const float hi = std::min(at + kStep, 1.0f);
    const glm::vec3 a = alongU ? surface(lo, v) : surface(u, lo);
    const glm::vec3 b = alongU ? surface(hi, v) : surface(u, hi);
    return (b - a) / (hi - lo);
}

void addTriangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const glm::vec3 area =
        glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
    if (glm::dot(area, area) > 1e-20f) {
        mesh.indices.insert(mesh.indices.end(), {a, b, c});
    }
}

void addGridIndices(Mesh& mesh, std::uint32_t first, int columns, int rows) {
    const auto stride = static_cast<std::uint32_t>(columns + 1);
    for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(rows); ++j) {
        for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(columns); ++i) {
            const std::uint32_t a = first + j * stride + i;
            addTriangle(mesh, a, a + stride, a + stride + 1);
            addTriangle(mesh, a, a + stride + 1, a + 1);
        }
    }
}

void addVertex(Mesh& mesh, const glm::vec3& position, const glm::vec3& normal,
               const glm::vec3& alongU, const glm::vec2& uv) {
    const glm::vec3 t = alongU - normal * glm::dot(alongU, normal);
    const float length = glm::length(t);
    const glm::vec3 axis = std::abs(normal.x) < 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1);
    const glm::vec3 tangent =
        length > 1e-6f ? t / length : glm::normalize(glm::cross(normal, axis));
    mesh.positions.push_back(position);
    mesh.normals.push_back(normal);
    mesh.tangents.emplace_back(tangent, 1.0f);
    mesh.uvs.push_back(uv);
}

/// Roundness of a tube's ends: 0 at the tip, 1 further in than `reach`.
float roundEnd(float t, float reach) {
    const float x = std::clamp(std::min(t, 1.0f - t) / reach, 0.0f, 1.0f);
    return std::sqrt(x * (2.0f - x));
}

} // namespace

void Mesh::append(const Mesh& other, const glm::vec3& offset) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const glm::vec3& p : other.positions) {
        positions.push_back(p + offset);
    }
    normals.insert(normals.end(), other.normals.begin(), other.normals.end());
    tangents.insert(tangents.end(), other.tangents.begin(), other.tangents.end());
    uvs.insert(uvs.end(), other.uvs.begin(), other.uvs.end());
    uvs1.insert(uvs1.end(), other.uvs1.begin(), other.uvs1.end());
    for (const std::uint32_t index : other.indices) {
        indices.push_back(first + index);
    }
}

Mesh tessellate(const Surface& surface, int columns, int rows, const glm::vec2& repeat) {
    Mesh mesh;
    for (int j = 0; j <= rows; ++j) {
        for (int i = 0; i <= columns; ++i) {
            const float u = static_cast<float>(i) / static_cast<float>(columns);
            const float v = static_cast<float>(j) / static_cast<float>(rows);
            const glm::vec3 alongV = slope(surface, u, v, false);
            glm::vec3 alongU = slope(surface, u, v, true);
            if (glm::length(alongU) < 1e-3f) { // a pole: look a little way along v
                alongU = slope(surface, u, std::clamp(v, 4.0f * kStep, 1.0f - 4.0f * kStep), true);
            }
            const glm::vec3 cross = glm::cross(alongV, alongU);
            const float length = glm::length(cross);
            const glm::vec3 normal = length > 1e-12f ? cross / length : glm::vec3(0.0f, 1.0f, 0.0f);
            addVertex(mesh, surface(u, v), normal, alongU, glm::vec2(u, v) * repeat);
        }
    }
    addGridIndices(mesh, 0, columns, rows);
    return mesh;
}

glm::vec2 splinePoint(const std::vector<glm::vec2>& points, float t) {
    const int last = static_cast<int>(points.size()) - 1;
    const float x = std::clamp(t, 0.0f, 1.0f) * static_cast<float>(last);
    const int i = std::min(static_cast<int>(x), last - 1);
    const float f = x - static_cast<float>(i);
    const auto at = [&](int k) { return points[static_cast<std::size_t>(std::clamp(k, 0, last))]; };
    const glm::vec2 a = at(i - 1);
    const glm::vec2 b = at(i);
    const glm::vec2 c = at(i + 1);
    const glm::vec2 d = at(i + 2);
    return b +
           0.5f * f *
               (c - a + f * (2.0f * a - 5.0f * b + 4.0f * c - d + f * (3.0f * (b - c) + d - a)));
}

Mesh lathe(const std::vector<glm::vec2>& profile, int columns, int rows, const glm::vec2& repeat) {
    const auto surface = [&](float u, float v) {
        const glm::vec2 p = splinePoint(profile, v);
        const float angle = 2.0f * kPi * u;
        const float radius = std::max(p.x, 0.0f);
        return glm::vec3(radius * std::sin(angle), p.y, radius * std::cos(angle));
    };
    return tessellate(surface, columns, rows, repeat);
}

Mesh tube(const std::vector<glm::vec2>& path, const std::vector<glm::vec2>& radii, int columns,
          int rows) {
    const auto surface = [&](float u, float v) {
        const glm::vec2 p = splinePoint(path, v);
        const glm::vec2 along = splinePoint(path, std::min(v + kStep, 1.0f)) -
                                splinePoint(path, std::max(v - kStep, 0.0f));
        const glm::vec2 side = glm::normalize(glm::vec2(-along.y, along.x));
        const glm::vec2 radius = splinePoint(radii, v) * roundEnd(v, 0.06f);
        const float angle = 2.0f * kPi * u;
        const glm::vec2 across = p + side * (radius.x * std::sin(angle));
        return glm::vec3(across.x, across.y, radius.y * std::cos(angle));
    };
    return tessellate(surface, columns, rows);
}

Mesh sphere(float radius, int columns, int rows) {
    Mesh mesh = tessellate(
        [=](float u, float v) {
            const float angle = 2.0f * kPi * u;
            const float polar = kPi * v;
            return radius * glm::vec3(std::sin(polar) * std::sin(angle), std::cos(polar),
                                      std::sin(polar) * std::cos(angle));
        },
        columns, rows);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) { // exact, poles included
        mesh.normals[i] = glm::normalize(mesh.positions[i]);
        const glm::vec3 n = mesh.normals[i];
        const glm::vec3 t =
            glm::vec3(mesh.tangents[i]) - n * glm::dot(glm::vec3(mesh.tangents[i]), n);
        mesh.tangents[i] = glm::vec4(glm::normalize(t), 1.0f);
    }
    return mesh;
}

Mesh roundedBox(const glm::vec3& half, float round, const glm::vec2& repeat) {
    struct Face {
        glm::vec3 right, down, out;
    };
    static const std::array<Face, 6> kFaces = {{
        {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
        {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
        {{0, 0, -1}, {0, -1, 0}, {1, 0, 0}},
        {{0, 0, 1}, {0, -1, 0}, {-1, 0, 0}},
        {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
        {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
    }};
    constexpr int kBevel = 5; // quads across the half of an edge's round
    std::vector<float> steps; // 0 to 1: the round, the flat, the round
    for (int i = 0; i <= kBevel; ++i) {
        steps.push_back(static_cast<float>(i) / kBevel);
    }
    const int count = 2 * kBevel + 1;
    Mesh mesh;
    for (const Face& face : kFaces) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        const float halfU = glm::dot(glm::abs(face.right), half);
        const float halfV = glm::dot(glm::abs(face.down), half);
        // Places along an edge, in angles of 45 degrees over the round, so that normals step
        // evenly.
        const auto place = [&](int i, float extent) {
            const int k = i <= kBevel ? i : count - i;
            const float angle = 0.25f * kPi * (1.0f - steps[static_cast<std::size_t>(k)]);
            const float p = extent - round + round * std::tan(angle);
            return i <= kBevel ? -p : p;
        };
        for (int j = 0; j <= count; ++j) {
            for (int i = 0; i <= count; ++i) {
                const float u = place(i, halfU);
                const float v = place(j, halfV);
                const glm::vec3 p =
                    face.right * u + face.down * v + face.out * glm::dot(glm::abs(face.out), half);
                const glm::vec3 inner = glm::clamp(p, -half + round, half - round);
                const glm::vec3 normal = glm::normalize(p - inner);
                const glm::vec2 uv{0.5f + 0.5f * u / halfU, 0.5f + 0.5f * v / halfV};
                addVertex(mesh, inner + normal * round, normal, face.right, uv * repeat);
            }
        }
        addGridIndices(mesh, first, count, count);
    }
    return mesh;
}

Mesh ewer() {
    const std::vector<glm::vec2> body = {
        {0.0f, 1.40f},  {0.05f, 1.39f},  {0.085f, 1.34f},  {0.05f, 1.28f},   {0.07f, 1.235f},
        {0.20f, 1.20f}, {0.30f, 1.13f},  {0.335f, 1.085f}, {0.30f, 1.05f},   {0.27f, 0.99f},
        {0.33f, 0.90f}, {0.48f, 0.76f},  {0.57f, 0.58f},   {0.56f, 0.40f},   {0.44f, 0.22f},
        {0.29f, 0.12f}, {0.27f, 0.085f}, {0.36f, 0.045f},  {0.375f, 0.015f}, {0.33f, 0.0f},
        {0.0f, 0.0f}};
    Mesh mesh = lathe(body, 88, 96);
    const std::vector<glm::vec2> spout = {{0.42f, 0.36f}, {0.62f, 0.42f}, {0.74f, 0.60f},
                                          {0.80f, 0.82f}, {0.88f, 0.97f}, {0.97f, 1.05f}};
    mesh.append(tube(spout,
                     {{0.15f, 0.17f},
                      {0.13f, 0.14f},
                      {0.09f, 0.095f},
                      {0.065f, 0.07f},
                      {0.055f, 0.06f},
                      {0.065f, 0.065f}},
                     32, 40));
    const std::vector<glm::vec2> handle = {{-0.26f, 0.98f}, {-0.44f, 1.07f}, {-0.68f, 1.05f},
                                           {-0.83f, 0.88f}, {-0.82f, 0.64f}, {-0.66f, 0.44f},
                                           {-0.46f, 0.36f}};
    mesh.append(
        tube(handle, {{0.045f, 0.06f}, {0.045f, 0.07f}, {0.05f, 0.07f}, {0.05f, 0.06f}}, 24, 48));
    return mesh;
}

Mesh column(float height, float radius) {
    constexpr int kFlutes = 16;
    const auto shaft = [=](float u, float v) {
        const float angle = 2.0f * kPi * u;
        // Narrower above, with a slight swelling; flutes fade out at both ends.
        const float taper = 0.84f + 0.16f * std::sqrt(v);
        const float ends = std::clamp(std::min(v, 1.0f - v) * 30.0f - 0.4f, 0.0f, 1.0f);
        const float flute = std::abs(std::sin(0.5f * kFlutes * angle));
        const float r = radius * taper * (1.0f - 0.075f * ends * (1.0f - flute));
        return glm::vec3(r * std::sin(angle), height * (0.94f - 0.88f * v), r * std::cos(angle));
    };
    Mesh mesh = tessellate(shaft, kFlutes * 10, 48, {2.0f, 4.0f});
    const float r = radius;
    const float top = height;
    mesh.append(lathe({{0.86f * r, top * 0.975f},
                       {1.12f * r, top * 0.97f},
                       {1.16f * r, top * 0.96f},
                       {1.0f * r, top * 0.95f},
                       {0.88f * r, top * 0.945f},
                       {0.92f * r, top * 0.935f},
                       {0.8f * r, top * 0.925f}},
                      64, 24));
    mesh.append(roundedBox({1.25f * r, 0.0125f * height, 1.25f * r}, 0.006f * height),
                {0.0f, top * 0.9875f, 0.0f});
    mesh.append(lathe({{0.95f * r, top * 0.07f},
                       {1.1f * r, top * 0.065f},
                       {1.16f * r, top * 0.056f},
                       {1.06f * r, top * 0.047f},
                       {1.1f * r, top * 0.042f},
                       {1.3f * r, top * 0.034f},
                       {1.3f * r, top * 0.022f},
                       {1.2f * r, top * 0.017f}},
                      64, 24));
    mesh.append(roundedBox({1.4f * r, 0.0125f * height, 1.4f * r}, 0.006f * height),
                {0.0f, top * 0.0125f, 0.0f});
    return mesh;
}

} // namespace lodestar::samples

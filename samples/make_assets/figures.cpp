// SPDX-License-Identifier: MIT
//
// Scenes after the figures of the papers: one thing changes at a time.
#include "scenes.h"

#include <array>
#include <cmath>
#include <string>

#include <glm/trigonometric.hpp>

#include "gltf_writer.h"
#include "io/image_file.h"
#include "textures.h"

namespace lodestar::samples {
namespace {

/// Vertical field of view in degrees that shows `height` metres at a distance.
float fovFor(float height, float distance) {
    return glm::degrees(2.0f * std::atan(0.5f * height / distance));
}

struct Reflectance {
    const char* name;
    glm::vec3 diffuse;
    glm::vec3 f0;
};

/// The crate's material, its normal map left out on request.
Json crateMaterial(GltfWriter& writer, bool withNormals) {
    const int color = writer.addTexture("crate_color.png");
    const int exponent = writer.addTexture("crate_exponent.png");
    const int occlusion = writer.addTexture("crate_occlusion.png");
    Json material{{"name", "crate"},
                  {"pbrMetallicRoughness",
                   {{"baseColorTexture", {{"index", color}}},
                    {"metallicFactor", 0.0f},
                    {"roughnessFactor", 0.6f}}},
                  {"occlusionTexture", {{"index", occlusion}}},
                  {"extras",
                   {{"lodestar",
                     {{"diffuse", {1.0f, 1.0f, 1.0f}},
                      {"f0", {0.11f, 0.105f, 0.10f}},
                      {"exponentTexture", {{"index", exponent}}},
                      {"exponentEncoding", "log2"},
                      {"exponentScale", kExponentScale}}}}}};
    if (withNormals) {
        material["normalTexture"] = {{"index", writer.addTexture("crate_normal.png")}};
    }
    return material;
}

core::Result<void> writeCrate(const std::filesystem::path& folder, const std::string& name,
                              bool withNormals) {
    GltfWriter writer(name);
    const int wood = writer.addMaterial(crateMaterial(writer, withNormals));
    const int slab = writer.addBlinnPhong("slab", {0.36f, 0.29f, 0.21f}, glm::vec3(0.04f), 24);
    writer.material(slab)["occlusionTexture"] = {{"index", writer.addTexture("crate_shadow.png")}};
    const int crate = writer.addMesh("crate", roundedBox(glm::vec3(0.5f), 0.022f), wood);
    const int ground = writer.addMesh("slab", roundedBox({1.6f, 0.06f, 1.6f}, 0.02f), slab);
    writer.addNode("slab", ground, {0.0f, -0.06f, 0.0f});
    writer.addNode("crate", crate, {0.0f, 0.5f, 0.0f}, turn(-32.0f));
    writer.addCamera("front", {0.15f, 1.45f, 3.1f}, {0.0f, 0.42f, 0.0f}, 30.0f);
    return writer.write(folder);
}

} // namespace

core::Result<void> writeFigure1(const std::filesystem::path& folder) {
    constexpr float kSpacing = 2.0f;
    static const std::array<Json, 7> kExponents = {1, 4, 16, 64, 256, 1024, "mirror"};
    GltfWriter writer("figure1");
    for (std::size_t i = 0; i < kExponents.size(); ++i) {
        const std::string label = kExponents[i].is_string() ? "mirror" : kExponents[i].dump();
        const int material = writer.addBlinnPhong("exponent " + label, {0.16f, 0.045f, 0.022f},
                                                  {0.58f, 0.53f, 0.47f}, kExponents[i]);
        const int mesh = i == 0 ? writer.addMesh("ewer " + label, ewer(), material)
                                : writer.addMeshLike("ewer " + label, 0, material);
        const float x = kSpacing * (static_cast<float>(i) - 3.0f);
        writer.addNode("ewer " + label, mesh, {x - 0.04f, -0.7f, 0.0f}, turn(-18.0f));
    }
    // The row fills the width of a 7:1 picture; from afar, so that all are seen alike.
    writer.addCamera("row", {0.0f, 9.0f, 38.0f}, {0.0f, 0.0f, 0.0f},
                     fovFor(kSpacing, std::hypot(9.0f, 38.0f)));
    return writer.write(folder);
}

core::Result<void> writeFigure2(const std::filesystem::path& folder) {
    static const std::array<Json, 8> kExponents = {0, 1, 4, 16, 64, 256, 1024, "mirror"};
    static const std::array<Reflectance, 5> kRows = {{
        {"glaze 0.04", {0.50f, 0.055f, 0.03f}, glm::vec3(0.04f)},
        {"0.2", {0.03f, 0.20f, 0.24f}, glm::vec3(0.2f)},
        {"0.5", {0.12f, 0.12f, 0.13f}, glm::vec3(0.5f)},
        {"gold", glm::vec3(0.0f), {1.0f, 0.71f, 0.29f}},
        {"silver", glm::vec3(0.0f), {0.95f, 0.94f, 0.92f}},
    }};
    constexpr float kSpacing = 1.0f;
    GltfWriter writer("figure2");
    for (std::size_t row = 0; row < kRows.size(); ++row) {
        for (std::size_t column = 0; column < kExponents.size(); ++column) {
            const std::string label =
                std::string(kRows[row].name) + ", exponent " +
                (kExponents[column].is_string() ? "mirror" : kExponents[column].dump());
            const int material =
                writer.addBlinnPhong(label, kRows[row].diffuse, kRows[row].f0, kExponents[column]);
            const int mesh = row + column == 0
                                 ? writer.addMesh(label, sphere(0.46f, 80, 40), material)
                                 : writer.addMeshLike(label, 0, material);
            writer.addNode(label, mesh,
                           {kSpacing * (static_cast<float>(column) - 3.5f),
                            kSpacing * (2.0f - static_cast<float>(row)), 0.0f});
        }
    }
    writer.addCamera("grid", {0.0f, 0.0f, 60.0f}, glm::vec3(0.0f), fovFor(5.0f * kSpacing, 60.0f));
    return writer.write(folder);
}

core::Result<void> writeFigure3(const std::filesystem::path& folder) {
    const Material crate = crateSide(1024);
    // Balls that stand in for the crate, turned as it is; they fill it well enough for a soft
    // shadow.
    std::vector<Occluder> balls;
    const float angle = glm::radians(-32.0f);
    for (const glm::vec2 at :
         {glm::vec2(-0.3f, -0.3f), glm::vec2(0.3f, -0.3f), glm::vec2(-0.3f, 0.3f),
          glm::vec2(0.3f, 0.3f), glm::vec2(0.0f, 0.0f)}) {
        const float x = at.x * std::cos(angle) + at.y * std::sin(angle);
        const float z = at.y * std::cos(angle) - at.x * std::sin(angle);
        balls.push_back({{x, 0.26f, z}, 0.29f});
        balls.push_back({{x, 0.7f, z}, 0.3f});
    }
    const std::pair<const char*, core::Image> files[] = {
        {"crate_color.png", crate.color},
        {"crate_normal.png", crate.normal},
        {"crate_exponent.png", crate.exponent},
        {"crate_occlusion.png", crate.occlusion},
        {"crate_shadow.png", floorOcclusion(256, glm::vec2(0.0f), glm::vec2(1.6f), balls)}};
    for (const auto& [name, image] : files) {
        if (core::Result<void> written = io::writeImage(folder / name, image); !written) {
            return written;
        }
    }
    if (core::Result<void> written = writeCrate(folder, "figure3", true); !written) {
        return written;
    }
    return writeCrate(folder, "figure3_flat", false);
}

core::Result<void> writeAshikhmin(const std::filesystem::path& folder) {
    GltfWriter writer("ashikhmin");
    const int metal =
        writer.addBlinnPhong("polished", glm::vec3(0.0f), {0.93f, 0.90f, 0.85f}, "mirror");
    const int mesh = writer.addMesh("ewer", ewer(), metal);
    writer.addNode("ewer", mesh, {-0.06f, -0.68f, 0.0f}, turn(-18.0f));
    writer.addCamera("front", {0.0f, 2.4f, 9.0f}, glm::vec3(0.0f),
                     fovFor(1.9f, std::hypot(2.4f, 9.0f)));
    return writer.write(folder);
}

core::Result<void> writeEstimators(const std::filesystem::path& folder) {
    GltfWriter writer("estimators");
    int column = 0;
    for (const int exponent : {2, 8, 32, 128, 2048}) {
        const std::string label = "exponent " + std::to_string(exponent);
        const int material =
            writer.addBlinnPhong(label, glm::vec3(0.0f), glm::vec3(0.95f), exponent);
        const int mesh = column == 0 ? writer.addMesh(label, sphere(0.47f, 128, 64), material)
                                     : writer.addMeshLike(label, 0, material);
        writer.addNode(label, mesh, {static_cast<float>(column++) - 2.0f, 0.0f, 0.0f});
    }
    writer.addCamera("row", {0.0f, 0.0f, 20.0f}, glm::vec3(0.0f), fovFor(1.0f, 20.0f));
    return writer.write(folder);
}

core::Result<void> writeLamps(const std::filesystem::path& folder) {
    GltfWriter writer("lamps");
    int column = 0;
    for (const int exponent : {1, 4, 16, 64, 256}) {
        const std::string label = "exponent " + std::to_string(exponent);
        const int material =
            writer.addBlinnPhong(label, {0.02f, 0.03f, 0.05f}, glm::vec3(0.04f), exponent);
        const int mesh = column == 0 ? writer.addMesh(label, sphere(0.47f, 128, 64), material)
                                     : writer.addMeshLike(label, 0, material);
        writer.addNode(label, mesh, {static_cast<float>(column++) - 2.0f, 0.0f, 0.0f});
    }
    // Far away, so that all are lit alike: one from before, one past the right rims.
    writer.addPointLight("before", {-120.0f, 120.0f, 240.0f}, glm::vec3(1.0f), 9e5f, 1e5f);
    writer.addPointLight("behind", {260.0f, 40.0f, -120.0f}, {1.0f, 0.75f, 0.5f}, 3e5f, 1e5f);
    writer.addCamera("row", {0.0f, 0.0f, 20.0f}, glm::vec3(0.0f), fovFor(1.0f, 20.0f));
    return writer.write(folder);
}

} // namespace lodestar::samples

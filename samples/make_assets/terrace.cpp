// SPDX-License-Identifier: MIT
//
// A terrace above the courtyard: a table with a still life, columns, steps, a balustrade.
#include "scenes.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "gltf_writer.h"
#include "io/image_file.h"
#include "noise.h"
#include "textures.h"

namespace lodestar::samples {
namespace {

constexpr float kFloorHalf = 5.0f; ///< of the terrace's floor, metres
constexpr float kTableTop = 0.84f;
constexpr float kTableHalfX = 1.05f;
constexpr float kTableHalfZ = 0.55f;

/// The scene's materials by what they are.
struct Palette {
    int stone, floor, step, wood, timber, brass, copper, ceramic, cloth, steel, gold, orange, glaze,
        leaf, clay;
};

/// A metallic-roughness material from textures named NAME_color.png and so on.
Json textured(GltfWriter& writer, const std::string& name, float normalScale) {
    return {{"name", name},
            {"pbrMetallicRoughness",
             {{"baseColorTexture", {{"index", writer.addTexture(name + "_color.png")}}},
              {"metallicRoughnessTexture", {{"index", writer.addTexture(name + "_rough.png")}}}}},
            {"normalTexture",
             {{"index", writer.addTexture(name + "_normal.png")}, {"scale", normalScale}}}};
}

Json plain(const std::string& name, const glm::vec3& color, float metallic, float roughness) {
    return {{"name", name},
            {"pbrMetallicRoughness",
             {{"baseColorFactor", {color.x, color.y, color.z, 1.0f}},
              {"metallicFactor", metallic},
              {"roughnessFactor", roughness}}}};
}

void setOcclusion(GltfWriter& writer, Json& material, const std::string& file) {
    material["occlusionTexture"] = {{"index", writer.addTexture(file)}, {"texCoord", 1}};
}

Palette makePalette(GltfWriter& writer) {
    Palette palette{};
    Json floor = textured(writer, "tiles", 1.0f);
    setOcclusion(writer, floor, "terrace_floor.png");
    palette.floor = writer.addMaterial(floor);
    palette.stone = writer.addMaterial(plain("limestone", {0.58f, 0.51f, 0.41f}, 0.0f, 0.62f));
    palette.step = writer.addMaterial(plain("polished stone", {0.34f, 0.28f, 0.23f}, 0.0f, 0.22f));
    palette.timber = writer.addMaterial(plain("dark wood", {0.13f, 0.055f, 0.025f}, 0.0f, 0.24f));
    Json wood = textured(writer, "boards", 1.0f);
    setOcclusion(writer, wood, "terrace_table.png");
    palette.wood = writer.addMaterial(wood);
    palette.brass = writer.addMaterial(textured(writer, "brass", 0.55f));
    palette.copper = writer.addMaterial(plain("copper", {0.93f, 0.52f, 0.36f}, 1.0f, 0.28f));
    palette.ceramic = writer.addMaterial(textured(writer, "ceramic", 1.0f));
    Json cloth = textured(writer, "cloth", 1.0f);
    cloth["doubleSided"] = true;
    palette.cloth = writer.addMaterial(cloth);
    palette.steel = writer.addMaterial(plain("mirror", {0.95f, 0.95f, 0.95f}, 1.0f, 0.0f));
    palette.gold = writer.addMaterial(plain("gold", {1.0f, 0.72f, 0.30f}, 1.0f, 0.12f));
    palette.orange = writer.addMaterial(plain("orange", {0.83f, 0.27f, 0.02f}, 0.0f, 0.42f));
    palette.glaze = writer.addMaterial(plain("green glaze", {0.025f, 0.16f, 0.09f}, 0.0f, 0.10f));
    palette.leaf = writer.addMaterial(plain("leaf", {0.07f, 0.15f, 0.035f}, 0.0f, 0.5f));
    palette.clay = writer.addMaterial(plain("terracotta", {0.50f, 0.20f, 0.10f}, 0.0f, 0.7f));
    return palette;
}

/// A flat rectangle facing up about the origin: tiled in the first uv set, whole in the second.
Mesh flatTop(float halfX, float halfZ, const glm::vec2& repeat) {
    Mesh mesh = tessellate(
        [=](float u, float v) {
            return glm::vec3((2.0f * u - 1.0f) * halfX, 0.0f, (2.0f * v - 1.0f) * halfZ);
        },
        8, 8, repeat);
    for (const glm::vec2& uv : mesh.uvs) {
        mesh.uvs1.push_back(uv / repeat);
    }
    return mesh;
}

/// A cloth on the table's front edge: flat above, falling in folds below.
Mesh drapedCloth() {
    constexpr float kHalf = 0.36f;
    constexpr float kOnTop = 0.62f;
    constexpr float kBend = 0.05f;
    const float arc = 0.5f * 3.14159265f * kBend;
    return tessellate(
        [=](float u, float v) {
            const float along = v * 1.12f; // metres of cloth from its back hem
            const float x = (2.0f * u - 1.0f) * kHalf;
            const float wave = 0.004f * std::sin(x * 21.0f + 3.0f * along);
            if (along < kOnTop) {
                return glm::vec3(x, 0.006f + wave + 0.004f, along - kOnTop);
            }
            if (along < kOnTop + arc) {
                const float angle = (along - kOnTop) / kBend;
                return glm::vec3(x, 0.01f + wave - kBend * (1.0f - std::cos(angle)),
                                 kBend * std::sin(angle));
            }
            const float drop = along - kOnTop - arc;
            const float fold =
                0.075f * smoothStep(0.0f, 0.45f, drop) * std::sin(x * 21.0f + 1.2f * drop + 0.4f);
            return glm::vec3(x * (1.0f - 0.16f * drop), 0.01f + wave - kBend - drop,
                             kBend + 0.55f * fold + 0.045f * drop);
        },
        120, 100, {1.0f, 1.6f});
}

/// A bowl with an inside: its profile goes from the middle of the inside over the rim to the foot.
Mesh bowl(float radius, float height) {
    return lathe({{0.0f, 0.16f * height},
                  {0.45f * radius, 0.20f * height},
                  {0.78f * radius, 0.46f * height},
                  {0.95f * radius, 0.95f * height},
                  {0.975f * radius, 1.0f * height},
                  {1.0f * radius, 0.96f * height},
                  {0.84f * radius, 0.42f * height},
                  {0.52f * radius, 0.12f * height},
                  {0.44f * radius, 0.06f * height},
                  {0.46f * radius, 0.0f},
                  {0.0f, 0.0f}},
                 96, 90, {2.0f, 1.0f});
}

Mesh baluster() {
    return lathe({{0.07f, 0.72f},
                  {0.085f, 0.70f},
                  {0.06f, 0.67f},
                  {0.04f, 0.60f},
                  {0.045f, 0.48f},
                  {0.085f, 0.30f},
                  {0.09f, 0.20f},
                  {0.05f, 0.10f},
                  {0.085f, 0.04f},
                  {0.085f, 0.0f}},
                 32, 40);
}

Mesh vase() {
    return lathe({{0.0f, 0.30f},
                  {0.10f, 0.34f},
                  {0.115f, 0.62f},
                  {0.14f, 0.70f},
                  {0.155f, 0.71f},
                  {0.14f, 0.66f},
                  {0.10f, 0.58f},
                  {0.12f, 0.50f},
                  {0.24f, 0.36f},
                  {0.26f, 0.24f},
                  {0.17f, 0.07f},
                  {0.14f, 0.02f},
                  {0.15f, 0.0f},
                  {0.0f, 0.0f}},
                 96, 96);
}

/// A clipped bush: a ball of uneven leaves.
Mesh bush() {
    return tessellate(
        [](float u, float v) {
            const float angle = 6.2831853f * u;
            const float polar = 3.14159265f * v;
            const float leaves = fractalNoise(u * 40.0f, v * 20.0f, 2, 700, 40);
            const float lumps = fractalNoise(u * 10.0f, v * 5.0f, 2, 710, 10);
            const float fade = std::sin(polar); // the poles stay whole
            const float r = 0.36f + fade * (0.085f * (leaves - 0.5f) + 0.10f * (lumps - 0.5f));
            return r * glm::vec3(std::sin(polar) * std::sin(angle), std::cos(polar),
                                 std::sin(polar) * std::cos(angle));
        },
        200, 100);
}

/// Places things and remembers them as balls for the occlusion of what they stand on.
class Stage {
public:
    Stage(GltfWriter& writer, std::vector<Occluder>& occluders)
        : writer_(writer), occluders_(occluders) {}

    void place(const std::string& name, int mesh, const glm::vec3& at, float degrees = 0.0f,
               float scale = 1.0f) {
        writer_.addNode(name, mesh, at, turn(degrees), scale);
    }

    /// A ball that darkens the floor, its centre above the floor.
    void shade(const glm::vec3& centre, float radius) { occluders_.push_back({centre, radius}); }

private:
    GltfWriter& writer_;
    std::vector<Occluder>& occluders_;
};

void addBuilding(GltfWriter& writer, const Palette& palette, std::vector<Occluder>& occluders) {
    Stage stage(writer, occluders);
    stage.place(
        "floor",
        writer.addMesh("floor", flatTop(kFloorHalf, kFloorHalf, {8.0f, 8.0f}), palette.floor),
        glm::vec3(0.0f));
    const int post = writer.addMesh("column", column(3.3f, 0.24f), palette.stone);
    for (const glm::vec3 at : {glm::vec3(-2.55f, 0.0f, -1.75f), glm::vec3(-3.0f, 0.0f, 0.9f),
                               glm::vec3(3.35f, 0.0f, -2.3f)}) {
        stage.place("column", post, at);
        stage.shade(at + glm::vec3(0.0f, 0.2f, 0.0f), 0.36f);
        stage.shade(at + glm::vec3(0.0f, 0.7f, 0.0f), 0.26f);
    }
    const int rail = writer.addMesh("rail", roundedBox({5.0f, 0.06f, 0.16f}, 0.03f), palette.stone);
    const int sill = writer.addMesh("sill", roundedBox({5.0f, 0.07f, 0.15f}, 0.03f), palette.stone);
    stage.place("rail", rail, {0.0f, 0.92f, -2.7f});
    stage.place("sill", sill, {0.0f, 0.07f, -2.7f});
    const int post2 = writer.addMesh("baluster", baluster(), palette.stone);
    for (int i = 0; i < 29; ++i) {
        const float x = -4.76f + 0.34f * static_cast<float>(i);
        stage.place("baluster", post2, {x, 0.14f, -2.7f});
        stage.shade({x, 0.15f, -2.7f}, 0.16f);
    }
    // Three steps that rise to the right.
    for (int i = 0; i < 3; ++i) {
        const float rise = 0.16f * static_cast<float>(i + 1);
        const float half = 1.1f - 0.22f * static_cast<float>(i);
        const int step = writer.addMesh(
            "step", roundedBox({half, 0.5f * rise, half * 0.8f}, 0.025f), palette.step);
        stage.place("step", step, {2.35f, 0.5f * rise, -0.95f}, 12.0f);
    }
    for (const float x : {1.6f, 2.35f, 3.1f}) {
        stage.shade({x, 0.2f, -0.95f}, 0.62f);
    }
}

void addTable(GltfWriter& writer, const Palette& palette, std::vector<Occluder>& occluders) {
    Stage stage(writer, occluders);
    // The slab carries whole-image uvs in its second set for the occlusion of what stands on it.
    Mesh slab = roundedBox({kTableHalfX, 0.035f, kTableHalfZ}, 0.02f);
    for (std::size_t i = 0; i < slab.positions.size(); ++i) {
        const glm::vec3& p = slab.positions[i];
        const glm::vec2 over(0.5f + 0.5f * p.x / kTableHalfX, 0.5f + 0.5f * p.z / kTableHalfZ);
        slab.uvs[i] = over;
        slab.uvs1.push_back(slab.normals[i].y > 0.1f ? over : glm::vec2(0.002f));
    }
    stage.place("table", writer.addMesh("table", slab, palette.wood),
                {0.0f, kTableTop - 0.035f, 0.0f});
    const Mesh legShape = lathe({{0.055f, 0.77f},
                                 {0.06f, 0.70f},
                                 {0.035f, 0.66f},
                                 {0.06f, 0.52f},
                                 {0.05f, 0.30f},
                                 {0.03f, 0.12f},
                                 {0.055f, 0.06f},
                                 {0.03f, 0.0f}},
                                40, 48);
    const int leg = writer.addMesh("leg", legShape, palette.timber);
    for (const float x : {-0.88f, 0.88f}) {
        for (const float z : {-0.4f, 0.4f}) {
            stage.place("leg", leg, {x, 0.0f, z});
            stage.shade({x, 0.06f, z}, 0.08f);
        }
    }
    for (const float x : {-0.8f, -0.27f, 0.27f, 0.8f}) {
        for (const float z : {-0.33f, 0.0f, 0.33f}) {
            stage.shade({x, 0.72f, z}, 0.42f);
        }
    }
}

/// What stands on the table; occluders are relative to its top.
void addStillLife(GltfWriter& writer, const Palette& palette, std::vector<Occluder>& occluders) {
    Stage stage(writer, occluders);
    const float top = kTableTop;
    stage.place("ewer", writer.addMesh("ewer", ewer(), palette.brass), {-0.52f, top, -0.12f}, 24.0f,
                0.42f);
    stage.shade({-0.52f, 0.06f, -0.12f}, 0.15f);
    stage.shade({-0.52f, 0.25f, -0.12f}, 0.24f);
    stage.place("bowl", writer.addMesh("bowl", bowl(0.26f, 0.17f), palette.ceramic),
                {0.30f, top + 0.012f, -0.10f});
    stage.shade({0.30f, 0.05f, -0.10f}, 0.13f);
    stage.shade({0.30f, 0.16f, -0.10f}, 0.21f);
    const int fruit = writer.addMesh("orange", sphere(0.082f, 48, 24), palette.orange);
    for (const glm::vec3 at :
         {glm::vec3(0.22f, 0.135f, -0.14f), glm::vec3(0.385f, 0.14f, -0.13f),
          glm::vec3(0.30f, 0.135f, 0.005f), glm::vec3(0.30f, 0.255f, -0.09f)}) {
        stage.place("orange", fruit, at + glm::vec3(0.0f, top, 0.0f));
    }
    stage.place("loose orange", fruit, {0.02f, top + 0.082f, 0.20f});
    stage.shade({0.02f, 0.082f, 0.20f}, 0.082f);
    stage.place("mirror ball", writer.addMesh("mirror ball", sphere(0.125f), palette.steel),
                {-0.14f, top + 0.125f, 0.02f});
    stage.shade({-0.14f, 0.125f, 0.02f}, 0.125f);
    stage.place("cup", writer.addMesh("cup", bowl(0.10f, 0.12f), palette.copper),
                {0.80f, top + 0.012f, 0.20f});
    stage.shade({0.80f, 0.06f, 0.20f}, 0.085f);
    stage.place("cloth", writer.addMesh("cloth", drapedCloth(), palette.cloth),
                {0.42f, top, kTableHalfZ - 0.035f}, 0.0f);
    stage.place("vase", writer.addMesh("small vase", vase(), palette.glaze), {0.78f, top, -0.26f},
                0.0f, 0.58f);
    stage.shade({0.78f, 0.12f, -0.26f}, 0.14f);
}

void addOrnaments(GltfWriter& writer, const Palette& palette, std::vector<Occluder>& occluders) {
    Stage stage(writer, occluders);
    stage.place("golden ball", writer.addMesh("golden ball", sphere(0.42f, 128, 64), palette.gold),
                {2.35f, 0.90f, -0.95f});
    stage.place("jar", writer.addMesh("jar", vase(), palette.ceramic), {-1.62f, 0.0f, 0.35f}, 0.0f,
                1.35f);
    stage.shade({-1.62f, 0.33f, 0.35f}, 0.36f);
    stage.place("pot", writer.addMesh("pot", vase(), palette.clay), {-1.95f, 0.0f, -1.3f}, 0.0f,
                1.1f);
    stage.shade({-1.95f, 0.27f, -1.3f}, 0.3f);
    stage.place("bush", writer.addMesh("bush", bush(), palette.leaf), {-1.95f, 1.05f, -1.3f});
    stage.place("silver ball", writer.addMesh("silver ball", sphere(0.16f), palette.steel),
                {1.35f, 0.16f, 0.72f});
    stage.shade({1.35f, 0.16f, 0.72f}, 0.16f);
}

core::Result<void> writeTextures(const std::filesystem::path& folder,
                                 const std::vector<Occluder>& onFloor,
                                 const std::vector<Occluder>& onTable) {
    const std::pair<std::string, Material> materials[] = {
        {"tiles", stoneTiles(1024)},
        {"brass", hammeredMetal(512, {0.90f, 0.66f, 0.33f})},
        {"boards", tableBoards(1024)},
        {"ceramic", paintedCeramic(1024)},
        {"cloth", stripedCloth(1024)}};
    std::vector<std::pair<std::string, core::Image>> files;
    for (const auto& [name, material] : materials) {
        files.emplace_back(name + "_color.png", material.color);
        files.emplace_back(name + "_rough.png", material.metallicRoughness);
        files.emplace_back(name + "_normal.png", material.normal);
    }
    files.emplace_back("terrace_floor.png",
                       floorOcclusion(512, glm::vec2(0.0f), glm::vec2(kFloorHalf), onFloor));
    files.emplace_back("terrace_table.png",
                       floorOcclusion(512, glm::vec2(0.0f), {kTableHalfX, kTableHalfZ}, onTable));
    for (const auto& [name, image] : files) {
        if (core::Result<void> written = io::writeImage(folder / name, image); !written) {
            return written;
        }
    }
    return {};
}

} // namespace

core::Result<void> writeTerrace(const std::filesystem::path& folder) {
    GltfWriter writer("terrace");
    const Palette palette = makePalette(writer);
    std::vector<Occluder> onFloor;
    std::vector<Occluder> onTable;
    addBuilding(writer, palette, onFloor);
    addTable(writer, palette, onFloor);
    addOrnaments(writer, palette, onFloor);
    addStillLife(writer, palette, onTable);
    writer.addCamera("terrace", {0.7f, 1.5f, 4.3f}, {0.14f, 0.86f, -0.6f}, 37.0f);
    writer.addCamera("table", {0.62f, 1.36f, 1.75f}, {0.08f, 0.93f, -0.05f}, 33.0f);
    writer.addCamera("steps", {3.9f, 1.35f, 1.9f}, {2.0f, 0.75f, -0.9f}, 36.0f);
    if (core::Result<void> written = writeTextures(folder, onFloor, onTable); !written) {
        return written;
    }
    return writer.write(folder);
}

} // namespace lodestar::samples

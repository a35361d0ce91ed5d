// SPDX-License-Identifier: MIT
//
// A courtyard, a hall behind it with a lift, and a store without windows: what light probes are
// for. South is +Z. The walls of a room stand on their own, as draws of their own.
#include <cmath>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "gltf_writer.h"
#include "scenes.h"
#include "shapes.h"

namespace lodestar::samples {
namespace {

constexpr float kWall = 0.4f; ///< thickness, metres

/// A side of a box, its texture a metre a unit.
Mesh side(const glm::vec3& corner, const glm::vec3& along, const glm::vec3& down) {
    const glm::vec2 size(glm::length(along), glm::length(down));
    return tessellate([=](float u, float v) { return corner + u * along + v * down; }, 1, 1, size);
}

Mesh block(const glm::vec3& low, const glm::vec3& high) {
    const glm::vec3 s = high - low;
    const glm::vec3 x(s.x, 0.0f, 0.0f), y(0.0f, s.y, 0.0f), z(0.0f, 0.0f, s.z);
    Mesh mesh = side({low.x, high.y, high.z}, x, -y);    // south
    mesh.append(side({high.x, high.y, low.z}, -x, -y));  // north
    mesh.append(side({high.x, high.y, high.z}, -z, -y)); // east
    mesh.append(side({low.x, high.y, low.z}, z, -y));    // west
    mesh.append(side({low.x, high.y, low.z}, x, z));     // top
    mesh.append(side({low.x, low.y, high.z}, x, -z));    // bottom
    return mesh;
}

struct Palette {
    int plaster, paving, parquet, ceiling, red, teal, ochre, steel, mirror, bronze, clay, water,
        cloth, lamp, cabin, wood;
};

/// Of quantities that stand beside a texture of colours.
int textured(GltfWriter& writer, const std::string& name, const std::string& file, float scale,
             float roughness) {
    const Json transform{{"KHR_texture_transform", {{"scale", Json::array({scale, scale})}}}};
    writer.useExtension("KHR_texture_transform");
    const Json texture{{"index", writer.addTexture(file)}, {"extensions", transform}};
    return writer.addMaterial({{"name", name},
                               {"pbrMetallicRoughness",
                                {{"baseColorTexture", texture},
                                 {"metallicFactor", 0.0f},
                                 {"roughnessFactor", roughness}}}});
}

Palette makePalette(GltfWriter& writer) {
    const glm::vec3 f0(0.04f);
    Palette p{};
    p.plaster = writer.addBlinnPhong("plaster", {0.62f, 0.55f, 0.45f}, f0, 6.0f);
    p.paving = textured(writer, "paving", "tiles_color.png", 0.6f, 0.45f);
    p.parquet = textured(writer, "parquet", "boards_color.png", 0.4f, 0.3f);
    p.ceiling = writer.addBlinnPhong("ceiling", {0.72f, 0.70f, 0.66f}, f0, 4.0f);
    p.red = writer.addBlinnPhong("red plaster", {0.50f, 0.13f, 0.09f}, f0, 8.0f);
    p.teal = writer.addBlinnPhong("teal plaster", {0.08f, 0.30f, 0.31f}, f0, 8.0f);
    p.ochre = writer.addBlinnPhong("ochre plaster", {0.58f, 0.36f, 0.12f}, f0, 8.0f);
    p.steel = writer.addBlinnPhong("steel", glm::vec3(0.0f), {0.62f, 0.61f, 0.60f}, 900.0f);
    p.mirror = writer.addBlinnPhong("mirror", glm::vec3(0.0f), glm::vec3(0.92f), "mirror");
    p.bronze = writer.addBlinnPhong("bronze", glm::vec3(0.0f), {0.72f, 0.46f, 0.22f}, 90.0f);
    p.clay = writer.addBlinnPhong("clay", {0.52f, 0.40f, 0.31f}, f0, 12.0f);
    p.water = writer.addBlinnPhong("water", {0.02f, 0.05f, 0.05f}, glm::vec3(0.06f), 4000.0f);
    p.cloth = writer.addBlinnPhong("awning", {0.62f, 0.10f, 0.06f}, glm::vec3(0.03f), 5.0f);
    writer.material(p.cloth)["doubleSided"] = true;
    writer.useExtension("KHR_materials_emissive_strength");
    p.lamp = writer.addBlinnPhong("lamp", glm::vec3(0.0f), f0, 10.0f);
    writer.material(p.lamp)["emissiveFactor"] = Json::array({1.0f, 0.72f, 0.42f});
    writer.material(p.lamp)["extensions"] = {
        {"KHR_materials_emissive_strength", {{"emissiveStrength", 14.0f}}}};
    p.cabin = writer.addBlinnPhong("cabin", {0.55f, 0.42f, 0.10f}, glm::vec3(0.06f), 120.0f);
    p.wood = writer.addBlinnPhong("dark wood", {0.20f, 0.11f, 0.06f}, f0, 40.0f);
    return p;
}

class Builder {
public:
    Builder(GltfWriter& writer, const Palette& palette) : writer_(writer), palette_(palette) {}

    int box(const std::string& name, const glm::vec3& low, const glm::vec3& high, int material) {
        return writer_.addNode(name, writer_.addMesh(name, block(low, high), material),
                               glm::vec3(0.0f));
    }
    int shape(const std::string& name, const Mesh& mesh, int material, const glm::vec3& at,
              float degrees = 0.0f, float scale = 1.0f) {
        return writer_.addNode(name, writer_.addMesh(name, mesh, material), at, turn(degrees),
                               scale);
    }
    /// A glowing ball and the light it gives. @return both nodes
    std::vector<int> lamp(const std::string& name, const glm::vec3& at, float candela) {
        return {shape(name, sphere(0.09f, 24, 12), palette_.lamp, at),
                writer_.addPointLight(name + " light", at, {1.0f, 0.72f, 0.42f}, candela, 12.0f)};
    }

private:
    GltfWriter& writer_;
    const Palette& palette_;
};

void addCourtyard(Builder& b, const Palette& p) {
    b.box("courtyard floor", {-8, -0.3f, 0}, {8, 0, 14}, p.paving);
    b.box("courtyard west", {-8.4f, 0, -0.4f}, {-8, 6, 14.4f}, p.plaster);
    b.box("courtyard east", {8, 0, -0.4f}, {8.4f, 6, 14.4f}, p.ochre);
    b.box("courtyard south", {-8.4f, 0, 14}, {8.4f, 6, 14.4f}, p.plaster);
    for (const float z : {3.5f, 6.5f, 9.5f}) {
        b.shape("column", column(4.2f, 0.28f), p.plaster, {-5.6f, 0, z});
        b.box("beam", {-8, 4.2f, z - 0.2f}, {-5.3f, 4.6f, z + 0.2f}, p.wood);
    }
    // A basin with water.
    b.box("basin west", {0.8f, 0, 5.6f}, {1.1f, 0.45f, 9.4f}, p.clay);
    b.box("basin east", {4.5f, 0, 5.6f}, {4.8f, 0.45f, 9.4f}, p.clay);
    b.box("basin north", {1.1f, 0, 5.6f}, {4.5f, 0.45f, 5.9f}, p.clay);
    b.box("basin south", {1.1f, 0, 9.1f}, {4.5f, 0.45f, 9.4f}, p.clay);
    b.box("water", {1.1f, 0.05f, 5.9f}, {4.5f, 0.34f, 9.1f}, p.water);
    b.box("plinth", {-3.3f, 0, 3.2f}, {-2.5f, 0.8f, 4.0f}, p.plaster);
    b.shape("bronze ball", sphere(0.55f, 64, 32), p.bronze, {-2.9f, 1.35f, 3.6f});
    b.shape("jar", ewer(), p.clay, {6.3f, 0, 3.0f}, 30.0f, 1.0f);
    const Mesh awning = tessellate(
        [](float u, float v) {
            const float sag = 0.25f * std::sin(3.14159265f * v);
            return glm::vec3(5.4f + 2.6f * u, 3.2f + 0.9f * u - sag * (1.0f - u) - 0.1f * sag,
                             4.5f + 6.5f * v);
        },
        12, 24);
    b.shape("awning", awning, p.cloth, glm::vec3(0.0f));
}

/// The wall between courtyard and hall: a doorway and two windows.
void addFront(Builder& b, const Palette& p) {
    const float z = -kWall;
    const auto piece = [&](float x0, float x1, float y0, float y1) {
        b.box("front wall", {x0, y0, z}, {x1, y1, 0}, p.plaster);
    };
    piece(-8, -4.2f, 0, 6);
    piece(-4.2f, -2.6f, 0, 1.2f);
    piece(-4.2f, -2.6f, 3.2f, 6);
    piece(-2.6f, -1.1f, 0, 6);
    piece(-1.1f, 1.1f, 3, 6);
    piece(1.1f, 2.6f, 0, 6);
    piece(2.6f, 4.2f, 0, 1.2f);
    piece(2.6f, 4.2f, 3.2f, 6);
    piece(4.2f, 8, 0, 6);
}

void addHall(Builder& b, const Palette& p) {
    b.box("hall floor", {-6.4f, -0.3f, -8.8f}, {6.4f, 0, 0}, p.parquet);
    b.box("hall ceiling", {-6.4f, 5, -8.4f}, {6.4f, 5.4f, -kWall}, p.ceiling);
    b.box("hall west", {-6.4f, 0, -8.8f}, {-6, 5, -kWall}, p.red);
    b.box("hall east", {6, 0, -8.8f}, {6.4f, 5, -kWall}, p.teal);
    b.box("hall north west", {-6, 0, -8.8f}, {-1.2f, 5, -8.4f}, p.ceiling);
    b.box("hall north east", {1.2f, 0, -8.8f}, {6, 5, -8.4f}, p.ceiling);
    b.box("hall north above", {-1.2f, 2.6f, -8.8f}, {1.2f, 5, -8.4f}, p.ceiling);
    b.box("mirror", {-5.98f, 0.9f, -6.4f}, {-5.94f, 3.1f, -3.6f}, p.mirror);
    b.box("mirror frame", {-6, 0.75f, -6.55f}, {-5.96f, 3.25f, -3.45f}, p.wood);
    b.box("pedestal", {3.1f, 0, -6.3f}, {3.9f, 1.0f, -5.5f}, p.wood);
    b.shape("statue", ewer(), p.clay, {3.5f, 1.0f, -5.9f}, 150.0f, 0.7f);
    b.shape("steel ball", sphere(0.6f, 64, 32), p.steel, {-3.0f, 0.6f, -5.8f});
    b.shape("bronze column", column(3.0f, 0.2f), p.bronze, {4.9f, 0, -2.6f});
    for (const float x : {-3.5f, 0.0f, 3.5f}) {
        b.lamp("hall lamp", {x, 4.5f, -4.4f}, 9.0f);
    }
}

void addStore(Builder& b, const Palette& p) {
    b.box("store floor", {6.4f, -0.3f, -8.8f}, {10.4f, 0, -4}, p.paving);
    b.box("store ceiling", {6.4f, 3, -8.8f}, {10.4f, 3.4f, -4}, p.ceiling);
    b.box("store east", {10, 0, -8.8f}, {10.4f, 3, -4}, p.plaster);
    b.box("store north", {6.4f, 0, -8.8f}, {10, 3, -8.4f}, p.plaster);
    b.box("store south", {6.4f, 0, -4.4f}, {10, 3, -4}, p.plaster);
    b.shape("store jar", ewer(), p.clay, {8.2f, 0, -6.4f});
    b.lamp("store lamp", {8.2f, 2.6f, -6.4f}, 2.0f);
}

/// The shaft and what moves in it. @return the nodes that move
std::vector<int> addLift(GltfWriter& writer, Builder& b, const Palette& p) {
    b.box("shaft west", {-1.9f, -0.3f, -11.6f}, {-1.5f, 9, -8.8f}, p.plaster);
    b.box("shaft east", {1.5f, -0.3f, -11.6f}, {1.9f, 9, -8.8f}, p.plaster);
    b.box("shaft north", {-1.9f, -0.3f, -12}, {1.9f, 9, -11.6f}, p.plaster);
    b.box("shaft south", {-1.9f, 5, -8.8f}, {1.9f, 9, -8.4f}, p.plaster);
    b.box("shaft floor", {-1.9f, -0.6f, -12}, {1.9f, -0.3f, -8.4f}, p.plaster);
    b.box("shaft roof", {-1.9f, 9, -12}, {1.9f, 9.4f, -8.4f}, p.plaster);
    Mesh cabin = block({-1.2f, 0, -11.3f}, {1.2f, 0.1f, -8.95f});
    cabin.append(block({-1.2f, 2.45f, -11.3f}, {1.2f, 2.55f, -8.95f}));
    cabin.append(block({-1.2f, 0.1f, -11.3f}, {1.2f, 2.45f, -11.2f}));
    cabin.append(block({-1.2f, 0.1f, -11.2f}, {-1.1f, 2.45f, -8.95f}));
    cabin.append(block({1.1f, 0.1f, -11.2f}, {1.2f, 2.45f, -8.95f}));
    const int lift =
        writer.addNode("Lift", writer.addMesh("Lift", cabin, p.cabin), glm::vec3(0.0f));
    std::vector<int> moving = {lift};
    for (const int node : b.lamp("lift lamp", {0, 2.3f, -10.1f}, 3.0f)) {
        moving.push_back(node);
    }
    return moving;
}

float smooth(float t) {
    t = glm::clamp(t, 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

/// Up in three seconds, a rest above, down, a rest below: eight seconds.
float liftHeight(float seconds) {
    const float t = seconds - 8.0f * std::floor(seconds / 8.0f);
    return 4.6f * (smooth((t - 1.0f) / 3.0f) - smooth((t - 5.0f) / 3.0f));
}

constexpr float kWalkSeconds = 20.0f;
constexpr int kKeysASecond = 10;

/// From the courtyard through the doorway towards the lift, then a look around.
void animate(GltfWriter& writer, int walker, const std::vector<int>& moving,
             const std::vector<glm::vec3>& from) {
    const std::vector<glm::vec2> path = {{3.6f, 12.4f}, {0.2f, 9.2f},  {-0.6f, 5.2f}, {0.0f, 1.0f},
                                         {0.0f, -1.6f}, {0.6f, -3.8f}, {1.2f, -5.0f}};
    const std::vector<glm::vec2> look = {{0.5f, 4.0f},   {0.0f, 0.0f},   {0.0f, -4.0f},
                                         {0.0f, -9.0f},  {-1.6f, -9.4f}, {-4.5f, -7.0f},
                                         {-0.6f, -10.0f}};
    std::vector<float> times;
    std::vector<glm::vec3> places;
    std::vector<glm::quat> turns;
    std::vector<std::vector<glm::vec3>> lifted(moving.size());
    for (int i = 0; i <= static_cast<int>(kWalkSeconds) * kKeysASecond; ++i) {
        const float seconds = static_cast<float>(i) / static_cast<float>(kKeysASecond);
        const float t = smooth(seconds / kWalkSeconds) * 0.5f + seconds / kWalkSeconds * 0.5f;
        const glm::vec2 at = splinePoint(path, t);
        const glm::vec2 to = splinePoint(look, t);
        times.push_back(seconds);
        places.emplace_back(at.x, 1.65f, at.y);
        turns.push_back(lookRotation(places.back(), {to.x, 1.5f, to.y}));
        for (std::size_t k = 0; k < moving.size(); ++k) {
            lifted[k].push_back(from[k] + glm::vec3(0.0f, liftHeight(seconds), 0.0f));
        }
    }
    std::vector<AnimationChannel> channels = {{walker, "translation", times, places, {}},
                                              {walker, "rotation", times, {}, turns}};
    for (std::size_t k = 0; k < moving.size(); ++k) {
        channels.push_back({moving[k], "translation", times, lifted[k], {}});
    }
    writer.addAnimation("walk", channels);
}

} // namespace

core::Result<void> writeLift(const std::filesystem::path& folder) {
    GltfWriter writer("lift");
    const Palette palette = makePalette(writer);
    Builder builder(writer, palette);
    addCourtyard(builder, palette);
    addFront(builder, palette);
    addHall(builder, palette);
    addStore(builder, palette);
    const std::vector<int> moving = addLift(writer, builder, palette);
    writer.addCamera("courtyard", {6.4f, 1.7f, 12.6f}, {-1.0f, 1.6f, 1.5f}, 50.0f);
    writer.addCamera("hall", {4.6f, 1.75f, -1.1f}, {-2.0f, 1.5f, -7.6f}, 58.0f);
    writer.addCamera("lift", {1.6f, 1.65f, -4.4f}, {-0.3f, 1.6f, -10.0f}, 55.0f);
    const int walker =
        writer.cameraNode(writer.addCamera("Walker", {3.6f, 1.65f, 12.4f}, {0.5f, 1.5f, 4}, 55.0f));
    animate(writer, walker, moving, {glm::vec3(0.0f), {0.0f, 2.3f, -10.1f}, {0.0f, 2.3f, -10.1f}});
    return writer.write(folder);
}

} // namespace lodestar::samples

// SPDX-License-Identifier: MIT
//
// Goldens of materials and of the file's own light.
#include "golden/gltf_golden.h"
#include "support/shapes.h"

namespace lodestar::testing {
namespace {

constexpr glm::vec2 kCorners[] = {{-1.0f, 0.2f}, {0.2f, 0.2f}, {-1.0f, -1.0f}, {0.2f, -1.0f}};

/// Four squares of 32 x 32 pixels, one a material.
void fourPanels(GltfBuilder& file, const std::array<int, 4>& materials) {
    std::vector<Json> parts;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::vec2& c = kCorners[i];
        parts.push_back(file.panel(c.x, c.y, c.x + 0.8f, c.y + 0.8f, materials[i]));
    }
    file.show(parts);
}

const float* middleOf(const Shot& shot, std::size_t panel) {
    return shot.at(kCorners[panel].x + 0.4125f, kCorners[panel].y + 0.4125f);
}

void withoutExtensions(Json& document) {
    for (Json& material : document["materials"]) {
        material.erase("extensions");
    }
}

void unlit(GltfBuilder& file) {
    const Json ball = file.primitive(sphere(24, 48), file.unlit(0.9f, 0.4f, 0.1f));
    Json lit = ball;
    lit["material"] =
        file.add("materials", {{"pbrMetallicRoughness",
                                {{"baseColorFactor", {0.9, 0.4, 0.1, 1}}, {"metallicFactor", 0}}}});
    const Json half = {{"scale", {0.5, 0.5, 0.5}}};
    Json left = half;
    Json right = half;
    left["translation"] = {-0.55, 0, 0};
    right["translation"] = {0.55, 0, 0};
    file.show({ball}, left);
    file.show({lit}, right);
}

/// Emission alone, in the dark: three strengths and none given.
void emission(GltfBuilder& file) {
    file.uses("KHR_materials_emissive_strength");
    std::array<int, 4> materials{};
    const double strengths[] = {0.25, 1.0, 4.0, 16.0};
    for (std::size_t i = 0; i < 4; ++i) {
        materials[i] = file.add(
            "materials",
            {{"emissiveFactor", {1.0, 0.5, 0.125}},
             {"extensions",
              {{"KHR_materials_emissive_strength", {{"emissiveStrength", strengths[i]}}}}}});
    }
    fourPanels(file, materials);
}

/// A black dielectric that shows its F0 when radiance 1 comes from everywhere.
Json black(const Json& extensions) {
    return {{"pbrMetallicRoughness",
             {{"baseColorFactor", {0, 0, 0, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 0.3}}},
            {"extensions", extensions}};
}

void specular(GltfBuilder& file) {
    file.uses("KHR_materials_specular");
    file.uses("KHR_materials_ior");
    core::Texels factor(1, 1);
    factor.bytes() = {0, 0, 0, 51}; // alpha 0.2
    core::Texels color(1, 1);
    color.bytes() = {255, 0, 255, 255};
    const Json ior = {{"ior", 3.0}}; // F0 = 0.25
    const Json cases[] = {
        {{"specularFactor", 0.0}},
        {{"specularFactor", 0.5}},
        {{"specularColorFactor", {2.0, 1.0, 0.5}}},
        {{"specularTexture", {{"index", file.texture("factor.png", factor)}}},
         {"specularColorTexture", {{"index", file.texture("color.png", color)}}}}};
    std::array<int, 4> materials{};
    for (std::size_t i = 0; i < 4; ++i) {
        materials[i] = file.add(
            "materials", black({{"KHR_materials_specular", cases[i]}, {"KHR_materials_ior", ior}}));
    }
    fourPanels(file, materials);
}

void withoutSpecular(Json& document) {
    for (Json& material : document["materials"]) {
        material["extensions"].erase("KHR_materials_specular");
    }
}

/// F0 as the extension says. The panels are seen along their normals; 1e-3 holds the lookup.
template <std::size_t kCount>
void showF0(const Shot& shot, const std::array<glm::vec3, kCount>& expected) {
    for (std::size_t i = 0; i < kCount; ++i) {
        expectColor(middleOf(shot, i), expected[i], 1e-3f);
    }
}

void refraction(GltfBuilder& file) {
    file.uses("KHR_materials_ior");
    std::array<int, 4> materials{};
    const double indices[] = {1.0, 1.33, 2.42, 0.0};
    for (std::size_t i = 0; i < 4; ++i) {
        materials[i] = file.add("materials", black({{"KHR_materials_ior", {{"ior", indices[i]}}}}));
    }
    fourPanels(file, materials);
}

constexpr unsigned char kFaces[6][4] = {{255, 40, 40, 128},  {40, 255, 40, 255},
                                        {60, 90, 255, 102},  {120, 100, 60, 255},
                                        {255, 230, 60, 255}, {90, 230, 230, 204}};

/// A mirror ball and a white one in the file's own light: six pictures on disk, RGBD, each with a
/// dark upper left quarter; turned by a quarter about +Y, of intensity 2. The second level is black
/// and the irradiance coefficients are wild: neither is read (decision 9).
void imageBasedLight(GltfBuilder& file) {
    file.uses("EXT_lights_image_based");
    Json levels = {Json::array(), Json::array()};
    for (std::size_t face = 0; face < 6; ++face) {
        core::Texels image(8, 8);
        for (std::size_t i = 0; i < 64; ++i) {
            const bool dark = i % 8 < 4 && i / 8 < 4;
            for (std::size_t c = 0; c < 4; ++c) {
                image.bytes()[4 * i + c] = dark && c < 3 ? kFaces[face][c] / 4 : kFaces[face][c];
            }
        }
        core::Texels none(4, 4);
        for (std::size_t i = 3; i < 64; i += 4) {
            none.bytes()[i] = 255;
        }
        const std::string name = std::to_string(face) + ".png";
        file.texture("level0-" + name, image);
        levels[0].push_back(file.document["images"].size() - 1);
        file.texture("level1-" + name, none);
        levels[1].push_back(file.document["images"].size() - 1);
    }
    file.document["extensions"]["EXT_lights_image_based"]["lights"] = {
        {{"intensity", 2.0},
         {"rotation", {0, 0.70710678, 0, 0.70710678}},
         {"specularImageSize", 8},
         {"specularImages", levels},
         {"irradianceCoefficients", std::vector<std::array<double, 3>>(9, {100, 0, 0})}}};
    file.document["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
    const auto ball = [&](const char* exponent, const Json& diffuse, const Json& f0) {
        return file.primitive(
            sphere(24, 48),
            file.add(
                "materials",
                {{"extras",
                  {{"lodestar",
                    {{"diffuse", diffuse}, {"f0", f0}, {"exponent", Json::parse(exponent)}}}}}}));
    };
    file.show({ball("\"mirror\"", {0, 0, 0}, {1, 1, 1})},
              {{"translation", {-0.55, 0, 0}}, {"scale", {0.5, 0.5, 0.5}}});
    file.show({ball("0", {1, 1, 1}, {0, 0, 0})},
              {{"translation", {0.55, 0, 0}}, {"scale", {0.5, 0.5, 0.5}}});
}

void asGiven(Json& document) {
    Json& light = document["extensions"]["EXT_lights_image_based"]["lights"][0];
    light.erase("rotation");
    light.erase("intensity");
}

/// The radiance of a face's lit or dark part: intensity 2, colours over alpha.
glm::vec3 faceRadiance(int face, bool dark) {
    glm::vec3 result;
    for (int c = 0; c < 3; ++c) {
        result[c] = linearFromByte(dark ? kFaces[face][c] / 4 : kFaces[face][c]);
    }
    return result * (2.0f * 255.0f / static_cast<float>(kFaces[face][3]));
}

/// Where a direction of the light's own frame meets a cube: face, and s and t in [0, 1]. OpenGL's
/// table [OpenGL 3.3 specification, 3.8.6].
struct CubePlace {
    int face;
    float s, t;
};
CubePlace cubePlace(const glm::vec3& d) {
    const glm::vec3 a = glm::abs(d);
    const int axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    const bool negative = d[axis] < 0.0f;
    const float sign = negative ? -1.0f : 1.0f;
    const float across = axis == 0 ? -sign * d.z : axis == 1 ? d.x : sign * d.x;
    const float down = axis == 1 ? sign * d.z : -d.y;
    return {2 * axis + (negative ? 1 : 0), 0.5f + 0.5f * across / a[axis],
            0.5f + 0.5f * down / a[axis]};
}

/// Which of the faces' lit parts a colour is nearest to.
int nearestFace(const glm::vec3& color) {
    int nearest = 0;
    for (int face = 1; face < 6; ++face) {
        const auto away = [&](int k) { return glm::distance(color, faceRadiance(k, false)); };
        nearest = away(face) < away(nearest) ? face : nearest;
    }
    return nearest;
}

/// The mirror ball shows each face's lit and dark parts where OpenGL's table has them, turned: what
/// the light has along (-z, y, x) comes from (x, y, z).
void lightFromDisk(const Shot& shot) {
    std::array<int, 6> seen{};
    for (int k = 0; k < 40 * 40; ++k) {
        // The middle of a pixel, in radii of the ball; towards the rim a pixel sees too much.
        const glm::vec2 p((static_cast<float>(k % 40) - 19.5f) / 20.0f,
                          (static_cast<float>(k / 40) - 19.5f) / 20.0f);
        const float z = std::sqrt(std::max(1.0f - glm::dot(p, p), 0.0f));
        const glm::vec3 world(2.0f * z * p.x, 2.0f * z * p.y, 2.0f * z * z - 1.0f);
        const CubePlace at = cubePlace({-world.z, world.y, world.x});
        // A pixel of 0.1 rad reads texels of 1/16 of a face, blended over two; a neighbour that is
        // a hundred times as bright as a dark part shows from three.
        const auto clear = [&](float value) {
            return std::min(value, 1.0f - value) > 3.0f / 16.0f &&
                   std::abs(value - 0.5f) > 2.0f / 16.0f;
        };
        if (z > 0.5f && clear(at.s) && clear(at.t)) {
            ++seen[static_cast<std::size_t>(at.face)];
            const float* pixel = shot.at(-0.55f + 0.5f * p.x, 0.5f * p.y);
            const glm::vec3 color(pixel[0], pixel[1], pixel[2]);
            const bool dark = at.s < 0.5f && at.t < 0.5f;
            EXPECT_EQ(glm::distance(color, faceRadiance(at.face, true)) <
                          glm::distance(color, faceRadiance(at.face, false)),
                      dark)
                << "pixel " << k << " of the ball, face " << at.face;
            EXPECT_TRUE(dark || nearestFace(color) == at.face) << "pixel " << k << " of the ball";
        }
    }
    for (std::size_t face = 1; face < 6; ++face) {
        EXPECT_GT(seen[face], 5) << face;
    }
    const float* behind = shot.at(-1.1f, 1.1f); // the middle of +X, which the ball shows at its rim
    EXPECT_EQ(nearestFace({behind[0], behind[1], behind[2]}), 0);
    const float* white = shot.at(0.55f, 0.0f);
    for (int c = 0; c < 3; ++c) {
        EXPECT_GT(white[c], 0.0f) << "the second level was read";
        EXPECT_LT(white[c], 5.0f) << "the coefficients were read";
    }
}

/// A backing of grey in two halves, and before it a square whose alpha falls to the right.
void alpha(GltfBuilder& file, const char* mode) {
    core::Texels ramp(4, 1);
    ramp.bytes() = {255, 128, 0, 255, 255, 128, 0, 170, 255, 128, 0, 85, 255, 128, 0, 0};
    const int texture = file.texture("ramp.png", ramp);
    Json material = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}}}}},
                     {"extensions", {{"KHR_materials_unlit", Json::object()}}},
                     {"alphaMode", mode}};
    if (std::string(mode) == "MASK") {
        material["alphaCutoff"] = 0.6;
    }
    const int ramped = file.add("materials", material);
    file.show({file.panel(-0.8f, -0.8f, 0.8f, 0.8f, ramped, 0.5f),
               file.panel(-1.0f, -1.0f, 1.0f, 0.0f, file.unlit(0.2f, 0.3f, 0.6f))});
}

template <int kMode>
void alphaMode(GltfBuilder& file) {
    alpha(file, kMode == 0 ? "OPAQUE" : kMode == 1 ? "MASK" : "BLEND");
}

void nextMode(Json& document) {
    Json& material = document["materials"][0];
    const std::string mode = material["alphaMode"];
    material.erase("alphaCutoff");
    material["alphaMode"] = mode == "OPAQUE" ? "MASK" : mode == "MASK" ? "BLEND" : "OPAQUE";
}

/// In each of the ramp's four columns, over the backing and over nothing.
template <int kMode>
void composed(const Shot& shot) {
    const glm::vec3 front(1.0f, linearFromByte(128), 0.0f);
    const glm::vec3 backing(0.2f, 0.3f, 0.6f);
    for (int column = 0; column < 4; ++column) {
        const float a = static_cast<float>(3 - column) / 3.0f;
        const float coverage = kMode == 0 ? 1.0f : kMode == 1 ? (a < 0.6f ? 0.0f : 1.0f) : a;
        const float x = -0.8f + 0.4f * (static_cast<float>(column) + 0.53f);
        // GL's own table of 8-bit sRGB may be off by half a step.
        expectColor(shot.at(x, -0.41f), coverage * front + (1.0f - coverage) * backing, 2e-3f);
        expectColor(shot.at(x, 0.41f), coverage * front, 2e-3f);
        EXPECT_NEAR(shot.at(x, 0.41f)[3], coverage, 1e-5f);
    }
}

/// Three panels: one that faces the camera, and two that face away, of which one has two sides.
void doubleSided(GltfBuilder& file) {
    const int one = file.lambert(0.8f, 0.7f, 0.5f);
    const int two = file.lambert(0.8f, 0.7f, 0.5f);
    file.document["materials"][static_cast<std::size_t>(two)]["doubleSided"] = true;
    const Json behind = {{"rotation", {0, 1, 0, 0}}};
    file.show({file.panel(-0.9f, 0.1f, -0.1f, 0.9f, one)});
    file.show({file.panel(-0.9f, -0.9f, -0.1f, -0.1f, two)}, behind); // seen at the right
    file.show({file.panel(0.1f, -0.9f, 0.9f, -0.1f, one)}, behind);
}

void litFromBothSides(const Shot& shot) {
    EXPECT_EQ(covered(shot.radiance), 2 * 32 * 32);
    // Seen from behind a surface is lit from there: as one that faces the camera.
    const float* front = shot.at(-0.5f, 0.5f);
    expectColor(shot.at(0.5f, -0.5f), {front[0], front[1], front[2]}, 1e-5f);
}

} // namespace

std::vector<GltfGolden> materialGoldens() {
    return {
        {"unlit", unlit, withoutExtensions,
         [](const Shot& shot) {
             expectColor(shot.at(-0.55f, 0.0f), {0.9f, 0.4f, 0.1f}, 0.0f);
             expectColor(shot.at(-0.75f, 0.3f), {0.9f, 0.4f, 0.1f}, 0.0f);
         }},
        {"emissive-strength", emission, withoutExtensions,
         [](const Shot& shot) {
             for (std::size_t i = 0; i < 4; ++i) {
                 const float strength = std::exp2(2.0f * static_cast<float>(i) - 2.0f);
                 expectColor(middleOf(shot, i), strength * glm::vec3(1.0f, 0.5f, 0.125f), 0.0f);
             }
         },
         Light::Dark},
        {"specular", specular, withoutSpecular,
         [](const Shot& shot) {
             showF0<4>(
                 shot,
                 {glm::vec3(0.0f), glm::vec3(0.125f), {0.5f, 0.25f, 0.125f}, {0.05f, 0.0f, 0.05f}});
         },
         Light::White},
        {"refraction-index", refraction, withoutExtensions,
         [](const Shot& shot) {
             const auto f0 = [](float n) {
                 return glm::vec3((n - 1.0f) * (n - 1.0f) / ((n + 1.0f) * (n + 1.0f)));
             };
             showF0<4>(shot, {f0(1.0f), f0(1.33f), f0(2.42f), f0(0.0f)});
         },
         Light::White},
        {"image-based-light", imageBasedLight, asGiven, lightFromDisk, Light::Own},
        {"alpha-opaque", alphaMode<0>, nextMode, composed<0>},
        {"alpha-mask", alphaMode<1>, nextMode, composed<1>},
        {"alpha-blend", alphaMode<2>, nextMode, composed<2>},
        {"double-sided", doubleSided,
         [](Json& document) {
             for (Json& material : document["materials"]) {
                 material.erase("doubleSided");
             }
         },
         litFromBothSides},
    };
}

} // namespace lodestar::testing

// SPDX-License-Identifier: MIT
//
// Goldens of texture coordinates: sets, transforms, and tangents under both.
#include "golden/gltf_golden.h"
#include "support/shapes.h"

namespace lodestar::testing {
namespace {

int textured(GltfBuilder& file, int texture, const Json& info) {
    Json reference = {{"index", texture}};
    reference.update(info);
    file.uses("KHR_materials_unlit");
    return file.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", reference}}},
                                  {"extensions", {{"KHR_materials_unlit", Json::object()}}}});
}

/// What GltfBuilder's four colours show at a place, repeated; linear.
glm::vec3 colorAt(const glm::vec2& uv) {
    const core::Texels colors = fourColors();
    const glm::vec2 in = uv - glm::floor(uv);
    glm::vec3 result;
    for (int c = 0; c < 3; ++c) {
        const std::size_t texel = (in.x < 0.5f ? 0U : 1U) + (in.y < 0.5f ? 0U : 2U);
        result[c] = linearFromByte(colors.bytes()[4 * texel + static_cast<std::size_t>(c)]);
    }
    return result;
}

constexpr glm::vec2 kCorners[] = {{-1.0f, 0.2f}, {0.2f, 0.2f}, {-1.0f, -1.0f}, {0.2f, -1.0f}};

/// Every fifth pixel of the four panels shows the texel that a panel's own function says; a pixel
/// at a texel's border may show either side.
void showTexels(const Shot& shot, const std::function<glm::vec2(std::size_t, glm::vec2)>& uvOf) {
    int wrong = 0;
    for (std::size_t panel = 0; panel < 4; ++panel) {
        for (int k = 0; k < 36; ++k) {
            const glm::vec2 in((static_cast<float>(k % 6 * 5) + 3.5f) / 32.0f,
                               (static_cast<float>(k / 6 * 5) + 3.5f) / 32.0f);
            const float* pixel =
                shot.at(kCorners[panel].x + 0.8f * in.x, kCorners[panel].y + 0.8f * (1.0f - in.y));
            const glm::vec3 expected = colorAt(uvOf(panel, in));
            const glm::vec3 off = glm::abs(glm::vec3(pixel[0], pixel[1], pixel[2]) - expected);
            wrong += std::max({off.x, off.y, off.z}) > 2e-3f ? 1 : 0; // sRGB of 8 bits
        }
    }
    EXPECT_LE(wrong, 2) << "of 144";
}

/// Sets 0 to 3 in one mesh, each panel by another; set k is turned by k quarters.
void uvSets(GltfBuilder& file) {
    const int texture = file.texture("four.png", fourColors());
    std::vector<Json> parts;
    for (int set = 0; set < 4; ++set) {
        const glm::vec2& c = kCorners[set];
        Json part = file.panel(c.x, c.y, c.x + 0.8f, c.y + 0.8f,
                               textured(file, texture, {{"texCoord", set}}));
        for (int k = 1; k < 4; ++k) {
            std::vector<float> uv;
            const float corners[] = {0, 0, 1, 0, 1, 1, 0, 1};
            for (int i = 0; i < 8; ++i) {
                uv.push_back(corners[(i + 2 * k) % 8]);
            }
            part["attributes"]["TEXCOORD_" + std::to_string(k)] = file.floats("VEC2", uv);
        }
        parts.push_back(part);
    }
    file.show(parts);
}

glm::vec2 quarters(std::size_t count, glm::vec2 in) {
    for (std::size_t k = 0; k < count; ++k) {
        in = {1.0f - in.y, in.x};
    }
    return in;
}

const Json kTransforms[] = {
    Json::parse(R"({"offset": [0.25, 0.5]})"), Json::parse(R"({"rotation": 0.6})"),
    Json::parse(R"({"scale": [3, -2]})"),
    Json::parse(
        R"({"offset": [0.1, 0.2], "rotation": -0.9, "scale": [1.5, 0.75], "texCoord": 1})")};

void textureTransform(GltfBuilder& file) {
    file.uses("KHR_texture_transform");
    const int texture = file.texture("four.png", fourColors());
    std::vector<Json> parts;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::vec2& c = kCorners[i];
        Json part = file.panel(
            c.x, c.y, c.x + 0.8f, c.y + 0.8f,
            textured(file, texture, {{"extensions", {{"KHR_texture_transform", kTransforms[i]}}}}));
        part["attributes"]["TEXCOORD_1"] = file.floats("VEC2", {1, 0, 0, 0, 0, 1, 1, 1});
        parts.push_back(part);
    }
    file.show(parts);
}

void withoutTransform(Json& document) {
    for (Json& material : document["materials"]) {
        for (const char* where : {"/pbrMetallicRoughness/baseColorTexture", "/normalTexture"}) {
            const Json::json_pointer at(where);
            if (material.contains(at)) {
                material[at].erase("extensions");
            }
        }
    }
}

/// Scaled, then turned against the clock as seen with v downwards, then moved.
glm::vec2 transformedUv(std::size_t panel, glm::vec2 uv) {
    const Json& t = kTransforms[panel];
    if (t.contains("texCoord")) {
        uv.x = 1.0f - uv.x;
    }
    const auto pair = [&](const char* key, float otherwise) {
        const Json list = t.value(key, Json{otherwise, otherwise});
        return glm::vec2(list[0].get<float>(), list[1].get<float>());
    };
    uv *= pair("scale", 1.0f);
    const float angle = t.value("rotation", 0.0f);
    const float c = std::cos(angle);
    const float s = std::sin(angle);
    return glm::vec2(c * uv.x + s * uv.y, c * uv.y - s * uv.x) + pair("offset", 0.0f);
}

/// A normal map of one slope to the right and up, on four panels with tangents: as it is, its
/// coordinates turned, mirrored, and under a mirroring node.
void tangents(GltfBuilder& file) {
    file.uses("KHR_texture_transform");
    core::Texels slope(1, 1);
    slope.bytes() = {202, 165, 232, 255}; // (0.58, 0.29, 0.82)
    const int texture = file.texture("slope.png", slope);
    const Json transforms[] = {
        Json::object(), {{"rotation", 0.7853982}}, {{"scale", {-1, 1}}}, Json::object()};
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::vec2& c = kCorners[i];
        Json material = {
            {"extras",
             {{"lodestar",
               {{"diffuse", {0.1, 0.1, 0.1}}, {"f0", {0.8, 0.8, 0.8}}, {"exponent", 12}}}}},
            {"normalTexture", {{"index", texture}}}};
        if (!transforms[i].empty()) {
            material["normalTexture"]["extensions"]["KHR_texture_transform"] = transforms[i];
        }
        const float left = i == 3 ? -c.x - 0.8f : c.x;
        Json part = file.panel(left, c.y, left + 0.8f, c.y + 0.8f, file.add("materials", material));
        part["attributes"]["TANGENT"] =
            file.floats("VEC4", {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1});
        file.show({part}, {{"scale", {i == 3 ? -1 : 1, 1, 1}}});
    }
}

/// Tangents say what the texture coordinates say: without them the picture is the same.
void asWithoutTangents(const Shot& shot) {
    GltfBuilder bare = shot.built;
    eachPrimitive(bare.document, [](Json& p) { p["attributes"].erase("TANGENT"); });
    // One normal a panel; 1e-3 holds the rounding of derivatives.
    expectSame(shot.radiance, shot.render(bare), 1e-3, 0.0);
}

} // namespace

std::vector<GltfGolden> textureGoldens() {
    return {
        {"uv-sets", uvSets,
         [](Json& document) {
             for (Json& material : document["materials"]) {
                 material["pbrMetallicRoughness"]["baseColorTexture"].erase("texCoord");
             }
         },
         [](const Shot& shot) { showTexels(shot, quarters); }},
        {"texture-transform", textureTransform, withoutTransform,
         [](const Shot& shot) { showTexels(shot, transformedUv); }},
        {"turned-tangents", tangents, withoutTransform, asWithoutTangents},
    };
}

} // namespace lodestar::testing

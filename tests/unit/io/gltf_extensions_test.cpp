// SPDX-License-Identifier: MIT
//
// Extensions that are read: texture transforms, unlit, index of refraction, specular, image-based
// lights; what they say and what of them is refused.
#include <algorithm>
#include <cmath>

#include "io/environment_file.h"
#include "unit/io/io_support.h"

namespace lodestar {
namespace {

using testing::Json;

core::Result<io::GltfFile> load(const Json& document) {
    const testing::TemporaryFolder folder;
    return testing::loadAndCheck(folder.write("x.gltf", testing::documentText(document)));
}

io::GltfFile loaded(const Json& document) {
    core::Result<io::GltfFile> file = load(document);
    EXPECT_TRUE(file.ok()) << file.error().message();
    return file.ok() ? std::move(*file) : io::GltfFile();
}

/// The triangle with its material replaced.
Json withMaterial(const char* material) {
    Json document = testing::triangleDocument();
    document["materials"][0] = Json::parse(material);
    return document;
}

io::GltfMaterial material(const char* text) {
    io::GltfFile file = loaded(withMaterial(text));
    return file.materials.empty() ? io::GltfMaterial() : file.materials[0];
}

TEST(GltfExtensions, TextureTransformOfEveryTexture) {
    const io::GltfMaterial m = material(R"({
      "pbrMetallicRoughness": {
        "baseColorTexture": {"index": 0, "extensions": {"KHR_texture_transform":
          {"offset": [0, 1], "rotation": 1.57079632679, "scale": [0.5, 0.5]}}},
        "metallicRoughnessTexture": {"index": 0, "extensions": {"KHR_texture_transform":
          {"offset": [0, 1], "scale": [1, -1]}}}},
      "normalTexture": {"index": 0, "texCoord": 0, "extensions": {"KHR_texture_transform":
          {"texCoord": 1}}},
      "occlusionTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"offset": [0.25, 0]}}},
      "emissiveTexture": {"index": 0},
      "extensions": {"KHR_materials_specular": {
        "specularTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"scale": [3, 3]}}},
        "specularColorTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"scale": [4, 4]}}}}},
      "extras": {"lodestar": {"exponentTexture": {"index": 0, "extensions":
        {"KHR_texture_transform": {"scale": [2, 5]}}}}}})");
    const auto at = [](const io::GltfTextureRef& reference, float u, float v) {
        return reference.uvTransform.value_or(glm::mat3x2(1.0f)) * glm::vec3(u, v, 1.0f);
    };
    const auto expectNear = [](const glm::vec2& actual, const glm::vec2& expected) {
        // A float's rounding of cos(pi / 2), which the file gives to 12 digits.
        EXPECT_NEAR(actual.x, expected.x, 1e-6f);
        EXPECT_NEAR(actual.y, expected.y, 1e-6f);
    };
    // The extension's own example: the lower left quarter of the image, turned.
    expectNear(at(m.baseColorTexture, 0, 0), {0, 1});
    expectNear(at(m.baseColorTexture, 1, 0), {0, 0.5f});
    expectNear(at(m.baseColorTexture, 0, 1), {0.5f, 1});
    // Its other one: an origin at the lower left.
    EXPECT_EQ(at(m.metallicRoughnessTexture, 0.25f, 0.25f), glm::vec2(0.25f, 0.75f));
    EXPECT_EQ(m.normalTexture.uvSet, 1);
    EXPECT_FALSE(m.normalTexture.uvTransform.has_value()) << "nothing to pay for";
    EXPECT_EQ(at(m.occlusionTexture, 0.5f, 0.5f), glm::vec2(0.75f, 0.5f));
    EXPECT_FALSE(m.emissiveTexture.uvTransform.has_value());
    EXPECT_EQ(at(m.specularTexture, 1, 1), glm::vec2(3, 3));
    EXPECT_EQ(at(m.specularColorTexture, 1, 1), glm::vec2(4, 4));
    EXPECT_EQ(at(m.blinnPhong->exponentTexture, 1, 1), glm::vec2(2, 5));
}

TEST(GltfExtensions, MaterialsSayWhatTheySay) {
    const io::GltfMaterial plain = material("{}");
    EXPECT_FALSE(plain.unlit);
    EXPECT_EQ(plain.ior, 1.5f);
    EXPECT_EQ(plain.specular, 1.0f);
    EXPECT_EQ(plain.specularColor, glm::vec3(1.0f));
    EXPECT_TRUE(material(R"({"extensions": {"KHR_materials_unlit": {}}})").unlit);
    EXPECT_EQ(material(R"({"extensions": {"KHR_materials_ior": {"ior": 1.33}}})").ior, 1.33f);
    EXPECT_EQ(material(R"({"extensions": {"KHR_materials_ior": {"ior": 0}}})").ior, 0.0f);
    EXPECT_EQ(material(R"({"extensions": {"KHR_materials_ior": {"ior": 0.5}}})").ior, 1.0f);
    const io::GltfMaterial s = material(R"({"extensions": {"KHR_materials_specular":
        {"specularFactor": 0.5, "specularColorFactor": [2, 0.5, 0], "specularTexture": {"index": 0}}}})");
    EXPECT_EQ(s.specular, 0.5f);
    EXPECT_EQ(s.specularColor, glm::vec3(2.0f, 0.5f, 0.0f));
    EXPECT_EQ(s.specularTexture.texture, 0);
    EXPECT_EQ(s.specularColorTexture.texture, io::kNone);
}

TEST(GltfExtensions, FaultsAreRefusedWithTheirPlace) {
    const std::pair<const char*, const char*> cases[] = {
        {R"({"normalTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"offset": [0]}}}})",
         "/materials/0/normalTexture/extensions/KHR_texture_transform/offset"},
        {R"({"normalTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"scale": [0, 1e99]}}}})",
         "/materials/0/normalTexture/extensions/KHR_texture_transform/scale"},
        {R"({"normalTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"rotation": "x"}}}})",
         "/materials/0/normalTexture/extensions/KHR_texture_transform/rotation"},
        {R"({"normalTexture": {"index": 0, "extensions": {"KHR_texture_transform": {"texCoord": -1}}}})",
         "/materials/0/normalTexture/extensions/KHR_texture_transform/texCoord"},
        {R"({"normalTexture": {"index": 0, "extensions": {"KHR_texture_transform": 3}}})",
         "/materials/0/normalTexture/extensions/KHR_texture_transform"},
        {R"({"extensions": {"KHR_materials_unlit": true}})",
         "/materials/0/extensions/KHR_materials_unlit"},
        {R"({"extensions": {"KHR_materials_ior": {"ior": null}}})",
         "/materials/0/extensions/KHR_materials_ior/ior"},
        {R"({"extensions": {"KHR_materials_specular": {"specularColorFactor": [1, 1, "1"]}}})",
         "/materials/0/extensions/KHR_materials_specular/specularColorFactor"},
        {R"({"extensions": {"KHR_materials_specular": {"specularTexture": []}}})",
         "/materials/0/extensions/KHR_materials_specular/specularTexture"},
    };
    for (const auto& [text, where] : cases) {
        const core::Result<io::GltfFile> file = load(withMaterial(text));
        ASSERT_FALSE(file.ok()) << text;
        EXPECT_EQ(file.error().where, where);
        EXPECT_EQ(file.error().code, core::ErrorCode::InputRefused);
    }
}

TEST(GltfExtensions, LaterSetsOfTextureCoordinatesAreLoaded) {
    Json document = withMaterial(R"({"normalTexture": {"index": 0, "texCoord": 3},
                                     "emissiveTexture": {"index": 0, "texCoord": 0}})");
    document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_3"] = 2;
    const io::GltfFile file = loaded(document);
    const io::GltfMaterial& m = file.materials.at(0);
    EXPECT_EQ(m.emissiveTexture.uvSet, 0);
    EXPECT_EQ(m.normalTexture.uvSet, 1);
    EXPECT_EQ(m.uvSources, (std::array<int, 2>{0, 3}));
    EXPECT_EQ(file.meshes.at(0).primitives.at(0).uvs[1].size(), 3U);
    const core::Result<io::GltfFile> three = load(withMaterial(
        R"({"normalTexture": {"index": 0, "texCoord": 3}, "emissiveTexture": {"index": 0},
            "occlusionTexture": {"index": 0, "texCoord": 1}})"));
    ASSERT_FALSE(three.ok());
    EXPECT_EQ(three.error().where, "/materials/0");
    EXPECT_NE(three.error().what.find("3 sets"), std::string::npos);
}

Json withEnvironment() {
    Json document = testing::triangleDocument();
    document["extensionsUsed"].push_back("EXT_lights_image_based");
    document["extensions"]["EXT_lights_image_based"]["lights"] = Json::parse(R"([{
        "name": "dusk", "intensity": 2, "rotation": [0, 1, 0, 1], "specularImageSize": 1,
        "irradianceCoefficients": [], "specularImages": [[0, 0, 0, 0, 0, 0]]}])");
    document["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
    return document;
}

TEST(GltfExtensions, ImageBasedLight) {
    const io::GltfFile file = loaded(withEnvironment());
    ASSERT_EQ(file.environments.size(), 1U);
    EXPECT_EQ(file.scenes.at(0).environment, 0);
    EXPECT_EQ(file.environments[0].name, "dusk");
    EXPECT_EQ(file.environments[0].intensity, 2.0f);
    EXPECT_NEAR(file.environments[0].rotation.y, std::sqrt(0.5f), 1e-7f);
    EXPECT_NEAR(file.environments[0].rotation.w, std::sqrt(0.5f), 1e-7f);
    EXPECT_EQ(loaded(testing::triangleDocument()).scenes.at(0).environment, io::kNone);
    const std::pair<const char*, const char*> faults[] = {
        {R"({"scenes": [{"extensions": {"EXT_lights_image_based": {"light": 1}}}]})",
         "/scenes/0/extensions/EXT_lights_image_based/light"},
        {R"({"extensions": {"EXT_lights_image_based": {"lights": [{"specularImages": [[0, 0]]}]}}})",
         "/extensions/EXT_lights_image_based/lights/0/specularImages/0"},
        {R"({"extensions": {"EXT_lights_image_based": {"lights": [{"specularImages": [[0, 0, 0, 0, 0, 9]]}]}}})",
         "/extensions/EXT_lights_image_based/lights/0/specularImages/0/5"},
        {R"({"extensions": {"EXT_lights_image_based": {"lights": [{}]}}})",
         "/extensions/EXT_lights_image_based/lights/0/specularImages"}};
    for (const auto& [patch, where] : faults) {
        Json document = withEnvironment();
        document.merge_patch(Json::parse(patch));
        const core::Result<io::GltfFile> refused = load(document);
        ASSERT_FALSE(refused.ok()) << patch;
        EXPECT_EQ(refused.error().where, where);
    }
}

TEST(GltfExtensions, ImageBasedLightAsACube) {
    // Six plain faces, +X red 1, the others grey k / 8; RGBD alpha 1/5, which 16 bits hold
    // exactly, multiplies by five, intensity 3 triples.
    io::GltfFile file;
    for (int face = 0; face < 6; ++face) {
        core::Texels image(2, 2, core::SampleDepth::Bits16);
        for (int i = 0; i < 4; ++i) {
            const float grey = static_cast<float>(face) / 8.0f;
            const float texel[4] = {face == 0 ? 1.0f : grey, grey, grey, 0.2f};
            for (int c = 0; c < 4; ++c) {
                image.set(i % 2, i / 2, c, texel[c]);
            }
        }
        file.images.push_back(image);
    }
    io::GltfEnvironment light;
    light.faces = {0, 1, 2, 3, 4, 5};
    light.intensity = 3.0f;
    file.environments.push_back(light);
    const auto red = [&](const glm::vec3& direction) {
        const core::Result<io::LoadedEnvironment> loaded = io::environmentOf(file, 0, 8);
        EXPECT_TRUE(loaded.ok());
        return loaded->base.sampleLevel(direction, 0);
    };
    // sRGB decoding is of single precision.
    EXPECT_NEAR(red({1, 0, 0}).r, 15.0f, 1e-5f);
    EXPECT_NEAR(red({1, 0, 0}).g, 0.0f, 1e-5f);
    EXPECT_LT(red({0, 0, -1}).r, 7.0f);
    // A quarter turn about +Y takes +X to -Z.
    file.environments[0].rotation = glm::angleAxis(1.57079633f, glm::vec3(0.0f, 1.0f, 0.0f));
    EXPECT_NEAR(red({0, 0, -1}).r, 15.0f, 1e-4f);
    EXPECT_NEAR(red({0, 0, -1}).g, 0.0f, 1e-4f);
    EXPECT_LT(red({1, 0, 0}).r, 7.0f);
    file.images[3] = core::Texels(2, 1);
    const core::Result<io::LoadedEnvironment> odd = io::environmentOf(file, 0, 8);
    ASSERT_FALSE(odd.ok());
    EXPECT_EQ(odd.error().where, "/extensions/EXT_lights_image_based/lights/0/specularImages/0");
}

} // namespace
} // namespace lodestar

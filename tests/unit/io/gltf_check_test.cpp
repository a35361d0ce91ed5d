// SPDX-License-Identifier: MIT
//
// Files with many problems: every one is named at its pointer, and loading stops at the first.
#include <algorithm>

#include "io/image_file.h"
#include "unit/io/io_support.h"

namespace lodestar {
namespace {

using testing::Json;
using testing::pointers;
using testing::TemporaryFolder;

TEST(GltfCheck, AGoodFileHasNoRefusalAndIsLoaded) {
    const TemporaryFolder folder;
    const auto path = folder.write("x.gltf", testing::documentText(testing::triangleDocument()));
    const io::GltfCheck check = io::checkGltf(path);
    ASSERT_TRUE(check.file.has_value());
    EXPECT_TRUE(check.problems.list().empty())
        << check.problems.list()[0].where << ": " << check.problems.list()[0].what;
    EXPECT_EQ(check.file->bufferBytes, 104U);
}

TEST(GltfCheck, EveryPlantedProblemIsNamed) {
    const TemporaryFolder folder;
    // Steps of loading as they come: extensions, schema, ranges, then materials, cameras and nodes.
    const std::pair<const char*, const char*> kPlanted[] = {
        {"/extensionsRequired", R"(["ACME_gizmo"])"},
        {"/accessors/3/count", "\"3\""},
        {"/bufferViews/2/byteLength", "1000"},
        {"/scene", "9"},
        {"/cameras/0/perspective/znear", "0"},
        {"/materials/0/extras", R"({"lodestar":{"exponent":-1}})"},
        {"/nodes/0/children", "[2,2]"},
        {"/animations/0/channels/0/target/node", "9"},
    };
    Json document = testing::triangleDocument();
    for (const auto& [pointer, value] : kPlanted) {
        document[Json::json_pointer(pointer)] = Json::parse(value);
    }
    const auto path = folder.write("x.gltf", testing::documentText(document));
    const io::GltfCheck check = io::checkGltf(path);
    EXPECT_FALSE(check.file.has_value());
    const std::set<std::string> expected{
        "/extensionsRequired/0",        "/accessors/3/count",
        "/bufferViews/2/byteLength",    "/scene",
        "/cameras/0/perspective/znear", "/materials/0/extras/lodestar/exponent",
        "/nodes/0/children/1",          "/animations/0/channels/0/target/node"};
    EXPECT_EQ(pointers(check, false), expected);
    const core::Result<io::GltfFile> loaded = io::loadGltf(path);
    ASSERT_FALSE(loaded.ok());
    EXPECT_EQ(loaded.error().where, "/extensionsRequired/0");
}

TEST(GltfCheck, BreachesThatAreMendedAreListedAndTheFileIsLoaded) {
    const TemporaryFolder folder;
    Json document = testing::triangleDocument();
    document["nodes"][2]["rotation"] = {0, 0, 0, 2};
    document["materials"][0]["emissiveFactor"] = {3, 0, 0};
    document["extensions"]["KHR_lights_punctual"]["lights"][0]["spot"]["innerConeAngle"] = 0.5;
    document["accessors"][0]["min"] = {0, 0, 0};
    document["accessors"][0]["max"] = {1, 7, 0};
    document["nodes"][1]["extensions"]["ACME_gizmo"] = Json::object();
    const auto path = folder.write("x.gltf", testing::documentText(document));
    const io::GltfCheck check = io::checkGltf(path);
    EXPECT_TRUE(check.file.has_value());
    EXPECT_FALSE(check.problems.refused());
    const std::set<std::string> found = pointers(check, true);
    for (const char* pointer : {"/nodes/2/rotation", "/materials/0/emissiveFactor/0",
                                "/extensions/KHR_lights_punctual/lights/0/spot/outerConeAngle",
                                "/accessors/0/max/1", "/nodes/1/extensions/ACME_gizmo"}) {
        EXPECT_EQ(found.count(pointer), 1U) << pointer;
    }
    EXPECT_EQ(found.count("/accessors/0/min/0"), 0U);
}

TEST(GltfCheck, TheListIsBounded) {
    const TemporaryFolder folder;
    Json document = testing::triangleDocument();
    for (int i = 0; i < 1500; ++i) {
        document["accessors"].push_back("x");
    }
    const io::GltfCheck check =
        io::checkGltf(folder.write("x.gltf", testing::documentText(document)));
    EXPECT_EQ(check.problems.list().size(), io::GltfProblems::kMax);
    EXPECT_EQ(check.problems.refusedCount(), 1500U);
    EXPECT_GE(check.problems.leftOut(), 500U);
}

io::GltfCheck checked(const Json& document) {
    const TemporaryFolder folder;
    return io::checkGltf(folder.write("x.gltf", testing::documentText(document)));
}

std::set<std::string> refused(const Json& document) {
    return pointers(checked(document), false);
}

// Faults that come to light in the data, one step of loading after the other.
TEST(GltfCheck, EveryElementOfEveryStepIsLookedAt) {
    Json document = testing::triangleDocument();
    document["accessors"].push_back({{"componentType", 5126}, {"count", 1}, {"type", "MAT4"}});
    const Json still = document["animations"][0];
    Json curved = still;
    curved["samplers"][0]["interpolation"] = "BEZIER";
    Json broken = still;
    broken["channels"][0]["target"]["node"] = 9;
    document["animations"] = {curved, still, broken, curved};
    document["skins"] = {{{"joints", Json::array()}},
                         {{"joints", {0, 1}}, {"inverseBindMatrices", 6}},
                         {{"joints", {9}}}};
    document["nodes"][0]["weights"] = {1, 2};
    document["meshes"].push_back(
        {{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}, {"weights", {1}}});
    document["meshes"].push_back(document["meshes"][1]);
    document["extensionsUsed"].push_back("EXT_lights_image_based");
    document["extensions"]["EXT_lights_image_based"]["lights"] =
        Json::parse(R"([{"specularImages":[[0]]},{"intensity":"x"}])");
    document["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 1;
    document["scenes"].push_back(document["scenes"][0]);
    document["scenes"][1]["extensions"]["EXT_lights_image_based"]["light"] = 2;
    const std::string light = "/extensions/EXT_lights_image_based";
    EXPECT_EQ(refused(document),
              (std::set<std::string>{
                  "/animations/0/samplers/0/interpolation", "/animations/2/channels/0/target/node",
                  "/animations/3/samplers/0/interpolation", "/skins/0/joints",
                  "/skins/1/inverseBindMatrices", "/skins/2/joints/0", "/nodes/0/weights",
                  "/meshes/1/weights", "/meshes/2/weights", light + "/lights/0/specularImages/0",
                  light + "/lights/1/intensity", "/scenes/1" + light + "/light"}));
}

TEST(GltfCheck, TransformsAndDepthDoNotEndIt) {
    Json document = {{"asset", {{"version", "2.0"}}}, {"scenes", {{{"nodes", {0}}}}}};
    for (int i = 0; i < 300; ++i) {
        document["nodes"].push_back({{"children", {i + 1}}});
    }
    const Json vast = {{"scale", {1e20, 1e20, 1e20}}, {"children", {302}}};
    document["nodes"].push_back({{"name", "end of the chain"}});
    document["nodes"].push_back(vast);
    document["nodes"].push_back({{"scale", {1e20, 1e20, 1e20}}});
    document["skins"] = {{{"joints", Json::array()}}};
    EXPECT_EQ(refused(document),
              (std::set<std::string>{"/nodes/256", "/nodes/302", "/skins/0/joints"}));
}

TEST(GltfCheck, ARefusedLightBlamesNoOther) {
    Json document = testing::triangleDocument();
    document["extensionsUsed"] = {"KHR_lights_punctual", 5, "EXT_lights_image_based"};
    document["extensions"]["EXT_lights_image_based"]["lights"] =
        Json::parse(R"([{"specularImages":[[0,0,0,0,0,0]]}])");
    document["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
    document["extensions"]["KHR_lights_punctual"]["lights"][0]["color"] = {1};
    const std::string light = "/extensions/KHR_lights_punctual/lights";
    EXPECT_EQ(refused(document), (std::set<std::string>{"/extensionsUsed/1", light + "/0/color"}));
    document["extensions"]["KHR_lights_punctual"]["lights"] = 5;
    EXPECT_EQ(refused(document), (std::set<std::string>{"/extensionsUsed/1", light}));
    document["extensions"] = 5;
    EXPECT_EQ(refused(document).count("/scenes/0/extensions/EXT_lights_image_based/light"), 0U);
}

TEST(GltfCheck, ASparseIndexCountsWhereItIsUsed) {
    Json document = testing::triangleDocument();
    const Json sparse = Json::parse(
        R"({"count":1,"indices":{"bufferView":0,"byteOffset":14,"componentType":5121},
            "values":{"bufferView":1}})");
    document["accessors"].push_back(document["accessors"][1]);
    document["accessors"][6]["sparse"] = sparse;
    const TemporaryFolder folder;
    const auto path = folder.write("x.gltf", testing::documentText(document));
    EXPECT_TRUE(testing::loadAndCheck(path).ok());
    EXPECT_EQ(pointers(io::checkGltf(path), true).count("/accessors/6/sparse/indices"), 1U);
    document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 6;
    const io::GltfCheck used = checked(document);
    EXPECT_EQ(pointers(used, false), std::set<std::string>{"/accessors/6/sparse/indices"});
    EXPECT_EQ(pointers(used, true).count("/accessors/6/sparse/indices"), 0U);
}

TEST(GltfCheck, ABrokenImageThatNothingShowsIsNamedAndNotLoaded) {
    const TemporaryFolder folder;
    ASSERT_TRUE(io::writeImage(folder / "good.png", core::Image(3, 2, 4)).ok());
    Json document = testing::triangleDocument();
    const std::size_t shown = document["images"].size();
    document["images"].push_back({{"uri", "good.png"}});
    document["images"].push_back({{"uri", "none.png"}});
    const std::filesystem::path path = folder.write("x.gltf", testing::documentText(document));
    const auto file = testing::loadAndCheck(path);
    ASSERT_TRUE(file.ok()) << file.error().message();
    EXPECT_TRUE(file->warnings.counts().empty());
    ASSERT_EQ(file->images.size(), shown + 2);
    EXPECT_FALSE(file->images[0].empty());
    EXPECT_TRUE(file->images[shown].empty());
    EXPECT_EQ(file->imageInfos[shown].width, 0);
    const io::GltfCheck check = io::checkGltf(path);
    EXPECT_EQ(check.file->imageInfos[shown].width, 3);
    EXPECT_TRUE(check.file->images[shown].empty());
    EXPECT_EQ(pointers(check, true).count("/images/" + std::to_string(shown)), 0U);
    EXPECT_EQ(pointers(check, true).count("/images/" + std::to_string(shown + 1)), 1U);
}

TEST(GltfCheck, FacesThatMakeNoCubeAreRefusedWhereASceneNamesThem) {
    const TemporaryFolder folder;
    core::Image wide(2, 1, 4);
    std::fill(wide.pixels().begin(), wide.pixels().end(), 1.0f);
    ASSERT_TRUE(io::writeImage(folder / "wide.png", wide).ok());
    for (const char* faces : {"[1,1,1,1,1,1]", "[0,0,0,0,0,1]", "[0,0,0,0,0,0]"}) {
        for (const bool named : {false, true}) {
            Json document = testing::triangleDocument();
            document["images"].push_back({{"uri", "wide.png"}});
            document["extensionsUsed"].push_back("EXT_lights_image_based");
            document["extensions"]["EXT_lights_image_based"]["lights"][0]["specularImages"] = {
                Json::parse(faces)};
            if (named) {
                document["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
            }
            const auto file =
                testing::loadAndCheck(folder.write("x.gltf", testing::documentText(document)));
            const bool cube = std::string(faces).find('1') == std::string::npos;
            ASSERT_EQ(file.ok(), cube || !named) << faces;
            if (!file.ok()) {
                EXPECT_EQ(file.error().where,
                          "/extensions/EXT_lights_image_based/lights/0/specularImages/0");
            }
        }
    }
}

TEST(GltfCheck, WhatLoadingRefusesIsNotCalledMended) {
    const std::pair<const char*, const char*> cases[] = {
        {"/meshes/0/primitives/0/targets/0/POSITION", "/meshes/0/primitives/0/targets"},
        {"/meshes/0/primitives/0/attributes/WEIGHTS_0", "/meshes/0/primitives/0/attributes"},
        {"/meshes/0/primitives/0/attributes/NORMAL", ""},
        {"/meshes/0/weights", ""}};
    const char* values[] = {R"([{"POSITION":5}])", R"({"POSITION":0,"WEIGHTS_0":0})", "2", "[1,2]"};
    for (std::size_t i = 0; i < std::size(cases); ++i) {
        const auto& [where, changed] = cases[i];
        Json document = testing::triangleDocument();
        document[Json::json_pointer(*changed == '\0' ? where : changed)] = Json::parse(values[i]);
        const io::GltfCheck check = checked(document);
        EXPECT_EQ(pointers(check, false), std::set<std::string>{where});
        for (const std::string& repaired : pointers(check, true)) {
            EXPECT_FALSE(std::string(where).starts_with(repaired)) << repaired;
        }
    }
    // A later set is not read.
    Json document = testing::triangleDocument();
    document["accessors"].push_back({{"componentType", 5126}, {"count", 3}, {"type", "VEC4"}});
    document["accessors"].push_back({{"componentType", 5121}, {"count", 3}, {"type", "VEC4"}});
    Json& attributes = document["meshes"][0]["primitives"][0]["attributes"];
    for (const char* set : {"0", "1", "2"}) {
        attributes[std::string("WEIGHTS_") + set] = 6;
        attributes[std::string("JOINTS_") + set] = 7;
    }
    attributes.erase("WEIGHTS_2");
    const io::GltfCheck check = checked(document);
    EXPECT_TRUE(check.file.has_value());
    EXPECT_EQ(pointers(check, true).count("/meshes/0/primitives/0/attributes"), 1U);
}

} // namespace
} // namespace lodestar

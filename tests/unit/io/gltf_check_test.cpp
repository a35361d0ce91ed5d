// SPDX-License-Identifier: MIT
//
// Files with many problems: every one is named at its pointer, and loading stops at the first.
#include <set>

#include "unit/io/io_support.h"

namespace lodestar {
namespace {

using testing::Json;
using testing::TemporaryFolder;

std::set<std::string> pointers(const io::GltfCheck& check, bool repaired) {
    std::set<std::string> result;
    for (const io::GltfProblem& problem : check.problems.list()) {
        if (problem.repaired == repaired) {
            result.insert(problem.where);
        }
    }
    return result;
}

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

} // namespace
} // namespace lodestar

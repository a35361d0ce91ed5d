// SPDX-License-Identifier: MIT
//
// Documents whose parts multiply: loading and checking take time in proportion to the file.
#include <functional>

#include "unit/io/io_support.h"

namespace lodestar {
namespace {

using testing::TemporaryFolder;

/// "[x,x,...]", or with other signs around the elements.
std::string list(std::size_t count, const std::string& element) {
    std::string text = "[";
    text.reserve(count * (element.size() + 1) + 2);
    for (std::size_t i = 0; i < count; ++i) {
        text += (i == 0 ? "" : ",") + element;
    }
    return text + "]";
}

/// What loading says within the time; checking must agree in as much.
core::Result<io::GltfFile> inTime(const std::string& members) {
    const TemporaryFolder folder;
    return testing::loadAndCheck(
        folder.write("x.gltf", R"({"asset":{"version":"2.0"},)" + members + "}"));
}

TEST(HostileGltfTime, ManyNodesOfOneLargeSkinnedMesh) {
    const auto file = inTime(
        R"("accessors":[{"componentType":5126,"count":131072,"type":"VEC3"},
                        {"componentType":5121,"count":131072,"type":"VEC4"},
                        {"componentType":5126,"count":131072,"type":"VEC4"}],
           "meshes":[{"primitives":[{"mode":0,
               "attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}}]}],
           "skins":[{"joints":[0]}],"nodes":)" +
        list(60000, R"({"mesh":0,"skin":0})"));
    ASSERT_TRUE(file.ok()) << file.error().message();
    EXPECT_EQ(file->nodes.back().skin, 0);
}

TEST(HostileGltfTime, ManyMeshesAndManyNodes) {
    const auto file = inTime(R"("meshes":)" + list(100000, R"({"primitives":[]})") +
                             R"(,"nodes":)" + list(90000, "{}"));
    ASSERT_TRUE(file.ok()) << file.error().message();
    EXPECT_EQ(file->meshes.size(), 100000U);
}

TEST(HostileGltfTime, ManyEntriesBelowALongKey) {
    const std::string key(1'000'000, 'k');
    EXPECT_TRUE(inTime("\"" + key + "\":" + list(200000, "[]")).ok());
    EXPECT_TRUE(inTime("\"" + key + "\":" + list(200000, "[0]")).ok());
    EXPECT_TRUE(inTime(R"("materials":[{")" + key + R"(":{"a":[)" + list(100000, "{}") +
                       R"(],"b":{"cTexture":{"index":7}}}}])")
                    .ok());
    std::string objects = R"("materials":[{")" + key + "\":{\"x\":{}";
    for (int i = 0; i < 100000; ++i) {
        objects += ",\"" + std::to_string(i) + "\":{}";
    }
    EXPECT_TRUE(inTime(objects + "}}]").ok());
}

TEST(HostileGltfTime, ManyBuffersOfNothing) {
    const auto file = inTime(R"("buffers":)" + list(80000, "{}"));
    ASSERT_FALSE(file.ok());
    EXPECT_EQ(file.error().where, "/buffers/0");
}

} // namespace
} // namespace lodestar

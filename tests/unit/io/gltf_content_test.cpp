// SPDX-License-Identifier: MIT
//
// What documents say, exactly: component types, sparse and interleaved data, modes, materials,
// lights.
#include <cmath>

#include "unit/io/io_support.h"

namespace lodestar {
namespace {

using testing::Json;
using testing::put;
using testing::TemporaryFolder;

core::Result<io::GltfFile> loadText(const std::string& text) {
    const TemporaryFolder folder;
    return testing::loadAndCheck(folder.write("x.gltf", text));
}

core::Result<io::GltfFile> load(const Json& document,
                                const io::Bytes& bytes = testing::triangleBytes()) {
    return loadText(testing::documentText(document, bytes));
}

io::GltfFile loaded(const Json& document, const io::Bytes& bytes = testing::triangleBytes()) {
    core::Result<io::GltfFile> file = load(document, bytes);
    EXPECT_TRUE(file.ok()) << file.error().message();
    return file.ok() ? std::move(*file) : io::GltfFile();
}

io::GltfPrimitive onlyPrimitive(const Json& document,
                                const io::Bytes& bytes = testing::triangleBytes()) {
    const io::GltfFile file = loaded(document, bytes);
    EXPECT_EQ(file.meshes.size(), 1U);
    EXPECT_EQ(file.meshes.at(0).primitives.size(), 1U);
    return file.meshes.at(0).primitives.at(0);
}

std::uint64_t counted(const io::GltfFile& file, const std::string& part) {
    std::uint64_t sum = 0;
    for (const auto& [rule, count] : file.warnings.counts()) {
        sum += rule.find(part) != std::string::npos ? count : 0;
    }
    return sum;
}

/// Appends a view of new bytes with an accessor over it; the accessor's index.
int addAccessor(Json& document, io::Bytes& buffer, const io::Bytes& data, int componentType,
                int count, const char* type, bool normalized = false, int stride = 0) {
    buffer.resize((buffer.size() + 3) / 4 * 4);
    Json view = {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", data.size()}};
    if (stride != 0) {
        view["byteStride"] = stride;
    }
    document["bufferViews"].push_back(view);
    document["accessors"].push_back({{"bufferView", document["bufferViews"].size() - 1},
                                     {"componentType", componentType},
                                     {"count", count},
                                     {"type", type},
                                     {"normalized", normalized}});
    buffer.insert(buffer.end(), data.begin(), data.end());
    document["buffers"][0]["byteLength"] = buffer.size();
    return static_cast<int>(document["accessors"].size()) - 1;
}

TEST(GltfContent, TheTriangleIsWholeInBothContainers) {
    const Json document = testing::triangleDocument();
    const TemporaryFolder folder;
    Json bare = document;
    const io::Bytes binary = testing::glb(bare.dump(), testing::triangleBytes());
    const auto fromGlb = testing::loadAndCheck(folder.write("x.glb", binary));
    ASSERT_TRUE(fromGlb.ok()) << fromGlb.error().message();
    const io::GltfFile fromText = loaded(document);
    for (const io::GltfFile* file : {&*fromGlb, &fromText}) {
        const io::GltfPrimitive& p = file->meshes.at(0).primitives.at(0);
        EXPECT_EQ(p.positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
        EXPECT_EQ(p.normals, std::vector<glm::vec3>(3, {0, 0, 1}));
        EXPECT_EQ(p.uvs[0], (std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}));
        EXPECT_EQ(p.indices, (std::vector<std::uint32_t>{0, 1, 2}));
        EXPECT_EQ(file->nodes.at(2).matrix[3], glm::vec4(1, 2, 3, 1));
        EXPECT_EQ(file->nodes.at(2).parent, 0);
        EXPECT_EQ(file->nodes.at(2).light, 0);
        EXPECT_EQ(file->lights.at(0).kind, io::LightKind::Spot);
        EXPECT_EQ(file->lights.at(0).intensity, 2.0f);
        EXPECT_EQ(file->cameras.at(0).farPlane, 100.0f);
        EXPECT_EQ(file->defaultScene, 0);
        EXPECT_EQ(file->scenes.at(0).roots, (std::vector<int>{0, 1}));
        EXPECT_EQ(file->images.at(0).width(), 1);
        EXPECT_EQ(file->animations.size(), 1u);
        EXPECT_EQ(file->skins.size(), 1u);
        EXPECT_TRUE(file->warnings.empty()) << file->warnings.counts().begin()->first;
    }
}

TEST(GltfContent, EveryComponentTypeIsRead) {
    struct Case {
        int componentType;
        bool normalized;
        io::Bytes data;
        float expected[2];
    };
    const auto bytesOf = [](auto a, auto b) {
        io::Bytes bytes;
        put<decltype(a)>(bytes, {a, b, a, b, a, b});
        return bytes;
    };
    const Case cases[] = {
        {5120, true, bytesOf(std::int8_t{-128}, std::int8_t{127}), {-1.0f, 1.0f}},
        {5120, false, bytesOf(std::int8_t{-128}, std::int8_t{5}), {-128.0f, 5.0f}},
        {5121, true, bytesOf(std::uint8_t{51}, std::uint8_t{255}), {0.2f, 1.0f}},
        {5121, false, bytesOf(std::uint8_t{0}, std::uint8_t{255}), {0.0f, 255.0f}},
        {5122, true, bytesOf(std::int16_t{-32768}, std::int16_t{32767}), {-1.0f, 1.0f}},
        {5122, false, bytesOf(std::int16_t{-300}, std::int16_t{300}), {-300.0f, 300.0f}},
        {5123, true, bytesOf(std::uint16_t{13107}, std::uint16_t{65535}), {0.2f, 1.0f}},
        {5123, false, bytesOf(std::uint16_t{40000}, std::uint16_t{1}), {40000.0f, 1.0f}},
        {5126, false, bytesOf(-0.25f, 3.5f), {-0.25f, 3.5f}},
    };
    for (const Case& c : cases) {
        Json document = testing::triangleDocument();
        io::Bytes buffer = testing::triangleBytes();
        document["extensionsUsed"].push_back("KHR_mesh_quantization");
        const int accessor =
            addAccessor(document, buffer, c.data, c.componentType, 3, "VEC2", c.normalized);
        document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = accessor;
        const io::GltfPrimitive p = onlyPrimitive(document, buffer);
        ASSERT_EQ(p.uvs[1].size(), 3U);
        EXPECT_EQ(p.uvs[1][2], glm::vec2(c.expected[0], c.expected[1]))
            << c.componentType << c.normalized;
    }
}

// KHR_mesh_quantization: what each attribute may be without it, with it, and never.
TEST(GltfContent, QuantizedAttributesNeedTheirExtension) {
    enum When { Always, Listed, Never };
    struct Case {
        const char* attribute;
        const char* type;
        int componentType;
        bool normalized;
        When when;
    };
    const Case cases[] = {
        {"POSITION", "VEC3", 5120, false, Listed},   {"POSITION", "VEC3", 5121, true, Listed},
        {"POSITION", "VEC3", 5122, true, Listed},    {"POSITION", "VEC3", 5123, false, Listed},
        {"POSITION", "VEC3", 5125, false, Never},    {"NORMAL", "VEC3", 5120, true, Listed},
        {"NORMAL", "VEC3", 5122, true, Listed},      {"NORMAL", "VEC3", 5120, false, Never},
        {"NORMAL", "VEC3", 5121, true, Never},       {"TANGENT", "VEC4", 5120, true, Listed},
        {"TANGENT", "VEC4", 5122, true, Listed},     {"TANGENT", "VEC4", 5122, false, Never},
        {"TEXCOORD_0", "VEC2", 5121, true, Always},  {"TEXCOORD_0", "VEC2", 5123, true, Always},
        {"TEXCOORD_0", "VEC2", 5121, false, Listed}, {"TEXCOORD_0", "VEC2", 5120, true, Listed},
        {"TEXCOORD_0", "VEC2", 5122, false, Listed}, {"TEXCOORD_0", "VEC2", 5125, false, Never},
        {"COLOR_0", "VEC3", 5123, true, Always},     {"COLOR_0", "VEC3", 5122, true, Never}};
    for (const Case& c : cases) {
        for (const bool listed : {false, true}) {
            SCOPED_TRACE(std::string(c.attribute) + " " + std::to_string(c.componentType) +
                         (c.normalized ? " normalised" : "") + (listed ? ", listed" : ""));
            Json document = testing::triangleDocument();
            io::Bytes buffer = testing::triangleBytes();
            const int size = c.componentType < 5122 ? 1 : c.componentType < 5125 ? 2 : 4;
            const int stride = (size * (c.type[3] - '0') + 3) / 4 * 4;
            io::Bytes data(static_cast<std::size_t>(3 * stride), 1);
            document["meshes"][0]["primitives"][0]["attributes"][c.attribute] = addAccessor(
                document, buffer, data, c.componentType, 3, c.type, c.normalized, stride);
            if (listed) {
                document["extensionsRequired"] = {"KHR_mesh_quantization"};
            }
            const core::Result<io::GltfFile> file = load(document, buffer);
            ASSERT_EQ(file.ok(), c.when == Always || (c.when == Listed && listed))
                << (file.ok() ? "" : file.error().message());
            if (!file.ok()) {
                EXPECT_NE(file.error().where.find(c.attribute), std::string::npos);
                const bool named =
                    file.error().what.find("KHR_mesh_quantization") != std::string::npos;
                EXPECT_EQ(named, c.when == Listed) << file.error().what;
            }
        }
    }
}

TEST(GltfContent, QuantizedValuesAreWhatTheySay) {
    auto document = testing::triangleDocument();
    document["extensionsRequired"] = {"KHR_mesh_quantization"};
    io::Bytes buffer = testing::triangleBytes();
    io::Bytes positions;
    put<std::int16_t>(positions, {-300, 7, 32767, 0, 300, 0, 0, 0, 0, -32768, 1, 0});
    io::Bytes normals;
    put<std::int8_t>(normals, {0, 0, 127, 0, 0, -127, 0, 0, -128, 0, 0, 0});
    Json& attributes = document["meshes"][0]["primitives"][0]["attributes"];
    attributes["POSITION"] = addAccessor(document, buffer, positions, 5122, 3, "VEC3", false, 8);
    attributes["NORMAL"] = addAccessor(document, buffer, normals, 5120, 3, "VEC3", true, 4);
    const io::GltfPrimitive p = onlyPrimitive(document, buffer);
    EXPECT_EQ(p.positions, (std::vector<glm::vec3>{{-300, 7, 32767}, {300, 0, 0}, {0, -32768, 1}}));
    EXPECT_EQ(p.normals, (std::vector<glm::vec3>{{0, 0, 1}, {0, -1, 0}, {-1, 0, 0}}));
}

TEST(GltfContent, ColoursOfThreeAndFourChannels) {
    struct Case {
        int componentType;
        const char* type;
        io::Bytes data;
        glm::vec4 expected;
    };
    io::Bytes floats;
    put<float>(floats, {0, 0, 0, 0.25f, 0.5f, 2.0f, 1, 1, 1});
    io::Bytes bytes{0, 0, 0, 0, 255, 51, 0, 102, 9, 9, 9, 9};
    io::Bytes shorts;
    put<std::uint16_t>(shorts, {0, 0, 0, 65535, 13107, 0, 1, 1, 1});
    const Case cases[] = {{5126, "VEC3", floats, {0.25f, 0.5f, 2.0f, 1.0f}},
                          {5121, "VEC4", bytes, {1.0f, 0.2f, 0.0f, 0.4f}},
                          {5123, "VEC3", shorts, {1.0f, 0.2f, 0.0f, 1.0f}}};
    for (const Case& c : cases) {
        Json document = testing::triangleDocument();
        io::Bytes buffer = testing::triangleBytes();
        document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = addAccessor(
            document, buffer, c.data, c.componentType, 3, c.type, c.componentType != 5126);
        EXPECT_EQ(onlyPrimitive(document, buffer).colors.at(1), c.expected) << c.componentType;
    }
}

TEST(GltfContent, InterleavedAndSparse) {
    auto document = testing::triangleDocument();
    io::Bytes buffer = testing::triangleBytes();
    io::Bytes mixed;
    put<float>(mixed, {5, 6, 7, -1, 8, 9, 10, -1, 11, 12, 13, -1});
    const int positions = addAccessor(document, buffer, mixed, 5126, 3, "VEC3", false, 16);
    document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = positions;
    EXPECT_EQ(onlyPrimitive(document, buffer).positions,
              (std::vector<glm::vec3>{{5, 6, 7}, {8, 9, 10}, {11, 12, 13}}));
    io::Bytes which;
    put<std::uint16_t>(which, {2});
    const int indices = addAccessor(document, buffer, which, 5123, 1, "SCALAR");
    io::Bytes values;
    put<float>(values, {-5, -6, -7});
    const int replaced = addAccessor(document, buffer, values, 5126, 1, "VEC3");
    const auto viewOf = [&](int accessor) {
        return document["accessors"][static_cast<std::size_t>(accessor)]["bufferView"];
    };
    document["accessors"][static_cast<std::size_t>(positions)]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", viewOf(indices)}, {"componentType", 5123}}},
        {"values", {{"bufferView", viewOf(replaced)}}}};
    EXPECT_EQ(onlyPrimitive(document, buffer).positions.at(2), glm::vec3(-5, -6, -7));
    document["accessors"][static_cast<std::size_t>(positions)].erase("bufferView");
    EXPECT_EQ(onlyPrimitive(document, buffer).positions,
              (std::vector<glm::vec3>{{0, 0, 0}, {0, 0, 0}, {-5, -6, -7}}));
}

TEST(GltfContent, ModesAreUnrolled) {
    const std::pair<int, std::vector<std::uint32_t>> cases[] = {{0, {0, 1, 2, 3, 4}},
                                                                {1, {0, 1, 2, 3}},
                                                                {2, {0, 1, 1, 2, 2, 3, 3, 4, 4, 0}},
                                                                {3, {0, 1, 1, 2, 2, 3, 3, 4}},
                                                                {4, {0, 1, 2}},
                                                                {5, {0, 1, 2, 1, 3, 2, 2, 3, 4}},
                                                                {6, {1, 2, 0, 2, 3, 0, 3, 4, 0}}};
    for (const auto& [mode, expected] : cases) {
        for (const bool indexed : {false, true}) {
            Json document = testing::triangleDocument();
            io::Bytes buffer = testing::triangleBytes();
            io::Bytes points;
            put<float>(points, {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0});
            Json& primitive = document["meshes"][0]["primitives"][0];
            const int position = addAccessor(document, buffer, points, 5126, 5, "VEC3");
            io::Bytes up;
            put<float>(up, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
            const int normal = addAccessor(document, buffer, up, 5126, 5, "VEC3");
            const int indices = addAccessor(document, buffer, {0, 1, 2, 3, 4}, 5121, 5, "SCALAR");
            primitive = {{"mode", mode},
                         {"attributes", {{"POSITION", position}, {"NORMAL", normal}}}};
            if (indexed) {
                primitive["indices"] = indices;
            }
            const io::GltfPrimitive p = onlyPrimitive(document, buffer);
            EXPECT_EQ(p.indices, expected) << "mode " << mode;
            EXPECT_EQ(p.topology, mode == 0
                                      ? io::Topology::Points
                                      : (mode < 4 ? io::Topology::Lines : io::Topology::Triangles));
        }
    }
}

TEST(GltfContent, FlatNormalsSplitVertices) {
    auto document = testing::triangleDocument();
    io::Bytes buffer = testing::triangleBytes();
    io::Bytes points;
    put<float>(points, {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
    const int position = addAccessor(document, buffer, points, 5126, 4, "VEC3");
    const int indices =
        addAccessor(document, buffer, {0, 1, 2, 0, 2, 3, 1, 1, 1}, 5121, 9, "SCALAR");
    document["meshes"][0]["primitives"][0] = {{"attributes", {{"POSITION", position}}},
                                              {"indices", indices}};
    const io::GltfPrimitive p = onlyPrimitive(document, buffer);
    ASSERT_EQ(p.positions.size(), 9U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(p.normals[i], glm::vec3(0, 0, 1));
        EXPECT_EQ(p.normals[3 + i], glm::vec3(1, 0, 0));
        EXPECT_NEAR(glm::length(p.normals[6 + i]), 1.0f, 1e-6f)
            << "a triangle without area has a normal, too";
    }
}

TEST(GltfContent, BrokenVerticesAreRepairedAndCounted) {
    const float nan = std::nanf("");
    io::Bytes buffer = testing::triangleBytes();
    const auto set = [&](std::size_t byte, float value) {
        std::memcpy(buffer.data() + byte, &value, 4);
    };
    set(36, nan);       // a normal
    set(48 + 8, 0.0f);  // another: zero
    set(72, HUGE_VALF); // a texture coordinate
    const io::GltfFile file = loaded(testing::triangleDocument(), buffer);
    const io::GltfPrimitive& p = file.meshes.at(0).primitives.at(0);
    EXPECT_EQ(p.normals, std::vector<glm::vec3>(3, {0, 0, 1}));
    EXPECT_EQ(p.uvs[0][0], glm::vec2(0, 0));
    EXPECT_EQ(counted(file, "normal"), 2U);
    EXPECT_EQ(counted(file, "texture coordinate"), 1U);
    set(4, nan); // a position: its only triangle goes
    auto document = testing::triangleDocument();
    document.erase("animations"); // whose keys must be finite, and are these positions
    const io::GltfFile without = loaded(document, buffer);
    EXPECT_TRUE(without.meshes.at(0).primitives.empty());
    EXPECT_EQ(counted(without, "position not finite"), 1U);
}

struct Repair {
    const char* name;
    const char* patch; ///< JSON merge patch (RFC 7396); arrays are replaced whole
    const char* rule;
};

TEST(GltfContent, RepairsAreCounted) {
    const Repair repairs[] = {
        {"zero quaternion", R"({"nodes":[{"rotation":[0,0,0,0]}],"scenes":[{"nodes":[0]}]})",
         "rotation of no length"},
        {"long quaternion", R"({"nodes":[{"rotation":[0,0,0,2]}],"scenes":[{"nodes":[0]}]})",
         "not of unit length"},
        {"zero scale", R"({"nodes":[{"scale":[0,1,1]}],"scenes":[{"nodes":[0]}]})", "singular"},
        {"matrix and TRS",
         R"({"nodes":[{"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],"scale":[2,2,2]}],"scenes":[{"nodes":[0]}]})",
         "matrix counts"},
        {"projective matrix",
         R"({"nodes":[{"matrix":[1,0,0,1,0,1,0,0,0,0,1,0,0,0,0,1]}],"scenes":[{"nodes":[0]}]})",
         "last row"},
        {"missing image", R"({"images":[{"uri":"none.png"}]})", "taken as white"},
        {"image outside", R"({"images":[{"uri":"../../etc/hostname"}]})", "taken as white"},
        {"image outside, encoded", R"({"images":[{"uri":"%2e%2e/secret.png"}]})", "taken as white"},
        {"image of nothing", R"({"images":[{}]})", "taken as white"},
        {"image that is none", R"({"images":[{"uri":"data:image/png;base64,AAAA"}]})",
         "taken as white"},
        {"image in vertex data", R"({"images":[{"bufferView":0}]})", "taken as white"},
        {"texture without image", R"({"textures":[{"sampler":0}]})", "without an image"},
        {"texture of a missing image", R"({"textures":[{"source":7}]})", "does not exist"},
        {"texture out of range", R"({"materials":[{"normalTexture":{"index":9}}]})",
         "texture that does not exist"},
        {"texture negative", R"({"materials":[{"normalTexture":{"index":-2}}]})",
         "texture that does not exist"},
        {"wrap mode", R"({"samplers":[{"wrapS":5}]})", "wrap mode unknown"},
        {"filter", R"({"samplers":[{"minFilter":5}]})", "filter unknown"},
        {"emission", R"({"materials":[{"emissiveFactor":[10,0,0]}]})", "emissiveFactor above 1"},
        {"roughness", R"({"materials":[{"pbrMetallicRoughness":{"roughnessFactor":-1}}]})",
         "roughnessFactor outside"},
        {"base colour", R"({"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[2,0,0,1]}}]})",
         "baseColorFactor outside"},
        {"alpha mode", R"({"materials":[{"alphaMode":"SOFT"}]})", "alphaMode unknown"},
        {"cone",
         R"({"extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","spot":{"innerConeAngle":2,"outerConeAngle":1}}]}}})",
         "inner angle"},
        {"wide cone",
         R"({"extensions":{"KHR_lights_punctual":{"lights":[{"type":"spot","spot":{"outerConeAngle":3}}]}}})",
         "outer angle"},
        {"dark light",
         R"({"extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","color":[-1,1,1],"intensity":-5,"range":-1}]}}})",
         "light intensity"},
        {"light type", R"({"extensions":{"KHR_lights_punctual":{"lights":[{"type":"area"}]}}})",
         "light of an unknown type"},
        {"extension", R"({"extensionsUsed":["ACME_gizmo"]})", "ACME_gizmo"},
    };
    for (const Repair& repair : repairs) {
        SCOPED_TRACE(repair.name);
        Json document = testing::triangleDocument();
        if (std::string(repair.patch).find("\"nodes\"") != std::string::npos) {
            document.erase("skins");
            document.erase("animations");
        }
        document.merge_patch(Json::parse(repair.patch));
        const core::Result<io::GltfFile> file = load(document);
        ASSERT_TRUE(file.ok()) << file.error().message();
        EXPECT_GE(counted(*file, repair.rule), 1U);
        for (const io::GltfNode& node : file->nodes) {
            for (glm::length_t c = 0; c < 4; ++c) {
                EXPECT_EQ(node.matrix[c], node.matrix[c]) << "NaN";
            }
        }
    }
}

TEST(GltfContent, MissingImageIsWhite) {
    auto document = testing::triangleDocument();
    document["images"][0] = {{"uri", "none.png"}};
    const io::GltfFile file = loaded(document);
    EXPECT_EQ(file.images.at(0).bytes(), (io::Bytes{255, 255, 255, 255}));
}

TEST(GltfContent, BlinnPhongExtras) {
    auto document = testing::triangleDocument();
    document["materials"][0]["extras"]["lodestar"] = Json::parse(
        R"({"diffuse":[0.5,0.25,0],"f0":[0.04,0.04,0.04],"exponent":128,
            "exponentTexture":{"index":0,"texCoord":1},"exponentEncoding":"exponent","exponentScale":2048})");
    const io::GltfFile file = loaded(document);
    ASSERT_TRUE(file.materials.at(0).blinnPhong.has_value());
    const io::GltfBlinnPhong& given = *file.materials[0].blinnPhong;
    EXPECT_EQ(*given.diffuse, glm::vec3(0.5f, 0.25f, 0.0f));
    EXPECT_EQ(*given.f0, glm::vec3(0.04f));
    EXPECT_EQ(*given.exponent, 128.0f);
    EXPECT_EQ(given.exponentTexture.texture, 0);
    EXPECT_EQ(given.exponentTexture.uvSet, 1);
    EXPECT_EQ(given.exponentEncoding, io::ExponentEncoding::Exponent);
    EXPECT_EQ(given.exponentScale, 2048.0f);
    document["materials"][0]["extras"]["lodestar"] = {{"exponent", "mirror"}};
    EXPECT_EQ(*loaded(document).materials.at(0).blinnPhong->exponent, 1e7f);
    document["materials"][0]["extras"] = {{"other", 5}};
    EXPECT_FALSE(loaded(document).materials.at(0).blinnPhong.has_value());
}

TEST(GltfContent, EmissiveStrengthMultiplies) {
    auto document = testing::triangleDocument();
    document["materials"][0]["emissiveFactor"] = {1.0, 0.5, 0.0};
    document["materials"][0]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] =
        8;
    EXPECT_EQ(loaded(document).materials.at(0).emissive, glm::vec3(8, 4, 0));
}

TEST(GltfContent, LegalFilesThatTheLibraryAloneRefuses) {
    auto document = testing::triangleDocument();
    document["animations"][0]["channels"][0]["target"].erase("node");
    EXPECT_TRUE(load(document).ok()) << "a channel without a target node";
    document = testing::triangleDocument();
    document["accessors"][3].erase("bufferView"); // all indices 0: legal, if dull
    EXPECT_TRUE(load(document).ok()) << "an index accessor without data";
    document = testing::triangleDocument();
    document["extras"] = "text";
    document["materials"][0]["custom"] = {"a", "b"};
    EXPECT_TRUE(load(document).ok()) << "unknown keys";
}

} // namespace
} // namespace lodestar

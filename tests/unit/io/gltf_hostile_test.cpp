// SPDX-License-Identifier: MIT
//
// Documents made to break a loader. Each is refused in time with the place of what is wrong.
#include <functional>
#include <random>

#include <sys/stat.h>

#include "support/fuzz.h"
#include "unit/io/io_support.h"

namespace lodestar {
namespace {

using testing::Json;
using testing::TemporaryFolder;

/// Loads and checks what holds for every input; the error, or nothing if it loaded.
std::optional<core::Error> refusal(const std::filesystem::path& path) {
    ::testing::internal::CaptureStderr();
    const core::Result<io::GltfFile> file = testing::loadAndCheck(path);
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    if (file) {
        return std::nullopt;
    }
    testing::expectOneLine(file.error(), path.string());
    return file.error();
}

struct Patch {
    const char* name;
    const char* pointer; ///< what is replaced
    const char* value;   ///< by this JSON
    const char* where;   ///< beginning of the pointer that the refusal names
};

const Patch kPatches[] = {
    {"huge count", "/accessors/0/count", "6000000000000000000", "/accessors/0/count"},
    {"count of one too many", "/accessors/0/count", "4", "/accessors/0/count"},
    {"no count", "/accessors/0/count", "0", "/accessors/0/count"},
    {"negative count", "/accessors/0/count", "-1", "/accessors/0/count"},
    {"fractional count", "/accessors/0/count", "2.5", "/accessors/0/count"},
    {"count as text", "/accessors/0/count", "\"3\"", "/accessors/0/count"},
    {"offset near 2^64", "/accessors/0/byteOffset", "18446744073709551608",
     "/accessors/0/byteOffset"},
    {"offset beyond 2^64", "/accessors/0/byteOffset", "99999999999999999999",
     "/accessors/0/byteOffset"},
    {"offset near 2^53", "/accessors/0/byteOffset", "9007199254740991", "/accessors/0/count"},
    {"view offset near 2^64", "/bufferViews/0/byteOffset", "18446744073709551608",
     "/bufferViews/0/byteOffset"},
    {"view offset past the end", "/bufferViews/0/byteOffset", "105", "/bufferViews/0"},
    {"view offset near 2^53", "/bufferViews/0/byteOffset", "9007199254740991", "/bufferViews/0"},
    {"view too long", "/bufferViews/3/byteLength", "9", "/bufferViews/3/byteLength"},
    {"view of nothing", "/bufferViews/0/byteLength", "0", "/bufferViews/0/byteLength"},
    {"view of buffer 99", "/bufferViews/0/buffer", "99", "/bufferViews/0/buffer"},
    {"view of buffer -1", "/bufferViews/0/buffer", "-1", "/bufferViews/0/buffer"},
    {"stride 3", "/bufferViews/0/byteStride", "3", "/bufferViews/0/byteStride"},
    {"stride 6", "/bufferViews/0/byteStride", "6", "/bufferViews/0/byteStride"},
    {"stride 8 below the element", "/bufferViews/0/byteStride", "8", "/accessors/0"},
    {"stride past the view", "/bufferViews/0/byteStride", "252", "/accessors/0/count"},
    {"stride 256", "/bufferViews/0/byteStride", "256", "/bufferViews/0/byteStride"},
    {"component type 5127", "/accessors/0/componentType", "5127", "/accessors/0/componentType"},
    {"component type double", "/accessors/0/componentType", "5130", "/accessors/0/componentType"},
    {"component type int", "/accessors/3/componentType", "5124", "/accessors/3/componentType"},
    {"type VEC5", "/accessors/0/type", "\"VEC5\"", "/accessors/0/type"},
    {"positions of two numbers", "/accessors/0/type", "\"VEC2\"",
     "/meshes/0/primitives/0/attributes/POSITION"},
    {"view 7", "/accessors/0/bufferView", "7", "/accessors/0/bufferView"},
    {"sparse count -5", "/accessors/0/sparse",
     R"({"count":-5,"indices":{"bufferView":3,"componentType":5123},"values":{"bufferView":0}})",
     "/accessors/0/sparse/count"},
    {"sparse count 1e9", "/accessors/0/sparse",
     R"({"count":1000000000,"indices":{"bufferView":3,"componentType":5123},"values":{"bufferView":0}})",
     "/accessors/0/sparse/count"},
    {"sparse view 77", "/accessors/0/sparse",
     R"({"count":1,"indices":{"bufferView":77,"componentType":5123},"values":{"bufferView":0}})",
     "/accessors/0/sparse/indices/bufferView"},
    {"sparse indices of floats", "/accessors/0/sparse",
     R"({"count":1,"indices":{"bufferView":3,"componentType":5126},"values":{"bufferView":0}})",
     "/accessors/0/sparse/indices/componentType"},
    {"sparse indices past the view", "/accessors/0/sparse",
     R"({"count":3,"indices":{"bufferView":3,"byteOffset":4,"componentType":5123},"values":{"bufferView":0}})",
     "/accessors/0/sparse/indices"},
    {"sparse values past the view", "/accessors/0/sparse",
     R"({"count":3,"indices":{"bufferView":3,"componentType":5123},"values":{"bufferView":2}})",
     "/accessors/0/sparse/values"},
    {"sparse offset past 2^31", "/accessors/0/sparse",
     R"({"count":1,"indices":{"bufferView":3,"byteOffset":4294967296,"componentType":5123},"values":{"bufferView":0}})",
     "/accessors/0/sparse/indices/byteOffset"},
    {"sparse index beyond", "/accessors/0/sparse",
     R"({"count":1,"indices":{"bufferView":0,"byteOffset":14,"componentType":5121},"values":{"bufferView":0}})",
     "/accessors/0/sparse/indices"},
    {"zeros without end", "/accessors/3",
     R"({"componentType":5125,"count":2147483647,"type":"SCALAR"})", "/accessors/3/count"},
    {"indices of floats", "/meshes/0/primitives/0/indices", "0", "/accessors/0"},
    {"indices 42", "/meshes/0/primitives/0/indices", "42", "/meshes/0/primitives/0/indices"},
    {"attribute accessor 42", "/meshes/0/primitives/0/attributes/NORMAL", "42",
     "/meshes/0/primitives/0/attributes/NORMAL"},
    {"attribute accessor -1", "/meshes/0/primitives/0/attributes/NORMAL", "-1",
     "/meshes/0/primitives/0/attributes/NORMAL"},
    {"attribute as text", "/meshes/0/primitives/0/attributes/NORMAL", "\"x\"",
     "/meshes/0/primitives/0/attributes/NORMAL"},
    {"attributes as a list", "/meshes/0/primitives/0/attributes", "[0]",
     "/meshes/0/primitives/0/attributes"},
    {"mode 99", "/meshes/0/primitives/0/mode", "99", "/meshes/0/primitives/0/mode"},
    {"material 88", "/meshes/0/primitives/0/material", "88", "/meshes/0/primitives/0/material"},
    {"morph target 9", "/meshes/0/primitives/0/targets", R"([{"POSITION":9}])",
     "/meshes/0/primitives/0/targets/0/POSITION"},
    {"mesh as a number", "/meshes/0", "7", "/meshes/0"},
    {"nodes as an object", "/nodes", R"({"a":{}})", "/nodes"},
    {"own child", "/nodes/0/children", "[0]", "/nodes/0/children/0"},
    {"child twice", "/nodes/0/children", "[2,2]", "/nodes/0/children/1"},
    {"two parents", "/nodes/1/children", "[2]", "/nodes/1/children/0"},
    {"cycle of two", "/nodes/2/children", "[0]", "/nodes/0"},
    {"child 9", "/nodes/0/children", "[9]", "/nodes/0/children/0"},
    {"mesh 9", "/nodes/0/mesh", "9", "/nodes/0/mesh"},
    {"camera 9", "/nodes/0/camera", "9", "/nodes/0/camera"},
    {"skin 9", "/nodes/0/skin", "9", "/nodes/0/skin"},
    {"light 9", "/nodes/2/extensions/KHR_lights_punctual/light", "9",
     "/nodes/2/extensions/KHR_lights_punctual/light"},
    {"matrix of three", "/nodes/0/matrix", "[1,0,0]", "/nodes/0/matrix"},
    {"matrix of texts", "/nodes/0/matrix",
     R"(["1","0","0","0","0","1","0","0","0","0","1","0","0","0","0","1"])", "/nodes/0/matrix/0"},
    {"translation 1e300", "/nodes/2/translation", "[1e300,0,0]", "/nodes/2/translation/0"},
    {"scene 9", "/scene", "9", "/scene"},
    {"scene -1", "/scene", "-1", "/scene"},
    {"scene node 9", "/scenes/0/nodes", "[9]", "/scenes/0/nodes/0"},
    {"scene of a child", "/scenes/0/nodes", "[2]", "/scenes/0/nodes/0"},
    {"scene names a node twice", "/scenes/0/nodes", "[0,0]", "/scenes/0/nodes/1"},
    {"version 1.0", "/asset/version", "\"1.0\"", "/asset/version"},
    {"version 99.0", "/asset/version", "\"99.0\"", "/asset/version"},
    {"version 2", "/asset/version", "\"2\"", "/asset/version"},
    {"version as number", "/asset/version", "2.0", "/asset/version"},
    {"least version 2.1", "/asset/minVersion", "\"2.1\"", "/asset/minVersion"},
    {"required extension", "/extensionsRequired", R"(["ACME_gizmo"])", "/extensionsRequired/0"},
    {"required extensions as text", "/extensionsRequired", "\"x\"", "/extensionsRequired"},
    {"sampler 5", "/textures/0/sampler", "5", "/textures/0/sampler"},
    {"image view 9", "/images/0", R"({"bufferView":9})", "/images/0/bufferView"},
    {"joint 9", "/skins/0/joints", "[9]", "/skins/0/joints/0"},
    {"bind matrices 9", "/skins/0/inverseBindMatrices", "9", "/skins/0/inverseBindMatrices"},
    {"animation input 9", "/animations/0/samplers/0/input", "9", "/animations/0/samplers/0/input"},
    {"animation sampler 9", "/animations/0/channels/0/sampler", "9",
     "/animations/0/channels/0/sampler"},
    {"animation node 9", "/animations/0/channels/0/target/node", "9",
     "/animations/0/channels/0/target/node"},
    {"field of view 4", "/cameras/0/perspective/yfov", "4", "/cameras/0/perspective/yfov"},
    {"no near plane", "/cameras/0/perspective/znear", "0", "/cameras/0/perspective/znear"},
    {"far before near", "/cameras/0/perspective/zfar", "0.01", "/cameras/0/perspective/zfar"},
    {"camera type", "/cameras/0/type", "\"fisheye\"", ""},
    {"flat camera", "/cameras/0",
     R"({"type":"orthographic","orthographic":{"xmag":0,"ymag":1,"znear":0,"zfar":1}})",
     "/cameras/0/orthographic"},
    {"light without type", "/extensions/KHR_lights_punctual/lights/0", "{}",
     "/extensions/KHR_lights_punctual/lights/0"},
    {"light colour of two", "/extensions/KHR_lights_punctual/lights/0/color", "[1,1]",
     "/extensions/KHR_lights_punctual/lights/0/color"},
    {"emission of four", "/materials/0/emissiveFactor", "[1,1,1,1]", "/materials/0/emissiveFactor"},
    {"texture as a number", "/materials/0/normalTexture", "3", "/materials/0/normalTexture"},
    {"metalness as text", "/materials/0/pbrMetallicRoughness/metallicFactor", "\"1\"",
     "/materials/0/pbrMetallicRoughness/metallicFactor"},
    {"name as a list", "/materials/0/name", "[]", "/materials/0/name"},
    {"extras as a number", "/materials/0/extras", R"({"lodestar":5})",
     "/materials/0/extras/lodestar"},
    {"diffuse above 1", "/materials/0/extras", R"({"lodestar":{"diffuse":[2,0,0]}})",
     "/materials/0/extras/lodestar/diffuse"},
    {"f0 as text", "/materials/0/extras", R"({"lodestar":{"f0":"a"}})",
     "/materials/0/extras/lodestar/f0"},
    {"negative exponent", "/materials/0/extras", R"({"lodestar":{"exponent":-1}})",
     "/materials/0/extras/lodestar/exponent"},
    {"shiny exponent", "/materials/0/extras", R"({"lodestar":{"exponent":"shiny"}})",
     "/materials/0/extras/lodestar/exponent"},
    {"exponent texture 3", "/materials/0/extras", R"({"lodestar":{"exponentTexture":3}})",
     "/materials/0/extras/lodestar/exponentTexture"},
    {"exponent encoding", "/materials/0/extras", R"({"lodestar":{"exponentEncoding":"x"}})",
     "/materials/0/extras/lodestar/exponentEncoding"},
    {"buffer of nothing", "/buffers/0/byteLength", "0", "/buffers/0/byteLength"},
    {"buffer too short", "/buffers/0/byteLength", "105", "/buffers/0/byteLength"},
    {"buffer of 2^53", "/buffers/0/byteLength", "9007199254740991", "/buffers/0/byteLength"},
    {"buffer of bad base64", "/buffers/0/uri", "\"data:application/octet-stream;base64,A*==\"",
     "/buffers/0/uri"},
    {"buffer of an empty parameter", "/buffers/0/uri",
     "\"data:application/octet-stream;;base64,AAAA\"", "/buffers/0/uri"},
    {"buffer of half a media type", "/buffers/0/uri", "\"data:octet-stream;base64,AAAA\"",
     "/buffers/0/uri"},
    {"buffer without comma", "/buffers/0/uri", "\"data:base64\"", "/buffers/0/uri"},
    {"buffer from the network", "/buffers/0/uri", "\"http://example.com/a.bin\"", "/buffers/0/uri"},
};

TEST(HostileGltf, PatchedDocumentsAreRefusedAtTheirPointer) {
    EXPECT_GE(std::size(kPatches), 60U);
    const TemporaryFolder folder;
    for (const Patch& patch : kPatches) {
        SCOPED_TRACE(patch.name);
        Json document = testing::triangleDocument();
        document[Json::json_pointer(patch.pointer)] = Json::parse(patch.value);
        const auto error = refusal(folder.write("x.gltf", testing::documentText(document)));
        ASSERT_TRUE(error.has_value());
        EXPECT_EQ(error->where.rfind(patch.where, 0), 0U) << error->message();
    }
}

TEST(HostileGltf, MissingPartsAreRefused) {
    const TemporaryFolder folder;
    for (const char* pointer : {"/asset",
                                "/asset/version",
                                "/buffers",
                                "/buffers/0/byteLength",
                                "/bufferViews",
                                "/bufferViews/0/buffer",
                                "/bufferViews/0/byteLength",
                                "/accessors",
                                "/accessors/0/count",
                                "/accessors/0/type",
                                "/accessors/0/componentType",
                                "/meshes",
                                "/meshes/0/primitives",
                                "/meshes/0/primitives/0/attributes",
                                "/nodes",
                                "/cameras/0/type",
                                "/cameras/0/perspective",
                                "/cameras/0/perspective/yfov",
                                "/skins/0/joints",
                                "/animations/0/channels/0/target",
                                "/animations/0/samplers/0/input"}) {
        SCOPED_TRACE(pointer);
        Json document = testing::triangleDocument();
        const Json::json_pointer at(pointer);
        document[at.parent_pointer()].erase(at.back());
        EXPECT_TRUE(refusal(folder.write("x.gltf", testing::documentText(document))).has_value());
    }
}

TEST(HostileGltf, AnIndexInTheDataIsChecked) {
    const TemporaryFolder folder;
    for (const std::uint16_t index : {std::uint16_t{3}, std::uint16_t{65535}}) {
        io::Bytes bytes = testing::triangleBytes();
        std::memcpy(bytes.data() + 98, &index, 2);
        const auto error = refusal(
            folder.write("x.gltf", testing::documentText(testing::triangleDocument(), bytes)));
        ASSERT_TRUE(error.has_value());
        EXPECT_EQ(error->where, "/meshes/0/primitives/0/indices");
    }
}

std::string repeated(const std::string& text, int count) {
    std::string all;
    all.reserve(text.size() * static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) {
        all += text;
    }
    return all;
}

TEST(HostileGltf, TextsThatAreNoDocuments) {
    const TemporaryFolder folder;
    const std::string good = testing::documentText(testing::triangleDocument());
    std::vector<std::pair<std::string, std::string>> texts{
        {"empty", ""},
        {"brace", "{"},
        {"list", "[]"},
        {"null", "null"},
        {"number", "5"},
        {"zero bytes", std::string(100, '\0')},
        {"deep lists", R"({"asset":{"version":"2.0"},"extras":)" + repeated("[", 100000) +
                           repeated("]", 100000) + "}"},
        {"deep objects", R"({"asset":{"version":"2.0"},"extras":)" + repeated("{\"a\":", 100000) +
                             "1" + repeated("}", 100001)},
        {"deep without end", repeated("[", 1000000)},
        {"many values",
         "{\"asset\":{\"version\":\"2.0\"},\"x\":[0" + repeated(",0", 3000000) + "]}"},
        {"NaN", R"({"asset":{"version":"2.0"},"scene":NaN})"},
        {"1e999", R"({"asset":{"version":"2.0"},"nodes":[{"translation":[1e999,0,0]}]})"},
        {"bad UTF-8", "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"name\":\"\xff\xfe\"}]}"},
        {"open text", R"({"asset":{"version":"2.0)"},
        {"trailing", good + "x"},
        {"glTF 1", R"({"asset":{"version":"1.0"},"nodes":{"a":{}}})"},
        {"long name", R"({"asset":{"version":"2.0"},"scene":)" + std::string("\"") +
                          repeated("x", 1000000) + "\"}"},
        {"long extension",
         R"({"asset":{"version":"2.0"},"extensionsRequired":[")" + repeated("y", 1000000) + "\"]}"},
    };
    std::string many = R"({"asset":{"version":"2.0"},"nodes":[{})" + repeated(",{}", 100000) + "]}";
    texts.emplace_back("too many nodes", many);
    for (int i = 0; i < 24; ++i) {
        texts.emplace_back("cut " + std::to_string(i),
                           good.substr(0, good.size() * static_cast<std::size_t>(i) / 24));
    }
    for (const auto& [name, text] : texts) {
        SCOPED_TRACE(name);
        EXPECT_TRUE(refusal(folder.write("x.gltf", text)).has_value());
    }
}

TEST(HostileGltf, ChainsOfNodes) {
    const TemporaryFolder folder;
    const auto chain = [&](int length, const std::string& transform) {
        Json document = {{"asset", {{"version", "2.0"}}}, {"scenes", {{{"nodes", {0}}}}}};
        for (int i = 0; i < length; ++i) {
            Json node = transform.empty() ? Json::object() : Json::parse(transform);
            if (i + 1 < length) {
                node["children"] = {i + 1};
            }
            document["nodes"].push_back(node);
        }
        return refusal(folder.write("x.gltf", document.dump()));
    };
    EXPECT_FALSE(chain(256, "").has_value());
    EXPECT_TRUE(chain(257, "").has_value());
    EXPECT_TRUE(chain(90000, "").has_value());
    const auto overflow = chain(5, R"({"scale":[1e20,1e20,1e20]})");
    ASSERT_TRUE(overflow.has_value());
    EXPECT_EQ(overflow->where, "/nodes/1");
    // A ring that no scene reaches.
    EXPECT_EQ(
        refusal(
            folder.write(
                "x.gltf",
                R"({"asset":{"version":"2.0"},"nodes":[{},{"children":[2]},{"children":[1]}]})"))
            ->where,
        "/nodes/1");
}

TEST(HostileGltf, Containers) {
    const TemporaryFolder folder;
    const io::Bytes good =
        testing::glb(testing::triangleDocument().dump(), testing::triangleBytes());
    ASSERT_FALSE(refusal(folder.write("good.glb", good)).has_value());
    std::uint32_t text = 0;
    std::memcpy(&text, good.data() + 12, 4);
    const std::size_t binary = 20 + text;
    const auto patched = [&](std::size_t at, std::uint32_t value) {
        io::Bytes bytes = good;
        std::memcpy(bytes.data() + at, &value, 4);
        return bytes;
    };
    const auto size = static_cast<std::uint32_t>(good.size());
    const std::pair<const char*, io::Bytes> cases[] = {
        {"version 1", patched(4, 1)},
        {"length + 1", patched(8, size + 1)},
        {"length - 1", patched(8, size - 1)},
        {"length 0", patched(8, 0)},
        {"length 2^32 - 1", patched(8, 0xffffffff)},
        {"JSON chunk + 8", patched(12, text + 8)},
        {"JSON chunk to the end", patched(12, size - 20)},
        {"JSON chunk beyond", patched(12, size)},
        {"JSON chunk 2^32 - 1", patched(12, 0xffffffff)},
        {"JSON chunk 2^32 - 8", patched(12, 0xfffffff8)},
        {"JSON chunk of nothing", patched(12, 0)},
        {"first chunk is binary", patched(16, 0x004e4942)},
        {"binary chunk + 8", patched(binary, 104 + 8)},
        {"binary chunk 2^32 - 1", patched(binary, 0xffffffff)},
        {"binary chunk of nothing", patched(binary, 0)},
        {"binary chunk of another type", patched(binary + 4, 0x12345678)},
    };
    for (const auto& [name, bytes] : cases) {
        SCOPED_TRACE(name);
        EXPECT_TRUE(refusal(folder.write("x.glb", bytes)).has_value());
    }
    for (std::size_t i = 0; i < 40; ++i) {
        io::Bytes cut = good;
        cut.resize(good.size() * i / 40);
        EXPECT_TRUE(refusal(folder.write("x.glb", cut)).has_value()) << cut.size();
    }
}

TEST(HostileGltf, NoUriLeavesTheFolder) {
    const TemporaryFolder folder;
    // Each would serve as the buffer, if it were reached.
    const io::Bytes bytes = testing::triangleBytes();
    folder.write("secret.bin", bytes);
    folder.write("root/inside.bin", bytes);
    std::filesystem::create_directories(folder / "root/sub");
    std::filesystem::create_symlink(folder / "secret.bin", folder / "root/link.bin");
    std::filesystem::create_symlink("..", folder / "root/up");
    ::mkfifo((folder / "root/fifo.bin").c_str(), 0600);
    const std::string absolute = (folder / "secret.bin").string();
    const std::vector<std::string> uris{"../secret.bin",
                                        "./../secret.bin",
                                        "sub/../../secret.bin",
                                        "sub/./.././../secret.bin",
                                        "%2e%2e/secret.bin",
                                        "%2E%2E%2Fsecret.bin",
                                        "..%2fsecret.bin",
                                        "%252e%252e/secret.bin",
                                        "..\\secret.bin",
                                        "..%5csecret.bin",
                                        absolute,
                                        "%2f" + absolute,
                                        "//" + absolute,
                                        "file://" + absolute,
                                        "link.bin",
                                        "up/secret.bin",
                                        "fifo.bin",
                                        "sub",
                                        ".",
                                        "..",
                                        "",
                                        "/dev/zero",
                                        "../../../../../../dev/zero",
                                        "inside.bin%00.png",
                                        "~/secret.bin",
                                        "$(cat secret.bin)",
                                        "`cat secret.bin`",
                                        "missing.bin"};
    const auto withUri = [&](const std::string& uri) {
        Json document = testing::triangleDocument();
        document["buffers"][0]["uri"] = uri;
        return refusal(folder.write("root/x.gltf", document.dump()));
    };
    ASSERT_FALSE(withUri("inside.bin").has_value());
    ASSERT_FALSE(withUri("sub/../inside%2ebin").has_value());
    EXPECT_GE(uris.size(), 15U);
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path()); // no falling back to the working directory either
    for (const std::string& uri : uris) {
        SCOPED_TRACE(uri);
        const auto error = withUri(uri);
        EXPECT_TRUE(error.has_value());
        if (error) {
            EXPECT_EQ(error->where, "/buffers/0/uri");
        }
    }
    EXPECT_TRUE(withUri("secret.bin").has_value()) << "only in the working directory";
    std::filesystem::current_path(before);
}

TEST(HostileGltf, MuchFromLittleIsRefused) {
    const TemporaryFolder folder;
    // A few hundred bytes that ask for a gigabyte: zeros without data, used again and again.
    Json document = {{"asset", {{"version", "2.0"}}}};
    document["accessors"] = {{{"componentType", 5126}, {"count", 1 << 20}, {"type", "VEC3"}}};
    for (int i = 0; i < 200; ++i) {
        document["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}});
    }
    EXPECT_TRUE(refusal(folder.write("x.gltf", document.dump())).has_value());
}

TEST(HostileGltf, FlippedBitsNeverCrash) {
    const TemporaryFolder folder;
    const io::Bytes good =
        testing::glb(testing::triangleDocument().dump(), testing::triangleBytes());
    std::mt19937 random(424242);
    int loaded = 0;
    const int rounds = testing::fuzzRounds(1500);
    for (int i = 0; i < rounds; ++i) {
        io::Bytes spoiled = good;
        for (unsigned k = 0; k < 1 + random() % 4; ++k) {
            spoiled[random() % spoiled.size()] ^= static_cast<unsigned char>(1U << (random() % 8));
        }
        loaded += refusal(folder.write("x.glb", spoiled)).has_value() ? 0 : 1;
    }
    EXPECT_GT(loaded, 0);
    EXPECT_LT(loaded, rounds);
}

TEST(HostileGltf, MixedValuesNeverCrash) {
    // Any value of the document replaced by any other kind of value: types and ranges together.
    const TemporaryFolder folder;
    const Json flat = testing::triangleDocument().flatten();
    const char* values[] = {"null",
                            "true",
                            "-1",
                            "0",
                            "3",
                            "4294967296",
                            "18446744073709551615",
                            "-9223372036854775808",
                            "1e308",
                            "0.5",
                            "\"\"",
                            "\"VEC4\"",
                            "[]",
                            "[[]]",
                            "{}",
                            "[0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0]"};
    int refused = 0;
    for (const auto& [pointer, old] : flat.items()) {
        for (const char* value : values) {
            SCOPED_TRACE(pointer + " = " + value);
            Json document = testing::triangleDocument();
            document[Json::json_pointer(pointer)] = Json::parse(value);
            refused += refusal(folder.write("x.gltf", testing::documentText(document))).has_value()
                           ? 1
                           : 0;
        }
    }
    EXPECT_GT(refused, 500);
}

} // namespace
} // namespace lodestar

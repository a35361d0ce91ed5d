// SPDX-License-Identifier: MIT
//
// Skins, morph targets and animations: what is read exactly, what is repaired, what is refused.
#include <functional>
#include <limits>

#include "unit/io/io_support.h"

namespace lodestar {
namespace {

using testing::Json;
using testing::put;

/// The triangle with eight joints a vertex, two targets and an animation of everything.
struct Moving {
    Json document = testing::triangleDocument();
    io::Bytes bytes = testing::triangleBytes();

    template <class T>
    int add(int componentType, const char* type, int count, std::initializer_list<T> values,
            bool normalized = false) {
        bytes.resize((bytes.size() + 3) / 4 * 4);
        const std::size_t from = bytes.size();
        put<T>(bytes, values);
        document["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", from}, {"byteLength", bytes.size() - from}});
        document["accessors"].push_back({{"bufferView", document["bufferViews"].size() - 1},
                                         {"componentType", componentType},
                                         {"count", count},
                                         {"type", type},
                                         {"normalized", normalized}});
        document["buffers"][0]["byteLength"] = bytes.size();
        return static_cast<int>(document["accessors"].size()) - 1;
    }

    Moving() {
        Json& primitive = document["meshes"][0]["primitives"][0];
        Json& attributes = primitive["attributes"];
        attributes["JOINTS_0"] =
            add<std::uint8_t>(5121, "VEC4", 3, {0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0});
        attributes["WEIGHTS_0"] =
            add<std::uint8_t>(5121, "VEC4", 3, {51, 102, 0, 0, 255, 0, 0, 0, 127, 0, 0, 0}, true);
        attributes["JOINTS_1"] =
            add<std::uint16_t>(5123, "VEC4", 3, {1, 9, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0});
        attributes["WEIGHTS_1"] =
            add<float>(5126, "VEC4", 3, {0.4f, 0, 0, 0, 0, 0, 0, 0, 0.5f, 0, 0, 0});
        const int deltas = add<float>(5126, "VEC3", 3, {0, 0, 1, 0, 0, 2, 0, 0, 3});
        primitive["targets"] = {{{"POSITION", deltas}}, {{"POSITION", deltas}, {"NORMAL", deltas}}};
        document["meshes"][0]["weights"] = {0.25, 0.5};
        document["nodes"][0]["skin"] = 0;
        document["skins"] = {{{"joints", {2, 0}}, {"name", "bones"}}};
        const int times = add<float>(5126, "SCALAR", 2, {0.5f, 2.0f});
        const int turns =
            add<std::int16_t>(5122, "VEC4", 2, {0, 0, 0, 32767, 0, 32767, 0, 0}, true);
        const int weights = add<float>(5126, "SCALAR", 12, {0, 0, 1, 2, 0, 0, 0, 0, 3, 4, 0, 0});
        document["animations"] = {
            {{"name", "move"},
             {"channels",
              {{{"sampler", 0}, {"target", {{"node", 2}, {"path", "rotation"}}}},
               {{"sampler", 1}, {"target", {{"node", 0}, {"path", "weights"}}}},
               {{"sampler", 0}, {"target", {{"path", "rotation"}}}}}},
             {"samplers",
              {{{"input", times}, {"output", turns}, {"interpolation", "STEP"}},
               {{"input", times}, {"output", weights}, {"interpolation", "CUBICSPLINE"}}}}}};
    }

    [[nodiscard]] io::GltfCheck check() const {
        const testing::TemporaryFolder folder;
        return io::checkGltf(folder.write("x.gltf", testing::documentText(document, bytes)));
    }

    [[nodiscard]] core::Result<io::GltfFile> load() const {
        const testing::TemporaryFolder folder;
        return testing::loadAndCheck(
            folder.write("x.gltf", testing::documentText(document, bytes)));
    }
};

std::uint64_t counted(const io::GltfFile& file, const std::string& part) {
    std::uint64_t sum = 0;
    for (const auto& [rule, count] : file.warnings.counts()) {
        sum += rule.find(part) != std::string::npos ? count : 0;
    }
    return sum;
}

TEST(GltfMotion, SkinsTargetsAndAnimationsAreReadWhole) {
    const auto file = Moving().load();
    ASSERT_TRUE(file.ok()) << file.error().message();
    const io::GltfPrimitive& p = file->meshes.at(0).primitives.at(0);
    EXPECT_EQ(p.joints[0].at(0), glm::u16vec4(0, 1, 0, 0));
    EXPECT_FLOAT_EQ(p.weights[0].at(0).x, 0.2f);
    EXPECT_FLOAT_EQ(p.weights[0].at(0).y, 0.4f);
    EXPECT_FLOAT_EQ(p.weights[1].at(0).x, 0.4f);
    EXPECT_EQ(p.joints[1].at(0), glm::u16vec4(1, 0, 0, 0)); // 9 had weight 0
    EXPECT_FLOAT_EQ(p.weights[0].at(2).x + p.weights[1].at(2).x, 1.0f);
    ASSERT_EQ(p.targets.size(), 2u);
    EXPECT_EQ(p.targets[1].normals.at(2), glm::vec3(0, 0, 3));
    EXPECT_EQ(file->meshes[0].weights, (std::vector<float>{0.25f, 0.5f}));
    const io::GltfSkin& skin = file->skins.at(0);
    EXPECT_EQ(skin.joints, (std::vector<int>{2, 0}));
    EXPECT_EQ(skin.inverseBind, std::vector<glm::mat4>(2, glm::mat4(1.0f)));
    const io::GltfAnimation& animation = file->animations.at(0);
    EXPECT_EQ(animation.name, "move");
    ASSERT_EQ(animation.channels.size(), 2u);
    EXPECT_EQ(counted(*file, "channel without a node"), 1u);
    EXPECT_EQ(animation.samplers[0].interpolation, io::Interpolation::Step);
    EXPECT_EQ(animation.samplers[0].values, (std::vector<float>{0, 0, 0, 1, 0, 1, 0, 0}));
    EXPECT_EQ(animation.samplers[1].components, 2u);
    EXPECT_EQ(animation.samplers[1].times, (std::vector<float>{0.5f, 2.0f}));
}

TEST(GltfMotion, WeightsAreRepairedAndCounted) {
    Moving moving;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    Json& attributes = moving.document["meshes"][0]["primitives"][0]["attributes"];
    attributes.erase("JOINTS_1");
    attributes.erase("WEIGHTS_1");
    attributes["WEIGHTS_0"] =
        moving.add<float>(5126, "VEC4", 3, {2, 2, 0, 0, -1, nan, 0, 0, 0, 0, 0, 0.5f});
    const auto file = moving.load();
    ASSERT_TRUE(file.ok()) << file.error().message();
    const auto& weights = file->meshes.at(0).primitives.at(0).weights[0];
    EXPECT_EQ(weights.at(0), glm::vec4(0.5f, 0.5f, 0, 0));
    EXPECT_EQ(weights.at(1), glm::vec4(1, 0, 0, 0));
    EXPECT_EQ(weights.at(2), glm::vec4(0, 0, 0, 1));
    EXPECT_EQ(counted(*file, "negative or not finite"), 2u);
    EXPECT_EQ(counted(*file, "are all 0"), 1u);
    EXPECT_EQ(counted(*file, "do not add up"), 2u);
}

TEST(GltfMotion, WhatCannotMoveIsLeftOutAndCounted) {
    Moving moving;
    Json& channels = moving.document["animations"][0]["channels"];
    channels.push_back(channels[0]); // moves what another moves
    channels.push_back({{"sampler", 1}, {"target", {{"node", 2}, {"path", "weights"}}}});
    channels.push_back({{"sampler", 0}, {"target", {{"node", 2}, {"path", "pointer"}}}});
    const auto file = moving.load();
    ASSERT_TRUE(file.ok()) << file.error().message();
    EXPECT_EQ(file->animations.at(0).channels.size(), 2u);
    EXPECT_EQ(counted(*file, "another moves already"), 1u);
    EXPECT_EQ(counted(*file, "without targets"), 1u);
    EXPECT_EQ(counted(*file, "another property"), 1u);
}

TEST(GltfMotion, WhatIsWrongIsRefusedWithItsPlace) {
    const Moving base;
    struct Wrong {
        const char* name;
        std::function<void(Moving&)> change;
        const char* where;
    };
    const auto sampler = [](Moving& m, const char* key, int accessor, std::size_t which = 0) {
        m.document["animations"][0]["samplers"][which][key] = accessor;
    };
    const auto attribute = [](Moving& m, const char* key, int accessor) {
        m.document["meshes"][0]["primitives"][0]["attributes"][key] = accessor;
    };
    const float inf = std::numeric_limits<float>::infinity();
    const Wrong cases[] = {
        {"times that stand",
         [&](Moving& m) {
             sampler(m, "input", m.add<float>(5126, "SCALAR", 2, {1, 1}));
         },
         "/animations/0/samplers/0/input"},
        {"times that are negative",
         [&](Moving& m) {
             sampler(m, "input", m.add<float>(5126, "SCALAR", 2, {-1, 1}));
         },
         "/animations/0/samplers/0/input"},
        {"times without end",
         [&](Moving& m) {
             sampler(m, "input", m.add<float>(5126, "SCALAR", 2, {0, inf}));
         },
         "/animations/0/samplers/0/input"},
        {"times of integers",
         [&](Moving& m) {
             sampler(m, "input", m.add<std::uint16_t>(5123, "SCALAR", 2, {0, 1}));
         },
         "/animations/0/samplers/0/input"},
        {"too few values",
         [&](Moving& m) {
             sampler(m, "output", m.add<float>(5126, "VEC4", 1, {0, 0, 0, 1}));
         },
         "/animations/0/samplers/0/output"},
        {"values of another type",
         [&](Moving& m) {
             sampler(m, "output", m.add<float>(5126, "VEC3", 2, {0, 0, 0, 1, 1, 1}));
         },
         "/animations/0/samplers/0/output"},
        {"a value without end",
         [&](Moving& m) {
             sampler(m, "output", m.add<float>(5126, "VEC4", 2, {0, 0, 0, 1, 0, 0, 0, inf}));
         },
         "/animations/0/samplers/0/output"},
        {"spline weights without tangents",
         [&](Moving& m) {
             sampler(m, "output", m.add<float>(5126, "SCALAR", 4, {0, 0, 1, 1}), 1);
         },
         "/animations/0/samplers/1/output"},
        {"a spline of one key",
         [&](Moving& m) { sampler(m, "input", m.add<float>(5126, "SCALAR", 1, {0}), 1); },
         "/animations/0/samplers/1/input"},
        {"interpolation BEZIER",
         [&](Moving& m) { m.document["animations"][0]["samplers"][0]["interpolation"] = "BEZIER"; },
         "/animations/0/samplers/0/interpolation"},
        {"a joint that the skin lacks",
         [&](Moving& m) {
             attribute(m, "JOINTS_0",
                       m.add<std::uint8_t>(5121, "VEC4", 3, {0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
         },
         "/nodes/0/skin"},
        {"joints as floats",
         [&](Moving& m) {
             attribute(m, "JOINTS_0",
                       m.add<float>(5126, "VEC4", 3, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}));
         },
         "/meshes/0/primitives/0/attributes/JOINTS_0"},
        {"joints without weights",
         [&](Moving& m) {
             m.document["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_1");
         },
         "/meshes/0/primitives/0/attributes/JOINTS_1"},
        {"weights for fewer vertices",
         [&](Moving& m) {
             attribute(m, "WEIGHTS_0", m.add<float>(5126, "VEC4", 1, {1, 0, 0, 0}));
         },
         "/meshes/0/primitives/0/attributes/WEIGHTS_0"},
        {"no joints", [&](Moving& m) { m.document["skins"][0]["joints"] = Json::array(); },
         "/skins/0/joints"},
        {"fewer matrices than joints",
         [&](Moving& m) {
             m.document["skins"][0]["inverseBindMatrices"] =
                 m.add<float>(5126, "MAT4", 1, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
         },
         "/skins/0/inverseBindMatrices"},
        {"matrices of another type",
         [&](Moving& m) { m.document["skins"][0]["inverseBindMatrices"] = 0; },
         "/skins/0/inverseBindMatrices"},
        {"deltas for fewer vertices",
         [&](Moving& m) {
             m.document["meshes"][0]["primitives"][0]["targets"][0]["POSITION"] =
                 m.add<float>(5126, "VEC3", 1, {0, 0, 0});
         },
         "/meshes/0/primitives/0/targets/0/POSITION"},
        {"one weight for two targets", [&](Moving& m) { m.document["meshes"][0]["weights"] = {1}; },
         "/meshes/0/weights"},
        {"a node's three weights for two targets",
         [&](Moving& m) {
             m.document["nodes"][0]["weights"] = {1, 2, 3};
         },
         "/nodes/0/weights"},
    };
    for (const Wrong& wrong : cases) {
        Moving moving = base;
        wrong.change(moving);
        const auto file = moving.load();
        ASSERT_FALSE(file.ok()) << wrong.name;
        EXPECT_EQ(file.error().where, wrong.where) << wrong.name << ": " << file.error().message();
        EXPECT_EQ(file.error().code, core::ErrorCode::InputRefused);
        // Nothing else is blamed for it, and nobody says that it was mended.
        const io::GltfCheck check = moving.check();
        EXPECT_EQ(testing::pointers(check, false), std::set<std::string>{wrong.where})
            << wrong.name;
        EXPECT_EQ(testing::pointers(check, true).count(wrong.where), 0u) << wrong.name;
        for (const io::GltfProblem& problem : check.problems.list()) {
            const bool again =
                problem.repaired && (problem.what.find("morph target") != std::string::npos ||
                                     problem.what.find("count") != std::string::npos ||
                                     problem.what.find("as many") != std::string::npos ||
                                     problem.what.find("format") != std::string::npos);
            EXPECT_FALSE(again) << wrong.name << ": " << problem.where << " " << problem.what;
        }
    }
}

// Triangles lose the deltas with the tangents that makeFlat takes away; points keep theirs.
TEST(GltfMotion, DeltasOfWhatThePrimitiveLacksAreNotKept) {
    for (const int mode : {0, 1, 4}) {
        Moving moving;
        Json& primitive = moving.document["meshes"][0]["primitives"][0];
        const int deltas = primitive["targets"][0]["POSITION"].get<int>();
        primitive["mode"] = mode;
        primitive["attributes"].erase("NORMAL");
        primitive["targets"] = {{{"TANGENT", deltas}}, {{"NORMAL", deltas}, {"TANGENT", deltas}}};
        const auto file = moving.load();
        ASSERT_TRUE(file.ok()) << file.error().message();
        const io::GltfPrimitive& p = file->meshes.at(0).primitives.at(0);
        EXPECT_EQ(p.normals.empty(), mode != 4);
        EXPECT_TRUE(p.tangents.empty());
        ASSERT_EQ(p.targets.size(), 2u);
        for (const io::GltfMorphTarget& target : p.targets) {
            EXPECT_TRUE(target.normals.empty()) << mode;
            EXPECT_TRUE(target.tangents.empty()) << mode;
        }
        EXPECT_EQ(counted(*file, "that its primitive lacks"), 2u);
    }
}

// KHR_mesh_quantization has signed deltas, of directions normalised ones.
TEST(GltfMotion, QuantizedDeltasNeedTheirExtension) {
    struct Case {
        const char* attribute;
        int componentType;
        bool normalized;
        bool allowed; ///< with the extension; never without it
    };
    const Case cases[] = {{"POSITION", 5120, false, true},  {"POSITION", 5122, true, true},
                          {"POSITION", 5121, false, false}, {"POSITION", 5123, true, false},
                          {"NORMAL", 5120, true, true},     {"NORMAL", 5122, true, true},
                          {"NORMAL", 5120, false, false},   {"NORMAL", 5121, true, false},
                          {"TANGENT", 5122, true, true},    {"TANGENT", 5122, false, false},
                          {"POSITION", 5125, false, false}};
    for (const Case& c : cases) {
        for (const char* list : {"", "extensionsUsed", "extensionsRequired"}) {
            SCOPED_TRACE(std::string(c.attribute) + " " + std::to_string(c.componentType) + list);
            Moving moving;
            const std::initializer_list<std::uint32_t> ones = {1, 1, 1, 1, 1, 1, 1, 1, 1};
            const int deltas =
                moving.add<std::uint32_t>(c.componentType, "VEC3", 3, ones, c.normalized);
            moving.document["meshes"][0]["primitives"][0]["targets"][0] = {{c.attribute, deltas}};
            if (*list != '\0') {
                moving.document[list].push_back("KHR_mesh_quantization");
            }
            const auto file = moving.load();
            EXPECT_EQ(file.ok(), c.allowed && *list != '\0');
            if (!file.ok()) {
                EXPECT_EQ(file.error().where,
                          std::string("/meshes/0/primitives/0/targets/0/") + c.attribute);
            }
        }
    }
}

TEST(GltfMotion, ASamplerThatIsMinusZeroIsRefused) {
    for (const bool any : {false, true}) {
        Json document = testing::triangleDocument();
        if (!any) {
            document["animations"][0]["samplers"] = Json::array();
        }
        std::string text = testing::documentText(document);
        const std::string plain = "\"sampler\":0,\"target\"";
        const std::size_t at = text.find(plain);
        ASSERT_NE(at, std::string::npos);
        text.replace(at, plain.size(), "\"sampler\":-0,\"target\"");
        const testing::TemporaryFolder folder;
        const auto file = testing::loadAndCheck(folder.write("x.gltf", text));
        ASSERT_FALSE(file.ok());
        EXPECT_EQ(file.error().where, "/animations/0/channels/0/sampler");
    }
}

} // namespace
} // namespace lodestar

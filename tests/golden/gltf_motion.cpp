// SPDX-License-Identifier: MIT
//
// Goldens of what moves: the three interpolations, skins and morph targets.
#include "golden/gltf_golden.h"
#include "support/baked.h"
#include "support/shapes.h"

namespace lodestar::testing {
namespace {

constexpr double kTime = 0.3; ///< of keys at 0 and 1
constexpr const char* kInterpolations[] = {"STEP", "LINEAR", "CUBICSPLINE"};
const glm::vec2 kFrom(-0.8f, -0.6f);
const glm::vec2 kTo(0.6f, 0.8f);
const glm::vec2 kLeaving(0.0f, 4.0f);   ///< out-tangent of the first key
const glm::vec2 kArriving(-3.0f, 0.0f); ///< in-tangent of the second

/// Three panels: one moved, one turned, one scaled, by the same keys in an interpolation. All nine
/// samplers are in the file.
template <int kMode>
void interpolation(GltfBuilder& file) {
    const int orange = file.unlit(0.9f, 0.5f, 0.1f);
    const int green = file.unlit(0.2f, 0.8f, 0.3f);
    const int moved = file.show({file.panel(-0.1f, -0.1f, 0.1f, 0.1f, orange)});
    const int turned = file.show({file.panel(-0.3f, -0.05f, 0.3f, 0.05f, green)},
                                 {{"translation", {0.6, -0.7, 0}}});
    const int scaled =
        file.show({file.panel(-0.2f, -0.2f, 0.2f, 0.2f, file.unlit(0.2f, 0.4f, 1.0f))},
                  {{"translation", {-0.7, 0.7, 0}}});
    const int times = file.floats("SCALAR", {0, 1});
    const auto three = [&](const std::vector<float>& from, const std::vector<float>& out,
                           const std::vector<float>& in, const std::vector<float>& to) {
        const std::vector<float> none(from.size());
        std::vector<float> plain = from;
        plain.insert(plain.end(), to.begin(), to.end());
        std::vector<float> spline;
        for (const auto* part : {&none, &from, &out, &in, &to, &none}) {
            spline.insert(spline.end(), part->begin(), part->end());
        }
        const char* type = from.size() == 4 ? "VEC4" : "VEC3";
        return std::array<int, 2>{file.floats(type, plain), file.floats(type, spline)};
    };
    const std::array<int, 2> outputs[] = {
        three({kFrom.x, kFrom.y, 0}, {kLeaving.x, kLeaving.y, 0}, {kArriving.x, kArriving.y, 0},
              {kTo.x, kTo.y, 0}),
        three({0, 0, 0, 1}, {0, 0, 2, 0}, {0, 0, 0, 0}, {0, 0, 0.8f, 0.6f}),
        three({1, 1, 1}, {3, 0, 0}, {0, 0, 0}, {0.5f, 1.5f, 1})};
    Json animation = {{"samplers", Json::array()}, {"channels", Json::array()}};
    for (int mode = 0; mode < 3; ++mode) {
        for (const std::array<int, 2>& output : outputs) {
            animation["samplers"].push_back({{"input", times},
                                             {"output", output[mode == 2 ? 1 : 0]},
                                             {"interpolation", kInterpolations[mode]}});
        }
    }
    const std::pair<int, const char*> targets[] = {
        {moved, "translation"}, {turned, "rotation"}, {scaled, "scale"}};
    for (int i = 0; i < 3; ++i) {
        animation["channels"].push_back(
            {{"sampler", 3 * kMode + i},
             {"target", {{"node", targets[i].first}, {"path", targets[i].second}}}});
    }
    file.add("animations", animation);
}

void nextInterpolation(Json& document) {
    for (Json& channel : document["animations"][0]["channels"]) {
        channel["sampler"] = (channel["sampler"].get<int>() + 3) % 9;
    }
}

/// Where the moved panel is: its middle pixels are orange, and those around it are not.
template <int kMode>
void standsWhereItShould(const Shot& shot) {
    const auto t = static_cast<float>(kTime);
    const float u = 1.0f - t;
    const glm::vec2 place = kMode == 0 ? kFrom
                            : kMode == 1
                                ? u * kFrom + t * kTo
                                : u * u * (1.0f + 2.0f * t) * kFrom + t * u * u * kLeaving +
                                      t * t * (3.0f - 2.0f * t) * kTo - t * t * u * kArriving;
    glm::dvec2 sum(0.0);
    int count = 0;
    for (int y = 0; y < kGltfSide; ++y) {
        for (int x = 0; x < kGltfSide; ++x) {
            if (shot.radiance.at(x, y)[0] > 0.8f) {
                sum += glm::dvec2(pixelMiddle(x), -pixelMiddle(y));
                ++count;
            }
        }
    }
    ASSERT_GT(count, 0);
    // 8 x 8 pixels, of which a row and a column may lie on the border: half a pixel.
    EXPECT_NEAR(sum.x / count, place.x, 0.5 / 40.0);
    EXPECT_NEAR(sum.y / count, place.y, 0.5 / 40.0);
}

/// Against the same vertices moved here in double, in the picture's own steps.
void asItsVertices(const Shot& shot) {
    expectSame(shot.radiance, shot.renderScene(baked(shot.scene)), 1.0 / 255.0, 0.0);
}

/// A post of eight storeys that two joints share by height; the upper one bends, turns and grows.
void skin(GltfBuilder& file) {
    io::GltfPrimitive post;
    std::vector<std::uint8_t> joints;
    std::vector<float> weights;
    for (int j = 0; j <= 8; ++j) {
        for (int i = 0; i <= 24; ++i) {
            const float angle = 6.2831853f * static_cast<float>(i) / 24.0f;
            const float share = static_cast<float>(j) / 8.0f;
            const glm::vec3 normal(std::sin(angle), 0.0f, std::cos(angle));
            post.positions.push_back(0.25f * normal + glm::vec3(0, 1.6f * share - 0.9f, 0));
            post.normals.push_back(normal);
            post.uvs[0].emplace_back(share, 0.0f);
            joints.insert(joints.end(), {0, 1, 0, 0});
            weights.insert(weights.end(), {1.0f - share, share, 0, 0});
        }
    }
    for (std::uint32_t i = 0; i < 8 * 25; ++i) {
        if (i % 25 < 24) {
            for (const std::uint32_t corner : {i, i + 1, i + 26, i, i + 26, i + 25}) {
                post.indices.push_back(corner);
            }
        }
    }
    Json primitive = file.primitive(post, file.lambert(0.8f, 0.5f, 0.3f));
    primitive["attributes"]["JOINTS_0"] = file.accessor("VEC4", joints);
    primitive["attributes"]["WEIGHTS_0"] = file.floats("VEC4", weights);
    const int upper = file.add("nodes", {{"translation", {0, 0.6, 0}},
                                         {"rotation", {0.1464466, 0.1464466, 0.3535534, 0.9122265}},
                                         {"scale", {1.6, 0.9, 1.0}}});
    const int lower = file.node({{"translation", {0, -0.9, 0}}, {"children", {upper}}});
    file.add("skins", {{"joints", {lower, upper}},
                       {"inverseBindMatrices",
                        file.floats("MAT4", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0.9f, 0, 1,
                                             1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0.3f, 0, 1})}});
    file.show({primitive}, {{"skin", 0}});
}

/// The same under a node that mirrors x: its faces wind the other way, and none is lost.
void mirroredSkin(GltfBuilder& file) {
    skin(file);
    Json& scene = file.document["scenes"][0]["nodes"];
    const int root = scene[0];
    scene[0] = file.add("nodes", {{"name", "mirror"}, {"children", {root}}, {"scale", {-1, 1, 1}}});
}

/// A sphere with two targets of position, or of normals alone.
Json morphable(GltfBuilder& file, bool positions) {
    const io::GltfPrimitive shape = sphere(24, 48);
    Json primitive = file.primitive(shape, file.lambert(0.5f, 0.6f, 0.8f));
    std::vector<glm::vec3> taller;
    std::vector<glm::vec3> leaning;
    for (const glm::vec3& p : shape.positions) {
        taller.push_back(positions ? glm::vec3(-0.6f * p.x, 0.2f * p.y, 0)
                                   : glm::vec3(0, 2 * p.y, 0));
        leaning.push_back(positions ? glm::vec3(0.4f * p.y, 0, 0) : glm::vec3(p.z, 0, 0));
    }
    const char* attribute = positions ? "POSITION" : "NORMAL";
    primitive["targets"] = {{{attribute, file.vectors(taller)}},
                            {{attribute, file.vectors(leaning)}}};
    return primitive;
}

template <bool kPositions>
void morph(GltfBuilder& file) {
    const int node = file.show({morphable(file, kPositions)});
    file.document["meshes"][0]["weights"] = {0.3, 0.3};
    file.document["nodes"][static_cast<std::size_t>(node)]["weights"] = {0.8, 0.7};
}

void withoutWeights(Json& document) {
    document["meshes"][0]["weights"] = {0, 0};
    for (Json& node : document["nodes"]) {
        node.erase("weights");
    }
}

void animatedWeights(GltfBuilder& file) {
    const int node = file.show({morphable(file, true)});
    file.document["meshes"][0]["weights"] = {0, 0};
    const Json sampler = {{"input", file.floats("SCALAR", {0, 1})},
                          {"output", file.floats("SCALAR", {-1, 1, 1, -1})}};
    const Json channel = {{"sampler", 0}, {"target", {{"node", node}, {"path", "weights"}}}};
    file.add("animations", {{"samplers", {sampler}}, {"channels", {channel}}});
}

} // namespace

std::vector<GltfGolden> motionGoldens() {
    const auto withoutSkin = [](Json& document) {
        for (Json& node : document["nodes"]) {
            node.erase("skin");
        }
    };
    return {
        {"interpolation-step", interpolation<0>, nextInterpolation, standsWhereItShould<0>,
         Light::Faces, -1, kTime},
        {"interpolation-linear", interpolation<1>, nextInterpolation, standsWhereItShould<1>,
         Light::Faces, -1, kTime},
        {"interpolation-cubic-spline", interpolation<2>, nextInterpolation, standsWhereItShould<2>,
         Light::Faces, -1, kTime},
        {"skin", skin, withoutSkin, asItsVertices},
        {"mirrored-skin", mirroredSkin, withoutSkin, asItsVertices},
        {"morph-positions", morph<true>, withoutWeights, asItsVertices},
        {"morph-normals", morph<false>, withoutWeights, asItsVertices},
        {"morph-animated", animatedWeights, [](Json& document) { document.erase("animations"); },
         asItsVertices, Light::Faces, -1, kTime},
    };
}

} // namespace lodestar::testing

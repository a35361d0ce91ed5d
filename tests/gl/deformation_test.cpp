// SPDX-License-Identifier: MIT
//
// Skinned and morphed meshes against the same vertices made here, in double, as a static mesh.
#include <cmath>

#include "io/gltf.h"
#include "lighting/environment.h"
#include "lodestar/display.glsl"
#include "scene/animation.h"
#include "scene/draw_list.h"
#include "scene/renderer.h"
#include "support/baked.h"
#include "support/gl_fixture.h"
#include "support/picture.h"
#include "support/shapes.h"
#include "support/shared.h"

namespace lodestar {
namespace {

core::Image display(core::Image radiance) {
    for (float& value : radiance.pixels()) {
        value = shader::lodestar_srgbFromLinear(shader::lodestar_filmic(value));
    }
    return radiance;
}

class Deformation : public testing::GlTest {
protected:
    static scene::RenderSettings settings() {
        scene::RenderSettings s;
        s.width = s.height = 160;
        return s;
    }
    std::unique_ptr<scene::Renderer> renderer(const scene::Scene& scene) {
        auto made = scene::Renderer::make(device(), scene);
        EXPECT_TRUE(made.ok());
        (*made)->setEnvironment("sky",
                                lighting::cubeFromAnalytic(lighting::ClearSkyEnvironment{}, 64));
        return std::move(*made);
    }

    /// Three times of animation 0: as drawn against as baked.
    void compareAtThreeTimes(scene::Scene scene, const char* effect) {
        scene::reachOver(scene, 0);
        const double last = scene::duration(scene, 0);
        ASSERT_GT(last, 0.0);
        const scene::View view = *scene::chooseView(scene, {}, 1.0f);
        auto moving = renderer(scene);
        core::Image before;
        std::uint64_t uploaded = 0;
        std::uint64_t forecast = 0;
        for (const double share : {0.13, 0.41, 0.77}) {
            scene::pose(scene, 0, share * last);
            const scene::Scene fixed = testing::baked(scene);
            auto drawn = moving->render(view, settings());
            auto reference = renderer(fixed)->render(view, settings());
            ASSERT_TRUE(drawn.ok() && reference.ok());
            EXPECT_TRUE(drawn->plan->runs(effect));
            EXPECT_FALSE(reference->plan->runs(effect));
            expectHeld(scene, fixed);
            uploaded = drawn->counters.uploadBytes;
            forecast = costOf(*drawn->plan, effect).uploadBytes;
            const core::Image picture = display(drawn->radiance);
            EXPECT_LE(testing::compare(picture, display(reference->radiance), 1.0 / 255.0).largest,
                      1.0 / 255.0)
                << effect << " at " << share;
            if (!before.empty()) {
                EXPECT_GT(testing::compare(picture, before, 0.05).failingFraction, 0.002)
                    << "nothing moved";
            }
            before = picture;
        }
        // The same pose again: nothing is uploaded but the uniform blocks.
        auto again = moving->render(view, settings());
        ASSERT_TRUE(again.ok());
        EXPECT_FALSE(again->plan->runs(effect));
        EXPECT_GT(forecast, 0u);
        EXPECT_EQ(uploaded - again->counters.uploadBytes, forecast);
        auto third = moving->render(view, settings());
        EXPECT_EQ(third->counters.uploadBytes, again->counters.uploadBytes);
        EXPECT_EQ(display(again->radiance).pixels(), before.pixels());
    }

    static plan::Cost costOf(const plan::EffectPlan& plan, const std::string& name) {
        for (const plan::Effect& effect : plan.effects) {
            if (effect.effect == name) {
                return effect.cost;
            }
        }
        ADD_FAILURE() << "no effect " << name;
        return {};
    }

    /// The boxes that cull and frame hold every vertex.
    static void expectHeld(const scene::Scene& scene, const scene::Scene& fixed) {
        for (const scene::DrawItem& item : scene::drawItems(fixed)) {
            const auto n = static_cast<std::size_t>(item.node);
            const auto& component = std::get<scene::MeshComponent>(
                scene.nodes[n].components[static_cast<std::size_t>(item.component)]);
            const scene::Bounds box = scene::primitiveWorldBounds(
                scene, scene.nodes[n], component, static_cast<std::size_t>(item.primitive));
            scene::Bounds vertices =
                scene::transformed(fixed.primitiveBounds[static_cast<std::size_t>(item.mesh)]
                                                        [static_cast<std::size_t>(item.primitive)],
                                   fixed.nodes[n].worldFromNode);
            const float slack = 1e-5f * (1.0f + vertices.radius());
            for (glm::length_t a = 0; a < 3; ++a) {
                ASSERT_LE(box.low[a], vertices.low[a] + slack);
                ASSERT_GE(box.high[a], vertices.high[a] - slack);
            }
        }
    }

    void compareFile(const char* relative, const char* effect) {
        auto file = io::loadGltf(testing::sharedPath("assets/gltf") / relative);
        ASSERT_TRUE(file.ok()) << file.error().message();
        compareAtThreeTimes(scene::buildScene(std::move(*file)), effect);
    }
};

io::GltfAnimationSampler line(io::AnimationPath path, std::vector<float> values) {
    const std::size_t components = path == io::AnimationPath::Rotation ? 4 : 3;
    return {io::Interpolation::Linear, {0.0f, 1.0f}, std::move(values), components};
}

/// A sphere that follows six joints, up its axis; two turn, one grows unevenly, one moves.
io::GltfFile sixJoints() {
    io::GltfPrimitive primitive = testing::sphere(32, 64);
    constexpr int kJoints = 6;
    for (const glm::vec3& p : primitive.positions) {
        double weights[8] = {};
        double sum = 0.0;
        for (int j = 0; j < kJoints; ++j) {
            const double d = p.y - (-1.0 + 0.4 * j);
            weights[j] = std::exp(-4.0 * d * d);
            sum += weights[j];
        }
        const auto four = [&](const double* w) {
            return glm::vec4(glm::dvec4(w[0], w[1], w[2], w[3]) / sum);
        };
        primitive.joints[0].emplace_back(0, 1, 2, 3);
        primitive.weights[0].push_back(four(weights));
        primitive.joints[1].emplace_back(4, 5, 0, 0);
        primitive.weights[1].push_back(four(weights + 4));
    }
    io::GltfFile file =
        testing::fileOf(primitive, testing::blinnPhong({0.6, 0.4, 0.2}, glm::vec3(0.04f), 30.0f));
    file.nodes[0].skin = 0;
    file.nodes[0].translation = {40, 0, 0}; // a skinned mesh is where its joints are
    io::GltfSkin skin;
    for (int j = 0; j < kJoints; ++j) {
        io::GltfNode node;
        node.parent = j == 0 ? io::kNone : j;
        node.translation = j == 0 ? glm::vec3(0, -1, 0) : glm::vec3(0, 0.4f, 0);
        if (j > 0) {
            file.nodes.back().children.push_back(j + 1);
        }
        file.nodes.push_back(node);
        skin.joints.push_back(j + 1);
        skin.inverseBind.push_back(glm::mat4(1.0f));
        skin.inverseBind.back()[3] = {0.0f, 1.0f - 0.4f * static_cast<float>(j), 0.0f, 1.0f};
    }
    file.scenes[0].roots.push_back(1);
    file.skins.push_back(skin);
    io::GltfAnimation bend;
    bend.samplers = {line(io::AnimationPath::Rotation, {0, 0, 0, 1, 0, 0, 0.5f, 0.8660254f}),
                     line(io::AnimationPath::Rotation, {0, 0, 0, 1, 0.6f, 0, 0, 0.8f}),
                     line(io::AnimationPath::Scale, {1, 1, 1, 2.0f, 0.5f, 1.5f}),
                     line(io::AnimationPath::Translation, {0, 0.4f, 0, 0.3f, 0.8f, 0})};
    bend.channels = {{3, io::AnimationPath::Rotation, 0},
                     {4, io::AnimationPath::Rotation, 1},
                     {2, io::AnimationPath::Scale, 2},
                     {5, io::AnimationPath::Translation, 3}};
    file.animations.push_back(bend);
    return file;
}

/// A sphere with two targets; flat: every triangle on its own, as the reader makes them.
io::GltfFile twoTargets(bool flat) {
    io::GltfPrimitive primitive = testing::sphere(16, 24);
    if (flat) {
        io::GltfPrimitive split;
        for (std::uint32_t index : primitive.indices) {
            split.indices.push_back(static_cast<std::uint32_t>(split.positions.size()));
            split.positions.push_back(primitive.positions[index]);
            split.normals.push_back(primitive.normals[index]);
        }
        split.flatNormals = true;
        primitive = split;
    }
    primitive.targets.resize(2);
    for (const glm::vec3& p : primitive.positions) {
        primitive.targets[0].positions.emplace_back(0.0f, p.y * p.y, 0.0f);
        primitive.targets[1].positions.emplace_back(0.8f * p.x, 0.0f, 0.3f * p.y);
        if (!flat) {
            primitive.targets[0].normals.emplace_back(-p.x * p.y, 0.1f, -p.z * p.y);
        }
    }
    io::GltfFile file =
        testing::fileOf(primitive, testing::blinnPhong({0.3, 0.5, 0.6}, glm::vec3(0.04f), 20.0f));
    io::GltfAnimation animation;
    animation.samplers = {{io::Interpolation::Linear, {0, 1}, {0, 1, 1, -0.5f}, 2}};
    animation.channels = {{0, io::AnimationPath::Weights, 0}};
    file.animations.push_back(animation);
    return file;
}

/// The file's sphere with tangents and a bumpy normal map.
io::GltfFile bumped(io::GltfFile file) {
    io::GltfPrimitive& primitive = file.meshes[0].primitives[0];
    for (const glm::vec2& uv : primitive.uvs[0]) {
        const float longitude = 6.2831853f * uv.x;
        primitive.tangents.emplace_back(std::cos(longitude), 0.0f, -std::sin(longitude), 1.0f);
    }
    for (io::GltfMorphTarget& target : primitive.targets) {
        for (const glm::vec3& p : primitive.positions) {
            target.tangents.emplace_back(0.3f * p.y, 0.5f * p.z, 0.2f);
        }
    }
    core::Texels map(8, 8);
    for (std::size_t i = 0; i < 64; ++i) {
        const std::size_t x = i % 8;
        const std::size_t y = i / 8;
        const int red = x % 4 < 2 ? 190 : 66;
        const int green = y % 4 < 2 ? 190 : 66;
        const int texel[] = {red, green, 210, 255};
        std::copy_n(texel, 4, &map.bytes()[4 * i]);
    }
    file.images.push_back(map);
    file.textures.push_back({0, {}, {}, {}, {}, io::MipFilter::None});
    file.materials[0].normalTexture.texture = 0;
    return file;
}

TEST_F(Deformation, TangentsFollowSixJoints) {
    compareAtThreeTimes(scene::buildScene(bumped(sixJoints())), "skinning");
    io::GltfFile mirrored = bumped(sixJoints());
    mirrored.nodes[1].scale = {-1, 1, 1};
    compareAtThreeTimes(scene::buildScene(std::move(mirrored)), "skinning");
}

TEST_F(Deformation, TangentsFollowTargets) {
    compareAtThreeTimes(scene::buildScene(bumped(twoTargets(false))), "morphs");
}

TEST_F(Deformation, SixJointsMatchTheirVertices) {
    compareAtThreeTimes(scene::buildScene(sixJoints()), "skinning");
}

// Joints that turn a mesh inside out turn its winding too: what is seen is its outside, and not the
// inside that triangles wound the other way would show.
TEST_F(Deformation, MirroredJointsShowTheOutside) {
    for (const glm::vec3& scale : {glm::vec3(-1, 1, 1), glm::vec3(-1, -1, -1)}) {
        io::GltfFile file = sixJoints();
        file.nodes[1].scale = scale;
        for (int idle = 0; idle < 20; ++idle) { // joints of the same skin that no vertex follows
            file.skins[0].joints.push_back(0);
            file.skins[0].inverseBind.emplace_back(1.0f);
        }
        scene::Scene scene = scene::buildScene(std::move(file));
        scene::reachOver(scene, 0);
        const scene::View view = *scene::chooseView(scene, {}, 1.0f);
        scene::pose(scene, 0, 0.6);
        scene::Scene fixed = testing::baked(scene);
        auto drawn = renderer(scene)->render(view, settings());
        auto reference = renderer(fixed)->render(view, settings());
        std::vector<std::uint32_t>& indices = fixed.meshes.back().primitives[0].indices;
        for (std::size_t i = 0; i < indices.size(); i += 3) {
            std::swap(indices[i + 1], indices[i + 2]);
        }
        auto inside = renderer(fixed)->render(view, settings());
        ASSERT_TRUE(drawn.ok() && reference.ok() && inside.ok());
        const core::Image picture = display(drawn->radiance);
        EXPECT_LE(testing::compare(picture, display(reference->radiance), 1.0 / 255.0).largest,
                  1.0 / 255.0);
        EXPECT_GT(testing::compare(picture, display(inside->radiance), 0.05).failingFraction, 0.02);
    }
}

TEST_F(Deformation, TargetsMatchTheirVertices) {
    compareAtThreeTimes(scene::buildScene(twoTargets(false)), "morphs");
}

TEST_F(Deformation, FlatTargetsMatchTheirVertices) {
    compareAtThreeTimes(scene::buildScene(twoTargets(true)), "morphs");
}

TEST_F(Deformation, KhronosSkinsMatchTheirVertices) {
    LODESTAR_NEEDS_SHARED();
    compareFile("khronos/RiggedSimple/glTF-Binary/RiggedSimple.glb", "skinning");
    compareFile("bevy/SimpleSkin/SimpleSkin.gltf", "skinning");
}

TEST_F(Deformation, KhronosMorphsMatchTheirVertices) {
    LODESTAR_NEEDS_SHARED();
    compareFile("khronos/AnimatedMorphCube/glTF-Binary/AnimatedMorphCube.glb", "morphs");
    compareFile("khronos/SimpleMorph/glTF/SimpleMorph.gltf", "morphs");
}

TEST_F(Deformation, WhatIsOutOfViewIsNotUploaded) {
    for (const auto& [file, effect] :
         {std::pair(sixJoints(), "skinning"), std::pair(twoTargets(false), "morphs")}) {
        scene::Scene scene = scene::buildScene(file);
        scene::CameraRequest away;
        away.eye = glm::vec3(0.0f, 0.0f, 5.0f);
        away.target = glm::vec3(0.0f, 0.0f, 9.0f);
        const scene::View view = *scene::chooseView(scene, away, 1.0f);
        auto moving = renderer(scene);
        ASSERT_TRUE(moving->render(view, settings()).ok()); // makes the environment ready
        scene::pose(scene, 0, 0.5);
        auto moved = moving->render(view, settings());
        auto still = moving->render(view, settings());
        ASSERT_TRUE(moved.ok() && still.ok());
        EXPECT_FALSE(moved->plan->runs(effect));
        EXPECT_EQ(moved->counters.uploadBytes, still->counters.uploadBytes) << effect;
        auto seen = moving->render(*scene::chooseView(scene, {}, 1.0f), settings());
        ASSERT_TRUE(seen.ok());
        EXPECT_TRUE(seen->plan->runs(effect));
    }
}

} // namespace
} // namespace lodestar

// SPDX-License-Identifier: MIT
//
// Batches: many draws in few calls, the same picture, and uploads of what moved alone.
#include <cmath>

#include "lighting/environment.h"
#include "scene/renderer.h"
#include "support/gl_fixture.h"
#include "support/shapes.h"

namespace lodestar {
namespace {

class Batches : public testing::GlTest {
protected:
    std::unique_ptr<scene::Renderer> rendererOf(const scene::Scene& scene) {
        auto made = scene::Renderer::make(device(), scene);
        EXPECT_TRUE(made.ok());
        (*made)->setEnvironment("sky",
                                lighting::cubeFromAnalytic(lighting::ClearSkyEnvironment{}, 32));
        return std::move(*made);
    }
    static scene::RenderSettings small() {
        scene::RenderSettings settings;
        settings.width = settings.height = 96;
        return settings;
    }
};

/// Nodes in a grid, every third one mirrored, every fourth turned, in two materials. One mesh a
/// material, or one for each node: the same picture either way.
io::GltfFile grid(int side, bool shared) {
    io::GltfFile file;
    io::GltfPrimitive shape = testing::sphere(8, 16);
    // What a mirror shows: no symmetry left.
    for (glm::vec3& p : shape.positions) {
        p.x += 0.3f * p.y;
    }
    file.materials = {testing::blinnPhong({0.6f, 0.2f, 0.1f}, glm::vec3(0.04f), 20.0f),
                      testing::blinnPhong(glm::vec3(0.1f), {0.9f, 0.7f, 0.3f}, 60.0f)};
    file.scenes.push_back({"grid", {}});
    for (int i = 0; i < side * side; ++i) {
        if (!shared || i < 2) {
            io::GltfPrimitive part = shape;
            part.material = i % 2;
            file.meshes.push_back({"mesh", {part}, {}});
        }
        io::GltfNode node;
        node.mesh = shared ? i % 2 : i;
        const float step = 2.4f / static_cast<float>(side);
        node.translation = {
            step * (static_cast<float>(i % side) - 0.5f * static_cast<float>(side - 1)),
            step * (static_cast<float>(i / side) - 0.5f * static_cast<float>(side - 1)), 0.0f};
        node.scale = glm::vec3(0.4f * step);
        node.scale.x *= i % 3 == 0 ? -1.0f : 1.0f;
        if (i % 4 == 0) {
            node.rotation = glm::angleAxis(1.0f, glm::normalize(glm::vec3(1.0f, 2.0f, 0.5f)));
        }
        file.nodes.push_back(node);
        file.scenes[0].roots.push_back(i);
    }
    file.defaultScene = 0;
    return file;
}

TEST_F(Batches, ThePictureIsTheSame) {
    const scene::Scene together = scene::buildScene(grid(6, true));
    const scene::Scene apart = scene::buildScene(grid(6, false));
    const scene::View view = testing::frontView(together, 4.0f);
    auto batched = rendererOf(together)->render(view, small());
    auto single = rendererOf(apart)->render(view, small());
    ASSERT_TRUE(batched.ok() && single.ok());
    EXPECT_EQ(batched->radiance.pixels(), single->radiance.pixels());
    // Two materials, each wound both ways, and the backdrop.
    EXPECT_EQ(batched->counters.draws, 5u);
    EXPECT_EQ(single->counters.draws, 37u);
    std::uint64_t planned = 0;
    for (const plan::Effect& effect : batched->plan->effects) {
        planned += effect.cost.draws;
    }
    EXPECT_EQ(planned, batched->counters.draws);
}

/// The scene under a sun, with a shadow of each node.
std::unique_ptr<scene::Renderer> underTheSun(std::unique_ptr<scene::Renderer> renderer) {
    lighting::DayLight sun;
    sun.kind = lighting::LightKind::Sun;
    sun.axis = glm::normalize(glm::dvec3(0.4, 0.6, 1.0));
    lighting::DayKey key;
    key.hour = 12.0;
    key.tint = glm::dvec3(1.0);
    key.gradient.stops = {{0.0, glm::dvec3(1.0), 10.0}, {3.0, glm::dvec3(1.0), 10.0}};
    sun.keys = {key};
    core::Tally warnings;
    renderer->setLights({*lighting::repaired(sun, warnings)});
    return renderer;
}

// A driver whose buffer textures hold five instances: as many calls as pages and batches ask for,
// the same picture, and what moves is uploaded in its page.
TEST_F(Batches, InstancesBeyondAPageAreInTheNext) {
    scene::Scene scene = scene::buildScene(grid(6, true));
    const scene::View view = testing::frontView(scene, 4.0f);
    const auto whole = underTheSun(rendererOf(scene))->render(view, small());
    device().limitBufferTexels(4 * 5 + 3);
    const auto renderer = underTheSun(rendererOf(scene));
    const auto paged = renderer->render(view, small());
    ASSERT_TRUE(whole.ok() && paged.ok());
    EXPECT_EQ(paged->radiance.pixels(), whole->radiance.pixels());
    // 36 draws in 4 batches, their casters behind them in 4 more, cut at 5, 10, .. 70.
    EXPECT_EQ(whole->counters.draws, 1u + 4u + 4u);
    EXPECT_GT(paged->counters.draws, 1u + 72u / 5u);
    std::uint64_t planned = 0;
    for (const plan::Effect& effect : paged->plan->effects) {
        planned += effect.cost.draws;
    }
    EXPECT_EQ(planned, paged->counters.draws);
    for (const std::vector<plan::Batch>* batches :
         {&paged->plan->batches, &paged->plan->casterBatches}) {
        const std::size_t before = batches == &paged->plan->batches ? 0 : 36;
        for (const plan::Batch& batch : *batches) {
            EXPECT_EQ((before + batch.first) / 5, (before + batch.first + batch.count - 1) / 5);
        }
    }
    const auto idle = renderer->render(view, small());
    scene.nodes[7].worldFromNode[3].x += 0.01f;
    scene.nodes[30].worldFromNode[3].x += 0.01f;
    const auto moved = renderer->render(view, small());
    ASSERT_TRUE(idle.ok() && moved.ok());
    // Two pages of draws, two of casters; and the shadow is drawn again, by a block of its own
    // before the picture's.
    EXPECT_EQ(idle->counters.uploads, 0u);
    EXPECT_EQ(moved->counters.uploads, 4u + 2u);
}

// A frame in which nothing has changed has the plan of the one before; whatever changes, the plan
// is what it would be if nothing were kept: a picture by another view between two frames makes all
// draws be described anew.
TEST_F(Batches, PlansAreKeptWhileNothingChanges) {
    scene::Scene scene = scene::buildScene(grid(6, true));
    const auto kept = underTheSun(rendererOf(scene));
    const auto anew = underTheSun(rendererOf(scene));
    scene::View view = testing::frontView(scene, 4.0f);
    const scene::View elsewhere = testing::frontView(scene, 40.0f);
    scene::RenderSettings settings = small();
    std::shared_ptr<const plan::EffectPlan> last;
    const auto frame = [&](const char* change) {
        const auto a = kept->render(view, settings);
        const auto b = anew->render(view, settings);
        EXPECT_TRUE(a.ok() && b.ok() && anew->render(elsewhere, settings).ok()) << change;
        EXPECT_EQ(*a->plan, *b->plan) << change;
        const bool same = a->plan == last;
        last = a->plan;
        return same;
    };
    frame("first");
    EXPECT_FALSE(frame("what was made in the first is kept in the second"));
    EXPECT_TRUE(frame("idle"));
    EXPECT_TRUE(frame("idle"));
    scene.nodes[5].worldFromNode[3].x += 9.0f;
    EXPECT_FALSE(frame("a node out of the view"));
    EXPECT_FALSE(frame("its shadow is drawn"));
    EXPECT_TRUE(frame("idle"));
    view = testing::frontView(scene, 2.0f);
    EXPECT_FALSE(frame("the view"));
    EXPECT_TRUE(frame("idle"));
    settings.materialOverride = scene::MaterialOverride{glm::vec3(1.0f), glm::vec3(0.0f), 0.0f};
    EXPECT_FALSE(frame("a setting"));
    EXPECT_TRUE(frame("idle"));
    settings.hour = 13.0;
    EXPECT_FALSE(frame("the hour, a setting too"));
    for (scene::Renderer* renderer : {kept.get(), anew.get()}) {
        renderer->setEnvironment("other",
                                 lighting::cubeFromAnalytic(lighting::ConstantEnvironment{}, 8));
    }
    EXPECT_FALSE(frame("the environment"));
    EXPECT_FALSE(frame("its parts are made"));
    EXPECT_TRUE(frame("idle"));
    for (scene::Renderer* renderer : {kept.get(), anew.get()}) {
        renderer->setLights({});
    }
    EXPECT_FALSE(frame("the lights"));
    EXPECT_TRUE(frame("idle"));
}

TEST_F(Batches, TenThousandDrawsAreFewCalls) {
    scene::Scene scene = scene::buildScene(grid(100, true));
    const scene::View view = testing::frontView(scene, 4.0f);
    auto renderer = rendererOf(scene);
    auto first = renderer->render(view, small());
    ASSERT_TRUE(first.ok());
    EXPECT_EQ(first->plan->drawOrder.size(), 10000u);
    EXPECT_EQ(first->counters.draws, 5u);
    // Nothing moved: nothing is uploaded.
    auto idle = renderer->render(view, small());
    ASSERT_TRUE(idle.ok());
    EXPECT_EQ(idle->counters.uploads, 0u);
    // One node moved: one instance of 64 bytes.
    scene.nodes[4321].worldFromNode[3].x += 0.01f;
    auto moved = renderer->render(view, small());
    ASSERT_TRUE(moved.ok());
    EXPECT_EQ(moved->counters.uploads, 1u);
    EXPECT_EQ(moved->counters.uploadBytes, 64u);
    // Two nodes apart: what lies between them in the order goes along.
    scene.nodes[2].worldFromNode[3].x += 0.01f;
    scene.nodes[9998].worldFromNode[3].x += 0.01f;
    auto far = renderer->render(view, small());
    ASSERT_TRUE(far.ok());
    EXPECT_EQ(far->counters.uploads, 1u);
    EXPECT_GT(far->counters.uploadBytes, 128u);
}

// Fewer instances than before, then as many again: the tail that was not drawn is still right.
TEST_F(Batches, CulledDrawsComeBack) {
    const scene::Scene scene = scene::buildScene(grid(10, true));
    auto renderer = rendererOf(scene);
    const scene::View all = testing::frontView(scene, 4.0f);
    scene::View some = testing::frontView(scene, 1.5f);
    auto before = renderer->render(all, small());
    auto close = renderer->render(some, small());
    auto after = renderer->render(all, small());
    ASSERT_TRUE(before.ok() && close.ok() && after.ok());
    EXPECT_LT(close->plan->drawOrder.size(), 100u);
    EXPECT_GT(close->plan->drawOrder.size(), 4u);
    EXPECT_EQ(before->radiance.pixels(), after->radiance.pixels());
    EXPECT_EQ(close->radiance.pixels(),
              rendererOf(scene)->render(some, small())->radiance.pixels());
}

// Blended draws keep their order from back to front; only neighbours of one kind are one call.
TEST_F(Batches, BlendedDrawsKeepTheirOrder) {
    io::GltfFile file;
    for (int i = 0; i < 2; ++i) {
        io::GltfMaterial glass;
        glass.baseColor =
            i == 0 ? glm::vec4(0.9f, 0.1f, 0.1f, 0.5f) : glm::vec4(0.1f, 0.1f, 0.9f, 0.5f);
        glass.alphaMode = io::AlphaMode::Blend;
        glass.unlit = true;
        file.materials.push_back(glass);
        io::GltfPrimitive part = testing::square();
        part.material = i;
        file.meshes.push_back({"pane", {part}, {}});
    }
    file.scenes.push_back({"panes", {}});
    const int meshes[] = {0, 1, 0, 0}; // by distance: 0 nearest
    for (int i = 0; i < 4; ++i) {
        io::GltfNode node;
        node.mesh = meshes[i];
        node.translation.z = -0.2f * static_cast<float>(i);
        file.nodes.push_back(node);
        file.scenes[0].roots.push_back(i);
    }
    file.defaultScene = 0;
    const scene::Scene scene = scene::buildScene(std::move(file));
    scene::RenderSettings settings = small();
    settings.backdrop = false;
    auto frame = rendererOf(scene)->render(testing::frontView(scene, 6.0f), settings);
    ASSERT_TRUE(frame.ok());
    EXPECT_EQ(frame->counters.draws, 3u) << "the two red panes behind are one";
    // Red over blue over two reds: premultiplied, each covers half.
    const float* center = frame->radiance.at(48, 48);
    EXPECT_NEAR(center[0], 0.5f * 0.9f + 0.25f * 0.1f + 0.125f * 0.9f + 0.0625f * 0.9f, 1e-5f);
    EXPECT_NEAR(center[2], 0.5f * 0.1f + 0.25f * 0.9f + 0.125f * 0.1f + 0.0625f * 0.1f, 1e-5f);
}

} // namespace
} // namespace lodestar

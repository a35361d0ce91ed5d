// SPDX-License-Identifier: MIT
//
// Light probes at their limits: mirrors in rooms, walks, broken input, and that what is not called
// for costs nothing.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "lighting/environment.h"
#include "scene/gpu_probes.h"
#include "scene/renderer.h"
#include "support/gl_fixture.h"
#include "support/probe_world.h"

namespace lodestar {
namespace {

using testing::blinnPhong;
using testing::glowing;
using testing::ProbeWorld;

class ProbeCases : public testing::ProbeTest {
protected:
    std::unique_ptr<scene::Renderer> rendererOf(const scene::Scene& scene, double sky = 0.4) {
        auto made = ProbeTest::rendererOf(scene);
        made->setEnvironment("sky", testing::constantSky(sky));
        return made;
    }
};

/// A room whose walls are glowing colours of their own, and a mirror that a probe serves.
struct MirrorRoom {
    glm::vec3 low{-3, 0, -2}, high{3, 2.5f, 4};
    glm::vec3 colors[6] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}};

    [[nodiscard]] ProbeWorld make(bool proxy) const {
        ProbeWorld world;
        for (int axis = 0; axis < 3; ++axis) {
            for (int side = 0; side < 2; ++side) {
                glm::vec3 a = low - 0.3f, b = high + 0.3f;
                (side == 0 ? a : b)[axis] = (side == 0 ? high : low)[axis];
                world.box("wall", a, b, glowing(colors[2 * axis + side]), 1);
            }
        }
        world.box("mirror", {-1.5f, 0.2f, -1.9f}, {1.5f, 2.2f, -1.8f},
                  blinnPhong(glm::vec3(0.0f), glm::vec3(1.0f), 1e7f), 2);
        const glm::dvec3 center = 0.5 * glm::dvec3(low + high);
        const glm::dvec3 at(0.8, 1.1, 0.4); // not in the middle
        lighting::Probe& probe = world.probe("room", at, glm::dvec3(high - low) + 0.4, 0.0);
        probe.influence.center = center - at;
        probe.exterior = false;
        probe.capture.resolution = 256;
        probe.capture.layers = 1;
        if (proxy) {
            probe.proxy = lighting::ProbeVolume{
                lighting::VolumeShape::Box, center - at, glm::dvec3(high - low), {}};
        }
        return world;
    }
    /// What a ray from inside meets first: its colour and how near to an edge of two walls, radians
    /// as seen from where the probe captured.
    glm::vec3 hit(const glm::vec3& from, const glm::vec3& d, float& edge) const {
        float nearest = 1e30f;
        glm::vec3 color(0.0f);
        int wall = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const float t = ((d[axis] > 0.0f ? high : low)[axis] - from[axis]) / d[axis];
            if (t < nearest) {
                nearest = t;
                wall = axis;
                color = colors[2 * axis + (d[axis] > 0.0f ? 0 : 1)];
            }
        }
        const glm::vec3 at = from + nearest * d;
        edge = 1e30f;
        for (int axis = 0; axis < 3; ++axis) {
            if (axis != wall) {
                edge = std::min({edge, at[axis] - low[axis], high[axis] - at[axis]});
            }
        }
        edge /= glm::length(at - glm::vec3(0.8f, 1.1f, 0.4f));
        return color;
    }
};

// The mirror's picture is that of rays: wrong colours lie within a texel of an edge of two walls,
// with half a texel more that a bilinear fetch mixes and half a pixel of the picture.
TEST_F(ProbeCases, CornersOfAMirroredRoomLieWhereTheyAre) {
    const MirrorRoom room;
    for (const bool proxy : {true, false}) {
        const scene::Scene scene = room.make(proxy).make();
        auto renderer = rendererOf(scene, 0.0);
        const glm::vec3 eye(-0.9f, 1.5f, 2.8f);
        const scene::View view = testing::lookAt(scene, eye, {0.2f, 1.2f, -1.8f}, 0.6f);
        constexpr int kSide = 160;
        const core::Image picture = frameOf(*renderer, view, small(kSide)).radiance;
        const glm::mat4 worldFromClip = glm::inverse(view.clipFromWorld());
        int wrong = 0, mirrored = 0;
        for (int y = 0; y < kSide; ++y) {
            for (int x = 0; x < kSide; ++x) {
                const glm::vec4 clip(2.0f * (static_cast<float>(x) + 0.5f) / kSide - 1.0f,
                                     1.0f - 2.0f * (static_cast<float>(y) + 0.5f) / kSide, 0.5f, 1);
                const glm::vec4 world = worldFromClip * clip;
                const glm::vec3 d = glm::normalize(glm::vec3(world) / world.w - eye);
                const glm::vec3 at = eye + (-1.8f - eye.z) / d.z * d;
                if (at.x < -1.45f || at.x > 1.45f || at.y < 0.25f || at.y > 2.15f) {
                    continue;
                }
                ++mirrored;
                float edge = 0.0f;
                const glm::vec3 truth = room.hit(at, {d.x, d.y, -d.z}, edge);
                const float* seen = picture.at(x, y);
                const float off =
                    std::max({std::abs(seen[0] - truth.r), std::abs(seen[1] - truth.g),
                              std::abs(seen[2] - truth.b)});
                // A texel of 256 is at most 2 / 256; the picture's pixel .6 / 160.
                if (off > 0.5f && edge > 1.5f * 2.0f / 256.0f + 0.5f * 0.6f / kSide) {
                    ++wrong;
                }
            }
        }
        EXPECT_GT(mirrored, 8000);
        if (proxy) {
            EXPECT_EQ(wrong, 0);
        } else {
            EXPECT_GT(wrong, 500); // without parallax corners lie elsewhere
        }
    }
}

// A ball walks through three probes of different light, a frame of 60 a second at 1.4 m/s. What may
// change is what smooth blends of 2 m change: 1.5 / 2 a metre of the contrast of 1; nothing jumps.
TEST_F(ProbeCases, AWalkAcrossOverlapsHasNoStep) {
    ProbeWorld world;
    world.ball("walker", {0, 0, 0}, 0.3f, blinnPhong(glm::vec3(0.6f), glm::vec3(0.3f), 60.0f));
    const float radiance[] = {0.2f, 0.9f, 0.5f};
    for (int i = 0; i < 3; ++i) {
        world.probe("probe " + std::to_string(i), {3.0 * i - 3.0, 0, 0}, {7, 6, 6}, 2.0);
        world.holding(glm::vec3(radiance[i]));
    }
    scene::Scene scene = world.make();
    auto renderer = rendererOf(scene, 0.6);
    constexpr float kStep = 1.4f / 60.0f;
    double worst = 0.0, before = -1.0;
    for (float x = -9.0f; x < 9.0f; x += kStep) {
        scene.nodes[0].parentFromNode[3] = glm::vec4(x, 0, 0, 1);
        scene::updateTransforms(scene);
        const core::Image picture =
            frameOf(*renderer, testing::lookAt(scene, {x, 0.3f, 2}, {x, 0, 0}, 0.4f), small(9))
                .radiance;
        const double now = static_cast<double>(picture.at(4, 4)[1]);
        worst = before >= 0.0 ? std::max(worst, std::abs(now - before)) : 0.0;
        before = now;
    }
    // Contrasts are .7 at most, two blends may fall together.
    EXPECT_LT(worst, 2.0 * 0.7 * 1.5 / 2.0 * kStep);
    std::printf("a walk's greatest step: %.2f / 255 of the radiance\n", 255.0 * worst);
}

TEST_F(ProbeCases, BrokenVolumesAndFramesAreDefined) {
    ProbeWorld world;
    world.ball("ball", {0, 0, 0}, 0.5f, blinnPhong(glm::vec3(0.5f), glm::vec3(0.1f), 20.0f));
    world.probe("flat", {0, 0, 0}, {4, 0, 4}, 0.5);
    for (int i = 0; i < 12; ++i) {
        world.probe("nested " + std::to_string(i), {0, 0, 0}, glm::dvec3(1.0 + 0.5 * i), 0.2);
    }
    scene::Scene scene = world.make();
    auto renderer = rendererOf(scene);
    const scene::View view = testing::lookAt(scene, {0, 0, 4}, {0, 0, 0});
    EXPECT_EQ(frameOf(*renderer, view, small(32)).repairedPixels, 0u);
    const std::size_t last = scene.nodes.size() - 1;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const glm::mat4& frame : {glm::mat4(nan), glm::mat4(0.0f), glm::mat4(-1.0f),
                                   glm::mat4(glm::vec4(3, 0, 0, 0), glm::vec4(0, -0.2f, 0, 0),
                                             glm::vec4(0, 0, 1, 0), glm::vec4(0, 0, 0, 1)),
                                   glm::mat4(1e30f), glm::mat4(1.0f)}) {
        for (std::size_t node = last - 2; node <= last; ++node) {
            scene.nodes[node].parentFromNode = frame;
        }
        scene::updateTransforms(scene);
        const scene::Frame drawn = frameOf(*renderer, view, small(32));
        EXPECT_EQ(drawn.repairedPixels, 0u);
        EXPECT_GT(drawn.radiance.at(16, 16)[0], 0.01f);
    }
}

TEST_F(ProbeCases, ResolutionsOfOneAndOfSixteenThousand) {
    for (const int resolution : {1, 3, 16384}) {
        ProbeWorld world;
        world.ball("ball", {0, 0, 0}, 0.5f, blinnPhong(glm::vec3(0.5f), glm::vec3(0.1f), 20.0f), 2);
        lighting::Probe& probe = world.probe("probe", {0, 1, 0}, {6, 6, 6}, 0.5);
        probe.capture.resolution = resolution;
        probe.capture.layers = 1;
        const scene::Scene scene = world.make();
        auto renderer = rendererOf(scene, 1.0);
        const scene::View view = testing::lookAt(scene, {0, 0, 4}, {0, 0, 0});
        const scene::Frame frame = frameOf(*renderer, view, small(32));
        EXPECT_EQ(frame.counters.probeFaces, 6u);
        // A white world: k_L (1 - F) + F, F 0.1 and more.
        EXPECT_NEAR(frame.radiance.at(16, 16)[1], 0.55f, 0.02f) << resolution;
        EXPECT_EQ(renderer->probeWarnings().empty(), resolution < 16384);
    }
}

// Where there is no memory for a probe it is made smaller, and counted; where there is none for the
// smallest the frame fails with a sentence, and the next is whole once there is.
TEST_F(ProbeCases, MemoryThatIsRefusedLosesNothing) {
    ProbeWorld world;
    world.ball("ball", {0, 0, 0}, 0.5f, blinnPhong(glm::vec3(0.5f), glm::vec3(0.1f), 20.0f), 2);
    for (int i = 0; i < 3; ++i) {
        lighting::Probe& probe =
            world.probe("probe " + std::to_string(i), {0.1 * i, 1, 0}, glm::dvec3(6.0 - i), 0.5);
        probe.capture.resolution = 256;
        probe.capture.layers = 1;
    }
    const scene::Scene scene = world.make();
    auto renderer = rendererOf(scene, 1.0);
    const scene::View view = testing::lookAt(scene, {0, 0, 4}, {0, 0, 0});
    const std::uint64_t held = device().counters().textureBytes;
    device().limitTargetBytes(held + 1000);
    const auto refused = renderer->render(view, small(32));
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.error().message().find("no memory"), std::string::npos);
    // The first of three finds room for half of its width, in the second frame; what was refused
    // before is asked for again.
    device().limitTargetBytes(held + 6u * 1024u * 1024u);
    auto drawn = renderer->render(view, small(32));
    device().limitTargetBytes(std::numeric_limits<std::uint64_t>::max());
    if (!drawn.ok()) {
        drawn = renderer->render(view, small(32));
    }
    ASSERT_TRUE(drawn.ok()) << drawn.error().message();
    EXPECT_NEAR(drawn->radiance.at(16, 16)[1], 0.55f, 0.02f);
    EXPECT_FALSE(renderer->probeWarnings().empty());
    EXPECT_EQ(frameOf(*renderer, view, small(32)).repairedPixels, 0u);
}

TEST_F(ProbeCases, WithoutABudgetNothingIsDrawnAndNothingIsLost) {
    ProbeWorld world;
    world.ball("ball", {0, 0, 0}, 0.5f, blinnPhong(glm::vec3(0.5f), glm::vec3(0.1f), 20.0f));
    world.probe("probe", {0, 1, 0}, {6, 6, 6}, 0.5);
    const scene::Scene scene = world.make();
    auto renderer = rendererOf(scene, 1.0);
    const scene::View view = testing::lookAt(scene, {0, 0, 4}, {0, 0, 0});
    scene::RenderSettings settings = small(32);
    settings.faceBudget = 0;
    for (int i = 0; i < 3; ++i) {
        const scene::Frame frame = frameOf(*renderer, view, settings);
        EXPECT_EQ(frame.counters.probeFaces, 0u);
        EXPECT_NEAR(frame.radiance.at(16, 16)[1], 0.55f, 0.02f); // the sky lights it until then
    }
    EXPECT_EQ(renderer->probeProgress(0), 0.0);
    settings.faceBudget = 4;
    EXPECT_EQ(frameOf(*renderer, view, settings).counters.probeFaces, 4u);
    EXPECT_FALSE(renderer->isProbeReady(0));
    EXPECT_DOUBLE_EQ(renderer->probeProgress(0), 4.0 / 6.0);
    EXPECT_EQ(frameOf(*renderer, view, settings).counters.probeFaces, 2u);
    EXPECT_TRUE(renderer->isProbeReady(0));
    EXPECT_EQ(renderer->probeProgress(0), 1.0);
    renderer->requestProbe(0);
    settings.faceBudget = 3;
    EXPECT_EQ(frameOf(*renderer, view, settings).counters.probeFaces, 3u);
    EXPECT_EQ(renderer->probeProgress(0), 0.5);
    EXPECT_TRUE(renderer->isProbeReady(0)); // it goes on showing what it held
}

lighting::DayLight constantLight(lighting::LightKind kind) {
    const bool sun = kind == lighting::LightKind::Sun;
    lighting::DayLight light;
    light.name = sun ? "sun" : "sky";
    light.kind = kind;
    light.axis = glm::dvec3(0.3, 1, 0.2);
    light.add = true;
    light.keys = {{12.0,
                   sun ? lighting::Gradient{{{0, glm::dvec3(100.0), 0},
                                             {1, glm::dvec3(100.0), 0},
                                             {1, {}, 0}}}
                       : lighting::Gradient{{{90, glm::dvec3(0.2), 0}}},
                   glm::dvec3(1.0),
                   {}}};
    core::Tally warnings;
    return *lighting::repaired(light, warnings);
}

/// A scene, and the effects that it calls for: no others may run.
struct Called {
    const char* name;
    bool ball, sky, sun, unseenProbe, probe;
    std::set<std::string> effects;
};

// Each scene calls for one effect more. What is not called for runs nothing, compiles nothing, and
// no counter of it moves; what is foreseen is what is done, call by call and pass by pass.
TEST_F(ProbeCases, WhatIsNotCalledForCostsNothing) {
    const Called scenes[] = {
        {"nothing", false, false, false, false, false, {}},
        {"a ball", true, false, false, false, false, {"tent-mips", "irradiance"}},
        {"an unseen probe", true, false, false, true, false, {"tent-mips", "irradiance"}},
        {"a sky", true, true, false, false, false, {"tent-mips", "irradiance", "rsrm-blend"}},
        {"a sun",
         true,
         false,
         true,
         false,
         false,
         {"tent-mips", "irradiance", "rsrm-blend", "shadow-map"}},
        {"a probe",
         true,
         false,
         false,
         false,
         true,
         {"tent-mips", "irradiance", "probe-capture", "probe-compose", "probe-mips",
          "probe-irradiance"}},
        {"all",
         true,
         true,
         true,
         true,
         true,
         {"tent-mips", "irradiance", "rsrm-blend", "shadow-map", "probe-capture", "probe-compose",
          "probe-mips", "probe-irradiance"}}};
    std::map<std::string, gl::WorkCounters> done;
    for (const Called& called : scenes) {
        ProbeWorld world;
        if (called.ball) {
            world.ball("ball", {0, 0, 0}, 0.5f,
                       blinnPhong(glm::vec3(0.5f), glm::vec3(0.1f), 20.0f));
        }
        if (called.unseenProbe) {
            world.probe("attic", {50, 0, 0}, {4, 4, 4}, 0.5);
        }
        if (called.probe) {
            world.probe("here", {0, 1, 0}, {6, 6, 6}, 0.5);
        }
        const scene::Scene scene = world.make();
        auto renderer = rendererOf(scene);
        std::vector<lighting::DayLight> lights;
        if (called.sky) {
            lights.push_back(constantLight(lighting::LightKind::Sky));
        }
        if (called.sun) {
            lights.push_back(constantLight(lighting::LightKind::Sun));
        }
        renderer->setLights(lights);
        const scene::View view = testing::lookAt(scene, {0, 0, 4}, {0, 0, 0});
        const scene::Frame first = frameOf(*renderer, view, small(32));
        std::set<std::string> ran;
        std::uint64_t passes = 1, calls = 0;
        for (const plan::Effect& effect : first.plan->effects) {
            passes += effect.cost.passes;
            calls += effect.cost.draws;
            if (effect.decision == plan::Decision::Run && effect.effect != "draw") {
                ran.insert(effect.effect);
            }
        }
        EXPECT_EQ(ran, called.effects) << called.name;
        EXPECT_EQ(first.counters.passes, passes) << called.name;
        EXPECT_EQ(first.counters.draws, calls) << called.name;
        EXPECT_EQ(first.counters.probeFaces, called.probe ? 6u : 0u) << called.name;
        done[called.name] = first.counters;
        const gl::WorkCounters second = frameOf(*renderer, view, small(32)).counters;
        EXPECT_EQ(second.passes, 1u) << called.name;
        EXPECT_EQ(second.draws, first.plan->batches.size()) << called.name;
        EXPECT_EQ(second.uploads, 0u) << called.name;
        EXPECT_EQ(second.shaderCompilations, 0u) << called.name;
        EXPECT_EQ(second.probeFaces, 0u) << called.name;
    }
    // A probe that nobody sees: not a shader, not a texture, not a pass more than the ball alone.
    const gl::WorkCounters& alone = done["a ball"];
    const gl::WorkCounters& unseen = done["an unseen probe"];
    EXPECT_EQ(unseen.shaderCompilations, alone.shaderCompilations);
    EXPECT_EQ(unseen.passes, alone.passes);
    EXPECT_EQ(unseen.textureBytes, alone.textureBytes);
    EXPECT_EQ(done["nothing"].shaderCompilations, 0u);
}

} // namespace
} // namespace lodestar

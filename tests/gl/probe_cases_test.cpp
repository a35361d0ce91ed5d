// SPDX-License-Identifier: MIT
//
// Light probes at their limits: mirrors in rooms, walks, broken input, and that what is not called
// for costs nothing.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <string>

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
    settings.faceBudget = 6;
    EXPECT_EQ(frameOf(*renderer, view, settings).counters.probeFaces, 6u);
    EXPECT_TRUE(renderer->isProbeReady(0));
}

/// What a scene is made to call for beyond the one before it, and what must then be counted.
struct Step {
    const char* name;
    std::function<void(ProbeWorld&)> add;
};

// Each scene calls for one effect more. What is not called for runs nothing, compiles nothing, and
// no counter of it moves.
TEST_F(ProbeCases, WhatIsNotCalledForCostsNothing) {
    const auto ball = [](ProbeWorld& world) {
        world.ball("ball", {0, 0, 0}, 0.5f, blinnPhong(glm::vec3(0.5f), glm::vec3(0.1f), 20.0f));
    };
    const Step steps[] = {{"nothing", [](ProbeWorld&) {}},
                          {"a ball", ball},
                          {"a probe that nobody sees",
                           [&](ProbeWorld& world) {
                               ball(world);
                               world.probe("attic", {50, 0, 0}, {4, 4, 4}, 0.5);
                           }},
                          {"a probe", [&](ProbeWorld& world) {
                               ball(world);
                               world.probe("here", {0, 1, 0}, {6, 6, 6}, 0.5);
                           }}};
    std::uint64_t compiled = 0;
    for (const Step& step : steps) {
        ProbeWorld world;
        step.add(world);
        const scene::Scene scene = world.make();
        auto renderer = rendererOf(scene);
        const scene::View view = testing::lookAt(scene, {0, 0, 4}, {0, 0, 0});
        const scene::Frame first = frameOf(*renderer, view, small(32));
        const plan::EffectPlan& plan = *first.plan;
        const bool probes = std::string(step.name) == "a probe";
        EXPECT_EQ(first.counters.probeFaces, probes ? 6u : 0u) << step.name;
        EXPECT_EQ(plan.runs("probe-capture"), probes) << step.name;
        EXPECT_EQ(plan.runs("probe-compose"), probes) << step.name;
        EXPECT_EQ(plan.runs("probe-mips"), probes) << step.name;
        EXPECT_EQ(plan.runs("probe-irradiance"), probes) << step.name;
        EXPECT_EQ(plan.runs("tent-mips"), std::string(step.name) != "nothing") << step.name;
        if (std::string(step.name) == "a ball") {
            compiled = first.counters.shaderCompilations;
        }
        if (std::string(step.name) == "a probe that nobody sees") {
            // Not a shader, not a texture, not a pass more than the ball alone.
            EXPECT_EQ(first.counters.shaderCompilations, compiled);
            EXPECT_EQ(first.counters.passes, 1u);
        }
        // What was foreseen is what was done, call by call and pass by pass.
        std::uint64_t passes = 1, calls = 0;
        const std::uint64_t draws = plan.batches.size();
        for (const plan::Effect& effect : plan.effects) {
            passes += effect.cost.passes;
            calls += effect.cost.draws;
        }
        EXPECT_EQ(first.counters.passes, passes) << step.name;
        EXPECT_EQ(first.counters.draws, calls) << step.name;
        const gl::WorkCounters second = frameOf(*renderer, view, small(32)).counters;
        EXPECT_EQ(second.passes, 1u) << step.name;
        EXPECT_EQ(second.draws, draws) << step.name;
        EXPECT_EQ(second.uploads, 0u) << step.name;
        EXPECT_EQ(second.shaderCompilations, 0u) << step.name;
        EXPECT_EQ(second.probeFaces, 0u) << step.name;
    }
}

} // namespace
} // namespace lodestar

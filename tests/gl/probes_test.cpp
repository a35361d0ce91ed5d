// SPDX-License-Identifier: MIT
//
// Light probes on screen: a constant world stays constant, rooms keep the sky out, nothing is lit
// by itself, what is composed is what a camera sees.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>

#include <glm/geometric.hpp>

#include "lighting/environment.h"
#include "scene/renderer.h"
#include "support/gl_fixture.h"
#include "support/probe_world.h"

namespace lodestar {
namespace {

using testing::blinnPhong;
using testing::glowing;
using testing::ProbeWorld;

class Probes : public testing::ProbeTest {};

float greatest(const core::Image& image) {
    float most = 0.0f;
    for (std::size_t i = 0; i < image.pixels().size(); i += 4) {
        most = std::max({most, image.pixels()[i], image.pixels()[i + 1], image.pixels()[i + 2]});
    }
    return most;
}

/// By how much covered pixels differ from 1.
float worstFromOne(const core::Image& image, int& covered) {
    float worst = 0.0f;
    for (std::size_t i = 0; i < image.pixels().size(); i += 4) {
        if (image.pixels()[i + 3] > 0.0f) {
            ++covered;
            for (std::size_t c = 0; c < 3; ++c) {
                worst = std::max(worst, std::abs(image.pixels()[i + c] - 1.0f));
            }
        }
    }
    return worst;
}

// All that is seen has radiance 1, so all that is lit has. The balls are in a layer of their own:
// captured, they would show an interior that nothing lights.
TEST_F(Probes, AConstantWorldIsUnchangedByRandomLayouts) {
    constexpr std::uint32_t kCaptured = 1, kBalls = 2;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const auto within = [&](double a, double b) { return a + (b - a) * unit(random); };
    for (int layout = 0; layout < 12; ++layout) {
        ProbeWorld world;
        world.ball("mirror", {-1.2f, 0, 0}, 1.0f,
                   blinnPhong(glm::vec3(0.0f), glm::vec3(1.0f), 900.0f), kBalls);
        world.ball("matt", {1.2f, 0, 0}, 1.0f, blinnPhong(glm::vec3(1.0f), glm::vec3(0.0f), 0.0f),
                   kBalls);
        world.ball("glossy", {0, 1.6f, 0}, 0.8f,
                   blinnPhong(glm::vec3(0.0f), glm::vec3(1.0f), 12.0f), kBalls);
        for (int i = 0; i < 5; ++i) {
            const glm::vec3 at(within(-6, 6), within(-6, -3), within(-6, 6));
            world.box("stone", at, at + glm::vec3(1.0f), glowing(glm::vec3(1.0f)), kCaptured);
        }
        const int count = 1 + layout % 6;
        for (int i = 0; i < count; ++i) {
            lighting::Probe& probe = world.probe(
                "probe " + std::to_string(i), {within(-2, 2), within(-2, 2), within(-2, 2)},
                {within(0.2, 6), within(0.2, 6), within(0.2, 6)}, within(0, 2));
            probe.capture.layers = kCaptured;
            probe.exterior = unit(random) < 0.6;
            probe.priority = static_cast<int>(within(0, 3));
            probe.influence.shape =
                unit(random) < 0.3 ? lighting::VolumeShape::Sphere : lighting::VolumeShape::Box;
            if (unit(random) < 0.5) {
                probe.proxy = probe.influence;
            }
        }
        const scene::Scene scene = world.make();
        auto renderer = rendererOf(scene);
        renderer->setEnvironment("white", testing::constantSky(1.0));
        const scene::Frame frame =
            frameOf(*renderer, testing::lookAt(scene, {0, 0.5f, 6}, {0, 0.5f, 0}, 0.8f), small(48));
        int covered = 0;
        // Half floats round to 5e-4 in level 0 and in the mips.
        EXPECT_LT(worstFromOne(frame.radiance, covered), 1e-3f) << "layout " << layout;
        EXPECT_GT(covered, 300);
        EXPECT_GT(frame.counters.probeFaces, 0u);
    }
}

TEST_F(Probes, AClosedRoomKeepsTheSkyOut) {
    ProbeWorld world;
    world.room({-2, 0, -3}, {2, 2.5f, 3}, 0.3f,
               blinnPhong(glm::vec3(0.8f), glm::vec3(0.04f), 30.0f));
    world.ball("statue", {0.5f, 0.6f, -1}, 0.5f,
               blinnPhong(glm::vec3(0.4f), glm::vec3(0.3f), 200.0f));
    lighting::Probe& probe = world.probe("room", {0, 1.25, 0}, {4.3, 2.8, 6.3}, 0.1);
    probe.exterior = false;
    const scene::Scene scene = world.make();
    auto renderer = rendererOf(scene);
    renderer->setEnvironment("white", testing::constantSky(1.0));
    const scene::View inside = testing::lookAt(scene, {0, 1.4f, 2.5f}, {0.2f, 1.0f, -2});
    const scene::Frame frame = frameOf(*renderer, inside, small(64));
    EXPECT_LT(greatest(frame.radiance), 1e-3f);
    int covered = 0;
    (void)worstFromOne(frame.radiance, covered);
    EXPECT_EQ(covered, 64 * 64);
    // Without the probe it is as bright as under the open sky.
    ProbeWorld open;
    open.room({-2, 0, -3}, {2, 2.5f, 3}, 0.3f,
              blinnPhong(glm::vec3(0.8f), glm::vec3(0.04f), 30.0f));
    const scene::Scene bare = open.make();
    auto bright = rendererOf(bare);
    bright->setEnvironment("white", testing::constantSky(1.0));
    EXPECT_GT(greatest(frameOf(*bright, inside, small(64)).radiance), 0.5f);
}

/// A sun of irradiance 10 about an axis, and no sky. @param visibility whether it casts shadows
std::vector<lighting::DayLight> bareSun(const glm::dvec3& axis, bool visibility) {
    lighting::DayLight sun;
    sun.name = "sun";
    sun.kind = lighting::LightKind::Sun;
    sun.axis = axis;
    sun.visibility = visibility;
    sun.keys = {{12.0,
                 {{{0, glm::dvec3(147000.0), 0}, {0.27, glm::dvec3(147000.0), 0}, {0.27, {}, 0}}},
                 glm::dvec3(1.0),
                 {}}};
    core::Tally warnings;
    return {*lighting::repaired(sun, warnings)};
}

// By its shadow map where it has one, else by what the probe sees of it.
TEST_F(Probes, AClosedRoomKeepsTheSunOut) {
    for (const bool visibility : {true, false}) {
        for (const glm::dvec3& axis :
             {glm::dvec3(0.2, 1, 0.3), glm::dvec3(1, 0.2, 0.1), glm::dvec3(-0.3, 0.4, 1)}) {
            ProbeWorld world;
            world.room({-2, 0, -3}, {2, 2.5f, 3}, 0.3f,
                       blinnPhong(glm::vec3(0.8f), glm::vec3(0.04f), 30.0f));
            lighting::Probe& probe = world.probe("room", {0, 1.25, 0}, {4.3, 2.8, 6.3}, 0.1);
            probe.exterior = false;
            const scene::Scene scene = world.make();
            auto renderer = rendererOf(scene);
            renderer->setLights(bareSun(glm::normalize(axis), visibility));
            const auto lit = [&](const glm::vec3& eye, const glm::vec3& target) {
                return greatest(
                    frameOf(*renderer, testing::lookAt(scene, eye, target), small(64)).radiance);
            };
            const float outside = lit({7, 6, 7}, {0, 1, 0});
            EXPECT_GT(outside, 0.5f);
            EXPECT_LT(lit({0, 1.4f, 2.5f}, {0.2f, 1.0f, -2}), 0.01f * outside) << visibility;
            EXPECT_LT(lit({0, 1.4f, -2.5f}, {0.2f, 1.5f, 2}), 0.01f * outside) << visibility;
        }
    }
}

// A lamp in a room: the walls are lit by the picture of the walls, which the lamp lights.
TEST_F(Probes, ARoomIsLitByItsLamp) {
    ProbeWorld world;
    world.room({-2, 0, -3}, {2, 2.5f, 3}, 0.3f, blinnPhong(glm::vec3(0.5f), glm::vec3(0.0f), 0.0f));
    world.box("lamp", {-0.5f, 2.4f, -0.5f}, {0.5f, 2.5f, 0.5f}, glowing(glm::vec3(10.0f)));
    lighting::Probe& probe = world.probe("room", {0, 1.25, 0}, {4.3, 2.8, 6.3}, 0.1);
    probe.exterior = false;
    const scene::Scene scene = world.make();
    auto renderer = rendererOf(scene);
    renderer->setEnvironment("black", testing::constantSky(0.0));
    const scene::View down = testing::lookAt(scene, {0, 1.4f, 2.5f}, {0.0f, 0.0f, 0.5f}, 0.3f);
    const scene::Frame frame = frameOf(*renderer, down, small(16));
    // A square of 1 m at 1.15 m above the probe, about a normal that points at it: with a = .5 and
    // h = 1.15, E / pi = (4 / pi) (a / d) atan(a / d), d^2 = a^2 + h^2; k_L is a half.
    const double d = std::sqrt(0.25 + 1.15 * 1.15);
    const double expected = 0.5 * 10.0 * 4.0 / std::acos(-1.0) * (0.5 / d) * std::atan(0.5 / d);
    const float middle = frame.radiance.at(8, 8)[0];
    // Order 2 of the harmonics and texels of 3 degrees: a few per cent.
    EXPECT_NEAR(middle, expected, 0.06 * expected);
}

TEST_F(Probes, WhatStandsStillCostsNothing) {
    ProbeWorld world;
    world.ball("ball", {0, 0, 0}, 1.0f, blinnPhong(glm::vec3(0.5f), glm::vec3(0.2f), 60.0f));
    world.box("ground", {-5, -2, -5}, {5, -1, 5},
              blinnPhong(glm::vec3(0.5f), glm::vec3(0.04f), 10.0f));
    world.probe("here", {0, 1.5, 0}, {6, 6, 6}, 1.0);
    for (int i = 0; i < 1000; ++i) {
        world.probe("idle", {100.0 + i, 0, 0}, {1, 1, 1}, 0.1);
    }
    const scene::Scene scene = world.make();
    auto renderer = rendererOf(scene);
    renderer->setEnvironment("gradient",
                             lighting::cubeFromAnalytic(lighting::GradientEnvironment{}, 32));
    const scene::View view = testing::lookAt(scene, {0, 1, 5}, {0, 0, 0});
    const scene::Frame first = frameOf(*renderer, view, small(48));
    EXPECT_EQ(first.counters.probeFaces, 6u);
    const gl::WorkCounters second = frameOf(*renderer, view, small(48)).counters;
    EXPECT_EQ(second.probeFaces, 0u);
    EXPECT_EQ(second.passes, 1u);
    EXPECT_EQ(second.uploads, 0u);
    EXPECT_EQ(second.shaderCompilations, 0u);
}

} // namespace
} // namespace lodestar

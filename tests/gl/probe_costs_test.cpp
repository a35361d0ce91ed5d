// SPDX-License-Identifier: MIT
//
// What light probes cost when light changes: as much as is foreseen, and nothing where a factor
// tells all.
#include <variant>

#include <glm/geometric.hpp>

#include "lighting/environment.h"
#include "scene/renderer.h"
#include "support/gl_fixture.h"
#include "support/probe_world.h"

namespace lodestar {
namespace {

using testing::blinnPhong;
using testing::ProbeWorld;

class ProbeCosts : public testing::ProbeTest {};

/// A closed room with a lamp, lit by its probe alone.
ProbeWorld room() {
    ProbeWorld world;
    world.room({-2, 0, -3}, {2, 2.5f, 3}, 0.3f, blinnPhong(glm::vec3(0.5f), glm::vec3(0.1f), 9.0f));
    world.box("lamp", {-0.5f, 2.4f, -0.5f}, {0.5f, 2.5f, 0.5f},
              testing::glowing(glm::vec3(10.0f, 7.0f, 3.0f)));
    lighting::Probe& probe = world.probe("room", {0, 1.25, 0}, {4.3, 2.8, 6.3}, 0.1);
    probe.exterior = false;
    return world;
}

lighting::Probe& probeOf(scene::Scene& scene) {
    return std::get<scene::ProbeComponent>(scene.nodes.back().components.back()).probe;
}

// A probe's tint and intensity are factors of what is looked up: a block of uniforms, no face, no
// pass, no texel. Twos are powers of two, so that each pixel is doubled to the last bit.
TEST_F(ProbeCosts, ItsOwnTintAndIntensityAreFactorsAlone) {
    scene::Scene scene = room().make();
    auto renderer = rendererOf(scene);
    renderer->setEnvironment("black", testing::constantSky(0.0));
    const scene::View view = testing::lookAt(scene, {0, 1.2f, 2.5f}, {0.2f, 0.4f, -2});
    const core::Image before = frameOf(*renderer, view, small(32)).radiance;
    const gl::WorkCounters still = frameOf(*renderer, view, small(32)).counters;
    probeOf(scene).intensity *= 2.0;
    probeOf(scene).tint *= glm::dvec3(2.0, 1.0, 0.5);
    const scene::Frame after = frameOf(*renderer, view, small(32));
    EXPECT_EQ(after.counters.probeFaces, 0u);
    EXPECT_EQ(after.counters.passes, still.passes);
    EXPECT_EQ(after.counters.draws, still.draws);
    EXPECT_EQ(after.counters.texelsWritten, still.texelsWritten);
    EXPECT_EQ(after.counters.uploads, still.uploads + 1);
    EXPECT_TRUE(after.plan->probeWork.empty());
    int lit = 0;
    for (std::size_t i = 0; i < before.pixels().size(); i += 4) {
        const float factors[] = {4.0f, 2.0f, 1.0f};
        for (std::size_t c = 0; c < 3; ++c) {
            ASSERT_EQ(after.radiance.pixels()[i + c], factors[c] * before.pixels()[i + c]) << i;
        }
        lit += before.pixels()[i] > 0.01f ? 1 : 0;
    }
    EXPECT_EQ(lit, 32 * 32);
}

/// A sky that fades and a bare sun that does not.
std::vector<lighting::DayLight> evening() {
    const auto light = [](lighting::LightKind kind, lighting::Gradient first,
                          lighting::Gradient last) {
        lighting::DayLight made;
        made.name = kind == lighting::LightKind::Sky ? "sky" : "sun";
        made.kind = kind;
        made.visibility = false;
        made.axis = glm::dvec3(0.3, 1, 0.2);
        made.keys = {{16.0, std::move(first), glm::dvec3(1.0), {}},
                     {21.0, std::move(last), glm::dvec3(1.0), {}}};
        core::Tally warnings;
        return *lighting::repaired(made, warnings);
    };
    const lighting::Gradient disc{
        {{0, glm::dvec3(100.0), 0}, {1, glm::dvec3(100.0), 0}, {1, {}, 0}}};
    return {light(lighting::LightKind::Sky,
                  lighting::Gradient{{{90, {0.2, 0.4, 0.9}, 0}, {-90, {0.2, 0.2, 0.2}, 0}}},
                  lighting::Gradient{{{90, {0.1, 0.1, 0.2}, 0}, {-90, {0.05, 0.05, 0.05}, 0}}}),
            light(lighting::LightKind::Sun, disc, disc)};
}

// Under a sky that changes, light is composed and filtered again and no face is drawn: each effect
// of the plan is what the counters say, calls, passes and texels, the picture's own pass besides.
TEST_F(ProbeCosts, WhatIsForeseenIsWhatIsWritten) {
    for (const int resolution : {64, 33, 5, 1}) {
        ProbeWorld world;
        world.ball("matt", {-0.5f, 0, 0}, 0.5f, blinnPhong(glm::vec3(0.5f), glm::vec3(0.0f), 0.0f));
        world.ball("glossy", {0.5f, 0, 0}, 0.5f,
                   blinnPhong(glm::vec3(0.0f), glm::vec3(0.5f), 20.0f));
        world.probe("here", {0, 1.5, 0}, {6, 6, 6}, 0.5).capture.resolution = resolution;
        const scene::Scene scene = world.make();
        auto renderer = rendererOf(scene);
        renderer->setLights(evening());
        const scene::View view = testing::lookAt(scene, {0, 0, 4}, {0, 0, 0});
        scene::RenderSettings settings = small(32);
        settings.lightThreshold = 1e9;
        settings.hour = 17.0;
        EXPECT_EQ(frameOf(*renderer, view, settings).counters.probeFaces, 6u);
        settings.hour = 18.0;
        const scene::Frame frame = frameOf(*renderer, view, settings);
        plan::Cost foreseen;
        bool irradiance = false;
        for (const plan::Effect& effect : frame.plan->effects) {
            foreseen.passes += effect.cost.passes;
            foreseen.draws += effect.cost.draws;
            foreseen.texelsWritten += effect.cost.texelsWritten;
            irradiance = irradiance || effect.effect == "probe-irradiance";
        }
        EXPECT_TRUE(irradiance);
        EXPECT_EQ(frame.counters.probeFaces, 0u);
        EXPECT_EQ(frame.counters.passes, foreseen.passes + 1) << resolution;
        EXPECT_EQ(frame.counters.draws, foreseen.draws) << resolution;
        EXPECT_EQ(frame.counters.texelsWritten, foreseen.texelsWritten + 32 * 32) << resolution;
    }
}

// Maps of one mean are not one map: what is composed is composed again when the other comes.
TEST_F(ProbeCosts, AnotherEnvironmentOfTheSameMeanIsComposed) {
    ProbeWorld world;
    world.ball("ball", {0, 0, 0}, 0.5f, blinnPhong(glm::vec3(0.5f), glm::vec3(0.1f), 20.0f), 2);
    world.probe("here", {0, 1.5, 0}, {6, 6, 6}, 0.5).capture.layers = 1;
    const scene::Scene scene = world.make();
    auto renderer = rendererOf(scene);
    const scene::View view = testing::lookAt(scene, {0, 0, 4}, {0, 0, 0});
    lighting::Cubemap cube = testing::constantSky(1.0);
    for (const int bright : {0, 1}) { // +X, then -X
        for (int face = 0; face < 2; ++face) {
            for (int i = 0; i < 16 * 16; ++i) {
                cube.texel(face, i % 16, i / 16) = glm::vec4(glm::vec3(face == bright), 1.0f);
            }
        }
        renderer->setEnvironment("two", cube);
        frameOf(*renderer, view, small(16));
        EXPECT_EQ(renderer->readProbe(0, bright).at(8, 8)[0], 1.0f);
        EXPECT_EQ(renderer->readProbe(0, 1 - bright).at(8, 8)[0], 0.0f);
    }
}

} // namespace
} // namespace lodestar

// SPDX-License-Identifier: MIT
//
// Light probes while the world goes on: budgets, skies composed anew, bounces, walks, and that
// nothing is gained or lost over many frames.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <unistd.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

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

class ProbeMotion : public testing::ProbeTest {};

std::size_t nodeNamed(const scene::Scene& scene, const std::string& name) {
    const auto at = std::find_if(scene.nodes.begin(), scene.nodes.end(),
                                 [&](const scene::Node& node) { return node.name == name; });
    return static_cast<std::size_t>(at - scene.nodes.begin());
}

void moveTo(scene::Scene& scene, std::size_t node, const glm::vec3& to) {
    scene.nodes[node].parentFromNode[3] = glm::vec4(to, 1.0f);
    scene::updateTransforms(scene);
}

double mean(const core::Image& image) {
    double sum = 0.0;
    for (std::size_t i = 0; i < image.pixels().size(); i += 4) {
        sum +=
            static_cast<double>(image.pixels()[i] + image.pixels()[i + 1] + image.pixels()[i + 2]);
    }
    return sum / 3.0 / (static_cast<double>(image.pixels().size()) / 4.0);
}

/// A yard of walls, open above, with a ball and a column. @param reflectance 0: takes no light
ProbeWorld yard(float reflectance) {
    ProbeWorld world;
    io::GltfMaterial stone = blinnPhong(glm::vec3(reflectance), glm::vec3(0.0f), 0.0f);
    io::GltfMaterial metal = blinnPhong(glm::vec3(0.5f), glm::vec3(0.5f), 40.0f);
    for (io::GltfMaterial* material : {&stone, &metal}) {
        material->unlit = reflectance == 0.0f;
        material->baseColor = glm::vec4(glm::vec3(reflectance), 1.0f);
    }
    world.box("ground", {-6, -0.2f, -6}, {6, 0, 6}, stone);
    world.box("east", {5.5f, 0, -6}, {6, 4, 6}, stone);
    world.box("west", {-6, 0, -6}, {-5.5f, 3, 6}, stone);
    world.box("north", {-6, 0, -6}, {6, 5, -5.5f}, stone);
    world.box("column", {2, 0, -2}, {2.6f, 4, -1.4f}, stone);
    world.ball("ball", {0, 1, 0}, 0.7f, metal);
    return world;
}

lighting::DayLight dusk() {
    lighting::DayLight sky;
    sky.name = "sky";
    const lighting::Gradient day{{{90, {0.2, 0.4, 0.9}, 0},
                                  {10, {0.7, 0.8, 0.9}, 0},
                                  {0, {0.5, 0.5, 0.5}, 0},
                                  {-90, {0.2, 0.2, 0.2}, 0}}};
    const lighting::Gradient night{{{90, {0.02, 0.02, 0.08}, 0},
                                    {10, {0.3, 0.1, 0.05}, 0},
                                    {0, {0.1, 0.05, 0.05}, 0},
                                    {-90, {0.01, 0.01, 0.01}, 0}}};
    sky.keys = {{16.0, day, glm::dvec3(1.0), {}}, {21.0, night, glm::dvec3(1.0), {}}};
    core::Tally warnings;
    return *lighting::repaired(sky, warnings);
}

// What a camera with a backdrop sees from the probe is what the probe composes: without bounce, at
// any hour, though nothing is drawn again.
TEST_F(ProbeMotion, AComposedSkyIsWhatACameraSees) {
    ProbeWorld world = yard(0.0f);
    // Something that takes light, inside the view and under the ground.
    world.ball("witness", {0, -0.6f, 0}, 0.1f, blinnPhong(glm::vec3(0.5f), glm::vec3(0.1f), 30.0f),
               2);
    lighting::Probe& probe = world.probe("yard", {0, 2.2, 2.5}, {12, 8, 12}, 0.5);
    probe.capture.resolution = 64;
    probe.capture.layers = 1;
    const scene::Scene scene = world.make();
    auto renderer = rendererOf(scene);
    renderer->setLights({dusk()});
    const scene::View view = testing::lookAt(scene, {3, 3, 5}, {0, 1, 0});
    scene::RenderSettings settings = small(32);
    settings.hour = 16.0;
    EXPECT_EQ(frameOf(*renderer, view, settings).counters.probeFaces, 6u);
    plan::ProbeView place;
    place.position = glm::vec3(0, 2.2f, 2.5f);
    for (const double hour : {17.0, 18.5, 20.0}) {
        settings.hour = hour;
        settings.lightThreshold = 1e9;
        EXPECT_EQ(frameOf(*renderer, view, settings).counters.probeFaces, 0u) << hour;
        double worst = 0.0, sum = 0.0, all = 0.0;
        int compared = 0;
        for (int face = 0; face < 6; ++face) {
            const core::Image composed = renderer->readProbe(0, face);
            scene::View camera;
            const scene::FaceView seen = scene::faceView(place, face);
            camera.clipFromCamera = seen.clipFromWorld;
            camera.position = seen.position;
            scene::RenderSettings full = settings;
            full.width = full.height = 64;
            full.backdrop = true;
            auto truth = renderer->render(camera, full);
            ASSERT_TRUE(truth.ok());
            for (int y = 1; y < 63; ++y) {
                for (int x = 1; x < 63; ++x) {
                    // A picture's first row is its top, a face's is its bottom in clip space.
                    const auto at = [&](int i, int j) { return truth->radiance.at(i, 63 - j); };
                    bool edge = false; // of geometry: black beside the sky
                    for (int k = 0; k < 9; ++k) {
                        edge = edge || (at(x + k % 3 - 1, y + k / 3 - 1)[2] == 0.0f) !=
                                           (at(x, y)[2] == 0.0f);
                    }
                    const double want = static_cast<double>(at(x, y)[2]);
                    all += want;
                    if (!edge) {
                        const double off =
                            std::abs(static_cast<double>(composed.at(x, y)[2]) - want);
                        worst = std::max(worst, off);
                        sum += off;
                        ++compared;
                    }
                }
            }
        }
        const double average = all / (6 * 62 * 62);
        std::printf("%.1f h: mean off %.5f, worst %.5f of the mean %.4f\n", hour,
                    sum / compared / average, worst / average, average);
        EXPECT_LT(sum / compared, 0.005 * average);
        EXPECT_LT(worst, 0.02 * average);
        EXPECT_GT(compared, 15000);
    }
}

/// All texels of what a probe lights with.
std::vector<double> lightOf(const scene::Renderer& renderer) {
    std::vector<double> all;
    for (int face = 0; face < 6; ++face) {
        const core::Image image = renderer.readProbe(0, face);
        for (std::size_t i = 0; i < image.pixels().size(); ++i) {
            if (i % 4 < 3) {
                all.push_back(static_cast<double>(image.pixels()[i]));
            }
        }
    }
    return all;
}

// Dusk with walls that bounce light: composed skies, and bounces captured again beyond the
// threshold, against a capture at each hour. What is kept is off by at most the threshold of what
// bounces, over the part that is left of it.
TEST_F(ProbeMotion, TheThresholdKeepsItsPromise) {
    ProbeWorld world = yard(0.6f);
    lighting::Probe& probe = world.probe("yard", {0, 2.2, 2.5}, {12, 8, 12}, 0.5);
    probe.capture.resolution = 64;
    const scene::Scene scene = world.make();
    const scene::View view = testing::lookAt(scene, {3, 3, 5}, {0, 1, 0});
    for (const double threshold : {0.05, 0.1, 0.3, 1e9}) {
        auto kept = rendererOf(scene);
        kept->setLights({dusk()});
        auto fresh = rendererOf(scene);
        fresh->setLights({dusk()});
        scene::RenderSettings settings = small(8);
        double worst = 0.0;
        std::uint64_t faces = 0;
        for (double hour = 16.0; hour <= 20.0; hour += 0.2) {
            settings.hour = hour;
            settings.lightThreshold = threshold;
            faces += frameOf(*kept, view, settings).counters.probeFaces;
            fresh->requestProbe(0);
            EXPECT_EQ(frameOf(*fresh, view, settings).counters.probeFaces, 6u);
            const std::vector<double> a = lightOf(*kept), b = lightOf(*fresh);
            double off = 0.0, sum = 0.0;
            for (std::size_t i = 0; i < a.size(); ++i) {
                off += std::abs(a[i] - b[i]);
                sum += b[i];
            }
            worst = std::max(worst, off / sum);
        }
        std::printf("threshold %g: %.4f of the mean at most, %d faces of 126\n", threshold, worst,
                    static_cast<int>(faces));
        if (threshold < 1.0) {
            EXPECT_LT(worst, threshold / (1.0 - threshold));
        } else {
            EXPECT_GT(worst, 0.1); // what is never captured again goes wrong
        }
    }
}

TEST_F(ProbeMotion, NothingIsLitByItself) {
    ProbeWorld world;
    world.room({-2, 0, -2}, {2, 3, 2}, 0.3f, blinnPhong(glm::vec3(1.0f), glm::vec3(0.0f), 0.0f));
    lighting::Probe& probe = world.probe("room", {0, 1.5, 0}, {4.3, 3.3, 4.3}, 0.1);
    probe.exterior = false;
    probe.update = lighting::ProbeUpdate::Always;
    const scene::Scene scene = world.make();
    auto renderer = rendererOf(scene);
    renderer->setEnvironment("white", testing::constantSky(1.0));
    const scene::View view = testing::lookAt(scene, {0, 1.5f, 1.5f}, {0, 1, -1});
    for (int i = 0; i < 20; ++i) {
        const scene::Frame frame = frameOf(*renderer, view, small(16));
        EXPECT_EQ(frame.counters.probeFaces, 6u);
        EXPECT_LT(mean(frame.radiance), 1e-3) << i;
    }
}

// Two probes see each other's walls: light goes to and fro, and each way it loses what the walls
// take.
TEST_F(ProbeMotion, BouncesConverge) {
    ProbeWorld world;
    world.room({-4, 0, -2}, {4, 3, 2}, 0.3f, blinnPhong(glm::vec3(0.8f), glm::vec3(0.0f), 0.0f));
    world.box("lamp", {-3, 2.9f, -0.5f}, {-2, 3, 0.5f}, glowing(glm::vec3(20.0f)));
    for (const double x : {-2.0, 2.0}) {
        lighting::Probe& probe =
            world.probe(x < 0 ? "left" : "right", {x, 1.5, 0}, {4.3, 3.3, 4.3}, 0.5);
        probe.exterior = false;
        probe.update = lighting::ProbeUpdate::Always;
    }
    const scene::Scene scene = world.make();
    auto renderer = rendererOf(scene);
    renderer->setEnvironment("black", testing::constantSky(0.0));
    const scene::View view = testing::lookAt(scene, {3, 1.5f, 1.5f}, {-3, 1, -1}, 1.2f);
    std::vector<double> brightness;
    for (int i = 0; i < 14; ++i) {
        brightness.push_back(mean(frameOf(*renderer, view, small(24)).radiance));
    }
    for (std::size_t i = 3; i + 1 < brightness.size(); ++i) {
        const double before = brightness[i] - brightness[i - 1];
        const double after = brightness[i + 1] - brightness[i];
        // A bounce returns at most what the walls reflect, and what half floats round.
        EXPECT_LE(std::abs(after), 0.8 * std::abs(before) + 1e-3 * brightness[i]) << i;
    }
    EXPECT_GT(brightness.back(), brightness.front());
}

TEST_F(ProbeMotion, AMovingThingDirtiesOnlyTheFacesThatSeeIt) {
    ProbeWorld world = yard(0.5f);
    world.box("lift", {-0.3f, 1.5f, -4}, {0.3f, 2.5f, -3.6f},
              blinnPhong(glm::vec3(0.9f), glm::vec3(0.0f), 0.0f));
    world.probe("yard", {0, 2.2, 2.5}, {12, 8, 12}, 0.5);
    scene::Scene scene = world.make();
    auto renderer = rendererOf(scene);
    renderer->setEnvironment("grey", testing::constantSky(0.4));
    const scene::View view = testing::lookAt(scene, {3, 3, 5}, {0, 1, 0});
    frameOf(*renderer, view, small(32));
    const std::size_t lift = nodeNamed(scene, "lift");
    moveTo(scene, lift, glm::vec3(0, 2.4f, -3.8f));
    const scene::Frame frame = frameOf(*renderer, view, small(32));
    EXPECT_EQ(frame.counters.probeFaces, 1u); // -Z alone
    ASSERT_EQ(frame.plan->probeFaces.size(), 1u);
    EXPECT_EQ(frame.plan->probeFaces[0].face, 5);
    EXPECT_NE(plan::planText(*frame.plan).find("Probe 'yard': 1 of 6 faces: lift"),
              std::string::npos)
        << plan::planText(*frame.plan);
}

TEST_F(ProbeMotion, TheBudgetHoldsForTwoThousandFrames) {
    ProbeWorld world = yard(0.5f);
    world.ball("moving", {0, 1, 3}, 0.4f, blinnPhong(glm::vec3(0.9f), glm::vec3(0.1f), 20.0f));
    for (int i = 0; i < 4; ++i) {
        lighting::Probe& probe =
            world.probe("probe " + std::to_string(i), {-3.0 + 2 * i, 1.5, 2}, {5, 6, 9}, 1.0);
        probe.capture.resolution = 16;
        probe.update = i % 2 == 0 ? lighting::ProbeUpdate::Always : lighting::ProbeUpdate::OnChange;
    }
    scene::Scene scene = world.make();
    auto renderer = rendererOf(scene);
    renderer->setEnvironment("grey", testing::constantSky(0.4));
    const scene::View view = testing::lookAt(scene, {3, 3, 5}, {0, 1, 0});
    const std::size_t moving = nodeNamed(scene, "moving");
    scene::RenderSettings settings = small(16);
    std::uint64_t drawn = 0;
    for (int i = 0; i < 2000; ++i) {
        settings.faceBudget = 1 + i % 3;
        moveTo(scene, moving, {3.0f * std::sin(0.05f * static_cast<float>(i)), 1.0f, 3.0f});
        const scene::Frame frame = frameOf(*renderer, view, settings);
        ASSERT_LE(frame.counters.probeFaces, static_cast<std::uint64_t>(settings.faceBudget)) << i;
        drawn += frame.counters.probeFaces;
    }
    EXPECT_GT(drawn, 3900u); // two that always want more: nothing of the budget is left
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_TRUE(renderer->isProbeReady(i)) << i;
    }
}

// What a face takes is measured as it is drawn: one a frame while nothing is known, then as many as
// the milliseconds let through, and never less than one.
TEST_F(ProbeMotion, MillisecondsAreMeasuredAsFacesAreDrawn) {
    ProbeWorld world = yard(0.5f);
    lighting::Probe& probe = world.probe("probe", {0, 1.5, 0}, {12, 6, 12}, 1.0);
    probe.capture.resolution = 16;
    probe.update = lighting::ProbeUpdate::Always;
    const scene::Scene scene = world.make();
    const auto renderer = rendererOf(scene);
    renderer->setEnvironment("grey", testing::constantSky(0.4));
    const scene::View view = testing::lookAt(scene, {3, 3, 5}, {0, 1, 0});
    scene::RenderSettings settings = small(16);
    settings.probeBudgetMs = 1e6;
    EXPECT_EQ(frameOf(*renderer, view, settings).counters.probeFaces, 1u);
    std::uint64_t most = 0;
    for (int i = 0; i < 30; ++i) {
        most = std::max(most, frameOf(*renderer, view, settings).counters.probeFaces);
    }
    EXPECT_EQ(most, 6u);
    settings.probeBudgetMs = 0.0;
    for (int i = 0; i < 12; ++i) {
        EXPECT_EQ(frameOf(*renderer, view, settings).counters.probeFaces, 1u) << i;
    }
}

std::size_t residentKilobytes() {
    std::ifstream file("/proc/self/statm");
    std::size_t total = 0, resident = 0;
    file >> total >> resident;
    return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) / 1024;
}

TEST_F(ProbeMotion, TenThousandUpdatesGainNothing) {
    ProbeWorld world;
    world.ball("ball", {0, 0, 0}, 1.0f, blinnPhong(glm::vec3(0.5f), glm::vec3(0.2f), 60.0f));
    lighting::Probe& probe = world.probe("here", {0, 1.5, 0}, {6, 6, 6}, 1.0);
    probe.capture.resolution = 8;
    probe.update = lighting::ProbeUpdate::Always;
    const scene::Scene scene = world.make();
    auto renderer = rendererOf(scene);
    renderer->setEnvironment("grey", testing::constantSky(0.4));
    const scene::View view = testing::lookAt(scene, {0, 1, 5}, {0, 0, 0});
    std::size_t before = 0;
    std::uint64_t textures = 0;
    for (int i = 0; i < 10000; ++i) {
        const scene::Frame frame = frameOf(*renderer, view, small(4));
        ASSERT_EQ(frame.counters.probeFaces, 6u);
        if (i == 1000) {
            before = residentKilobytes();
            textures = frame.counters.textureBytes;
        }
        if (i == 9999) {
            EXPECT_EQ(frame.counters.textureBytes, textures);
        }
    }
    // A leak of a name or a plan a frame would be 9 MB and more.
    EXPECT_LT(residentKilobytes(), before + 2048);
}

} // namespace
} // namespace lodestar

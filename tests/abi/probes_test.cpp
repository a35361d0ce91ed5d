// SPDX-License-Identifier: MIT
//
// Light probes through the library: what a host is asked for, when what it drew lights, and by how
// much.
#include <algorithm>
#include <cmath>
#include <cstring>

#include <glm/gtc/packing.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x4.hpp>

#include "host.h"
#include "lodestar/cube.glsl"
#include "plan/probe_plan.h"
#include "probe_host.h"

namespace lodestar::testing {
namespace {

using AbiProbes = ProbeHost<AbiHost>;

TEST_F(AbiProbes, BadDescriptionsAreRefused) {
    LodestarProbe probe = 0;
    const auto refused = [&](const LodestarProbeDesc& desc, const char* where) {
        EXPECT_EQ(probes->probe_create(context, &desc, &probe), LODESTAR_E_ARG);
        EXPECT_NE(std::string(api.last_error(context)).find(where), std::string::npos)
            << api.last_error(context);
    };
    LodestarProbeDesc desc = probeDesc();
    desc.influence.shape = LODESTAR_VOLUME_NONE;
    refused(desc, "/influence/shape");
    desc = probeDesc();
    desc.influence.size[1] = 0.0;
    refused(desc, "/influence/size");
    desc = probeDesc();
    desc.influence.blend[5] = -1.0;
    refused(desc, "/influence/blend");
    desc = probeDesc();
    desc.proxy.shape = 7;
    refused(desc, "/proxy/shape");
    desc = probeDesc();
    desc.near_plane = 0.0;
    refused(desc, "/near_plane");
    desc = probeDesc();
    desc.width = 2049;
    refused(desc, "/width");
    desc = probeDesc();
    desc.update = LODESTAR_UPDATE_EVERY;
    refused(desc, "/every");
    desc = probeDesc();
    desc.update = 5;
    refused(desc, "/update");
    desc = probeDesc();
    desc.tint[2] = std::nan("");
    refused(desc, "/tint");
    desc = probeDesc();
    desc.intensity = -1.0;
    refused(desc, "/intensity");
    desc = probeDesc();
    desc.position[0] = HUGE_VAL;
    refused(desc, "/position");
    desc = probeDesc();
    desc.struct_size = 0;
    EXPECT_EQ(probes->probe_create(context, &desc, &probe), LODESTAR_E_ABI);
    EXPECT_EQ(probes->probe_create(context, &desc, nullptr), LODESTAR_E_ARG);
    const double identity[16] = {};
    EXPECT_EQ(probes->probe_move(context, 77, identity), LODESTAR_E_ARG);
    EXPECT_EQ(probes->probe_destroy(context, 77), LODESTAR_E_ARG);
    EXPECT_EQ(probes->probe_request(context, 77), LODESTAR_E_ARG);
    std::size_t count = 9;
    EXPECT_EQ(probes->probes(context, nullptr, &count), LODESTAR_MORE);
    EXPECT_EQ(count, 0u);
}

TEST_F(AbiProbes, BadBoxesAreRefused) {
    create(probeDesc());
    LodestarPlan plan = 0;
    boxes[0].low[1] = 2.0;
    EXPECT_EQ(place(), LODESTAR_E_ARG);
    boxes[0].low[1] = -0.5;
    boxes[0].high[1] = HUGE_VAL;
    EXPECT_EQ(place(), LODESTAR_E_ARG);
    boxes[0].high[1] = 0.5;
    addBox({0, 0, 0}, {1, 1, 1});
    boxes[1].id = boxes[0].id;
    EXPECT_EQ(place(), LODESTAR_E_ARG);
    boxes[1].id = 9;
    EXPECT_EQ(place(), LODESTAR_OK);
    LodestarDraw draw{};
    draw.struct_size = sizeof draw;
    draw.visible = 1;
    frame.draws = &draw;
    frame.draw_count = 1;
    frame.draw_stride = sizeof draw;
    EXPECT_EQ(api.plan_make(context, &frame, &plan), LODESTAR_E_ARG) << "two boxes, one draw";
    frame.draws = nullptr;
    EXPECT_EQ(api.plan_make(context, &frame, &plan), LODESTAR_OK) << "they were kept";
    EXPECT_EQ(jobs(plan).size(), 6u);
    EXPECT_EQ(api.plan_make(context, &frame, &plan), LODESTAR_OK);
    EXPECT_TRUE(jobs(plan).empty()) << "without boxes there are no probes";
}

// The budget spreads a round over plans; until it is whole, nothing of it shows.
TEST_F(AbiProbes, NothingIsHalfPublished) {
    const LodestarProbe probe = create(probeDesc());
    frame.max_faces = 4;
    const LodestarPlan first = planned();
    const auto four = jobs(first);
    ASSERT_EQ(four.size(), 4u);
    EXPECT_NE(text(first).find("Probe 'room': 4 of 6 faces: it shows nothing yet"),
              std::string::npos)
        << text(first);
    for (const LodestarProbeJob& job : four) {
        EXPECT_EQ(job.probe, probe);
        EXPECT_EQ(job.width, 16u);
        EXPECT_EQ(give(first, job, {1, 1, 1, 1}), LODESTAR_OK);
    }
    const LodestarPlan second = planned();
    const auto two = jobs(second);
    ASSERT_EQ(two.size(), 2u);
    EXPECT_EQ(give(second, two[0], {1, 1, 1, 1}), LODESTAR_OK);
    EXPECT_EQ(give(second, two[0], {1, 1, 1, 1}), LODESTAR_MORE) << "it came before";
    EXPECT_EQ(give(first, two[1], {1, 1, 1, 1}), LODESTAR_MORE) << "another plan's";
    const LodestarPlan third = planned();
    EXPECT_TRUE(jobs(third).empty());
    EXPECT_EQ(draws(third)[0].probe[0], 0u);
    EXPECT_EQ(cube(third, probe).version, 0u);
    EXPECT_NE(text(third).find("waits for faces that were asked for"), std::string::npos);
    EXPECT_EQ(give(second, two[1], {1, 1, 1, 1}), LODESTAR_OK);
    EXPECT_EQ(cube(third, probe).version, 0u) << "a plan is immutable";
    const LodestarPlan fourth = planned();
    EXPECT_EQ(draws(fourth)[0].probe[0], probe);
    EXPECT_EQ(draws(fourth)[0].dark[0], 0u);
    EXPECT_EQ(cube(fourth, probe).version, 1u);
    EXPECT_NE(text(fourth).find("Probe 'room': composed: its faces are published"),
              std::string::npos)
        << text(fourth);
    EXPECT_NE(draws(fourth)[0].features & LODESTAR_FEATURE_PROBE, 0u);
    // What stands still asks for nothing and makes nothing.
    const LodestarPlan fifth = planned();
    EXPECT_TRUE(jobs(fifth).empty());
    EXPECT_EQ(cube(fifth, probe).version, 1u);
    EXPECT_NE(text(fifth).find("nothing that it sees has changed"), std::string::npos);
}

TEST_F(AbiProbes, FacesThatNeverComeAreAskedForAgain) {
    create(probeDesc());
    const LodestarPlan first = planned();
    ASSERT_EQ(jobs(first).size(), 6u);
    for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(jobs(planned()).empty());
    }
    const LodestarPlan again = planned();
    const auto six = jobs(again);
    ASSERT_EQ(six.size(), 6u);
    EXPECT_EQ(give(first, six[0], {1, 1, 1, 1}), LODESTAR_MORE);
    for (const LodestarProbeJob& job : six) {
        EXPECT_EQ(give(again, job, {1, 1, 1, 1}), LODESTAR_OK);
    }
    EXPECT_NE(draws(planned())[0].probe[0], 0u);
}

// Only the faces that see what moved are drawn again, and what it shows stays till they are there.
TEST_F(AbiProbes, WhatMovesIsDrawnAgain) {
    const LodestarProbe probe = create(probeDesc());
    addBox({5, -0.5, -0.5}, {6, 0.5, 0.5});
    planAndDraw({1, 1, 1, 1});
    EXPECT_TRUE(jobs(planned()).empty());
    boxes[1].low[0] += 0.5;
    boxes[1].high[0] += 0.5;
    const LodestarPlan plan = planned();
    const auto one = jobs(plan);
    ASSERT_EQ(one.size(), 1u);
    EXPECT_EQ(one[0].face, 0);
    EXPECT_NE(text(plan).find("1 of 6 faces: draw 1 moved"), std::string::npos) << text(plan);
    // Seen from itself the face draws what is ahead; the probe is no light of its own faces.
    const auto seen = jobDraws(plan, 0, one[0].draw_count);
    ASSERT_EQ(seen.size(), 2u);
    for (const LodestarDrawProbes& draw : seen) {
        EXPECT_EQ(draw.probe[0], 0u);
    }
    EXPECT_EQ(draws(plan)[0].probe[0], probe);
    EXPECT_EQ(give(plan, one[0], {3, 3, 3, 1}), LODESTAR_OK);
    EXPECT_EQ(cube(planned(), probe).version, 2u);
    boxes[1].changed = 1;
    EXPECT_EQ(jobs(planned()).size(), 1u);
    boxes.pop_back();
    boxes[0].changed = 0;
    EXPECT_EQ(jobs(planned()).size(), 0u) << "the face is awaited, then drawn again";
}

// A capture draws what shares a layer with it and is not hidden.
TEST_F(AbiProbes, LayersKeepThingsOutOfFaces) {
    LodestarProbeDesc desc = probeDesc();
    desc.layers = 2;
    const LodestarProbe probe = create(desc);
    addBox({1, -0.5, -0.5}, {2, 0.5, 0.5});
    const auto asked = [&](std::uint32_t layers, std::uint32_t hidden) {
        boxes[1].layers = layers;
        boxes[1].hidden = hidden;
        EXPECT_EQ(probes->probe_request(context, probe), LODESTAR_OK);
        const LodestarPlan plan = planAndDraw({1, 1, 1, 1});
        const auto six = jobs(plan);
        EXPECT_EQ(six.size(), 6u);
        planned();                                   // the round is published
        return six.empty() ? 0u : six[0].draw_count; // +X
    };
    EXPECT_EQ(asked(0, 0), 2u) << "0 is all";
    EXPECT_EQ(asked(6, 0), 2u);
    EXPECT_EQ(asked(5, 0), 1u);
    EXPECT_EQ(asked(6, 1), 1u);
}

// The cameras of the six faces see the six directions of a cube as OpenGL has it.
TEST_F(AbiProbes, JobsSeeTheFaces) {
    LodestarProbeDesc desc = probeDesc();
    desc.position[1] = 0.25;
    desc.frame[0] = desc.frame[5] = desc.frame[10] = desc.frame[15] = 1.0;
    desc.frame[12] = 0.5;
    create(desc);
    const auto six = jobs(planned());
    ASSERT_EQ(six.size(), 6u);
    for (const LodestarProbeJob& job : six) {
        EXPECT_EQ(job.position[0], 0.5);
        EXPECT_EQ(job.position[1], 0.25);
        for (const glm::vec2 at : {glm::vec2(0, 0), glm::vec2(0.5f, -0.25f)}) {
            const glm::dvec3 world =
                glm::make_vec3(job.position) +
                3.0 * glm::dvec3(shader::lodestar_cubeDirection(job.face, at.x, at.y));
            const glm::dvec4 clip =
                glm::make_mat4(job.projection) * glm::make_mat4(job.view) * glm::dvec4(world, 1.0);
            EXPECT_NEAR(clip.x / clip.w, at.x, 1e-6);
            EXPECT_NEAR(clip.y / clip.w, at.y, 1e-6);
        }
    }
}

float firstHalf(const std::vector<std::uint8_t>& bytes, std::size_t channel) {
    std::uint16_t half = 0;
    std::memcpy(&half, bytes.data() + 2 * channel, sizeof half);
    return glm::unpackHalf1x16(half);
}

class AbiProbeLight : public AbiProbes {
protected:
    /// The largest distance of any texel, of any level, from a colour.
    double worst(LodestarPlan plan, LodestarProbe probe, int texels, const glm::dvec3& color) {
        const LodestarCube described = cube(plan, probe, texels);
        EXPECT_EQ(described.half_floats, 1u);
        double most = described.levels > 0 ? 0.0 : 1e9;
        for (std::uint32_t level = 0; level < described.levels; ++level) {
            std::size_t size = 0;
            EXPECT_EQ(
                probes->plan_probe_texels(context, plan, probe, texels, level, nullptr, &size),
                LODESTAR_MORE);
            const std::size_t width = std::max(described.width >> level, 1u);
            EXPECT_EQ(size, 6 * width * width * 8);
            std::vector<std::uint8_t> bytes(size);
            EXPECT_EQ(
                probes->plan_probe_texels(context, plan, probe, texels, level, bytes.data(), &size),
                LODESTAR_OK);
            for (std::size_t i = 0; i < size / 8; ++i) {
                for (std::size_t c = 0; c < 3; ++c) {
                    const double value =
                        static_cast<double>(firstHalf(bytes, 4 * i + c)) * described.scale;
                    most = std::max(most, std::abs(value - color[static_cast<int>(c)]));
                }
            }
        }
        return most;
    }
    /// How much of the first direction is covered.
    float covered(LodestarPlan plan, LodestarProbe probe) {
        std::size_t size = std::size_t{6} * 16 * 16 * 8;
        std::vector<std::uint8_t> bytes(size);
        EXPECT_EQ(probes->plan_probe_texels(context, plan, probe, LODESTAR_TEXELS_ENVIRONMENT, 0,
                                            bytes.data(), &size),
                  LODESTAR_OK);
        return firstHalf(bytes, 3);
    }
};

// Half covered by 0.25 under a sky of 2: everywhere 0.25 + 2 / 2, in all levels and the irradiance.
// Another sky is put behind it without a job.
TEST_F(AbiProbeLight, TheSkyStandsBehindWhatIsCovered) {
    setSky("constant:2,1,0.5");
    const LodestarProbe probe = create(probeDesc());
    planAndDraw({0.25f, 0.25f, 0.25f, 0.5f});
    LodestarPlan plan = planned();
    constexpr double kHalf = 2e-3; // steps of half floats, and the means of the mips
    const glm::dvec3 wanted(1.25, 0.75, 0.5);
    EXPECT_LT(worst(plan, probe, LODESTAR_TEXELS_ENVIRONMENT, wanted), kHalf);
    EXPECT_LT(worst(plan, probe, LODESTAR_TEXELS_IRRADIANCE, wanted), kHalf);
    EXPECT_EQ(cube(plan, probe, LODESTAR_TEXELS_IRRADIANCE).width, 17u);
    EXPECT_EQ(covered(plan, probe), 0.5f) << "what suns shine through";
    setSky("constant:2,1.05,0.5"); // too little for another capture
    plan = planned();
    EXPECT_TRUE(jobs(plan).empty());
    EXPECT_NE(text(plan).find("composed again: the sky has changed"), std::string::npos);
    EXPECT_LT(worst(plan, probe, LODESTAR_TEXELS_ENVIRONMENT, {1.25, 0.775, 0.5}), kHalf);
    // Twice as bright, what it lit has changed too: the faces are asked for.
    setSky("constant:4,2,1");
    EXPECT_EQ(jobs(planned()).size(), 6u);
}

// A painted sky is composed by its gradient; a sun is no part of a probe.
TEST_F(AbiProbeLight, SkiesAreBehindItAndSunsAreNot) {
    Sun sun;
    LodestarLight light = 0;
    ASSERT_EQ(api.light_create(context, &sun.desc, &light), LODESTAR_OK);
    sun.desc.kind = LODESTAR_SKY;
    sun.stops[0] = {90, {0.5, 0.25, 1}, 0};
    sun.stops[1] = {-90, {0.5, 0.25, 1}, 0};
    ASSERT_EQ(api.light_create(context, &sun.desc, &light), LODESTAR_OK);
    const LodestarProbe probe = create(probeDesc());
    planAndDraw({0, 0, 0, 0});
    EXPECT_LT(worst(planned(), probe, LODESTAR_TEXELS_ENVIRONMENT, {0.5, 0.25, 1}), 2e-3);
}

TEST_F(AbiProbeLight, ItHoldsAnEnvironmentsLight) {
    setSky("constant:1,1,1");
    LodestarEnvironmentDesc desc{};
    desc.struct_size = sizeof desc;
    desc.layout = LODESTAR_ANALYTIC;
    desc.analytic = "constant:3,2,1";
    desc.face_width = 8;
    LodestarEnvironment held = 0;
    ASSERT_EQ(api.environment_create(context, &desc, &held), LODESTAR_OK);
    const LodestarProbe probe = create(probeDesc());
    EXPECT_EQ(probes->probe_hold(context, probe, 99), LODESTAR_E_ARG);
    ASSERT_EQ(probes->probe_hold(context, probe, held), LODESTAR_OK);
    ASSERT_EQ(api.environment_destroy(context, held), LODESTAR_OK);
    const LodestarPlan plan = planned();
    EXPECT_TRUE(jobs(plan).empty());
    EXPECT_EQ(draws(plan)[0].probe[0], probe);
    EXPECT_EQ(cube(plan, probe).width, 8u);
    EXPECT_EQ(covered(plan, probe), 1.0f) << "no sun shines through a file's light";
    EXPECT_LT(worst(plan, probe, LODESTAR_TEXELS_ENVIRONMENT, {3, 2, 1}), 5e-3);
}

// A closed room keeps the sky out before anything of it has been drawn.
TEST_F(AbiProbes, AnInteriorIsDarkUntilItIsCaptured) {
    LodestarProbeDesc desc = probeDesc();
    desc.interior = 1;
    const LodestarProbe probe = create(desc);
    const LodestarPlan plan = planned();
    const LodestarDrawProbes draw = draws(plan)[0];
    EXPECT_EQ(draw.probe[0], probe);
    EXPECT_EQ(draw.dark[0], 1u);
    float uniforms[LODESTAR_PROBE_UNIFORMS][4];
    ASSERT_EQ(probes->plan_probe_uniforms(context, plan, &draw, &uniforms[0][0]), LODESTAR_OK);
    EXPECT_EQ(uniforms[3][0], 2.0f) << "half extents";
    EXPECT_EQ(uniforms[4][3], 1.0f) << "blends lie outside an interior";
    EXPECT_EQ(uniforms[11][0], 0.0f) << "it gives no light";
    EXPECT_EQ(uniforms[26][0], draw.factor[0]);
    EXPECT_EQ(uniforms[26][2], draw.open);
    // Its own faces keep it out as well.
    const auto six = jobs(plan);
    ASSERT_EQ(six.size(), 6u);
    const auto seen = jobDraws(plan, 0, six[0].draw_count);
    ASSERT_EQ(seen.size(), 1u);
    EXPECT_EQ(seen[0].probe[0], probe);
    EXPECT_EQ(seen[0].dark[0], 1u);
}

// What a draw is told is what the planner chooses, along a way through three volumes; it is
// continuous.
TEST_F(AbiProbes, ChoicesAreThePlanners) {
    std::vector<plan::ProbeView> views;
    std::vector<LodestarProbe> handles;
    for (const double x : {-3.0, 0.0, 3.0}) {
        LodestarProbeDesc desc = probeDesc(5.0);
        desc.position[0] = x;
        std::fill_n(desc.influence.blend, 6, 1.5);
        desc.update = LODESTAR_UPDATE_ONCE;
        handles.push_back(create(desc));
        lighting::ProbeVolume volume;
        volume.size = glm::dvec3(5.0);
        volume.blend.fill(1.5);
        plan::ProbeView view;
        glm::mat4 world(1.0f);
        world[3].x = static_cast<float>(x);
        view.influence = lighting::place(volume, world, false);
        views.push_back(view);
    }
    frame.max_faces = 18;
    for (const double x : {-3.0, 0.0, 3.0}) { // sees to it that all three are captured
        addBox({x - 0.1, -0.1, -0.1}, {x + 0.1, 0.1, 0.1});
    }
    planAndDraw({1, 1, 1, 1});
    const plan::ProbeIndex index(views);
    double before[2] = {-1.0, 0.0};
    LodestarProbe first = 0;
    for (double x = -6.0; x < 6.0; x += 0.05) {
        boxes[0].low[0] = x - 0.5;
        boxes[0].high[0] = x + 0.5;
        const LodestarDrawProbes told = draws(planned())[0];
        const plan::ProbeChoice wanted = index.choose(
            glm::vec3(static_cast<float>(boxes[0].low[0]), -0.5f, -0.5f),
            glm::vec3(static_cast<float>(boxes[0].high[0]), 0.5f, 0.5f), {true, true, true});
        for (std::size_t k = 0; k < 2; ++k) {
            EXPECT_EQ(told.probe[k],
                      wanted.probe[k] < 0 ? 0 : handles[static_cast<std::size_t>(wanted.probe[k])]);
            EXPECT_EQ(told.factor[k], wanted.factor[k]);
        }
        EXPECT_EQ(told.open, wanted.open);
        if (told.probe[0] == first && before[0] >= 0.0) {
            EXPECT_NEAR(told.factor[0], before[0], 0.35) << x;
        }
        first = told.probe[0];
        before[0] = static_cast<double>(told.factor[0]);
    }
}

constexpr const char* kDocument = R"({"lodestar": 1, "probes": [
    {"name": "hall", "position": [1, 2, 3], "capture": {"resolution": 32, "near": 0.1, "far": 50},
     "influence": {"shape": "box", "size": [8, 8, 8]}},
    {"name": "lift", "node": "cabin", "influence": {"shape": "sphere", "radius": 2}},
    {"name": "shop", "source": "constant:1,1,1", "influence": {"shape": "box", "size": [2, 2, 2]}}]})";

TEST_F(AbiProbes, ADocumentsProbes) {
    LodestarDocument document = 0;
    ASSERT_EQ(api.document_load(context, kDocument, std::strlen(kDocument), &document), LODESTAR_OK)
        << api.last_error(context);
    const LodestarProbe before = create(probeDesc());
    ASSERT_EQ(probes->document_probes(context, document), LODESTAR_OK);
    EXPECT_EQ(probes->probe_request(context, before), LODESTAR_E_ARG) << "they are replaced";
    std::vector<LodestarProbe> all(3);
    std::size_t count = 3;
    ASSERT_EQ(probes->probes(context, all.data(), &count), LODESTAR_OK);
    ASSERT_EQ(count, 3u);
    char name[32] = "";
    std::size_t size = sizeof name;
    EXPECT_EQ(probes->probe_node(context, all[0], name, &size), LODESTAR_OK);
    EXPECT_EQ(size, 0u);
    size = sizeof name;
    EXPECT_EQ(probes->probe_node(context, all[1], name, &size), LODESTAR_OK);
    EXPECT_STREQ(name, "cabin");
    size = sizeof name;
    EXPECT_EQ(probes->probe_source(context, all[2], name, &size), LODESTAR_OK);
    EXPECT_STREQ(name, "constant:1,1,1");
    addBox({0, 1, 2}, {2, 3, 4});
    frame.max_faces = 18;
    const auto asked = jobs(planned());
    ASSERT_EQ(asked.size(), 6u) << "the lift is nowhere, the shop holds nothing yet";
    EXPECT_EQ(asked[0].position[2], 3.0);
    EXPECT_EQ(asked[0].width, 32u);
    double frameOfNode[16] = {};
    frameOfNode[0] = frameOfNode[5] = frameOfNode[10] = frameOfNode[15] = 1.0;
    ASSERT_EQ(probes->probe_move(context, all[1], frameOfNode), LODESTAR_OK);
    EXPECT_EQ(jobs(planned()).size(), 6u) << "now it is";
}

} // namespace
} // namespace lodestar::testing

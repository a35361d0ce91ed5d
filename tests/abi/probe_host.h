// SPDX-License-Identifier: MIT
//
// A host of light probes in tests: it draws boxes that it never shows.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "lodestar/lodestar_probes.h"

namespace lodestar::testing {

inline LodestarProbeDesc probeDesc(double size = 4.0) {
    LodestarProbeDesc desc{};
    desc.struct_size = sizeof desc;
    desc.name = "room";
    desc.near_plane = 0.05;
    desc.far_plane = 100.0;
    desc.width = 16;
    desc.update = LODESTAR_UPDATE_ON_CHANGE;
    desc.tint[0] = desc.tint[1] = desc.tint[2] = desc.intensity = 1.0;
    desc.influence.shape = LODESTAR_VOLUME_BOX;
    for (int i = 0; i < 3; ++i) {
        desc.influence.size[i] = size;
    }
    return desc;
}

/// @tparam Base a fixture with a table and a context
template <class Base>
class ProbeHost : public Base {
protected:
    using Base::api;
    using Base::context;
    void SetUp() override {
        Base::SetUp();
        probes =
            static_cast<const LodestarProbesApi*>(api.get_extension(LODESTAR_EXTENSION_PROBES));
        ASSERT_NE(probes, nullptr);
        ASSERT_EQ(probes->struct_size, sizeof(LodestarProbesApi));
        frame.struct_size = sizeof frame;
        frame.hour = 12.0;
        frame.max_faces = 6;
        addBox({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
    }
    void setSky(const char* analytic) {
        LodestarEnvironmentDesc desc{};
        desc.struct_size = sizeof desc;
        desc.layout = LODESTAR_ANALYTIC;
        desc.analytic = analytic;
        desc.face_width = 16;
        LodestarEnvironment environment = 0;
        ASSERT_EQ(api.environment_create(context, &desc, &environment), LODESTAR_OK);
        ASSERT_EQ(api.set_environment(context, environment), LODESTAR_OK);
    }
    LodestarProbe create(const LodestarProbeDesc& desc) {
        LodestarProbe probe = 0;
        EXPECT_EQ(probes->probe_create(context, &desc, &probe), LODESTAR_OK)
            << api.last_error(context);
        return probe;
    }
    void addBox(const std::vector<double>& low, const std::vector<double>& high) {
        LodestarProbeDraw draw{};
        draw.struct_size = sizeof draw;
        draw.id = boxes.size() + 1;
        draw.share = 0.1;
        for (std::size_t i = 0; i < 3; ++i) {
            draw.low[i] = low[i];
            draw.high[i] = high[i];
        }
        boxes.push_back(draw);
    }
    LodestarStatus place() {
        LodestarProbeFrame placed{};
        placed.struct_size = sizeof placed;
        placed.draws = boxes.data();
        placed.draw_count = static_cast<std::uint32_t>(boxes.size());
        placed.draw_stride = sizeof boxes[0];
        return probes->frame_boxes(context, &placed);
    }
    LodestarPlan planned() {
        EXPECT_EQ(place(), LODESTAR_OK) << api.last_error(context);
        LodestarPlan plan = 0;
        EXPECT_EQ(api.plan_make(context, &frame, &plan), LODESTAR_OK) << api.last_error(context);
        return plan;
    }
    std::vector<LodestarProbeJob> jobs(LodestarPlan plan) {
        std::size_t count = 0;
        EXPECT_EQ(probes->plan_probe_jobs(context, plan, nullptr, &count), LODESTAR_MORE);
        std::vector<LodestarProbeJob> all(count);
        if (count > 0) {
            all[0].struct_size = sizeof all[0];
            EXPECT_EQ(probes->plan_probe_jobs(context, plan, all.data(), &count), LODESTAR_OK);
        }
        return all;
    }
    std::vector<LodestarDrawProbes> jobDraws(LodestarPlan plan, std::uint32_t job,
                                             std::size_t count) {
        std::vector<LodestarDrawProbes> draws(count);
        if (count > 0) {
            draws[0].struct_size = sizeof draws[0];
            EXPECT_EQ(probes->plan_job_draws(context, plan, job, draws.data(), &count),
                      LODESTAR_OK);
        }
        return draws;
    }
    std::vector<LodestarDrawProbes> draws(LodestarPlan plan) {
        std::vector<LodestarDrawProbes> all(boxes.size());
        std::size_t count = all.size();
        all[0].struct_size = sizeof all[0];
        EXPECT_EQ(probes->plan_draw_probes(context, plan, all.data(), &count), LODESTAR_OK);
        EXPECT_EQ(count, all.size());
        return all;
    }
    LodestarStatus give(LodestarPlan plan, const LodestarProbeJob& job,
                        const std::vector<float>& color) {
        std::vector<float> pixels;
        for (std::uint32_t i = 0; i < job.width * job.width; ++i) {
            pixels.insert(pixels.end(), color.begin(), color.end());
        }
        return probes->probe_face(context, plan, job.probe, job.face, pixels.data());
    }
    /// Plans, and gives all faces that are asked for.
    LodestarPlan planAndDraw(const std::vector<float>& color) {
        const LodestarPlan plan = planned();
        for (const LodestarProbeJob& job : jobs(plan)) {
            EXPECT_EQ(give(plan, job, color), LODESTAR_OK);
        }
        return plan;
    }
    std::string text(LodestarPlan plan) {
        std::size_t size = 0;
        EXPECT_EQ(api.plan_text(context, plan, nullptr, &size), LODESTAR_MORE);
        std::string words(size, '\0');
        EXPECT_EQ(api.plan_text(context, plan, words.data(), &size), LODESTAR_OK);
        return words;
    }
    LodestarCube cube(LodestarPlan plan, LodestarProbe probe,
                      int texels = LODESTAR_TEXELS_ENVIRONMENT) {
        LodestarCube cube{};
        cube.struct_size = sizeof cube;
        EXPECT_EQ(probes->plan_probe_cube(context, plan, probe, texels, &cube), LODESTAR_OK);
        return cube;
    }
    const LodestarProbesApi* probes = nullptr;
    std::vector<LodestarProbeDraw> boxes;
    LodestarFrame frame{};
};

} // namespace lodestar::testing

// SPDX-License-Identifier: MIT
//
// Plans through the library: what is decided, kept, and answered from any thread.
#include <atomic>
#include <cmath>
#include <cstring>
#include <thread>
#include <vector>

#include "host.h"

namespace lodestar::testing {
namespace {

class AbiPlan : public AbiHost {
protected:
    void SetUp() override {
        AbiHost::SetUp();
        LodestarEnvironmentDesc desc{};
        desc.struct_size = sizeof desc;
        desc.layout = LODESTAR_ANALYTIC;
        desc.analytic = "gradient:0,1";
        desc.face_width = 16;
        desc.name = "studio";
        ASSERT_EQ(api.environment_create(context, &desc, &environment), LODESTAR_OK);
        ASSERT_EQ(api.set_environment(context, environment), LODESTAR_OK);
        sun.desc.name = "sun";
        ASSERT_EQ(api.light_create(context, &sun.desc, &light), LODESTAR_OK);
        material.struct_size = sizeof material;
        material.given =
            LODESTAR_MATERIAL_DIFFUSE | LODESTAR_MATERIAL_F0 | LODESTAR_MATERIAL_EXPONENT;
        for (int i = 0; i < 3; ++i) {
            material.diffuse[i] = 0.5;
            material.f0[i] = 0.04;
        }
        material.exponent = 50.0;
        draw.struct_size = sizeof draw;
        draw.visible = 1;
        draw.name = "ball";
        draw.material = &material;
        frame.struct_size = sizeof frame;
        frame.hour = 12.0;
        frame.draws = &draw;
        frame.draw_count = 1;
        frame.draw_stride = sizeof draw;
    }
    LodestarPlan planned() {
        LodestarPlan plan = 0;
        EXPECT_EQ(api.plan_make(context, &frame, &plan), LODESTAR_OK) << api.last_error(context);
        return plan;
    }
    LodestarWork work(LodestarPlan plan) {
        LodestarWork work{};
        work.struct_size = sizeof work;
        EXPECT_EQ(api.plan_work(context, plan, &work), LODESTAR_OK);
        return work;
    }
    std::uint32_t feature(LodestarPlan plan) {
        std::uint32_t feature = 99;
        std::size_t count = 1;
        EXPECT_EQ(api.plan_features(context, plan, &feature, &count), LODESTAR_OK);
        return feature;
    }
    std::string text(LodestarPlan plan) {
        std::size_t size = 0;
        EXPECT_EQ(api.plan_text(context, plan, nullptr, &size), LODESTAR_MORE);
        std::string words(size, '\0');
        EXPECT_EQ(api.plan_text(context, plan, words.data(), &size), LODESTAR_OK);
        return words;
    }
    LodestarEnvironment environment = 0;
    LodestarLight light = 0;
    Sun sun;
    LodestarMaterial material{};
    LodestarDraw draw{};
    LodestarFrame frame{};
};

TEST_F(AbiPlan, AsksForWhatADrawCallsFor) {
    LodestarPlan plan = planned();
    EXPECT_EQ(feature(plan),
              static_cast<unsigned>(LODESTAR_FEATURE_ENVIRONMENT | LODESTAR_FEATURE_LIGHTS));
    EXPECT_EQ(work(plan).uploads, 3u + 6u * 5u + 6u) << "a light, five levels, irradiance";
    EXPECT_NE(text(plan).find("rsrm-blend 'sun': visible surfaces"), std::string::npos)
        << text(plan);
    // A frame later nothing is new.
    plan = planned();
    EXPECT_EQ(work(plan).uploads, 0u);
    EXPECT_EQ(work(plan).upload_bytes, 0u);
    // A mirror needs the gradients.
    material.exponent = HUGE_VAL;
    EXPECT_EQ(feature(planned()), 7u);
    // Unlit, and outside the view.
    draw.material = nullptr;
    EXPECT_EQ(feature(planned()), 0u);
    draw.material = &material;
    draw.visible = 0;
    plan = planned();
    EXPECT_EQ(feature(plan), 0u);
    EXPECT_NE(text(plan).find("nothing is visible"), std::string::npos);
    std::size_t count = 9;
    EXPECT_EQ(api.plan_lights(context, plan, nullptr, &count), LODESTAR_MORE);
    EXPECT_EQ(count, 0u);
}

TEST_F(AbiPlan, WhatIsNotSeenIsNotMade) {
    material.f0[0] = material.f0[1] = material.f0[2] = 0.0;
    material.exponent = 0.0;
    LodestarPlan plan = planned();
    EXPECT_EQ(work(plan).uploads, 3u + 6u) << "Lambert alone asks for irradiance alone";
    LodestarEnvironment of = 99;
    ASSERT_EQ(api.plan_environment(context, plan, LODESTAR_TEXELS_ENVIRONMENT, &of), LODESTAR_OK);
    EXPECT_EQ(of, 0u);
    ASSERT_EQ(api.plan_environment(context, plan, LODESTAR_TEXELS_IRRADIANCE, &of), LODESTAR_OK);
    EXPECT_EQ(of, environment);
    EXPECT_EQ(api.plan_environment(context, plan, LODESTAR_TEXELS_MAP, &of), LODESTAR_E_ARG);
    // A backdrop alone.
    draw.visible = 0;
    frame.backdrop = 1;
    plan = planned();
    ASSERT_EQ(api.plan_environment(context, plan, LODESTAR_TEXELS_ENVIRONMENT, &of), LODESTAR_OK);
    EXPECT_EQ(of, environment);
}

TEST_F(AbiPlan, UniformsSayTheFrame) {
    const LodestarPlan plan = planned();
    std::size_t size = 0;
    ASSERT_EQ(api.plan_uniforms(context, plan, nullptr, &size), LODESTAR_MORE);
    std::vector<float> data(size / sizeof(float));
    ASSERT_EQ(api.plan_uniforms(context, plan, data.data(), &size), LODESTAR_OK);
    const auto at = [&](const char* name, std::size_t component) {
        LodestarUniform info{};
        info.struct_size = sizeof info;
        for (std::uint32_t i = 0; api.uniform_info(i, &info) == LODESTAR_OK; ++i) {
            if (std::strcmp(info.name, name) == 0) {
                return data[info.offset / 4 + component];
            }
        }
        ADD_FAILURE() << name;
        return 0.0f;
    };
    EXPECT_EQ(at("lodestar_counts", 0), 1.0f);
    EXPECT_EQ(at("lodestar_counts", 1), 1.0f);
    EXPECT_EQ(at("lodestar_environmentCube", 0), 16.0f);
    EXPECT_EQ(at("lodestar_environmentCube", 1), 4.0f);
    EXPECT_EQ(at("lodestar_axes", 1), 1.0f) << "the sun stands overhead";
    EXPECT_EQ(at("lodestar_axes", 3), 0.0f);
    LodestarMapLayout layout{};
    layout.struct_size = sizeof layout;
    ASSERT_EQ(api.map_layout(&layout), LODESTAR_OK);
    EXPECT_EQ(at("lodestar_mapSize", 0), static_cast<float>(layout.columns));
    EXPECT_EQ(at("lodestar_mapRows", 0), layout.first_octave);
}

TEST_F(AbiPlan, BadFramesAreRefused) {
    LodestarPlan plan = 0;
    EXPECT_EQ(api.plan_make(context, nullptr, &plan), LODESTAR_E_ABI);
    EXPECT_EQ(api.plan_make(context, &frame, nullptr), LODESTAR_E_ARG);
    EXPECT_EQ(api.plan_make(nullptr, &frame, &plan), LODESTAR_E_ARG);
    frame.hour = std::nan("");
    EXPECT_EQ(api.plan_make(context, &frame, &plan), LODESTAR_E_ARG);
    frame.hour = 36.0;
    EXPECT_EQ(api.plan_make(context, &frame, &plan), LODESTAR_OK) << "wrapped";
    material.f0[1] = 2.0;
    EXPECT_EQ(api.plan_make(context, &frame, &plan), LODESTAR_E_ARG);
    EXPECT_NE(std::string(api.last_error(context)).find("/draws/0/material"), std::string::npos);
    material.f0[1] = 0.04;
    frame.draw_stride = 3;
    EXPECT_EQ(api.plan_make(context, &frame, &plan), LODESTAR_E_ARG);
    std::size_t size = 0;
    EXPECT_EQ(api.plan_text(context, 0, nullptr, &size), LODESTAR_E_ARG);
    EXPECT_EQ(api.plan_text(context, 1000, nullptr, &size), LODESTAR_E_ARG);
    EXPECT_EQ(api.plan_text(context, plan, nullptr, nullptr), LODESTAR_E_ARG);
    LodestarUniform info{};
    EXPECT_EQ(api.uniform_info(0, &info), LODESTAR_E_ABI);
    EXPECT_EQ(api.uniform_info(1000, &info), LODESTAR_E_ARG);
}

TEST_F(AbiPlan, TheLastFourAreKept) {
    const LodestarPlan first = planned();
    const std::string words = text(first);
    planned();
    planned();
    planned();
    EXPECT_EQ(text(first), words) << "a plan does not change";
    planned();
    std::size_t size = 0;
    EXPECT_EQ(api.plan_text(context, first, nullptr, &size), LODESTAR_E_ARG);
}

// A host of before has smaller structs in its arrays.
TEST_F(AbiPlan, ArraysAreOfTheHostsStructs) {
    struct Old {
        std::uint32_t struct_size, layer;
        LodestarLight light;
    };
    LodestarLight second = 0;
    ASSERT_EQ(api.light_create(context, &sun.desc, &second), LODESTAR_OK);
    const LodestarPlan plan = planned();
    Old lit[3] = {{sizeof(Old), 9, 9}, {0, 9, 9}, {77, 77, 77}};
    std::size_t count = 3;
    ASSERT_EQ(api.plan_lights(context, plan, reinterpret_cast<LodestarPlannedLight*>(lit), &count),
              LODESTAR_OK);
    EXPECT_EQ(count, 2u);
    EXPECT_EQ(lit[0].light, light);
    EXPECT_EQ(lit[1].light, second);
    EXPECT_EQ(lit[1].layer, 1u);
    EXPECT_EQ(lit[2].light, 77u);
    LodestarPlannedLight none[2]{};
    count = 2;
    EXPECT_EQ(api.plan_lights(context, plan, none, &count), LODESTAR_E_ABI);
}

// The main thread plans on while another reads what it planned.
TEST_F(AbiPlan, PlansAreReadOnAnyThread) {
    std::atomic<LodestarPlan> latest = planned();
    std::atomic<bool> done = false;
    std::atomic<int> read = 0;
    std::thread reader([&] {
        while (!done) {
            std::size_t size = 4096;
            std::vector<unsigned char> data(size);
            // Stale where four more were made meanwhile: that is a status too.
            const LodestarStatus status = api.plan_uniforms(context, latest, data.data(), &size);
            EXPECT_TRUE(status == LODESTAR_OK || status == LODESTAR_E_ARG);
            read += status == LODESTAR_OK ? 1 : 0;
        }
    });
    for (int i = 0; i < 200 || read < 50; ++i) {
        frame.hour = 0.1 * i;
        latest = planned();
        std::this_thread::yield();
    }
    done = true;
    reader.join();
    LodestarStatus status = LODESTAR_OK;
    std::thread([&] {
        LodestarPlan plan = 0;
        status = api.plan_make(context, &frame, &plan);
    }).join();
    EXPECT_EQ(status, LODESTAR_E_THREAD);
}

} // namespace
} // namespace lodestar::testing

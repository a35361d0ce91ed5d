// SPDX-License-Identifier: MIT
//
// The table's functions of plans, and what the shading text reads of them.
#include <array>
#include <cmath>
#include <cstddef>

#include "answers.h"

namespace lodestar::plugin {
namespace {

LodestarStatus make(LodestarContext* context, const LodestarFrame* frame,
                    LodestarPlan* plan) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        LodestarFrame given{};
        if (plan == nullptr) {
            return context->fail(LODESTAR_E_ARG, "no place for the plan");
        }
        if (!readStruct(frame, given)) {
            return context->fail(LODESTAR_E_ABI,
                                 "the frame's struct_size is none, or members are unknown");
        }
        if (!std::isfinite(given.hour)) {
            return context->fail(LODESTAR_E_ARG, "an hour is a finite number");
        }
        context->hour = lighting::wrappedHour(given.hour);
        auto packet = makePacket(*context, given);
        if (!packet) {
            return context->fail(LODESTAR_E_ARG, packet.error());
        }
        *plan = context->plans.add(std::move(*packet));
        return LODESTAR_OK;
    });
}

LodestarStatus text(LodestarContext* context, LodestarPlan plan, char* buffer,
                    size_t* size) noexcept {
    return answered(context, plan, size, [&](const Packet& packet) {
        const std::string words = plan::planText(packet.plan);
        return answerQuery(words.c_str(), words.size() + 1, 1, buffer, size);
    });
}

LodestarStatus lights(LodestarContext* context, LodestarPlan plan, LodestarPlannedLight* into,
                      size_t* count) noexcept {
    return answered(context, plan, count, [&](const Packet& packet) {
        std::vector<LodestarPlannedLight> shown;
        for (const Packet::Light& light : packet.lights) {
            shown.push_back(light.shown);
        }
        return answerStructs(shown, into, count);
    });
}

LodestarStatus jobs(LodestarContext* context, LodestarPlan plan, LodestarFaceJob* into,
                    size_t* count) noexcept {
    return answered(context, plan, count,
                    [&](const Packet& packet) { return answerStructs(packet.jobs, into, count); });
}

LodestarStatus features(LodestarContext* context, LodestarPlan plan, uint32_t* into,
                        size_t* count) noexcept {
    return answered(context, plan, count, [&](const Packet& packet) {
        return answerQuery(packet.features.data(), packet.features.size(), sizeof(uint32_t), into,
                           count);
    });
}

LodestarStatus environment(LodestarContext* context, LodestarPlan plan, int32_t texels,
                           LodestarEnvironment* into) noexcept {
    return answered(context, plan, into, [&](const Packet& packet) {
        if (texels != LODESTAR_TEXELS_ENVIRONMENT && texels != LODESTAR_TEXELS_IRRADIANCE) {
            return LODESTAR_E_ARG;
        }
        *into = texels == LODESTAR_TEXELS_IRRADIANCE ? packet.irradiance.of : packet.environment.of;
        return LODESTAR_OK;
    });
}

LodestarStatus uniforms(LodestarContext* context, LodestarPlan plan, void* buffer,
                        size_t* size) noexcept {
    return answered(context, plan, size, [&](const Packet& packet) {
        return answerQuery(&packet.uniforms, sizeof packet.uniforms, 1, buffer, size);
    });
}

LodestarStatus work(LodestarContext* context, LodestarPlan plan, LodestarWork* into) noexcept {
    return answered(context, plan, into, [&](const Packet& packet) {
        return writeStruct(packet.work, into) ? LODESTAR_OK : LODESTAR_E_ABI;
    });
}

using blocks::LodestarLighting;

constexpr LodestarUniform vec4At(const char* name, std::size_t offset, std::uint32_t count = 1) {
    return {sizeof(LodestarUniform),
            LODESTAR_UNIFORM_VEC4,
            name,
            count,
            static_cast<std::uint32_t>(offset),
            -1,
            0};
}

constexpr LodestarUniform sampler(const char* name, std::int32_t type, std::int32_t texels) {
    return {sizeof(LodestarUniform), type, name, 1, 0, texels, 0};
}

constexpr std::array kUniforms = {
    vec4At("lodestar_counts", offsetof(LodestarLighting, lodestar_counts)),
    vec4At("lodestar_environmentCube", offsetof(LodestarLighting, lodestar_environmentCube)),
    vec4At("lodestar_irradianceCube", offsetof(LodestarLighting, lodestar_irradianceCube)),
    vec4At("lodestar_mapSize", offsetof(LodestarLighting, lodestar_mapSize)),
    vec4At("lodestar_mapRows", offsetof(LodestarLighting, lodestar_mapRows)),
    vec4At("lodestar_axes", offsetof(LodestarLighting, lodestar_axes), LODESTAR_MAX_LIGHTS_SHOWN),
    vec4At("lodestar_spreads", offsetof(LodestarLighting, lodestar_spreads),
           LODESTAR_MAX_LIGHTS_SHOWN / 4),
    vec4At("lodestar_mapOctaves", offsetof(LodestarLighting, lodestar_mapOctaves),
           LODESTAR_MAP_ROW_VECTORS),
    sampler("lodestar_maps", LODESTAR_UNIFORM_ARRAY, LODESTAR_TEXELS_MAP),
    sampler("lodestar_lamberts", LODESTAR_UNIFORM_ARRAY, LODESTAR_TEXELS_LAMBERT),
    sampler("lodestar_gradients", LODESTAR_UNIFORM_ARRAY, LODESTAR_TEXELS_GRADIENT),
    sampler("lodestar_environmentTexels", LODESTAR_UNIFORM_CUBE, LODESTAR_TEXELS_ENVIRONMENT),
    sampler("lodestar_irradianceTexels", LODESTAR_UNIFORM_CUBE, LODESTAR_TEXELS_IRRADIANCE),
};

LodestarStatus uniformInfo(uint32_t index, LodestarUniform* into) noexcept {
    if (index >= kUniforms.size()) {
        return LODESTAR_E_ARG;
    }
    return writeStruct(kUniforms[index], into) ? LODESTAR_OK : LODESTAR_E_ABI;
}

} // namespace

void addPlanApi(LodestarApi& api) {
    api.plan_make = make;
    api.plan_text = text;
    api.plan_lights = lights;
    api.plan_jobs = jobs;
    api.plan_features = features;
    api.plan_environment = environment;
    api.plan_uniforms = uniforms;
    api.plan_work = work;
    api.uniform_info = uniformInfo;
}

} // namespace lodestar::plugin

// SPDX-License-Identifier: MIT
#include "app/cost_shading.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <epoxy/gl.h>

#include "app/cost_table.h"
#include "lighting/lookup.h"
#include "lodestar/lobes.glsl"
#include "scene/gpu_scene.h"
#include "scene/programs.h"

namespace lodestar::app {
namespace {

/// Quick lookups are repeated for so long: the processor has other things to do.
constexpr double kEnoughMs = 100.0;

/// A sky whose map is as any other sky's to the shader.
std::vector<lighting::DayLight> plainSky() {
    lighting::DayLight sky;
    sky.name = "sky";
    sky.keys = {{12.0,
                 {{{90, {0.1, 0.2, 0.5}, 0}, {0, {1, 0.9, 0.8}, 0}, {-90, {0.1, 0.1, 0.1}, 0}}},
                 glm::dvec3(1.0),
                 {}}};
    core::Tally none;
    return {*lighting::repaired(std::move(sky), none)};
}

scene::RenderSettings settingsOf(const CostedLookup& lookup) {
    scene::RenderSettings settings;
    (lookup.term == lighting::Term::Glossy ? settings.specular : settings.diffuse) =
        lookup.estimator;
    return settings;
}

} // namespace

CostShading::CostShading(gl::Device& device)
    : device_(device), vertices_(device), timer_(device), frameBlock_(device), lightBlock_(device) {
}

core::Result<std::unique_ptr<CostShading>>
CostShading::make(gl::Device& device, std::shared_ptr<lighting::RsrmKernels> kernels) {
    std::unique_ptr<CostShading> shading(new CostShading(device));
    if (kernels) {
        shading->kernels_ = std::move(kernels);
    }
    auto target = gl::Framebuffer::make(device, kTileSide, kTileSide);
    if (!target) {
        return target.error();
    }
    shading->target_ = std::move(*target);
    return shading;
}

plan::EffectPlan CostShading::planned(double exponent) const {
    plan::PlanInput input;
    plan::DrawView ball;
    ball.casts = false;
    ball.sharpest =
        static_cast<double>(shader::lodestar_lookupExponent(static_cast<float>(exponent), 0.0f));
    input.draws = {ball};
    input.environment.present = false;
    input.rsrmLights = views_;
    input.rsrmPublished = lights_.published();
    input.rsrmGreatestExponent = lights_.layout().greatestExponent;
    input.rsrmRows = lighting::hasOwnRows(lights_.layout());
    return plan::plan(input);
}

gl::Defines CostShading::definesFor(double exponent) const {
    const bool map = !lights_.empty();
    const bool glossy = lookup_.term == lighting::Term::Glossy;
    gl::Defines defines = {{"LODESTAR_COST_LOOKUP", glossy ? map ? "3" : "1" : map ? "4" : "2"}};
    const plan::EffectPlan plan = planned(exponent);
    const auto asked = [&](plan::Feature feature) {
        return plan::has(plan.drawFeatures.front(), feature) ? "1" : "0";
    };
    defines.emplace_back("LODESTAR_RSRM_LIGHTS", std::to_string(plan.rsrmLights.size()));
    defines.emplace_back("LODESTAR_SUNS", std::to_string(plan.suns()));
    defines.emplace_back("LODESTAR_RSRM_LAYOUT", plan.rsrmPublished ? "1" : "0");
    defines.emplace_back("LODESTAR_RSRM_ROWS", asked(plan::Feature::RsrmRows));
    defines.emplace_back("LODESTAR_RSRM_MIRROR", asked(plan::Feature::RsrmMirror));
    const scene::RenderSettings settings = settingsOf(lookup_);
    const gl::Defines chosen = scene::estimatorDefines(settings.specular, settings.diffuse);
    defines.insert(defines.end(), chosen.begin(), chosen.end());
    return defines;
}

core::Result<const gl::Program*> CostShading::program(const gl::Defines& defines) {
    const auto found = programs_.find(defines);
    if (found != programs_.end()) {
        return &found->second;
    }
    auto made = gl::Program::make(device_, "host/present.vert", "host/cost_tile.frag", defines);
    if (!made) {
        return made.error();
    }
    made->setBlock("LodestarFrame", scene::kFrameBinding);
    made->setBlock("LodestarRsrmLights", scene::kRsrmBinding);
    made->setSampler("uEnvironment", scene::kEnvironmentUnit);
    made->setSampler("uIrradiance", scene::kIrradianceUnit);
    made->setSampler("uRsrmMaps", scene::kRsrmMapUnit);
    made->setSampler("uRsrmLamberts", scene::kRsrmLambertUnit);
    made->setSampler("uRsrmGradients", scene::kRsrmGradientUnit);
    return &programs_.emplace(defines, std::move(*made)).first->second;
}

core::Result<void> CostShading::prepare(const std::vector<lighting::DayLight>& lights,
                                        const lighting::RsrmLayout& layout, double hour) {
    lookup_ = {};
    environment_ = {};
    lights_ = scene::GpuLights(lights, layout, kernels_);
    views_ = lights_.describe(hour);
    const plan::EffectPlan plan = planned(1.0);
    if (auto prepared = lights_.prepare(device_, plan); !prepared) {
        return prepared;
    }
    scene::blocks::LodestarRsrmLights block{};
    lights_.describe(plan, block);
    lightBlock_.set(block);
    return {};
}

core::Result<std::uint64_t> CostShading::prepare(const CostedLookup& lookup,
                                                 const lighting::Cubemap& base,
                                                 const lighting::PreparedEnvironment* made) {
    environment_ = {};
    lights_ = {};
    views_.clear();
    const std::uint64_t before = device_.counters().textureBytes;
    if (lookup.layout != nullptr) {
        if (auto prepared = prepare(plainSky(), *lookup.layout, 12.0); !prepared) {
            return prepared.error();
        }
    } else {
        environment_ = scene::GpuEnvironment("measured", base);
        const lighting::PreparedParts parts = lighting::partsFor(lookup.estimator);
        auto prepared = made != nullptr ? environment_.upload(device_, *made, parts)
                                        : environment_.prepare(device_, parts);
        if (!prepared) {
            return prepared.error();
        }
        scene::blocks::LodestarFrame block{};
        environment_.describe(settingsOf(lookup), block);
        frameBlock_.set(block);
    }
    lookup_ = lookup;
    return device_.counters().textureBytes - before;
}

core::Result<double> CostShading::drawn(const gl::Defines& defines, double exponent, int rows) {
    const auto made = program(defines);
    if (!made) {
        return made.error();
    }
    target_.begin();
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    vertices_.bind();
    frameBlock_.bind(scene::kFrameBinding);
    lightBlock_.bind(scene::kRsrmBinding);
    environment_.bind(settingsOf(lookup_));
    lights_.bind();
    (*made)->use();
    glUniform2f((*made)->uniform("uTile"), static_cast<float>(kTileSide),
                static_cast<float>(exponent));
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, kTileSide, rows);
    timer_.begin();
    gl::drawFullScreen(device_);
    timer_.end();
    glDisable(GL_SCISSOR_TEST);
    return timer_.milliseconds();
}

core::Result<double> CostShading::timed(const gl::Defines& defines, double exponent, int repeats) {
    double least = std::numeric_limits<double>::infinity();
    double spent = 0.0;
    for (int i = -1; i < repeats || (spent < kEnoughMs && i < 8 * repeats); ++i) {
        const auto ms = drawn(defines, exponent, kTileSide);
        if (!ms) {
            return ms;
        }
        least = i < 0 ? least : std::min(least, *ms); // the first compiles
        spent += *ms;
    }
    return least / (kTileSide * kTileSide * 1e-6);
}

core::Result<double> CostShading::slice(double exponent, int rows) {
    const auto ms = drawn(definesFor(exponent), exponent, rows);
    return ms ? core::Result<double>(*ms / (kTileSide * rows * 1e-6)) : ms;
}

core::Result<double> CostShading::milliseconds(double exponent, int repeats) {
    return timed(definesFor(exponent), exponent, repeats);
}

core::Result<double> CostShading::lobeMilliseconds(lighting::LobeForm lobes,
                                                   lighting::FresnelForm fresnel, double exponent,
                                                   int repeats) {
    return timed({{"LODESTAR_COST_LOOKUP", "5"},
                  {"LODESTAR_COST_LIGHTS", std::to_string(kCostedLights)},
                  {"LODESTAR_RSRM_LIGHTS", "0"},
                  {"LODESTAR_LOBES", lobes == lighting::LobeForm::Sg ? "1" : "0"},
                  {"LODESTAR_FRESNEL", fresnel == lighting::FresnelForm::Sg ? "1" : "0"}},
                 exponent, repeats);
}

core::Result<double> CostShading::emptyMilliseconds(int repeats) {
    gl::Defines defines = definesFor(1.0);
    defines.front() = {"LODESTAR_COST_LOOKUP", "0"};
    return timed(defines, 1.0, repeats);
}

} // namespace lodestar::app

// SPDX-License-Identifier: MIT
#include "scene/light_state.h"

#include <algorithm>
#include <cmath>

#include "lighting/gradient.h"
#include "plan/state_hash.h"
#include "scene/probe_observer.h"

namespace lodestar::scene {

namespace {

/// All skies' gradients, and what else composition depends on.
std::shared_ptr<const plan::SkyRadiance> skyRadiance(const GpuEnvironment& environment, bool shown,
                                                     const GpuLights& lights) {
    plan::SkyRadiance sky;
    sky.fixed = shown;
    plan::StateHash rest;
    rest.fold(shown ? environment.content() : std::uint64_t{0});
    for (std::size_t i = 0; i < lights.count(); ++i) {
        rest.fold(std::uint64_t{lights.content(i).factor > 0.0 ? 1u : 0u});
        if (lights.isSky(i)) {
            const std::vector<glm::vec3> gradient = lights.gradient(i);
            sky.samples.insert(sky.samples.end(), gradient.begin(), gradient.end());
        }
        if (lights.isSky(i) || lights.isBareSun(i)) {
            for (int c = 0; c < 3; ++c) {
                rest.fold(lights.axis(i)[c]);
            }
        }
    }
    sky.rest = rest.value();
    return std::make_shared<const plan::SkyRadiance>(std::move(sky));
}

} // namespace

plan::LightState lightState(const GpuEnvironment& environment, GpuLights& lights, bool radiance) {
    const glm::dvec3 up(0.0, 1.0, 0.0);
    plan::LightState state;
    const bool shown = !environment.empty() && lights.replacement().empty();
    const glm::dvec3 mean = shown ? environment.mean() : glm::dvec3(0.0);
    state.sources.push_back(plan::along(mean, up));
    plan::StateHash sky;
    sky.fold(shown ? environment.content() : std::uint64_t{0});
    for (std::size_t i = 0; i < lights.count(); ++i) {
        state.sources.push_back(plan::along(lights.facingIrradiance(i), lights.axis(i)));
        // Which suns are up numbers those that are.
        sky.fold(std::uint64_t{lights.content(i).factor > 0.0 ? 1u : 0u});
        if (lights.isSky(i)) {
            const lighting::LightMap::Content content = lights.content(i);
            sky.fold(static_cast<std::uint64_t>(content.from));
            sky.fold(static_cast<std::uint64_t>(content.to));
            sky.fold(content.t);
            sky.fold(content.factor);
            sky.fold(lights.painting(i));
        }
        if (lights.isSky(i) || lights.isBareSun(i)) { // what probes see of the latter
            for (int c = 0; c < 3; ++c) {
                sky.fold(lights.axis(i)[c]);
            }
        }
    }
    state.sky = sky.value();
    state.radiance = radiance ? skyRadiance(environment, shown, lights) : nullptr;
    return state;
}

float writtenFactor(const Scene& scene, const GpuEnvironment& environment,
                    const GpuLights& lights) {
    double emissive = 0.0;
    for (const io::GltfMaterial& material : scene.materials) {
        emissive = std::max({emissive, static_cast<double>(material.emissive.r),
                             static_cast<double>(material.emissive.g),
                             static_cast<double>(material.emissive.b)});
    }
    emissive = std::min(emissive, lighting::kMaxRadiance);
    const double brightest = environment.brightest() + lights.brightest() + emissive;
    constexpr double kHalfOfGreatestHalf = 32768.0;
    const double octaves = std::ceil(std::log2(std::max(brightest / kHalfOfGreatestHalf, 1.0)));
    return static_cast<float>(std::exp2(-octaves));
}

std::uint64_t brokenEmissions(const Scene& scene) {
    const auto broken = [](const io::GltfMaterial& material) {
        for (int c = 0; c < 3; ++c) {
            const auto emission = static_cast<double>(material.emissive[c]);
            if (!(emission >= 0.0 && emission <= lighting::kMaxRadiance)) {
                return true;
            }
        }
        return false;
    };
    return static_cast<std::uint64_t>(
        std::count_if(scene.materials.begin(), scene.materials.end(), broken));
}

plan::EnvironmentView beside(plan::EnvironmentView environment, const GpuLights& lights) {
    environment.replacedBy = lights.replacement();
    environment.present = environment.present && environment.replacedBy.empty();
    return environment;
}

void describeLights(const Scene& scene, const std::vector<DrawItem>& items, double hour,
                    GpuLights& lights, ShadowMaps& shadows, plan::PlanInput& input) {
    input.rsrmLights = lights.describe(hour);
    input.rsrmPublished = lights.published();
    input.rsrmGreatestExponent = lights.layout().greatestExponent;
    input.rsrmRows = lighting::hasOwnRows(lights.layout());
    std::vector<glm::dvec3> axes;
    for (std::size_t i = 0; i < input.rsrmLights.size(); ++i) {
        axes.push_back(lights.axis(i));
    }
    if (!axes.empty()) {
        shadows.describe(scene, items, axes, input);
    }
}

plan::PlanInput planInput(const Scene& scene, const View& view, const RenderSettings& settings,
                          plan::EnvironmentView environment,
                          const std::vector<lighting::DayLight>& lights,
                          const lighting::RsrmLayout& layout) {
    GpuLights described(lights, layout, nullptr); // it bakes nothing
    ShadowMaps shadows;
    plan::PlanInput input =
        planInput(scene, view, settings, beside(std::move(environment), described));
    describeLights(scene, drawItems(scene), settings.hour, described, shadows, input);
    input.faceBudget = settings.faceBudget;
    input.probeBudgetMs = settings.probeBudgetMs;
    if (ProbeObserver observer(scene); !observer.empty()) {
        observer.describe({}, false, settings.lightThreshold, input);
    }
    return input;
}

} // namespace lodestar::scene

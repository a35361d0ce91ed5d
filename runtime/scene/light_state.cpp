// SPDX-License-Identifier: MIT
#include "scene/light_state.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace lodestar::scene {
namespace {

/// Folds a value into a number that tells states apart, after Fowler, Noll and Vo.
void fold(std::uint64_t& state, std::uint64_t value) {
    state = (state ^ value) * 1099511628211ull;
    state ^= state >> 29;
}
void fold(std::uint64_t& state, double value) {
    fold(state, std::bit_cast<std::uint64_t>(value));
}

std::array<glm::dvec3, 3> along(const glm::dvec3& irradiance, const glm::dvec3& axis) {
    return {irradiance.r * axis, irradiance.g * axis, irradiance.b * axis};
}

} // namespace

plan::LightState lightState(const GpuEnvironment& environment, GpuLights& lights) {
    const glm::dvec3 up(0.0, 1.0, 0.0);
    plan::LightState state;
    const bool shown = !environment.empty() && lights.replacement().empty();
    const glm::dvec3 mean = shown ? environment.mean() : glm::dvec3(0.0);
    state.sources.push_back(along(mean, up));
    state.sky = 14695981039346656037ull;
    for (int c = 0; c < 3; ++c) {
        fold(state.sky, mean[c]);
    }
    for (std::size_t i = 0; i < lights.count(); ++i) {
        state.sources.push_back(along(lights.facingIrradiance(i), lights.axis(i)));
        // Which suns are up numbers those that are.
        fold(state.sky, std::uint64_t{lights.content(i).factor > 0.0 ? 1u : 0u});
        if (lights.isSky(i)) {
            const lighting::LightMap::Content content = lights.content(i);
            fold(state.sky, static_cast<std::uint64_t>(content.from));
            fold(state.sky, static_cast<std::uint64_t>(content.to));
            fold(state.sky, content.t);
            fold(state.sky, content.factor);
        }
        if (lights.isSky(i) || lights.isBareSun(i)) { // what probes see of the latter
            for (int c = 0; c < 3; ++c) {
                fold(state.sky, lights.axis(i)[c]);
            }
        }
    }
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
    const double brightest = environment.brightest() + lights.brightest() + emissive;
    constexpr double kHalfOfGreatestHalf = 32768.0;
    const double octaves = std::ceil(std::log2(std::max(brightest / kHalfOfGreatestHalf, 1.0)));
    return static_cast<float>(std::exp2(-octaves));
}

} // namespace lodestar::scene

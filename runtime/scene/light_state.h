// SPDX-License-Identifier: MIT
//
// What lights the world, as the planner and light probes need to know it.
#pragma once

#include "plan/probe_history.h"
#include "scene/draw_list.h"
#include "scene/gpu_environment.h"
#include "scene/gpu_lights.h"
#include "scene/scene.h"
#include "scene/shadow_maps.h"

namespace lodestar::scene {

/// Of the hour for which the lights were last described.
/// @param radiance whether LightState::radiance is asked for
[[nodiscard]] plan::LightState lightState(const GpuEnvironment& environment, GpuLights& lights,
                                          bool radiance);

/// A power of two, at most 1, by which captured radiance is multiplied so that half floats hold
/// twice the sum of everything's greatest radiance.
[[nodiscard]] float writtenFactor(const Scene& scene, const GpuEnvironment& environment,
                                  const GpuLights& lights);

/// Materials whose emission is not in [0, 1e9]. Light probes show NaN and what is negative as 0,
/// and cut what is more at what half floats hold.
[[nodiscard]] std::uint64_t brokenEmissions(const Scene& scene);

/// An environment beside lights: a sky that is not added stands in its place.
[[nodiscard]] plan::EnvironmentView beside(plan::EnvironmentView environment,
                                           const GpuLights& lights);

/// Fills the input's lights and shadows of an hour.
void describeLights(const Scene& scene, const std::vector<DrawItem>& items, double hour,
                    GpuLights& lights, ShadowMaps& shadows, plan::PlanInput& input);

} // namespace lodestar::scene

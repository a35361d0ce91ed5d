// SPDX-License-Identifier: MIT
//
// What lights the world, as light probes need to know it.
#pragma once

#include "plan/probe_history.h"
#include "scene/gpu_environment.h"
#include "scene/gpu_lights.h"
#include "scene/scene.h"

namespace lodestar::scene {

/// Of the hour for which the lights were last described.
[[nodiscard]] plan::LightState lightState(const GpuEnvironment& environment, GpuLights& lights);

/// A power of two, at most 1, by which captured radiance is multiplied so that half floats hold
/// twice the sum of everything's greatest radiance.
[[nodiscard]] float writtenFactor(const Scene& scene, const GpuEnvironment& environment,
                                  const GpuLights& lights);

} // namespace lodestar::scene

// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "io/gltf.h"

namespace lodestar::app {

/// Adds what a scene holds; the keys are a contract (docs/command-line.md). Uses the file up.
void describeScene(io::GltfFile&& scene, nlohmann::ordered_json& json);

} // namespace lodestar::app

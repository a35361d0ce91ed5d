// SPDX-License-Identifier: MIT
//
// The options that `render`, `view` and `plan` share: scene, environment, camera, estimators.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "io/environment_file.h"
#include "scene/camera.h"
#include "scene/renderer.h"

namespace lodestar::app {

/// The words as given.
struct SceneOptions {
    std::string scene;
    std::string assetRoot;
    std::string environment;
    std::string camera;
    std::string eye, target;
    double fovDegrees = 0.0; ///< 0: not given
    std::string size = "960x640";
    std::string specular, diffuse;
    std::string materialOverride;
    bool noBackdrop = false;
    bool faceSeams = false;
    int cubeWidth = io::kDefaultCubeWidth;
};

void addSceneOptions(CLI::App& command, SceneOptions& options);

/// What the words mean, files loaded.
struct LoadedScene {
    scene::Scene scene;
    scene::CameraRequest camera;
    int sceneCount = 1; ///< of the file, at least 1
    scene::View view;
    scene::RenderSettings settings;
    io::LoadedEnvironment environment;
    std::string environmentName;
};

/// @errors Usage for words, InputRefused for files
[[nodiscard]] core::Result<LoadedScene> load(const SceneOptions& options);

} // namespace lodestar::app

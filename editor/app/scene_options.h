// SPDX-License-Identifier: MIT
//
// The options that `render`, `view` and `plan` share: scene, environment, camera, estimators.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/environment_file.h"
#include "lighting/day.h"
#include "lighting/rsrm_layout.h"
#include "scene/animation.h"
#include "scene/camera.h"
#include "scene/renderer.h"

namespace CLI {
class App;
}

namespace lodestar::app {

/// The words as given.
struct SceneOptions {
    std::string scene;
    std::string assetRoot;
    std::string sceneName; ///< a scene of the file, by name or number
    std::string environment;
    std::string lighting; ///< a lighting document; empty: the one beside the scene, if any
    double hour = 15.0;
    std::string camera;
    std::string eye, target;
    double fovDegrees = 0.0; ///< 0: not given
    std::string size = "960x640";
    std::string animation;      ///< name or number; empty: the first, if a time is given
    std::optional<double> time; ///< seconds
    std::string specular, diffuse;
    std::string lobes = nameOf(lighting::LobeForm::Power);
    std::string fresnel = nameOf(lighting::FresnelForm::Schlick);
    std::string materialOverride;
    std::optional<int> faceBudget;       ///< faces of light probes a frame
    std::optional<double> probeBudgetMs; ///< milliseconds of a frame for light probes
    double lightThreshold = scene::RenderSettings().lightThreshold;
    bool noBackdrop = false;
    bool faceSeams = false;
    int cubeWidth = io::kDefaultCubeWidth;
};

void addSceneOptions(CLI::App& command, SceneOptions& options);

/// A file and which of its scenes is shown.
struct OpenedFile {
    io::GltfFile file;
    int sceneIndex = io::kNone; ///< kNone: the file has none, or has its root nodes shown
};

/// @param number the scene, whatever options.sceneName says  @errors Usage if the file has no such
/// scene, InputRefused
[[nodiscard]] core::Result<OpenedFile> openFile(const SceneOptions& options,
                                                std::optional<int> number = {});

/// A distant light and its name, for people.
struct DistantLight {
    std::string name;
    io::LoadedEnvironment environment;
};

/// What the words mean, files loaded.
struct LoadedScene {
    scene::Scene scene;
    scene::CameraRequest camera;
    int sceneIndex = io::kNone; ///< as OpenedFile's
    int sceneCount = 1;         ///< of the file, at least 1
    scene::View view;
    scene::RenderSettings settings;
    DistantLight light;                             ///< empty where the lights stand in its place
    std::vector<lighting::DayLight> lights;         ///< of the lighting document
    std::string lightsName;                         ///< its file
    std::string lightsEstimator = "rsrm";           ///< rsrmLayoutNamed: how their maps are stored
    lighting::RsrmLayout ownMaps = lighting::kRsrm; ///< what the document has for `rsrm`
    core::Tally lightWarnings;                      ///< of the document and the hour
    int animation = scene::kRestPose;               ///< that the scene is posed by
    double time = 0.0;                              ///< seconds into it

    /// Poses the scene and looks at it anew, for a camera that moves. @param seconds finite
    [[nodiscard]] core::Result<void> poseAt(double seconds);
};

/// The layout of an estimator of lights. @param name that rsrmLayoutNamed knows
/// @param own the document's, for `rsrm`
[[nodiscard]] const lighting::RsrmLayout& layoutOf(const std::string& name,
                                                   const lighting::RsrmLayout& own);

/// @errors Usage for words, InputRefused for files
[[nodiscard]] core::Result<LoadedScene> load(const SceneOptions& options);

} // namespace lodestar::app

// SPDX-License-Identifier: MIT
#include "app/scene_options.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include <glm/trigonometric.hpp>

#include <CLI/CLI.hpp>

#include "app/command.h"
#include "app/scene_lighting.h"
#include "io/gltf.h"
#include "lighting/rsrm_layout.h"

namespace lodestar::app {
namespace {

constexpr int kMaxSide = 16384;

core::Result<glm::ivec2> parseSize(const std::string& text) {
    int width = 0;
    int height = 0;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 1 ||
        height < 1 || width > kMaxSide || height > kMaxSide) {
        return usage("'" + text + "' is not a size WxH of 1 to 16384 pixels a side", "--size");
    }
    return glm::ivec2(width, height);
}

core::Result<float> unitInterval(double value, const std::string& key) {
    if (value < 0.0 || value > 1.0) {
        return usage(key + " is a reflectance in [0, 1]", "--override-material");
    }
    return static_cast<float>(value);
}

/// "diffuse=R,G,B,f0=R,G,B,exponent=S", each part optional, in any order.
core::Result<scene::MaterialOverride> parseOverride(const std::string& text) {
    scene::MaterialOverride values;
    std::size_t at = 0;
    while (at < text.size()) {
        const std::size_t equals = text.find('=', at);
        const std::string key = text.substr(at, equals == std::string::npos ? equals : equals - at);
        const std::size_t next = equals == std::string::npos ? equals : text.find('=', equals + 1);
        std::size_t end = next == std::string::npos ? text.size() : text.rfind(',', next);
        if (equals == std::string::npos || end == std::string::npos || end <= equals) {
            return usage("'" + text + "' is not diffuse=R,G,B,f0=R,G,B,exponent=S",
                         "--override-material");
        }
        const std::string value = text.substr(equals + 1, end - equals - 1);
        if (key == "exponent") {
            auto exponent = parseExponent(value, "--override-material");
            if (!exponent) {
                return exponent.error();
            }
            values.exponent = static_cast<float>(std::min(*exponent, 1e7));
        } else if (key == "diffuse" || key == "f0") {
            auto color = parseVector(value, "--override-material");
            if (!color) {
                return color.error();
            }
            for (int i = 0; i < 3; ++i) {
                auto channel = unitInterval((*color)[i], key);
                if (!channel) {
                    return channel.error();
                }
                (key == "f0" ? values.f0 : values.diffuse)[i] = *channel;
            }
        } else {
            return usage("unknown key '" + key + "'; the keys are diffuse, f0 and exponent",
                         "--override-material");
        }
        at = end + 1;
    }
    return values;
}

core::Result<lighting::Estimator> parseShaderEstimator(const std::string& name, lighting::Term term,
                                                       const lighting::Estimator& otherwise,
                                                       const std::string& option) {
    if (name.empty()) {
        return otherwise;
    }
    auto estimator = lighting::parseEstimator(name, term);
    if (!estimator) {
        core::Error error = estimator.error();
        error.where = option;
        return error;
    }
    if (estimator->kind == lighting::EstimatorKind::Reference) {
        return usage("'reference' runs on the CPU: ask for one lookup with `lodestar sample`",
                     option);
    }
    return estimator;
}

/// The scene of a file that a name or a number means; the file's own choice for no word.
core::Result<int> chooseScene(const io::GltfFile& file, const std::string& wanted) {
    if (wanted.empty()) {
        return file.defaultScene;
    }
    std::string known;
    for (std::size_t i = 0; i < file.scenes.size(); ++i) {
        if (file.scenes[i].name == wanted || std::to_string(i) == wanted) {
            return static_cast<int>(i);
        }
        known += (known.empty() ? "" : ", ") +
                 (file.scenes[i].name.empty() ? std::to_string(i) : file.scenes[i].name);
    }
    return usage("no scene '" + wanted + "'; the file has " +
                     (known.empty() ? "none" : std::to_string(file.scenes.size()) + ": " + known),
                 "--scene");
}

core::Result<scene::CameraRequest> cameraRequest(const SceneOptions& options) {
    scene::CameraRequest request;
    request.name = options.camera;
    const std::pair<const std::string*, std::optional<glm::vec3>*> points[] = {
        {&options.eye, &request.eye}, {&options.target, &request.target}};
    for (const auto& [text, point] : points) {
        if (!text->empty()) {
            auto vector = parseVector(*text, text == &options.eye ? "--eye" : "--target");
            if (!vector) {
                return vector.error();
            }
            *point = glm::vec3(*vector);
        }
    }
    if (options.fovDegrees != 0.0) {
        if (!(options.fovDegrees > 0.0 && options.fovDegrees < 180.0)) {
            return usage("the field of view lies between 0 and 180 degrees", "--fov");
        }
        request.verticalFov = static_cast<float>(glm::radians(options.fovDegrees));
    }
    return request;
}

/// Takes an estimator of a document's lights, which serves both terms, out of the words for the
/// environment's. Empty: none is given.
core::Result<std::string> takeLightsEstimator(SceneOptions& options) {
    std::string taken;
    for (std::string* text : {&options.specular, &options.diffuse}) {
        if (lighting::rsrmLayoutNamed(*text) != nullptr) {
            if (!taken.empty() && taken != *text) {
                return usage("lights have one estimator for both terms, not '" + taken + "' and '" +
                             *text + "'");
            }
            taken = std::exchange(*text, std::string());
        }
    }
    return taken;
}

core::Result<scene::RenderSettings> renderSettings(const SceneOptions& options) {
    scene::RenderSettings settings;
    auto size = parseSize(options.size);
    if (!size) {
        return size.error();
    }
    settings.width = size->x;
    settings.height = size->y;
    auto specular = parseShaderEstimator(options.specular, lighting::Term::Glossy,
                                         lighting::kDefaultSpecular, "--specular");
    if (!specular) {
        return specular.error();
    }
    settings.specular = *specular;
    auto diffuse = parseShaderEstimator(options.diffuse, lighting::Term::Diffuse,
                                        lighting::kDefaultDiffuse, "--diffuse");
    if (!diffuse) {
        return diffuse.error();
    }
    settings.diffuse = *diffuse;
    if (options.lobes == nameOf(lighting::LobeForm::Sg)) {
        settings.lobes = lighting::LobeForm::Sg;
    }
    if (options.fresnel == nameOf(lighting::FresnelForm::Sg)) {
        settings.fresnel = lighting::FresnelForm::Sg;
    }
    settings.backdrop = !options.noBackdrop;
    settings.seamless = !options.faceSeams;
    settings.faceBudget = options.faceBudget.value_or(settings.faceBudget);
    settings.probeBudgetMs = options.probeBudgetMs.value_or(settings.probeBudgetMs);
    settings.lightThreshold = options.lightThreshold;
    if (!options.materialOverride.empty()) {
        auto values = parseOverride(options.materialOverride);
        if (!values) {
            return values.error();
        }
        settings.materialOverride = *values;
    }
    return settings;
}

/// Estimators of environment light, and the forms of lobes and of Fresnel's reflectance.
void addEstimators(CLI::App& command, SceneOptions& options) {
    command.add_option("--specular", options.specular,
                       "Glossy estimator: tent (default), auto:ERROR, ring:3, ring:7, taps:N,\n"
                       "prefiltered, mip, mip-floor, bias:LAMBDA, bias:LAMBDA:vertex.\n"
                       "Of a document's lights, both terms: rsrm (default), rsrm-published,\n"
                       "rsrm-published-columns");
    command.add_option(
        "--diffuse", options.diffuse,
        "Diffuse estimator: irradiance (default), sh9, lowest-mip, bias:LAMBDA, or the lights'");
    command
        .add_option("--lobes", options.lobes,
                    "Highlights of the scene's lamps: power, or sg, spherical Gaussians")
        ->check(CLI::IsMember({"power", "sg"}))
        ->capture_default_str();
    command
        .add_option("--fresnel", options.fresnel,
                    "Fresnel's reflectance: schlick, or sg, one exponential")
        ->check(CLI::IsMember({"schlick", "sg"}))
        ->capture_default_str();
}

} // namespace

void addSceneOptions(CLI::App& command, SceneOptions& options) {
    command.add_option("SCENE", options.scene, "The scene, .gltf or .glb")->required();
    command.add_option(
        "--environment", options.environment,
        "Distant light: a panorama, a cube cross or strip, six files STEM_px.EXT .., or\n"
        "constant:R,G,B | gradient:DOWN,UP | disc:X,Y,Z,DEGREES,INSIDE[,OUTSIDE] |\n"
        "faces:C;C;C;C;C;C (C a number or R/G/B). Default: the scene's own\n"
        "EXT_lights_image_based, else a clear sky at 15:00");
    command.add_option(
        "--lighting", options.lighting,
        "A lighting document (default: SCENE-stem.lodestar.json beside the scene, if\n"
        "there is one). Without --environment its lights are all the light");
    command
        .add_option("--hour", options.hour, "Hour of the document's day, local solar time [0, 24)")
        ->capture_default_str();
    command
        .add_option("--environment-width", options.cubeWidth,
                    "Face width of the environment's cube map, in texels")
        ->check(CLI::Range(1, 4096))
        ->capture_default_str();
    command.add_option("--scene", options.sceneName,
                       "A scene of the file, by name or number (default: the file's own choice)");
    command.add_option("--camera", options.camera, "A camera of the scene, by name or number");
    command.add_option("--eye", options.eye, "Viewpoint X,Y,Z in metres");
    command.add_option("--target", options.target, "Point looked at, X,Y,Z in metres");
    command.add_option("--fov", options.fovDegrees, "Vertical field of view in degrees");
    command.add_option(
        "--animation", options.animation,
        "An animation of the scene, by name or number, at --time or its start.\n"
        "Without --animation, --time (and render's --fps): the scene as in the file");
    command.add_option("--time", options.time,
                       "Seconds into the animation (default the first); its ends hold outside it");
    command.add_option("--size", options.size, "Picture size WxH")->capture_default_str();
    addEstimators(command, options);
    command.add_option("--override-material", options.materialOverride,
                       "diffuse=R,G,B,f0=R,G,B,exponent=S for every material");
    command
        .add_option("--budget-faces", options.faceBudget,
                    "Faces of light probes drawn in a frame, at most (default: all that are due)")
        ->check(CLI::Range(0, 1000000));
    command
        .add_option("--budget-ms", options.probeBudgetMs,
                    "Milliseconds of a frame for light probes, at most, by what they took in the\n"
                    "frames before; one face a frame is drawn in any case (default: no bound)")
        ->check(CLI::Range(0.0, 1e9));
    command
        .add_option(
            "--light-threshold", options.lightThreshold,
            "Light probes are captured again where the light that bounces off what they see may\n"
            "have changed by more than that share; a changed sky is composed in any case")
        ->check(CLI::Range(0.0, 1e9))
        ->capture_default_str();
    command.add_flag("--no-backdrop", options.noBackdrop, "Background 0 with alpha 0");
    command.add_flag("--face-seams", options.faceSeams,
                     "Filter each cube face on its own, to see what seamless filtering mends");
    command.add_option("--asset-root", options.assetRoot,
                       "Folder that the scene's files may not leave (default: the scene's own)");
}

core::Result<OpenedFile> openFile(const SceneOptions& options, std::optional<int> number) {
    auto file = io::loadGltf(options.scene, {options.assetRoot});
    if (!file) {
        return core::inFile(file.error(), options.scene);
    }
    if (number && *number < static_cast<int>(file->scenes.size())) {
        return OpenedFile{std::move(*file), *number};
    }
    const auto index = chooseScene(*file, options.sceneName);
    if (!index) {
        return index.error();
    }
    return OpenedFile{std::move(*file), *index};
}

core::Result<LoadedScene> load(const SceneOptions& given) {
    LoadedScene loaded;
    SceneOptions options = given;
    const auto lightsEstimator = takeLightsEstimator(options);
    if (!lightsEstimator) {
        return lightsEstimator.error();
    }
    auto settings = renderSettings(options);
    if (!settings) {
        return settings.error();
    }
    loaded.settings = *settings;
    auto request = cameraRequest(options);
    if (!request) {
        return request.error();
    }
    auto opened = openFile(options);
    if (!opened) {
        return opened.error();
    }
    auto document = openDocument(options);
    if (!document) {
        return document.error();
    }
    auto light = distantLight(options, *opened, *document);
    if (!light) {
        return light.error();
    }
    loaded.light = std::move(*light);
    const auto hour = hourOf(options, loaded.lightWarnings);
    if (!hour) {
        return hour.error();
    }
    loaded.settings.hour = *hour;
    loaded.sceneIndex = opened->sceneIndex;
    loaded.sceneCount = std::max(1, static_cast<int>(opened->file.scenes.size()));
    loaded.scene = scene::buildScene(std::move(opened->file), opened->sceneIndex);
    if (*document) {
        applyMaterials((*document)->document, loaded.scene, loaded.lightWarnings);
        ProbeMaps maps;
        if (auto set = setDocumentProbes(**document, loaded.scene, maps, loaded.lightWarnings);
            !set) {
            return set.error();
        }
        loaded.lightWarnings.merge((*document)->warnings);
        loaded.lights = std::move((*document)->lights);
        loaded.lightsName = (*document)->file;
        loaded.ownMaps = document::mapLayout((*document)->document);
    }
    if (!lightsEstimator->empty()) {
        if (loaded.lights.empty()) {
            return usage("'" + *lightsEstimator +
                         "' is an estimator of a lighting document's lights, and there are none");
        }
        loaded.lightsEstimator = *lightsEstimator;
    }
    loaded.camera = *request;
    if (options.time && !std::isfinite(*options.time)) {
        return usage("a time is a number of seconds", "--time");
    }
    if (!options.animation.empty() || options.time) {
        auto animation =
            scene::findAnimation(loaded.scene, options.animation.empty() ? "0" : options.animation);
        if (!animation) {
            return core::inFile(animation.error(), options.scene);
        }
        loaded.animation = *animation;
        scene::reachOver(loaded.scene, loaded.animation);
    }
    if (auto posed = loaded.poseAt(options.time.value_or(0.0)); !posed) {
        return core::inFile(posed.error(), options.scene);
    }
    return loaded;
}

const lighting::RsrmLayout& layoutOf(const std::string& name, const lighting::RsrmLayout& own) {
    return name == "rsrm" ? own : *lighting::rsrmLayoutNamed(name);
}

core::Result<void> LoadedScene::poseAt(double seconds) {
    time = seconds;
    scene::pose(scene, animation, seconds);
    const float aspect = static_cast<float>(settings.width) / static_cast<float>(settings.height);
    auto chosen = scene::chooseView(scene, camera, aspect);
    if (!chosen) {
        return chosen.error();
    }
    view = *chosen;
    return {};
}

} // namespace lodestar::app

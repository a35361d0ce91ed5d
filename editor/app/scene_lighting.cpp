// SPDX-License-Identifier: MIT
#include "app/scene_lighting.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <glm/gtc/quaternion.hpp>

#include "app/command.h"
#include "io/document_file.h"
#include "lighting/environment.h"

namespace lodestar::app {
namespace {

constexpr const char* kClearSky = "sky";
constexpr double kMaxExponent = 1e7;
constexpr int kWidestFileProbe = 2048; ///< texels of a face

void apply(const document::Material& from, io::GltfMaterial& material, core::Tally& warnings) {
    // What a file gives by roughness and metalness stays so, textures and all, but for what is
    // given here.
    auto& exponent = material.blinnPhong ? material.blinnPhong->exponent : material.exponent;
    auto& diffuse = material.blinnPhong ? material.blinnPhong->diffuse : material.diffuse;
    auto& f0 = material.blinnPhong ? material.blinnPhong->f0 : material.f0;
    if (from.exponent) {
        exponent = static_cast<float>(std::min(*from.exponent, kMaxExponent));
        if (material.blinnPhong) {
            material.blinnPhong->exponentTexture = {};
        }
    }
    if (from.diffuse) {
        diffuse = glm::vec3(*from.diffuse);
    }
    if (from.f0) {
        f0 = glm::vec3(*from.f0);
    }
    if (from.specular) {
        const auto estimator = lighting::parseEstimator(*from.specular, lighting::Term::Glossy);
        const bool served = estimator && plan::estimatorFeature(*estimator).has_value();
        if (served || (estimator && estimator->kind == lighting::EstimatorKind::Auto)) {
            material.specularEstimator = *estimator;
        }
        warnings.add("estimator of one material that is not tent, ring:3, ring:7, taps:32, taps:64 "
                     "or auto:ERROR, left out",
                     material.specularEstimator ? 0 : 1);
    } else if (from.tolerance) {
        lighting::Estimator estimator{lighting::EstimatorKind::Auto};
        estimator.tolerance =
            static_cast<float>(std::min(*from.tolerance, double{lighting::kMostTolerance}));
        material.specularEstimator = estimator;
    }
}

} // namespace

core::Result<std::optional<OpenedDocument>> openDocument(const SceneOptions& options) {
    OpenedDocument opened;
    opened.file = options.lighting;
    if (opened.file.empty()) {
        const std::filesystem::path beside = io::sidecarPath(options.scene);
        std::error_code ignored;
        if (!std::filesystem::exists(beside, ignored)) {
            return std::optional<OpenedDocument>();
        }
        opened.file = beside.string();
    }
    auto document = io::loadDocument(opened.file, opened.warnings);
    if (!document) {
        return document.error();
    }
    core::Tally counted; // by the loading already
    auto lights = document::dayLights(*document, counted);
    if (!lights) {
        return core::inFile(lights.error(), opened.file);
    }
    opened.document = std::move(*document);
    opened.lights = std::move(*lights);
    return std::optional<OpenedDocument>(std::move(opened));
}

core::Result<DistantLight> documentEnvironment(const OpenedDocument& opened, int cubeWidth,
                                               std::optional<DistantLight>& kept) {
    const document::Environment& wanted = *opened.document.environment;
    const auto source = io::environmentSource(wanted.source, opened.file);
    if (!source) {
        return source.error();
    }
    if (!kept || kept->name != *source || kept->environment.base.width() != cubeWidth) {
        auto loaded = io::loadEnvironment(*source, cubeWidth);
        if (!loaded) {
            return core::inFile(loaded.error(), *source);
        }
        kept.emplace(DistantLight{*source, std::move(*loaded)});
    }
    DistantLight light = *kept;
    light.environment.base = lighting::placed(std::move(light.environment.base),
                                              lighting::aboutUp(wanted.rotation), wanted.ev);
    return light;
}

core::Result<DistantLight> distantLight(const SceneOptions& options, const OpenedFile& opened,
                                        const std::optional<OpenedDocument>& document) {
    const std::string& named = options.environment;
    const int own =
        opened.sceneIndex == io::kNone
            ? io::kNone
            : opened.file.scenes[static_cast<std::size_t>(opened.sceneIndex)].environment;
    if (named.empty() && document) {
        if (document->document.environment) {
            std::optional<DistantLight> kept;
            return documentEnvironment(*document, options.cubeWidth, kept);
        }
        if (!document->lights.empty()) {
            return DistantLight{};
        }
    }
    if (named.empty() && own == io::kNone) {
        DistantLight sky{kClearSky, {}};
        sky.environment.base =
            lighting::cubeFromAnalytic(lighting::ClearSkyEnvironment{}, options.cubeWidth);
        return sky;
    }
    auto environment = named.empty() ? io::environmentOf(opened.file, own, options.cubeWidth)
                                     : io::loadEnvironment(named, options.cubeWidth);
    if (!environment) {
        return core::inFile(environment.error(), named.empty() ? options.scene : named);
    }
    return DistantLight{
        named.empty() ? options.scene + " (image-based light " + std::to_string(own) + ")" : named,
        std::move(*environment)};
}

void applyMaterials(const document::Document& document, scene::Scene& scene,
                    core::Tally& warnings) {
    for (const auto& [name, material] : document.materials) {
        bool found = false;
        for (std::size_t i = 0; i < scene.materials.size(); ++i) {
            io::GltfMaterial& target = scene.materials[i];
            if ((!target.name.empty() && target.name == name) ||
                name == std::string("#").append(std::to_string(i))) {
                apply(material, target, warnings);
                found = true;
            }
        }
        warnings.add("material that the scene lacks, left out", found ? 0 : 1);
    }
}

core::Result<void> setDocumentProbes(const OpenedDocument& opened, scene::Scene& scene,
                                     ProbeMaps& maps, core::Tally& warnings) {
    std::vector<lighting::Probe> probes;
    std::vector<scene::ProbeMap> held;
    for (const document::Probe& written : opened.document.probes) {
        probes.push_back(written.probe);
        held.emplace_back();
        if (written.probe.source.empty()) {
            continue;
        }
        const auto source = io::environmentSource(written.probe.source, opened.file);
        if (!source) {
            return source.error();
        }
        const int width = std::min(written.probe.capture.resolution, kWidestFileProbe);
        scene::ProbeMap& map = maps[{*source, width}];
        if (!map) {
            auto loaded = io::loadEnvironment(*source, width);
            if (!loaded) {
                return core::inFile(loaded.error(), *source);
            }
            warnings.merge(loaded->warnings);
            map = std::make_shared<const lighting::Cubemap>(std::move(loaded->base));
        }
        held.back() = map;
    }
    scene::setProbes(scene, probes, held, warnings);
    return {};
}

core::Result<double> hourOf(const SceneOptions& options, core::Tally& warnings) {
    if (!std::isfinite(options.hour)) {
        return usage("an hour is a number", "--hour");
    }
    warnings.add("hour outside [0, 24), wrapped",
                 options.hour < 0.0 || options.hour >= 24.0 ? 1 : 0);
    return lighting::wrappedHour(options.hour);
}

} // namespace lodestar::app

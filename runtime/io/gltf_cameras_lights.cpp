// SPDX-License-Identifier: MIT
//
// Cameras and KHR_lights_punctual.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "io/gltf_internal.h"

namespace lodestar::io::detail {
namespace {

constexpr float kHalfPi = std::numbers::pi_v<float> / 2.0f;
constexpr float kMaxIntensity = 1e9f;

core::Result<void> readPerspective(const tinygltf::PerspectiveCamera& source, const Json& json,
                                   GltfCamera& camera, const std::string& at) {
    if (!(source.yfov > 0.0 && source.yfov < std::numbers::pi)) {
        return core::refused("yfov must lie between 0 and pi", at + "/yfov");
    }
    if (!(static_cast<float>(source.znear) > 0.0f)) {
        return core::refused("znear must be positive", at + "/znear");
    }
    if (json.contains("zfar")) {
        if (!(static_cast<float>(source.zfar) > static_cast<float>(source.znear))) {
            return core::refused("zfar must be larger than znear", at + "/zfar");
        }
        camera.farPlane = static_cast<float>(source.zfar);
    }
    if (json.contains("aspectRatio")) {
        if (!(static_cast<float>(source.aspectRatio) > 0.0f)) {
            return core::refused("aspectRatio must be positive", at + "/aspectRatio");
        }
        camera.aspect = static_cast<float>(source.aspectRatio);
    }
    camera.verticalFov = static_cast<float>(source.yfov);
    camera.nearPlane = static_cast<float>(source.znear);
    return {};
}

core::Result<void> readOrthographic(const tinygltf::OrthographicCamera& source, GltfCamera& camera,
                                    const std::string& at) {
    camera.perspective = false;
    camera.xMagnification = static_cast<float>(source.xmag);
    camera.yMagnification = static_cast<float>(source.ymag);
    camera.nearPlane = static_cast<float>(source.znear);
    camera.farPlane = static_cast<float>(source.zfar);
    if (camera.xMagnification == 0.0f || camera.yMagnification == 0.0f) {
        return core::refused("xmag and ymag must not be 0", at);
    }
    if (!(camera.nearPlane >= 0.0f && camera.farPlane > camera.nearPlane)) {
        return core::refused("zfar must be larger than znear, and znear not negative",
                             at + "/zfar");
    }
    return {};
}

double numberOr(const Json& object, const char* key, double otherwise) {
    const Json* found = member(object, key);
    return found == nullptr ? otherwise : found->get<double>();
}

void readCone(const Json& json, GltfLight& light, core::Tally& warnings) {
    const Json* spot = member(json, "spot");
    if (spot != nullptr) {
        light.innerConeAngle = static_cast<float>(numberOr(*spot, "innerConeAngle", 0.0));
        light.outerConeAngle =
            static_cast<float>(numberOr(*spot, "outerConeAngle", light.outerConeAngle));
    }
    const bool outerGood = light.outerConeAngle > 0.0f && light.outerConeAngle <= kHalfPi;
    if (!outerGood) {
        warnings.add("spot light's outer angle outside (0, pi/2], clamped");
        light.outerConeAngle = light.outerConeAngle > 0.0f ? kHalfPi : GltfLight().outerConeAngle;
    }
    if (!(light.innerConeAngle >= 0.0f && light.innerConeAngle < light.outerConeAngle)) {
        warnings.add("spot light's inner angle outside [0, outer), set to 0");
        light.innerConeAngle = 0.0f;
    }
}

/// The type is one of three; the schema saw that it is a text.
bool lightKind(const std::string& type, LightKind& kind) {
    kind = type == "directional" ? LightKind::Directional
           : type == "spot"      ? LightKind::Spot
                                 : LightKind::Point;
    return kind != LightKind::Point || type == "point";
}

GltfLight readLight(const Json& json, core::Tally& warnings) {
    GltfLight light;
    const Json* name = member(json, "name");
    light.name = name == nullptr ? std::string() : name->get<std::string>();
    const bool known = lightKind(json["type"].get<std::string>(), light.kind);
    warnings.add("light of an unknown type, switched off", known ? 0 : 1);
    if (const Json* color = member(json, "color")) {
        for (std::size_t c = 0; c < 3; ++c) {
            const auto value = (*color)[c].get<float>();
            warnings.add("light colour negative, set to 0", value < 0.0f ? 1 : 0);
            light.color[static_cast<glm::length_t>(c)] = std::clamp(value, 0.0f, kMaxIntensity);
        }
    }
    const double intensity = numberOr(json, "intensity", 1.0);
    warnings.add("light intensity outside [0, 1e9], clamped",
                 intensity >= 0.0 && intensity <= kMaxIntensity ? 0 : 1);
    light.intensity =
        known ? static_cast<float>(std::clamp(intensity, 0.0, double{kMaxIntensity})) : 0.0f;
    if (json.contains("range")) {
        const auto range = json["range"].get<float>();
        warnings.add("light range not positive, taken as infinite", range > 0.0f ? 0 : 1);
        light.range = range > 0.0f ? range : light.range;
    }
    if (light.kind == LightKind::Spot) {
        readCone(json, light, warnings);
    }
    return light;
}

} // namespace

void convertCameras(GltfContext& context) {
    for (std::size_t i = 0; i < context.model.cameras.size(); ++i) {
        const tinygltf::Camera& source = context.model.cameras[i];
        const Json& json = context.document["cameras"][i];
        const std::string at = pointer("/cameras", i) + "/" + source.type;
        GltfCamera camera;
        camera.name = source.name;
        core::Result<void> read =
            source.type == "perspective"
                ? readPerspective(source.perspective, json["perspective"], camera, at)
                : readOrthographic(source.orthographic, camera, at);
        if (!read) {
            context.problems.refuse(read.error());
        }
        context.file.cameras.push_back(camera);
    }
}

void convertLights(GltfContext& context) {
    const Json* punctual = extensionOf(context.document, "KHR_lights_punctual");
    for (std::size_t i = 0; punctual != nullptr && i < memberSize(*punctual, "lights"); ++i) {
        context.file.lights.push_back(readLight((*punctual)["lights"][i], context.file.warnings));
    }
}

} // namespace lodestar::io::detail

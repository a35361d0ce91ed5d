// SPDX-License-Identifier: MIT
#include "app/bake_lights.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <utility>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "app/command.h"
#include "io/document_file.h"
#include "io/environment_file.h"
#include "lighting/environment.h"
#include "lighting/photographed_lights.h"
#include "lighting/zonal_picture.h"
#include "lodestar/cube.glsl"

namespace lodestar::app {
namespace {

using lighting::LightKind;
using nlohmann::ordered_json;

constexpr double kDegrees = 180.0 / std::numbers::pi;
const glm::dvec3 kUp(0.0, 1.0, 0.0);

/// Width of the cubes that irradiance is compared on.
constexpr int kCubeWidth = 64;

document::Light lightOf(const char* name, LightKind kind, const lighting::Gradient& gradient,
                        const glm::dvec3& axis) {
    document::Light light;
    light.name = name;
    light.kind = kind;
    if (axis != kUp) {
        light.axis = axis;
    }
    document::Key key;
    key.hour = 12.0;
    key.gradient.interpolation = gradient.interpolation;
    key.gradient.space = gradient.space;
    for (const lighting::GradientStop& stop : gradient.stops) {
        key.gradient.stops.push_back({stop, {}});
    }
    light.keys.push_back(std::move(key));
    return light;
}

/// The sky as a panorama.
core::Image pictureOf(const lighting::Gradient& sky, const glm::dvec3& axis) {
    const lighting::RadianceProfile profile(sky, LightKind::Sky);
    core::Image image(4 * kCubeWidth, 2 * kCubeWidth, 3);
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const glm::dvec3 d = lighting::latLongDirection(x + 0.5, y + 0.5, image);
            const glm::dvec3 radiance =
                profile.radiance(std::acos(glm::clamp(glm::dot(d, axis), -1.0, 1.0)));
            for (int c = 0; c < 3; ++c) {
                image.at(x, y)[c] = static_cast<float>(radiance[c]);
            }
        }
    }
    return image;
}

} // namespace

double diffuseError(const core::Image& panorama, const lighting::PhotographedLights& lights,
                    const glm::dvec3& axis) {
    const lighting::Cubemap truth =
        lighting::irradianceCube(lighting::cubeFromLatLong(panorama, kCubeWidth));
    const lighting::Cubemap sky = lighting::irradianceCube(
        lighting::cubeFromLatLong(pictureOf(lights.sky, axis), kCubeWidth));
    const int n = truth.width();
    const std::vector<double> solidAngles = lighting::texelSolidAngles(n);
    double off = 0.0;
    double norm = 0.0;
    for (std::size_t i = 0; i < truth.level(0).size(); ++i) {
        glm::dvec3 found(sky.level(0)[i]);
        if (lights.sun) {
            const auto at = static_cast<int>(i);
            const auto place = [n](int k) {
                return static_cast<float>(2 * k + 1) / static_cast<float>(n) - 1.0f;
            };
            const glm::dvec3 normal = glm::normalize(glm::dvec3(
                shader::lodestar_cubeDirection(at / (n * n), place(at % n), place(at / n % n))));
            found += lights.sun->irradiance / std::numbers::pi *
                     std::max(glm::dot(normal, lights.sun->axis), 0.0);
        }
        const glm::dvec3 expected(truth.level(0)[i]);
        const double omega = solidAngles[i % solidAngles.size()];
        off += omega * glm::dot(found - expected, found - expected);
        norm += omega * glm::dot(expected, expected);
    }
    return norm > 0.0 ? std::sqrt(off / norm) : 0.0;
}

std::string photographAdvice(double residual, double error) {
    if (error > 0.15) {
        return "much of this sky's light lies where no symmetric map has it: light the scene by "
               "the panorama itself, as its environment";
    }
    return residual > 0.1 ? "diffuse and rough surfaces are lit as by the panorama; what polished "
                            "ones mirror is not there"
                          : "the sky is close to symmetric about the axis: these lights show it";
}

std::vector<document::Light> documentLights(const lighting::PhotographedLights& lights,
                                            const glm::dvec3& axis) {
    std::vector<document::Light> made{lightOf("sky", LightKind::Sky, lights.sky, axis)};
    if (lights.sun) {
        made.push_back(lightOf("sun", LightKind::Sun, lights.sun->gradient, lights.sun->axis));
    }
    return made;
}

namespace {

ordered_json describe(const core::Image& panorama, const lighting::PhotographedLights& lights,
                      const glm::dvec3& axis, const core::Tally& warnings) {
    const double error = diffuseError(panorama, lights, axis);
    ordered_json json;
    json["source"] = "panorama";
    json["sky"] = {{"stops", lights.sky.stops.size()}};
    if (lights.sun) {
        const lighting::PhotographedSun& sun = *lights.sun;
        json["sun"] = {{"axis", {sun.axis.x, sun.axis.y, sun.axis.z}},
                       {"elevation", std::asin(glm::clamp(sun.axis.y, -1.0, 1.0)) * kDegrees},
                       {"radius", sun.radius * kDegrees},
                       {"irradiance", {sun.irradiance.r, sun.irradiance.g, sun.irradiance.b}},
                       {"stops", sun.gradient.stops.size()}};
    } else {
        json["sun"] = nullptr;
    }
    json["residual_before"] = lights.residualBefore;
    json["residual"] = lights.residual;
    json["diffuse_error"] = error;
    json["advice"] = photographAdvice(lights.residual, error);
    json["warnings"] = warnings.counts();
    return json;
}

} // namespace

int bakeLights(const BakeLightsOptions& options) {
    if (std::filesystem::exists(options.output)) {
        return fail({core::ErrorCode::OutputFailed,
                     "there is such a document already, which would be lost",
                     options.output,
                     {}});
    }
    core::Tally warnings;
    const auto panorama = io::loadRadiance(options.source, warnings);
    if (!panorama) {
        return fail(panorama.error());
    }
    if (panorama->width() != 2 * panorama->height()) {
        return fail(core::inFile(core::refused("lights are found in a panorama, twice as wide as "
                                               "high; the picture is " +
                                               std::to_string(panorama->width()) + " x " +
                                               std::to_string(panorama->height())),
                                 options.source));
    }
    const auto axis = parseAxis(options.axis.empty() ? "0,1,0" : options.axis, "--axis");
    if (!axis) {
        return fail(axis.error());
    }
    const lighting::PhotographedLights lights =
        lighting::lightsFromPanorama(*panorama, *axis, !options.keepSun);
    document::Document document;
    document.lights = documentLights(lights, *axis);
    if (auto saved = io::saveDocument(options.output, document); !saved) {
        return fail(saved.error());
    }
    warn(warnings, options.source);
    std::printf("%s\n", describe(*panorama, lights, *axis, warnings).dump(2).c_str());
    return 0;
}

} // namespace lodestar::app

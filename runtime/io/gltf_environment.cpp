// SPDX-License-Identifier: MIT
//
// EXT_lights_image_based as a cube map.
#include <algorithm>
#include <cmath>

#include "io/environment_file.h"
#include "io/gltf_internal.h"
#include "lighting/environment.h"
#include "lodestar/cube.glsl"
#include "lodestar/display.glsl"

namespace lodestar::io {
namespace {

/// Smallest alpha of an RGBD texel: one step of 8 bits.
constexpr float kLeastAlpha = 1.0f / 255.0f;

/// A face's radiance: colours / alpha [RGBD], times the intensity.
core::Image radianceOf(const core::Texels& stored, float intensity) {
    core::Image face(stored.width(), stored.height(), 3);
    for (int y = 0; y < stored.height(); ++y) {
        for (int x = 0; x < stored.width(); ++x) {
            const float scale = intensity / std::max(stored.value(x, y, 3), kLeastAlpha);
            for (int c = 0; c < 3; ++c) {
                face.at(x, y)[c] = scale * shader::lodestar_linearFromSrgb(stored.value(x, y, c));
            }
        }
    }
    return face;
}

const char* const kLights = "/extensions/EXT_lights_image_based/lights";

/// @pre the file has the faces' images
core::Result<void> checkFaces(const GltfFile& file, std::size_t environment) {
    const std::array<int, 6>& faces = file.environments[environment].faces;
    const int side = file.images[static_cast<std::size_t>(faces[0])].width();
    for (const int face : faces) {
        const core::Texels& stored = file.images[static_cast<std::size_t>(face)];
        if (stored.width() != side || stored.height() != side || side < 1) {
            return core::refused("the six faces must be square and of one size",
                                 detail::pointer(kLights, environment) + "/specularImages/0");
        }
    }
    return {};
}

} // namespace

void detail::checkEnvironmentFaces(GltfContext& context) {
    if (!context.problems.clean("/extensions/EXT_lights_image_based")) {
        return;
    }
    std::vector<bool> named(context.file.environments.size());
    for (const GltfScene& scene : context.file.scenes) {
        if (scene.environment != kNone) {
            named[static_cast<std::size_t>(scene.environment)] = true;
        }
    }
    for (std::size_t i = 0; i < named.size(); ++i) {
        const std::array<int, 6>& faces = context.file.environments[i].faces;
        const bool known = std::all_of(faces.begin(), faces.end(), [&](int face) {
            return static_cast<std::size_t>(face) < context.file.images.size() &&
                   context.problems.clean(pointer("/images", static_cast<std::size_t>(face)));
        });
        core::Result<void> good =
            named[i] && known ? checkFaces(context.file, i) : core::Result<void>();
        if (!good) {
            context.problems.refuse(good.error());
        }
    }
}

core::Result<LoadedEnvironment> environmentOf(const GltfFile& file, int environment, int width) {
    const GltfEnvironment& light = file.environments[static_cast<std::size_t>(environment)];
    core::Result<void> good = checkFaces(file, static_cast<std::size_t>(environment));
    if (!good) {
        return good.error();
    }
    LoadedEnvironment loaded;
    loaded.layout = EnvironmentLayout::SixFiles;
    std::array<core::Image, 6> faces;
    for (std::size_t face = 0; face < 6; ++face) {
        const core::Texels& stored = file.images[static_cast<std::size_t>(light.faces[face])];
        faces[face] = radianceOf(stored, light.intensity);
        lighting::repairRadiance(faces[face], loaded.warnings);
    }
    loaded.base = lighting::cubeFromFaces(faces, width);
    if (std::abs(light.rotation.w) < 1.0f) {
        loaded.base = lighting::turned(loaded.base, light.rotation);
    }
    return loaded;
}

} // namespace lodestar::io

// SPDX-License-Identifier: MIT
#include "app/check_scene.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "scene/scene.h"

namespace lodestar::app {
namespace {

using Json = nlohmann::ordered_json;

Json extensionsJson(const std::vector<std::string>& names) {
    Json json = Json::array();
    for (const std::string& name : names) {
        json.push_back({{"name", name}, {"supported", io::isSupportedExtension(name)}});
    }
    return json;
}

Json imagesJson(const io::GltfFile& scene) {
    Json json = Json::array();
    for (const io::GltfImageInfo& image : scene.imageInfos) {
        json.push_back({{"name", image.name},
                        {"format", image.format.empty() ? Json(nullptr) : Json(image.format)},
                        {"width", image.width},
                        {"height", image.height},
                        {"channels", image.channels}});
    }
    return json;
}

Json texturesJson(const io::GltfFile& scene) {
    Json json = Json::array();
    for (const io::GltfTexture& texture : scene.textures) {
        if (texture.image == io::kNone) {
            json.push_back({{"image", nullptr}});
            continue;
        }
        const io::GltfImageInfo& image = scene.imageInfos[static_cast<std::size_t>(texture.image)];
        json.push_back({{"image", texture.image},
                        {"format", image.format.empty() ? Json(nullptr) : Json(image.format)},
                        {"width", image.width},
                        {"height", image.height}});
    }
    return json;
}

struct MeshCounts {
    std::size_t primitives = 0;
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    std::size_t lines = 0;
    std::size_t points = 0;
};

MeshCounts countMeshes(const io::GltfFile& scene) {
    MeshCounts counts;
    for (const io::GltfMesh& mesh : scene.meshes) {
        counts.primitives += mesh.primitives.size();
        for (const io::GltfPrimitive& primitive : mesh.primitives) {
            const std::size_t indices = primitive.indices.size();
            counts.vertices += primitive.positions.size();
            switch (primitive.topology) {
            case io::Topology::Triangles:
                counts.triangles += indices / 3;
                break;
            case io::Topology::Lines:
                counts.lines += indices / 2;
                break;
            case io::Topology::Points:
                counts.points += indices;
                break;
            }
        }
    }
    return counts;
}

template <class T>
Json names(const std::vector<T>& things) {
    Json json = Json::array();
    for (const T& thing : things) {
        json.push_back(thing.name);
    }
    return json;
}

const char* pathName(io::AnimationPath path) {
    switch (path) {
    case io::AnimationPath::Translation:
        return "translation";
    case io::AnimationPath::Rotation:
        return "rotation";
    case io::AnimationPath::Scale:
        return "scale";
    case io::AnimationPath::Weights:
        break;
    }
    return "weights";
}

const char* interpolationName(io::Interpolation interpolation) {
    switch (interpolation) {
    case io::Interpolation::Step:
        return "STEP";
    case io::Interpolation::Linear:
        return "LINEAR";
    case io::Interpolation::CubicSpline:
        break;
    }
    return "CUBICSPLINE";
}

/// Of the whole file, whichever scene shows them; nodes are the file's.
Json animationsJson(const io::GltfFile& scene) {
    Json json = Json::array();
    for (const io::GltfAnimation& animation : scene.animations) {
        Json channels = Json::array();
        float last = 0.0f; // [s]
        for (const io::GltfAnimationChannel& channel : animation.channels) {
            const auto& sampler = animation.samplers[static_cast<std::size_t>(channel.sampler)];
            last = sampler.times.empty() ? last : std::max(last, sampler.times.back());
            channels.push_back({{"node", channel.node},
                                {"path", pathName(channel.path)},
                                {"interpolation", interpolationName(sampler.interpolation)},
                                {"keys", sampler.times.size()}});
        }
        json.push_back(
            {{"name", animation.name}, {"duration", last}, {"channels", std::move(channels)}});
    }
    return json;
}

/// Of the default scene, in metres of the world; null where nothing has a place.
Json boundsJson(io::GltfFile&& file) {
    const scene::Bounds bounds = scene::buildScene(std::move(file)).worldBounds();
    if (bounds.empty()) {
        return nullptr;
    }
    return {{"min", {bounds.low.x, bounds.low.y, bounds.low.z}},
            {"max", {bounds.high.x, bounds.high.y, bounds.high.z}}};
}

} // namespace

void describeScene(io::GltfFile&& scene, Json& json) {
    const MeshCounts counts = countMeshes(scene);
    json["scenes"] = scene.scenes.size();
    json["sceneNames"] = names(scene.scenes);
    json["defaultScene"] =
        scene.defaultScene == io::kNone ? Json(nullptr) : Json(scene.defaultScene);
    json["nodes"] = scene.nodes.size();
    json["meshes"] = scene.meshes.size();
    json["primitives"] = counts.primitives;
    json["vertices"] = counts.vertices;
    json["triangles"] = counts.triangles;
    json["lines"] = counts.lines;
    json["points"] = counts.points;
    json["materials"] = scene.materials.size();
    json["materialNames"] = names(scene.materials);
    json["textures"] = texturesJson(scene);
    json["images"] = scene.imageInfos.size();
    json["imageList"] = imagesJson(scene);
    json["cameras"] = scene.cameras.size();
    json["cameraNames"] = names(scene.cameras);
    json["lights"] = scene.lights.size();
    json["lightNames"] = names(scene.lights);
    json["animations"] = scene.animations.size();
    json["animationList"] = animationsJson(scene);
    json["skins"] = scene.skins.size();
    json["bufferBytes"] = scene.bufferBytes;
    json["extensionsUsed"] = extensionsJson(scene.extensionsUsed);
    json["extensionsRequired"] = extensionsJson(scene.extensionsRequired);
    json["boundingBox"] = boundsJson(std::move(scene));
}

} // namespace lodestar::app

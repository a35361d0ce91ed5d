// SPDX-License-Identifier: MIT
//
// What is left of a document without its refused elements. Every array keeps its length, so that
// indices go on meaning what they meant.
#include <algorithm>
#include <string_view>

#include "io/gltf_rules.h"

namespace lodestar::io::detail {
namespace {

/// Taints `user` where it names a refused element of `array`.
void follow(const Json& object, const char* key, const char* array, const std::string& user,
            GltfProblems& problems) {
    const Json* index = member(object, key);
    if (index != nullptr && index->is_number_unsigned() &&
        !problems.clean(pointer(std::string("/") + array, index->get<std::size_t>()))) {
        problems.taint(user);
    }
}

void followMap(const Json& map, const std::string& user, GltfProblems& problems) {
    for (const auto& [key, index] : map.items()) {
        follow(map, key.c_str(), "accessors", user, problems);
    }
}

/// Refusals of buffers reach views and accessors in checkRanges; here they go on to the rest.
void spread(const Json& document, GltfProblems& problems) {
    eachClean(document, "images", problems, [&](const Json& image, const std::string& at) {
        follow(image, "bufferView", "bufferViews", at, problems);
    });
    eachClean(document, "meshes", problems, [&](const Json& mesh, const std::string& at) {
        for (const Json& primitive : mesh["primitives"]) {
            followMap(primitive["attributes"], at, problems);
            follow(primitive, "indices", "accessors", at, problems);
            for (std::size_t t = 0; t < memberSize(primitive, "targets"); ++t) {
                followMap(primitive["targets"][t], at, problems);
            }
        }
    });
    eachClean(document, "skins", problems, [&](const Json& skin, const std::string& at) {
        follow(skin, "inverseBindMatrices", "accessors", at, problems);
        for (std::size_t j = 0; j < memberSize(skin, "joints"); ++j) {
            if (!problems.clean(pointer("/nodes", skin["joints"][j].get<std::size_t>()))) {
                problems.taint(at);
            }
        }
    });
    eachClean(document, "animations", problems, [&](const Json& animation, const std::string& at) {
        for (const Json& sampler : animation["samplers"]) {
            follow(sampler, "input", "accessors", at, problems);
            follow(sampler, "output", "accessors", at, problems);
        }
        for (const Json& channel : animation["channels"]) {
            follow(channel["target"], "node", "nodes", at, problems);
        }
    });
}

/// The least that the schema takes in an element's place.
Json standIn(std::string_view array) {
    if (array == "accessors") {
        return {{"componentType", 5126}, {"count", 1}, {"type", "SCALAR"}};
    }
    if (array == "buffers") {
        return {{"byteLength", 1}};
    }
    if (array == "bufferViews") {
        return {{"buffer", 0}, {"byteLength", 1}};
    }
    if (array == "cameras") {
        return {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 1.0}}}};
    }
    if (array == "animations") {
        return {{"channels", Json::array()}, {"samplers", Json::array()}};
    }
    if (array == "meshes") {
        return {{"primitives", {{{"attributes", Json::object()}}}}};
    }
    return Json::object();
}

/// Nodes without the meshes and skins that fell.
void mendNodes(Json& nodes, const GltfProblems& problems) {
    for (Json& node : nodes) {
        const auto fell = [&](const char* key, const char* array) {
            const Json* index = member(node, key);
            return index != nullptr && !problems.clean(pointer(array, index->get<std::size_t>()));
        };
        if (fell("skin", "/skins")) {
            node.erase("skin");
        }
        if (fell("mesh", "/meshes")) {
            node.erase("mesh");
            node.erase("skin");
            node.erase("weights");
        }
    }
}

/// Lists of names without what is none, and extensions without the lights that fell.
void mendExtensions(Json& document, const GltfProblems& problems) {
    for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
        if (!document.contains(key)) {
            continue;
        }
        Json texts = Json::array();
        for (std::size_t i = 0; i < memberSize(document, key); ++i) {
            if (document[key][i].is_string()) {
                texts.push_back(document[key][i]);
            }
        }
        document[key] = std::move(texts);
    }
    if (!problems.clean("/extensions")) {
        document.erase("extensions");
    } else if (!problems.clean("/extensions/KHR_lights_punctual")) {
        document["extensions"].erase("KHR_lights_punctual");
    }
}

} // namespace

void cutOutRefused(Json& document, std::vector<Bytes>& buffers, GltfProblems& problems) {
    spread(document, problems);
    for (const char* array :
         {"accessors", "animations", "buffers", "bufferViews", "cameras", "images", "materials",
          "meshes", "nodes", "samplers", "scenes", "skins", "textures"}) {
        for (std::size_t i = 0; i < memberSize(document, array); ++i) {
            if (!problems.clean(pointer(std::string("/") + array, i))) {
                document[array][i] = standIn(array);
            }
        }
    }
    for (Bytes& buffer : buffers) {
        buffer.resize(std::max<std::size_t>(buffer.size(), 1));
    }
    if (memberSize(document, "nodes") > 0) {
        mendNodes(document["nodes"], problems);
    }
    if (!problems.clean("/scene")) {
        document.erase("scene");
    }
    mendExtensions(document, problems);
}

} // namespace lodestar::io::detail

// SPDX-License-Identifier: MIT
//
// tinygltf 2.7, kept from everything it does unsafely: it is given a document of known, checked
// keys without images, skins, animations and extensions, and its buffers by name from memory.
#include <algorithm>
#include <charconv>
#include <exception>
#include <string_view>

#include "io/gltf_internal.h"

namespace lodestar::io::detail {
namespace {

constexpr std::string_view kBufferName = "buffer-";

/// The "files" that tinygltf may see.
struct MemoryFiles {
    std::vector<Bytes> buffers;

    /// The buffer of a name, or null.
    Bytes* find(const std::string& name) {
        if (!name.starts_with(kBufferName)) {
            return nullptr;
        }
        std::size_t index = 0;
        const char* end = name.data() + name.size();
        const auto read = std::from_chars(name.data() + kBufferName.size(), end, index);
        return read.ec == std::errc() && read.ptr == end && index < buffers.size() ? &buffers[index]
                                                                                   : nullptr;
    }
};

bool fileExists(const std::string& name, void* user) {
    return static_cast<MemoryFiles*>(user)->find(name) != nullptr;
}

std::string expandPath(const std::string& name, void* /*user*/) {
    return name;
}

bool readFile(std::vector<unsigned char>* out, std::string* error, const std::string& name,
              void* user) {
    Bytes* bytes = static_cast<MemoryFiles*>(user)->find(name);
    if (bytes == nullptr) {
        if (error != nullptr) {
            *error += "no such buffer";
        }
        return false;
    }
    *out = std::move(*bytes);
    return true;
}

bool writeFile(std::string* /*error*/, const std::string& /*name*/,
               const std::vector<unsigned char>& /*contents*/, void* /*user*/) {
    return false;
}

/// Images are decoded elsewhere; the bytes are never touched.
bool ignoreImage(tinygltf::Image* /*image*/, const int /*index*/, std::string* /*error*/,
                 std::string* /*warning*/, int /*width*/, int /*height*/,
                 const unsigned char* /*bytes*/, int /*size*/, void* /*user*/) {
    return true;
}

Json prepared(const Json& document, std::size_t bufferCount) {
    Json copy = knownKeys(document);
    for (const char* key :
         {"images", "skins", "animations", "extensionsUsed", "extensionsRequired"}) {
        copy.erase(key);
    }
    for (std::size_t i = 0; i < bufferCount; ++i) {
        copy["buffers"][i]["uri"] = std::string(kBufferName) + std::to_string(i);
    }
    for (std::size_t m = 0; m < memberSize(copy, "meshes"); ++m) {
        for (Json& primitive : copy["meshes"][m]["primitives"]) {
            if (primitive.contains("indices")) {
                primitive["attributes"][kIndicesAttribute] = primitive["indices"];
                primitive.erase("indices");
            }
        }
    }
    return copy;
}

bool sameCounts(const Json& document, const tinygltf::Model& model) {
    bool same = model.nodes.size() == memberSize(document, "nodes") &&
                model.meshes.size() == memberSize(document, "meshes") &&
                model.materials.size() == memberSize(document, "materials") &&
                model.textures.size() == memberSize(document, "textures") &&
                model.samplers.size() == memberSize(document, "samplers") &&
                model.buffers.size() == memberSize(document, "buffers") &&
                model.bufferViews.size() == memberSize(document, "bufferViews") &&
                model.accessors.size() == memberSize(document, "accessors") &&
                model.cameras.size() == memberSize(document, "cameras") &&
                model.scenes.size() == memberSize(document, "scenes");
    for (std::size_t i = 0; same && i < model.meshes.size(); ++i) {
        same = model.meshes[i].primitives.size() == memberSize(document["meshes"][i], "primitives");
    }
    return same;
}

std::string oneLine(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (text.ends_with(' ')) {
        text.pop_back();
    }
    return text;
}

} // namespace

core::Result<tinygltf::Model> parseModel(const Json& document, std::vector<Bytes> buffers) {
    const std::string text = prepared(document, buffers.size()).dump();
    if (text.size() > 0xffffffffU) {
        return core::refused("JSON is longer than 4 GiB");
    }
    MemoryFiles files{std::move(buffers)};
    tinygltf::TinyGLTF loader;
    loader.SetFsCallbacks({fileExists, expandPath, readFile, writeFile, &files});
    loader.SetImageLoader(ignoreImage, nullptr);
    tinygltf::Model model;
    std::string error;
    std::string warning;
    try {
        const bool loaded = loader.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                                       static_cast<unsigned>(text.size()), "");
        if (!loaded || !error.empty()) {
            return core::refused("glTF cannot be read: " + oneLine(error));
        }
    } catch (const std::exception& exception) {
        return core::refused(std::string("glTF cannot be read: ") + oneLine(exception.what()));
    }
    if (!sameCounts(document, model)) {
        return core::refused("glTF cannot be read: a part of it was not understood");
    }
    return model;
}

} // namespace lodestar::io::detail

// SPDX-License-Identifier: MIT
#include "call.h"

#include <cmath>
#include <cstdio>

#include <glm/trigonometric.hpp>

namespace lodestar::samples {
namespace {

bool takeWord(HostCall& call, const std::string& word, const char* value) {
    float x = 0.0f, y = 0.0f, z = 0.0f;
    char rest = 0;
    if (word == "--lighting") {
        call.lighting = value;
    } else if (word == "-o") {
        call.output = value;
    } else if (word == "--size") {
        return std::sscanf(value, "%dx%d%c", &call.width, &call.height, &rest) == 2 &&
               call.width > 0 && call.height > 0 && call.width <= 8192 && call.height <= 8192;
    } else if (word == "--hour") {
        return std::sscanf(value, "%lf%c", &call.hour, &rest) == 1 && std::isfinite(call.hour);
    } else if (word == "--fov") {
        const bool read = std::sscanf(value, "%f%c", &x, &rest) == 1 && x > 0.0f && x < 180.0f;
        call.camera.verticalFov = glm::radians(x);
        return read;
    } else if (word == "--eye" || word == "--target") {
        const bool read = std::sscanf(value, "%f,%f,%f%c", &x, &y, &z, &rest) == 3;
        (word == "--eye" ? call.camera.eye : call.camera.target) = glm::vec3(x, y, z);
        return read;
    } else {
        return false;
    }
    return true;
}

} // namespace

std::optional<HostCall> parseHostCall(int argc, char** argv) {
    HostCall call;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word.empty() || word[0] != '-') {
            call.scene = word;
        } else if (i + 1 == argc || !takeWord(call, word, argv[++i])) {
            return {};
        }
    }
    if (call.scene.empty() || call.lighting.empty() || call.output.empty()) {
        return {};
    }
    return call;
}

int explainHost(const char* name, int argc, char** argv) {
    const bool asked = argc == 2 && std::string(argv[1]) == "--help";
    std::fprintf(asked ? stdout : stderr,
                 "usage: %s SCENE --lighting FILE -o OUT.png [--size WxH] [--hour H]\n"
                 "           [--eye X,Y,Z --target X,Y,Z] [--fov DEGREES]\n"
                 "Draws a glTF scene under a lighting document, without shadows and backdrop.\n"
                 "Example: %s spheres.gltf --lighting dusk.lodestar.json -o dusk.png --hour 18.5\n",
                 name, name);
    return asked ? 0 : 2;
}

int hostFails(const char* name, const std::string& what, int status) {
    std::fprintf(stderr, "%s: %s\n", name, what.c_str());
    return status;
}

core::Result<HostScene> loadHostScene(const HostCall& call) {
    auto file = io::loadGltf(call.scene, {});
    if (!file) {
        return core::inFile(file.error(), call.scene);
    }
    const scene::Scene scene = scene::buildScene(*file, file->defaultScene);
    const auto view = scene::chooseView(
        scene, call.camera, static_cast<float>(call.width) / static_cast<float>(call.height));
    if (!view) {
        return core::inFile(view.error(), call.scene);
    }
    return HostScene{std::move(*file), *view};
}

} // namespace lodestar::samples

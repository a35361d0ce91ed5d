// SPDX-License-Identifier: MIT
#include "call.h"

#include <cmath>
#include <cstdio>
#include <optional>

#include <glm/trigonometric.hpp>

#include "io/image_file.h"

namespace lodestar::samples {

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

namespace {

/// The words of a call; nothing where they are none.
std::optional<HostCall> parse(int argc, char** argv) {
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

/// How a host is called. @return the exit status of a call that was none
int explain(const char* name, int argc, char** argv) {
    const bool asked = argc == 2 && std::string(argv[1]) == "--help";
    std::fprintf(asked ? stdout : stderr,
                 "usage: %s SCENE --lighting FILE -o OUT.png [--size WxH] [--hour H]\n"
                 "           [--eye X,Y,Z --target X,Y,Z] [--fov DEGREES]\n"
                 "Draws a glTF scene under a lighting document, without shadows and backdrop.\n"
                 "Example: %s spheres.gltf --lighting dusk.lodestar.json -o dusk.png --hour 18.5\n",
                 name, name);
    return asked ? 0 : 2;
}

core::Result<void> drawInto(const HostCall& call, HostDraw draw) {
    const auto scene = loadScene(call);
    if (!scene) {
        return scene.error();
    }
    const auto picture = draw(call, *scene);
    return picture ? io::writeImage(call.output, *picture) : picture.error();
}

} // namespace

core::Result<HostScene> loadScene(const HostCall& call) {
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

int runHost(const char* name, int argc, char** argv, HostDraw draw) {
    const auto call = parse(argc, argv);
    if (!call) {
        return explain(name, argc, argv);
    }
    const auto drawn = drawInto(*call, draw);
    if (!drawn) {
        std::fprintf(stderr, "%s: %s\n", name, drawn.error().message().c_str());
        return static_cast<int>(drawn.error().code);
    }
    return 0;
}

void warn(const char* name, const HostCall& call, const core::Tally& leftOut) {
    for (const auto& [what, count] : leftOut.counts()) {
        std::fprintf(stderr, "%s: warning: %s: %s (%llu times)\n", name, call.scene.c_str(),
                     what.c_str(), static_cast<unsigned long long>(count));
    }
}

core::Image pictureOf(const HostCall& call, const std::uint8_t* bytes) {
    core::Image picture(call.width, call.height, 4);
    for (int y = call.height - 1; y >= 0; --y) {
        for (int x = 0; x < call.width; ++x) {
            for (int c = 0; c < 4; ++c) {
                picture.at(x, y)[c] = static_cast<float>(*bytes++) / 255.0f;
            }
        }
    }
    return picture;
}

} // namespace lodestar::samples

// SPDX-License-Identifier: MIT
//
// One load of a glTF file, by our loader or by tinygltf as it comes, for tests/bench/load.sh to
// measure from outside. Prints what was loaded; a step's milliseconds go to stderr.
#include <chrono>
#include <cstdio>
#include <string>

#include <tiny_gltf.h>

#include "io/gltf.h"
#include "scene/scene.h"

namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

int loadWithLodestar(const std::string& path) {
    const auto start = Clock::now();
    auto file = lodestar::io::loadGltf(path);
    if (!file) {
        std::fprintf(stderr, "bench-load: %s\n", file.error().message().c_str());
        return 3;
    }
    const double loaded = millisecondsSince(start);
    std::size_t bytes = 0;
    for (const auto& image : file->images) {
        bytes += image.bytes().size();
    }
    const lodestar::scene::Scene scene = lodestar::scene::buildScene(std::move(*file));
    std::fprintf(stderr, "file %.1f ms, scene %.1f ms\n", loaded,
                 millisecondsSince(start) - loaded);
    std::printf("%zu nodes, %zu image bytes\n", scene.nodes.size(), bytes);
    return 0;
}

int loadWithTinygltf(const std::string& path) {
    tinygltf::TinyGLTF loader;
    tinygltf::Model model;
    std::string error;
    std::string warning;
    const bool binary = path.ends_with(".glb");
    if (!(binary ? loader.LoadBinaryFromFile(&model, &error, &warning, path)
                 : loader.LoadASCIIFromFile(&model, &error, &warning, path))) {
        std::fprintf(stderr, "bench-load: %s: %s\n", path.c_str(), error.c_str());
        return 3;
    }
    std::size_t bytes = 0;
    for (const tinygltf::Image& image : model.images) {
        bytes += image.image.size();
    }
    std::printf("%zu nodes, %zu image bytes\n", model.nodes.size(), bytes);
    return 0;
}

} // namespace

int main(int count, char** words) {
    const std::string who = count == 3 ? words[1] : "";
    if (who != "lodestar" && who != "tinygltf") {
        std::fprintf(stderr, "usage: bench-load lodestar|tinygltf FILE\n");
        return 2;
    }
    return who == "lodestar" ? loadWithLodestar(words[2]) : loadWithTinygltf(words[2]);
}

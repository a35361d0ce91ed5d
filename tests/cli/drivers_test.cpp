// SPDX-License-Identifier: MIT
//
// One picture, two drivers: llvmpipe is bit-identical from run to run, and softpipe (OpenGL 3.3)
// shows the same scenes.
#include <filesystem>

#include <gtest/gtest.h>

#include "support/picture.h"
#include "support/run.h"
#include "support/shared.h"

namespace lodestar::testing {
namespace {

std::string ownScene(const TemporaryFolder& folder) {
    // A tilted square that shows its light: enough for drivers to disagree about.
    const std::string path = folder.file("square.gltf");
    const std::string text = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],
"nodes":[{"mesh":0,"rotation":[-0.35,0.2,0,0.9]},{"mesh":0,"translation":[0.5,0.6,-0.7],"scale":[0.7,0.7,0.7]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],
"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.9,0.6,0.3,1],"metallicFactor":0.6,"roughnessFactor":0.35},"doubleSided":true}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[-1,-1,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],
"buffers":[{"byteLength":60,"uri":"data:application/octet-stream;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAACAPwAAgD8AAAAAAACAvwAAgD8AAAAAAAABAAIAAAACAAMA"}]})";
    EXPECT_TRUE(io::writeFile(path, text.data(), text.size()).ok());
    return path;
}

core::Image render(const TemporaryFolder& folder, const std::string& scene, const char* driver,
                   const char* threads, const std::string& name, const std::string& environment) {
    const std::string picture = folder.file(name);
    std::vector<std::string> arguments = {"render", scene, "-o", picture, "--size", "240x180"};
    if (!environment.empty()) {
        arguments.insert(arguments.end(), {"--environment", environment});
    }
    const RunResult run = runLodestar(
        arguments,
        {std::string("GALLIUM_DRIVER=") + driver, std::string("LP_NUM_THREADS=") + threads}, 120.0);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err.find("OpenGL:"), std::string::npos) << run.err;
    return readPicture(picture);
}

TEST(Drivers, LlvmpipeIsBitIdenticalRunToRun) {
    const TemporaryFolder folder;
    const std::string scene = ownScene(folder);
    const core::Image first = render(folder, scene, "llvmpipe", "2", "a.exr", "");
    const core::Image second = render(folder, scene, "llvmpipe", "0", "b.exr", "");
    EXPECT_EQ(first.pixels(), second.pixels());
}

// Tolerance: 5 of 255 on all but 0.1 % of pixels: drivers round coverage at silhouettes and filter
// the three-face corner of a cube differently.
TEST(Drivers, SoftpipeShowsOwnScene) {
    const TemporaryFolder folder;
    const std::string scene = ownScene(folder);
    const core::Image llvmpipe = render(folder, scene, "llvmpipe", "2", "a.png", "");
    const core::Image softpipe = render(folder, scene, "softpipe", "2", "b.png", "");
    EXPECT_LE(compare(llvmpipe, softpipe, 5.0 / 255.0).failingFraction, 0.001);
}

// Real scenes under a smooth environment. Under a sharp HDR panorama the drivers differ more, for
// reasons of theirs (docs/testing.md): softpipe takes one of the three texels at a cube's corner
// where GL asks for their mean, and the drivers snap vertices to different sub-pixel grids, which
// turns the normals of slivers at silhouettes.
TEST(Drivers, SoftpipeShowsRealScenes) {
    LODESTAR_NEEDS_SHARED();
    const TemporaryFolder folder;
    for (const char* name :
         {"gltf/babylon/PBR_Spheres.glb", "gltf/vulkan-samples/teapot.gltf",
          "gltf/MaterialX/shaderball.glb", "gltf/babylon/blenderStudio/studio.gltf"}) {
        const std::string scene = (sharedPath("assets") / name).string();
        const core::Image llvmpipe =
            render(folder, scene, "llvmpipe", "2", "a.png", "gradient:0.1,1");
        const core::Image softpipe =
            render(folder, scene, "softpipe", "2", "b.png", "gradient:0.1,1");
        EXPECT_LE(compare(llvmpipe, softpipe, 5.0 / 255.0).failingFraction, 0.001) << name;
    }
}

} // namespace
} // namespace lodestar::testing

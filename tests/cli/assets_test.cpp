// SPDX-License-Identifier: MIT
//
// Files that no one here made, as a user would try them: what loads renders to a finite picture
// with the model in it, what is broken or beyond us is refused in one line, and nothing takes long.
#include <filesystem>
#include <set>

#include <gtest/gtest.h>

#include "support/picture.h"
#include "support/run.h"
#include "support/shared.h"

namespace lodestar::testing {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> filesBelow(const fs::path& folder,
                                    const std::set<std::string>& extensions) {
    std::vector<std::string> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file() && extensions.count(entry.path().extension().string()) > 0) {
            files.push_back(entry.path().string());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// Files that need what we lack, and the word that the refusal must contain.
const std::pair<const char*, const char*> kRefused[] = {
    {"heart_draco.glb", "KHR_draco_mesh_compression"},
    {"BoxDraco.gltf", "KHR_draco_mesh_compression"},
    {"BoxMeshopt.glb", "EXT_meshopt_compression"},
    {"ACMEBox.gltf", "ACME_gizmo"},
    {"Compatibility_04.gltf", "2.1"},
};

/// Files that hold nothing to see: empty scenes, and nodes without meshes.
const std::set<std::string> kNothingVisible = {"00_empty_scene.gltf", "two-scenes.gltf",
                                               "scene-transformation.gltf"};

void expectOneLine(const RunResult& run, const std::string& file) {
    ASSERT_EQ(run.errorLines().size(), 1u) << run.err;
    EXPECT_EQ(run.errorLines()[0].rfind("lodestar: ", 0), 0u) << run.errorLines()[0];
    EXPECT_NE(run.errorLines()[0].find(fs::path(file).filename().string()), std::string::npos)
        << "the message names no file: " << run.errorLines()[0];
}

TEST(Assets, EveryLoadableSceneShowsItsModelAndTheRestIsRefusedByName) {
    LODESTAR_NEEDS_SHARED();
    const TemporaryFolder folder;
    int rendered = 0;
    for (const std::string& file : filesBelow(sharedPath("assets/gltf"), {".gltf", ".glb"})) {
        SCOPED_TRACE(file);
        const std::string name = fs::path(file).filename().string();
        const std::string picture = folder.file("picture.exr");
        const RunResult run =
            runLodestar({"render", file, "-o", picture, "--size", "128x96", "--no-backdrop"});
        const auto* refused = std::find_if(std::begin(kRefused), std::end(kRefused),
                                           [&](const auto& entry) { return name == entry.first; });
        if (refused != std::end(kRefused)) {
            EXPECT_EQ(run.status, 3);
            expectOneLine(run, file);
            EXPECT_NE(run.err.find(refused->second), std::string::npos) << run.err;
            continue;
        }
        ASSERT_EQ(run.status, 0) << run.err;
        EXPECT_TRUE(run.errorLines().empty()) << run.err;
        const core::Image image = readPicture(picture);
        int covered = 0;
        for (std::size_t i = 0; i < image.pixels().size(); i += 4) {
            for (std::size_t c = 0; c < 4; ++c) {
                ASSERT_TRUE(std::isfinite(image.pixels()[i + c]));
            }
            covered += image.pixels()[i + 3] > 0.0f ? 1 : 0;
        }
        if (kNothingVisible.count(name) == 0) {
            EXPECT_GT(covered, 8) << "the model is not in the picture";
        }
        ++rendered;
    }
    EXPECT_GT(rendered, 45);
}

TEST(Assets, BrokenFilesEndInTwoSecondsWithoutACrash) {
    LODESTAR_NEEDS_SHARED();
    const TemporaryFolder folder;
    int tried = 0;
    for (const std::string& file :
         filesBelow(sharedPath("assets/invalid-gltf"), {".gltf", ".glb"})) {
        SCOPED_TRACE(file);
        const RunResult run = runLodestar({"render", file, "-o", folder.file("x.exr"), "--size",
                                           "64x64", "--environment-width", "32"},
                                          {}, 10.0);
        EXPECT_TRUE(run.status == 0 || run.status == 3) << run.status << " " << run.err;
        EXPECT_LT(run.seconds, 2.0);
        if (run.status == 3) {
            expectOneLine(run, file);
        }
        ++tried;
    }
    const std::string scene = sharedPath("assets/gltf/khronos/Box/glTF-Binary/Box.glb").string();
    for (const std::string& file :
         filesBelow(sharedPath("assets/malformed-images"), {".png", ".jpg", ".hdr", ".exr"})) {
        SCOPED_TRACE(file);
        const RunResult run = runLodestar(
            {"render", scene, "--environment", file, "-o", folder.file("x.exr"), "--size", "64x64"},
            {}, 10.0);
        EXPECT_EQ(run.status, 3) << run.err;
        EXPECT_LT(run.seconds, 2.0);
        expectOneLine(run, file);
        ++tried;
    }
    EXPECT_GE(tried, 40);
}

TEST(Assets, FurnaceOverRealScenes) {
    LODESTAR_NEEDS_SHARED();
    const TemporaryFolder folder;
    for (const char* name : {"gltf/babylon/PBR_Spheres.glb",
                             "gltf/khronos/NormalTangentTest/glTF-Binary/NormalTangentTest.glb",
                             "gltf/vulkan-samples/teapot.gltf", "gltf/MaterialX/shaderball.glb"}) {
        for (const char* material :
             {"diffuse=1,1,1,f0=0,0,0,exponent=40", "diffuse=0,0,0,f0=1,1,1,exponent=inf"}) {
            SCOPED_TRACE(std::string(name) + " " + material);
            const std::string picture = folder.file("furnace.exr");
            const RunResult run =
                runLodestar({"render", (sharedPath("assets") / name).string(), "-o", picture,
                             "--size", "160x120", "--environment", "constant:1,1,1",
                             "--no-backdrop", "--override-material", material});
            ASSERT_EQ(run.status, 0) << run.err;
            const core::Image image = readPicture(picture);
            int covered = 0;
            for (std::size_t i = 0; i < image.pixels().size(); i += 4) {
                if (image.pixels()[i + 3] > 0.0f) {
                    ++covered;
                    for (std::size_t c = 0; c < 3; ++c) {
                        ASSERT_NEAR(image.pixels()[i + c], 1.0f, 1e-3f);
                    }
                }
            }
            EXPECT_GT(covered, 500);
        }
    }
}

TEST(Assets, CubeAndLatLongOfOnePlaceLightASphereAlike) {
    LODESTAR_NEEDS_SHARED();
    // The two projections were resampled by their makers, so texels differ; a rough sphere averages
    // over them. The tolerance is theirs: their means differ by 0.1 %, and the exponent's lobe of
    // 40 degrees holds some 3,000 texels. A flipped or turned map differs by tens of per cent.
    const TemporaryFolder folder;
    const std::string scene = sharedPath("assets/gltf/babylon/PBR_Spheres.glb").string();
    for (const char* place : {"KernerEnv", "WavyLines"}) {
        core::Image images[2];
        const char* kinds[2] = {"LatLong", "Cube"};
        for (int i = 0; i < 2; ++i) {
            const std::string picture = folder.file(kinds[i]) + ".exr";
            const std::string environment =
                sharedPath("assets/hdr/openexr-images").string() + "/" + place + kinds[i] + ".exr";
            const RunResult run = runLodestar(
                {"render", scene, "-o", picture, "--size", "128x96", "--environment", environment,
                 "--no-backdrop", "--override-material", "diffuse=0,0,0,f0=1,1,1,exponent=16"});
            ASSERT_EQ(run.status, 0) << run.err;
            images[i] = readPicture(picture);
        }
        double sum = 0.0;
        int covered = 0;
        for (std::size_t i = 0; i < images[0].pixels().size(); i += 4) {
            covered += images[0].pixels()[i + 3] > 0.0f ? 1 : 0;
            sum += images[0].pixels()[i];
        }
        ASSERT_GT(covered, 500);
        const double mean = sum / covered;
        EXPECT_LT(compare(images[0], images[1], 0.0).largest, 0.05 * mean) << place;
    }
}

} // namespace
} // namespace lodestar::testing

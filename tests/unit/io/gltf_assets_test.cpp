// SPDX-License-Identifier: MIT
//
// Published files: what each holds, counted by a script from its JSON alone, or why it is refused.
#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "support/shared.h"
#include "unit/io/io_support.h"

namespace lodestar {
namespace {

struct Asset {
    const char* path;
    int nodes, meshes, triangles, lines, points, materials, images;
    const char* refusedAt; ///< beginning of the JSON pointer; empty where it loads
    const char* warning; ///< part of the one warning that must be there; empty where there is none
};

const Asset kAssets[] = {
    {"MaterialX/shaderball.glb", 2, 2, 88264, 0, 0, 1, 0, "", "FB_ngon_encoding"},
    {"assimp/textureTransform/TextureTransformTest.gltf", 12, 9, 18, 0, 0, 9, 5, "", ""},
    {"babylon/AssetGenerator/Animation_SkinType/Animation_SkinType_00.gltf", 3, 1, 4, 0, 0, 1, 0,
     "", ""},
    {"babylon/AssetGenerator/Animation_SkinType/Animation_SkinType_02.gltf", 3, 1, 4, 0, 0, 1, 0,
     "", ""},
    {"babylon/AssetGenerator/Buffer_Interleaved/Buffer_Interleaved_00.gltf", 1, 1, 2, 0, 0, 1, 1,
     "", ""},
    {"babylon/AssetGenerator/Buffer_Interleaved/Buffer_Interleaved_02.gltf", 1, 1, 2, 0, 0, 1, 1,
     "", ""},
    {"babylon/AssetGenerator/Buffer_Interleaved/Buffer_Interleaved_04.gltf", 1, 1, 2, 0, 0, 1, 1,
     "", ""},
    {"babylon/AssetGenerator/Compatibility/Compatibility_00.gltf", 1, 1, 2, 0, 0, 0, 0, "", ""},
    {"babylon/AssetGenerator/Compatibility/Compatibility_02.gltf", 1, 1, 2, 0, 0, 0, 0, "", ""},
    {"babylon/AssetGenerator/Compatibility/Compatibility_04.gltf", 1, 1, 2, 0, 0, 0, 0,
     "/asset/minVersion", ""},
    {"babylon/AssetGenerator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_00.gltf", 1, 1, 0, 0, 1024, 0, 0,
     "", ""},
    {"babylon/AssetGenerator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_02.gltf", 1, 1, 0, 4, 0, 0, 0,
     "", ""},
    {"babylon/AssetGenerator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_04.gltf", 1, 1, 2, 0, 0, 0, 0,
     "", ""},
    {"babylon/AssetGenerator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_06.gltf", 1, 1, 2, 0, 0, 0, 0,
     "", ""},
    {"babylon/AssetGenerator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_08.gltf", 1, 1, 0, 4, 0, 0, 0,
     "", ""},
    {"babylon/AssetGenerator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_10.gltf", 1, 1, 0, 4, 0, 0, 0,
     "", ""},
    {"babylon/AssetGenerator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_12.gltf", 1, 1, 2, 0, 0, 0, 0,
     "", ""},
    {"babylon/AssetGenerator/Mesh_PrimitiveMode/Mesh_PrimitiveMode_14.gltf", 1, 1, 2, 0, 0, 0, 0,
     "", ""},
    {"babylon/AssetGenerator/Mesh_PrimitiveVertexColor/Mesh_PrimitiveVertexColor_00.gltf", 1, 1, 2,
     0, 0, 1, 0, "", ""},
    {"babylon/AssetGenerator/Mesh_PrimitiveVertexColor/Mesh_PrimitiveVertexColor_02.gltf", 1, 1, 2,
     0, 0, 1, 0, "", ""},
    {"babylon/AssetGenerator/Mesh_PrimitiveVertexColor/Mesh_PrimitiveVertexColor_04.gltf", 1, 1, 2,
     0, 0, 1, 0, "", ""},
    {"babylon/PBR_Spheres.glb", 13, 12, 100320, 0, 0, 12, 12, "", ""},
    {"babylon/blenderStudio/studio.gltf", 33, 25, 18514, 0, 0, 6, 3, "", ""},
    {"bevy/SimpleSkin/SimpleSkin.gltf", 3, 1, 8, 0, 0, 0, 0, "", ""},
    {"blender-io/00_empty_scene/00_empty_scene.gltf", 1, 0, 0, 0, 0, 0, 0, "", ""},
    {"blender-io/00_no_scene/00_no_scene.gltf", 1, 1, 12, 0, 0, 1, 0, "", ""},
    {"gltf-transform/ACMEBox.gltf", 2, 1, 12, 0, 0, 1, 0, "/extensionsRequired/0", ""},
    {"gltf-transform/BoxDraco.gltf", 2, 1, 12, 0, 0, 1, 0, "/meshes/0/primitives/0/extensions", ""},
    {"gltf-transform/BoxMeshopt.glb", 1, 1, 12, 0, 0, 1, 0, "/extensionsRequired", ""},
    {"khronos/AnimatedCube/glTF/AnimatedCube.gltf", 1, 1, 12, 0, 0, 1, 2, "", ""},
    {"khronos/AnimatedMorphCube/glTF-Binary/AnimatedMorphCube.glb", 1, 1, 12, 0, 0, 1, 0, "", ""},
    {"khronos/AnimatedTriangle/glTF/AnimatedTriangle.gltf", 1, 1, 1, 0, 0, 0, 0, "", ""},
    {"khronos/BoomBoxWithAxes/glTF/BoomBoxWithAxes.gltf", 6, 5, 16688, 0, 0, 2, 5, "", ""},
    {"khronos/Box/glTF-Binary/Box.glb", 2, 1, 12, 0, 0, 1, 0, "", ""},
    {"khronos/Box/glTF-Embedded/Box.gltf", 2, 1, 12, 0, 0, 1, 0, "", ""},
    {"khronos/Box/glTF/Box.gltf", 2, 1, 12, 0, 0, 1, 0, "", ""},
    {"khronos/BoxInterleaved/glTF-Binary/BoxInterleaved.glb", 2, 1, 12, 0, 0, 1, 0, "", ""},
    {"khronos/BoxTextured/glTF/BoxTextured.gltf", 2, 1, 12, 0, 0, 1, 1, "", ""},
    {"khronos/Cameras/glTF/Cameras.gltf", 3, 1, 2, 0, 0, 0, 0, "", ""},
    {"khronos/NormalTangentTest/glTF-Binary/NormalTangentTest.glb", 2, 1, 7774, 0, 0, 1, 3, "", ""},
    {"khronos/RiggedSimple/glTF-Binary/RiggedSimple.glb", 5, 1, 188, 0, 0, 1, 0, "", ""},
    {"khronos/SimpleMeshes/glTF/SimpleMeshes.gltf", 2, 1, 1, 0, 0, 0, 0, "", ""},
    {"khronos/SimpleMorph/glTF/SimpleMorph.gltf", 1, 1, 1, 0, 0, 0, 0, "", ""},
    {"khronos/SimpleSparseAccessor/glTF/SimpleSparseAccessor.gltf", 1, 1, 12, 0, 0, 0, 0, "", ""},
    {"khronos/TextureCoordinateTest/glTF/TextureCoordinateTest.gltf", 6, 5, 10, 0, 0, 5, 1, "", ""},
    {"khronos/TextureSettingsTest/glTF-Binary/TextureSettingsTest.glb", 11, 10, 72, 0, 0, 10, 3, "",
     ""},
    {"khronos/Triangle/glTF/Triangle.gltf", 1, 1, 1, 0, 0, 0, 0, "", ""},
    {"khronos/TriangleWithoutIndices/glTF/TriangleWithoutIndices.gltf", 1, 1, 1, 0, 0, 0, 0, "",
     ""},
    {"khronos/TwoSidedPlane/glTF/TwoSidedPlane.gltf", 1, 1, 2, 0, 0, 1, 3, "", ""},
    {"magnum/scene-transformation.gltf", 7, 0, 0, 0, 0, 0, 0, "", "matrix counts"},
    {"magnum/two-scenes.gltf", 1, 0, 0, 0, 0, 0, 0, "", ""},
    {"nvpro/cornellBox.gltf", 11, 9, 16720, 0, 0, 9, 0, "", "image does not exist"},
    {"playcanvas/geometry-camera-light.glb", 6, 2, 14, 0, 0, 1, 0, "", ""},
    {"playcanvas/heart_draco.glb", 2, 1, 180, 0, 0, 1, 0, "/extensionsRequired/0", ""},
    {"playcanvas/vr-gallery.glb", 5, 1, 1930, 0, 0, 1, 2, "", ""},
    {"tinygltf/CubeImageUriSpaces/CubeImageUriSpaces.gltf", 1, 1, 12, 0, 0, 1, 1, "", ""},
    {"tinygltf/Extensions-issue97/test.gltf", 1, 1, 1, 0, 0, 1, 0, "", "VENDOR"},
    {"vulkan-samples/subpass_scene_opaque.gltf", 72, 12, 11132, 0, 0, 5, 0, "", "normal zero"},
    {"vulkan-samples/subpass_scene_transparent.gltf", 13, 5, 164, 0, 0, 1, 0, "", ""},
    {"vulkan-samples/teapot.gltf", 1, 1, 9128, 0, 0, 1, 0, "", ""},
};

std::size_t count(const io::GltfFile& file, io::Topology topology) {
    std::size_t sum = 0;
    for (const io::GltfMesh& mesh : file.meshes) {
        for (const io::GltfPrimitive& primitive : mesh.primitives) {
            sum += primitive.topology == topology
                       ? primitive.indices.size() / (static_cast<std::size_t>(topology) + 1)
                       : 0;
        }
    }
    return sum;
}

bool finite(const glm::vec4& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

void expectSound(const io::GltfPrimitive& primitive, const io::GltfFile& file) {
    const std::size_t n = primitive.positions.size();
    EXPECT_LT(primitive.material, static_cast<int>(file.materials.size()));
    for (const std::uint32_t index : primitive.indices) {
        ASSERT_LT(index, n);
    }
    EXPECT_TRUE(primitive.normals.size() == n ||
                (primitive.normals.empty() && primitive.topology != io::Topology::Triangles));
    EXPECT_TRUE(primitive.tangents.empty() || primitive.tangents.size() == n);
    EXPECT_TRUE(primitive.colors.empty() || primitive.colors.size() == n);
    for (const glm::vec3& p : primitive.positions) {
        ASSERT_TRUE(finite(glm::vec4(p, 0.0f)));
    }
    for (const glm::vec3& normal : primitive.normals) {
        // Normalised in double, rounded to float once a component.
        ASSERT_NEAR(glm::length(normal), 1.0f, 1e-6f);
    }
    for (const glm::vec4& tangent : primitive.tangents) {
        ASSERT_NEAR(glm::length(glm::vec3(tangent)), 1.0f, 1e-6f);
        ASSERT_EQ(std::abs(tangent.w), 1.0f);
    }
    for (const auto& uvs : primitive.uvs) {
        EXPECT_TRUE(uvs.empty() || uvs.size() == n);
        for (const glm::vec2& uv : uvs) {
            ASSERT_TRUE(finite(glm::vec4(uv, 0.0f, 0.0f)));
        }
    }
    for (const glm::vec4& color : primitive.colors) {
        ASSERT_TRUE(finite(color));
    }
    for (std::size_t set = 0; set < io::kInfluenceSets; ++set) {
        EXPECT_EQ(primitive.joints[set].size(), primitive.weights[set].size());
        EXPECT_TRUE(primitive.weights[set].empty() || primitive.weights[set].size() == n);
    }
    for (std::size_t i = 0; i < primitive.weights[0].size(); ++i) {
        glm::vec4 sum = primitive.weights[0][i];
        if (!primitive.weights[1].empty()) {
            sum += primitive.weights[1][i];
        }
        ASSERT_NEAR(sum.x + sum.y + sum.z + sum.w, 1.0f, 1e-6f); // eight roundings
    }
    const auto sized = [n](const std::vector<glm::vec3>& deltas, bool needed) {
        return deltas.empty() || (needed && deltas.size() == n);
    };
    for (const io::GltfMorphTarget& target : primitive.targets) {
        EXPECT_TRUE(sized(target.positions, true));
        EXPECT_TRUE(sized(target.normals, !primitive.normals.empty()));
        EXPECT_TRUE(sized(target.tangents, !primitive.tangents.empty()));
    }
}

/// Joints that vertices follow are joints of the skin.
void expectSound(const io::GltfNode& node, const io::GltfFile& file) {
    if (node.mesh == io::kNone) {
        EXPECT_EQ(node.skin, io::kNone);
        return;
    }
    const io::GltfMesh& mesh = file.meshes.at(static_cast<std::size_t>(node.mesh));
    EXPECT_TRUE(node.weights.empty() || node.weights.size() == mesh.weights.size());
    if (node.skin == io::kNone) {
        return;
    }
    const std::size_t joints = file.skins.at(static_cast<std::size_t>(node.skin)).joints.size();
    for (const io::GltfPrimitive& primitive : mesh.primitives) {
        for (const auto& set : primitive.joints) {
            for (const glm::u16vec4& four : set) {
                ASSERT_LT(std::max({four.x, four.y, four.z, four.w}), joints);
            }
        }
    }
}

void expectSound(const io::GltfAnimation& animation, const io::GltfFile& file) {
    for (const io::GltfAnimationChannel& channel : animation.channels) {
        const io::GltfNode& node = file.nodes.at(static_cast<std::size_t>(channel.node));
        const io::GltfAnimationSampler& sampler =
            animation.samplers.at(static_cast<std::size_t>(channel.sampler));
        const bool spline = sampler.interpolation == io::Interpolation::CubicSpline;
        ASSERT_FALSE(sampler.times.empty());
        EXPECT_EQ(sampler.values.size(),
                  sampler.times.size() * sampler.components * (spline ? 3U : 1U));
        EXPECT_TRUE(std::is_sorted(sampler.times.begin(), sampler.times.end()));
        if (channel.path == io::AnimationPath::Weights) {
            EXPECT_EQ(sampler.components,
                      file.meshes.at(static_cast<std::size_t>(node.mesh)).weights.size());
        } else {
            EXPECT_FALSE(node.hasMatrix);
            EXPECT_EQ(sampler.components, channel.path == io::AnimationPath::Rotation ? 4U : 3U);
        }
    }
}

void expectSound(const io::GltfFile& file) {
    for (const io::GltfMesh& mesh : file.meshes) {
        for (const io::GltfPrimitive& primitive : mesh.primitives) {
            expectSound(primitive, file);
            EXPECT_EQ(primitive.targets.size(), mesh.weights.size());
        }
    }
    for (const io::GltfSkin& skin : file.skins) {
        EXPECT_FALSE(skin.joints.empty());
        EXPECT_EQ(skin.inverseBind.size(), skin.joints.size());
        for (const int joint : skin.joints) {
            EXPECT_LT(static_cast<std::size_t>(joint), file.nodes.size());
        }
    }
    for (const io::GltfAnimation& animation : file.animations) {
        expectSound(animation, file);
    }
    for (const io::GltfTexture& texture : file.textures) {
        EXPECT_LT(texture.image, static_cast<int>(file.images.size()));
    }
    std::vector<bool> shown(file.images.size());
    for (const io::GltfTexture& texture : file.textures) {
        if (texture.image != io::kNone) {
            shown[static_cast<std::size_t>(texture.image)] = true;
        }
    }
    for (const io::GltfEnvironment& environment : file.environments) {
        for (const int face : environment.faces) {
            shown[static_cast<std::size_t>(face)] = true;
        }
    }
    for (std::size_t i = 0; i < file.images.size(); ++i) {
        EXPECT_EQ(file.images[i].empty(), !shown[i]) << i;
    }
    for (std::size_t i = 0; i < file.nodes.size(); ++i) {
        const io::GltfNode& node = file.nodes[i];
        EXPECT_LT(node.mesh, static_cast<int>(file.meshes.size()));
        EXPECT_LT(node.camera, static_cast<int>(file.cameras.size()));
        EXPECT_LT(node.light, static_cast<int>(file.lights.size()));
        expectSound(node, file);
        for (glm::length_t c = 0; c < 4; ++c) {
            EXPECT_TRUE(finite(node.matrix[c]));
        }
        for (const int child : node.children) {
            EXPECT_EQ(file.nodes[static_cast<std::size_t>(child)].parent, static_cast<int>(i));
        }
    }
    EXPECT_LT(file.defaultScene, static_cast<int>(file.scenes.size()));
}

TEST(GltfAssets, EachLoadsOrIsRefusedAsItSays) {
    LODESTAR_NEEDS_SHARED();
    for (const Asset& asset : kAssets) {
        SCOPED_TRACE(asset.path);
        const std::filesystem::path path = testing::sharedPath("assets/gltf") / asset.path;
        const double patience = std::numeric_limits<double>::infinity(); // they are large
        const core::Result<io::GltfFile> file = testing::loadAndCheck(path, {}, patience);
        if (*asset.refusedAt != '\0') {
            ASSERT_FALSE(file.ok());
            testing::expectOneLine(file.error(), path.string());
            EXPECT_EQ(file.error().where.rfind(asset.refusedAt, 0), 0U) << file.error().message();
            continue;
        }
        ASSERT_TRUE(file.ok()) << file.error().message();
        EXPECT_EQ(file->nodes.size(), static_cast<std::size_t>(asset.nodes));
        EXPECT_EQ(file->meshes.size(), static_cast<std::size_t>(asset.meshes));
        EXPECT_EQ(count(*file, io::Topology::Triangles), static_cast<std::size_t>(asset.triangles));
        EXPECT_EQ(count(*file, io::Topology::Lines), static_cast<std::size_t>(asset.lines));
        EXPECT_EQ(count(*file, io::Topology::Points), static_cast<std::size_t>(asset.points));
        EXPECT_EQ(file->materials.size(), static_cast<std::size_t>(asset.materials));
        EXPECT_EQ(file->images.size(), static_cast<std::size_t>(asset.images));
        const auto& warnings = file->warnings.counts();
        const bool said = std::any_of(warnings.begin(), warnings.end(), [&](const auto& entry) {
            return entry.first.find(asset.warning) != std::string::npos;
        });
        EXPECT_EQ(said, *asset.warning != '\0')
            << (warnings.empty() ? "" : warnings.begin()->first);
        expectSound(*file);
    }
}

TEST(GltfAssets, NoneIsForgotten) {
    LODESTAR_NEEDS_SHARED();
    std::size_t found = 0;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(testing::sharedPath("assets/gltf"))) {
        const std::string extension = entry.path().extension().string();
        found += extension == ".gltf" || extension == ".glb" ? 1U : 0U;
    }
    EXPECT_EQ(found, std::size(kAssets));
}

TEST(GltfAssets, InvalidFilesGiveAPointerOrACountedRepair) {
    LODESTAR_NEEDS_SHARED();
    // Those that may load, with the warning that must be counted; "" where what is broken is not
    // used.
    const std::pair<const char*, const char*> repaired[] = {
        {"invalid_elements_float.gltf", ""},
        {"spot_invalid_angles.gltf", "inner"},
        {"invalid_image_data.gltf", ""},
        {"unresolved_basecolor.gltf", "texture"}};
    int count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(
             testing::sharedPath("assets/invalid-gltf"))) {
        const std::filesystem::path& path = entry.path();
        if (path.extension() != ".gltf" && path.extension() != ".glb") {
            continue;
        }
        ++count;
        SCOPED_TRACE(path.string());
        const core::Result<io::GltfFile> file = testing::loadAndCheck(path);
        const auto known =
            std::find_if(std::begin(repaired), std::end(repaired),
                         [&](const auto& pair) { return path.filename() == pair.first; });
        ASSERT_EQ(file.ok(), known != std::end(repaired));
        if (!file) {
            testing::expectOneLine(file.error(), path.string());
            const bool json = file.error().what.find("JSON") != std::string::npos;
            EXPECT_TRUE(json || !file.error().where.empty()) << file.error().message();
        } else {
            expectSound(*file);
            std::string all;
            for (const auto& [rule, times] : file->warnings.counts()) {
                all += rule;
            }
            EXPECT_NE(all.find(known->second), std::string::npos) << all;
        }
    }
    EXPECT_EQ(count, 28);
}

TEST(GltfAssets, EveryFormOfTheBoxIsTheSame) {
    LODESTAR_NEEDS_SHARED();
    const std::filesystem::path folder = testing::sharedPath("assets/gltf/khronos/Box");
    std::vector<io::GltfPrimitive> boxes;
    for (const char* name : {"glTF/Box.gltf", "glTF-Embedded/Box.gltf", "glTF-Binary/Box.glb"}) {
        const auto file = io::loadGltf(folder / name);
        ASSERT_TRUE(file.ok()) << name;
        boxes.push_back(file->meshes.at(0).primitives.at(0));
    }
    for (const io::GltfPrimitive& box : boxes) {
        EXPECT_EQ(box.positions, boxes[0].positions);
        EXPECT_EQ(box.normals, boxes[0].normals);
        EXPECT_EQ(box.indices, boxes[0].indices);
    }
}

TEST(GltfAssets, AnAssetRootAboveOpensParentFolders) {
    LODESTAR_NEEDS_SHARED();
    const std::filesystem::path root = testing::sharedPath("assets/gltf");
    EXPECT_TRUE(io::loadGltf(root / "khronos/Box/glTF/Box.gltf", {root}).ok());
    EXPECT_FALSE(io::loadGltf(root / "khronos/Box/glTF/Box.gltf", {root / "khronos/Cameras"}).ok());
}

} // namespace
} // namespace lodestar

// SPDX-License-Identifier: MIT
//
// The renderer's promises: deterministic, finite, tiles without seams, counted work.
#include <cmath>
#include <limits>

#include "lighting/environment.h"
#include "lodestar/display.glsl"
#include "scene/renderer.h"
#include "support/gl_fixture.h"
#include "support/shapes.h"

namespace lodestar {
namespace {

class Rendering : public testing::GlTest {
protected:
    static scene::RenderSettings small(int width = 96, int height = 96) {
        scene::RenderSettings settings;
        settings.width = width;
        settings.height = height;
        return settings;
    }
    std::unique_ptr<scene::Renderer> renderer(const scene::Scene& scene, int width = 64) {
        auto made = scene::Renderer::make(device(), scene);
        EXPECT_TRUE(made.ok());
        (*made)->setEnvironment("sky",
                                lighting::cubeFromAnalytic(lighting::ClearSkyEnvironment{}, width));
        return std::move(*made);
    }
};

TEST_F(Rendering, SameFrameTwiceIsBitIdentical) {
    const scene::Scene scene = scene::buildScene(testing::fileOf(
        testing::sphere(), testing::blinnPhong({0.5, 0.2, 0.1}, glm::vec3(0.04f), 40.0f)));
    const scene::View view = testing::frontView(scene);
    auto first = renderer(scene)->render(view, small());
    auto second = renderer(scene)->render(view, small());
    ASSERT_TRUE(first.ok() && second.ok());
    EXPECT_EQ(first->radiance.pixels(), second->radiance.pixels());
}

TEST_F(Rendering, TilesJoinWithoutSeams) {
    // Two tiles high, against the same picture drawn in parts that fit one tile: every pixel whose
    // footprint does not touch the border is the same sample, up to the tile's projection rounding.
    const scene::Scene scene = scene::buildScene(testing::fileOf(
        testing::sphere(), testing::blinnPhong({0.7, 0.7, 0.7}, glm::vec3(0.04f), 8.0f)));
    const scene::View view = testing::frontView(scene);
    auto made = renderer(scene, 32);
    auto tall = made->render(view, small(16, 2600));
    ASSERT_TRUE(tall.ok());
    // The sphere is smooth: neighbouring rows across row 2048 differ no more than rows elsewhere.
    const auto step = [&](int y) {
        float largest = 0.0f;
        for (int x = 0; x < 16; ++x) {
            for (int c = 0; c < 3; ++c) {
                largest = std::max(
                    largest, std::abs(tall->radiance.at(x, y)[c] - tall->radiance.at(x, y - 1)[c]));
            }
        }
        return largest;
    };
    float elsewhere = 0.0f;
    for (int y = 2000; y < 2040; ++y) {
        elsewhere = std::max(elsewhere, step(y));
    }
    EXPECT_LE(step(2048), 2.0f * elsewhere + 1e-5f);
    EXPECT_GT(tall->radiance.at(8, 1300)[3], 0.0f);
}

TEST_F(Rendering, SecondFramePreparesAndCompilesNothing) {
    const scene::Scene scene = scene::buildScene(testing::fileOf(
        testing::sphere(), testing::blinnPhong({0.5, 0.5, 0.5}, glm::vec3(0.04f), 8.0f)));
    auto made = renderer(scene);
    const scene::View view = testing::frontView(scene);
    auto first = made->render(view, small());
    auto second = made->render(view, small());
    ASSERT_TRUE(first.ok() && second.ok());
    EXPECT_TRUE(first->plan->runs("tent-mips"));
    EXPECT_TRUE(first->plan->runs("irradiance"));
    EXPECT_FALSE(second->plan->runs("tent-mips"));
    EXPECT_FALSE(second->plan->runs("irradiance"));
    EXPECT_EQ(second->counters.shaderCompilations, 0u);
    EXPECT_EQ(second->counters.draws, 2u);          // the sphere and the backdrop
    EXPECT_LT(second->counters.uploadBytes, 8192u); // uniform blocks only
    EXPECT_EQ(second->counters.stateQueries, 0u);
}

TEST_F(Rendering, WhatNothingVisibleCallsForIsNotDone) {
    const scene::Scene scene = scene::buildScene(testing::fileOf(
        testing::sphere(), testing::blinnPhong({0.5, 0.5, 0.5}, glm::vec3(0.04f), 8.0f)));
    auto made = renderer(scene);
    scene::CameraRequest away;
    away.eye = glm::vec3(0.0f, 0.0f, 3.0f);
    away.target = glm::vec3(0.0f, 0.0f, 9.0f);
    scene::RenderSettings settings = small();
    settings.backdrop = false;
    auto frame = made->render(*scene::chooseView(scene, away, 1.0f), settings);
    ASSERT_TRUE(frame.ok());
    EXPECT_EQ(frame->counters.draws, 0u);
    EXPECT_EQ(frame->counters.shaderCompilations, 0u);
    EXPECT_FALSE(frame->plan->runs("tent-mips"));
    EXPECT_FALSE(frame->plan->runs("irradiance"));
    for (float value : frame->radiance.pixels()) {
        ASSERT_EQ(value, 0.0f);
    }
}

TEST_F(Rendering, RadianceAboveHalfFloatsRangeIsKept) {
    // A mirror under a constant 1e6, and a lamp of 1e9 in the dark.
    const scene::Scene scene = scene::buildScene(
        testing::fileOf(testing::square(), testing::blinnPhong({}, glm::vec3(1.0f), 1e7f)));
    auto made = renderer(scene);
    for (const double radiance : {1e6, 1e9}) {
        made->setEnvironment(
            "bright",
            lighting::cubeFromAnalytic(lighting::ConstantEnvironment{glm::dvec3(radiance)}, 16));
        auto frame = made->render(testing::frontView(scene), small());
        ASSERT_TRUE(frame.ok());
        EXPECT_NEAR(frame->radiance.at(48, 48)[0] / radiance, 1.0, 1e-3);
        EXPECT_EQ(frame->repairedPixels, 0u);
    }
}

TEST_F(Rendering, NormalMapTiltsTowardsItsColours) {
    // A flat normal map of (+x, 0, +z)/sqrt 2 on a mirror facing +Z reflects +X; of +y reflects +Y.
    const lighting::FacesEnvironment faces{{glm::dvec3(1, 0, 0), glm::dvec3(0), glm::dvec3(0, 1, 0),
                                            glm::dvec3(0), glm::dvec3(0), glm::dvec3(0)}};
    const float tilt = 0.5f + 0.5f * std::sqrt(0.5f);
    for (const bool up : {false, true}) {
        io::GltfMaterial material = testing::blinnPhong({}, glm::vec3(1.0f), 1e7f);
        material.normalTexture.texture = 0;
        io::GltfFile file = testing::fileOf(testing::square(), material);
        core::Texels normals(1, 1);
        const float texel[] = {up ? 0.5f : tilt, up ? tilt : 0.5f, tilt, 1.0f};
        for (int c = 0; c < 4; ++c) {
            normals.set(0, 0, c, texel[c]);
        }
        file.images.push_back(normals);
        file.textures.push_back({0, {}, {}, {}, {}, {}});
        const scene::Scene scene = scene::buildScene(std::move(file));
        auto made = scene::Renderer::make(device(), scene);
        ASSERT_TRUE(made.ok());
        (*made)->setEnvironment("faces", lighting::cubeFromAnalytic(faces, 64));
        auto frame = (*made)->render(testing::frontView(scene, 30.0f), small());
        ASSERT_TRUE(frame.ok());
        const float* center = frame->radiance.at(48, 48);
        EXPECT_GT(center[up ? 1 : 0], 0.9f) << (up ? "up" : "right");
        EXPECT_LT(center[up ? 0 : 1], 0.1f) << (up ? "up" : "right");
    }
}

TEST_F(Rendering, UnlitIsItsBaseColourAndAsksForNothing) {
    io::GltfMaterial material;
    material.unlit = true;
    material.baseColor = {0.25f, 0.5f, 0.75f, 1.0f};
    material.emissive = glm::vec3(5.0f); // no part of an unlit surface
    const scene::Scene scene = scene::buildScene(testing::fileOf(testing::square(), material));
    scene::RenderSettings settings = small();
    settings.backdrop = false;
    auto frame = renderer(scene)->render(testing::frontView(scene), settings);
    ASSERT_TRUE(frame.ok());
    const float* center = frame->radiance.at(48, 48);
    for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(center[c], material.baseColor[c]);
    }
    EXPECT_FALSE(frame->plan->runs("tent-mips"));
    EXPECT_FALSE(frame->plan->runs("irradiance"));
    EXPECT_LT(frame->counters.uploadBytes, 8192u); // uniform blocks only
}

TEST_F(Rendering, SpecularFactorAndIndexScaleF0) {
    // Black and seen head on under radiance 1, a surface shows its F0, but for the rise of Fresnel
    // at the view's few degrees and the lookup: 1e-3 of 1.
    struct Case {
        float ior, specular;
        glm::vec3 color;
        glm::vec3 f0;
    };
    const Case cases[] = {{1.5f, 1.0f, glm::vec3(1.0f), glm::vec3(0.04f)},
                          {1.5f, 0.0f, glm::vec3(1.0f), glm::vec3(0.0f)},
                          {3.0f, 0.5f, {1.0f, 0.5f, 8.0f}, {0.125f, 0.0625f, 0.5f}},
                          {0.0f, 1.0f, glm::vec3(1.0f), glm::vec3(1.0f)}};
    for (const Case& c : cases) {
        io::GltfMaterial material;
        material.metallic = 0.0f;
        material.roughness = 0.2f;
        material.baseColor = {0.0f, 0.0f, 0.0f, 1.0f};
        material.ior = c.ior;
        material.specular = c.specular;
        material.specularColor = c.color;
        const scene::Scene scene = scene::buildScene(testing::fileOf(testing::square(), material));
        auto made = renderer(scene);
        made->setEnvironment("white", lighting::cubeFromAnalytic(
                                          lighting::ConstantEnvironment{glm::dvec3(1.0)}, 16));
        auto frame = made->render(testing::frontView(scene, 30.0f), small());
        ASSERT_TRUE(frame.ok());
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(frame->radiance.at(48, 48)[k], c.f0[k], 1e-3f) << c.ior;
        }
    }
}

TEST_F(Rendering, RoughMetalAloneIsLit) {
    // No surface is diffuse, but at exponent 0 the glossy lobe is Lambert's and reads irradiance.
    io::GltfMaterial material;
    material.baseColor = {0.5f, 0.25f, 1.0f, 1.0f};
    const scene::Scene scene = scene::buildScene(testing::fileOf(testing::square(), material));
    auto made = renderer(scene);
    made->setEnvironment(
        "white", lighting::cubeFromAnalytic(lighting::ConstantEnvironment{glm::dvec3(1.0)}, 16));
    auto frame = made->render(testing::frontView(scene, 30.0f), small());
    ASSERT_TRUE(frame.ok());
    EXPECT_TRUE(frame->plan->runs("irradiance"));
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(frame->radiance.at(48, 48)[c], material.baseColor[c], 1e-3f);
    }
}

TEST_F(Rendering, TexturesOfBothDepthsAreDecodedFromSrgb) {
    // Darker than the darkest step of 8 bits, which is 0 there, and between two steps.
    const float encoded[] = {0.001f, 0.5f, 0.9f, 1.0f};
    for (const core::SampleDepth depth : {core::SampleDepth::Bits8, core::SampleDepth::Bits16}) {
        io::GltfMaterial material;
        material.unlit = true;
        material.baseColorTexture.texture = 0;
        io::GltfFile file = testing::fileOf(testing::square(), material);
        core::Texels texels(1, 1, depth);
        for (int c = 0; c < 4; ++c) {
            texels.set(0, 0, c, encoded[c]);
        }
        file.images.push_back(texels);
        file.textures.push_back({0, {}, {}, {}, {}, {}});
        const scene::Scene scene = scene::buildScene(std::move(file));
        auto frame = renderer(scene)->render(testing::frontView(scene), small());
        ASSERT_TRUE(frame.ok());
        const float* center = frame->radiance.at(48, 48);
        for (int c = 0; c < 3; ++c) {
            const float expected = shader::lodestar_linearFromSrgb(texels.value(0, 0, c));
            // Half a step of 16 linear bits is 8e-6; of 8 bits the driver's own table, which GL
            // lets differ by half a step of 8 bits.
            EXPECT_NEAR(center[c], expected, depth == core::SampleDepth::Bits8 ? 2e-3f : 1e-5f);
        }
    }
}

TEST_F(Rendering, TextureTransformsMoveEachTexture) {
    // Left half black, right half white, moved by half a picture: what was right is left.
    for (const bool moved : {false, true}) {
        io::GltfMaterial material;
        material.unlit = true;
        material.baseColorTexture.texture = 0;
        if (moved) {
            material.baseColorTexture.uvTransform = glm::mat3x2(1, 0, 0, 1, 0.5f, 0);
        }
        io::GltfFile file = testing::fileOf(testing::square(), material);
        core::Texels halves(2, 1);
        halves.bytes() = {0, 0, 0, 255, 255, 255, 255, 255};
        file.images.push_back(halves);
        io::GltfTexture texture;
        texture.image = 0;
        texture.magnification = texture.minification = io::Filter::Nearest;
        texture.mip = io::MipFilter::None;
        file.textures.push_back(texture);
        const scene::Scene scene = scene::buildScene(std::move(file));
        auto frame = renderer(scene)->render(testing::frontView(scene), small());
        ASSERT_TRUE(frame.ok());
        EXPECT_EQ(frame->radiance.at(30, 48)[0], moved ? 1.0f : 0.0f);
        EXPECT_EQ(frame->radiance.at(66, 48)[0], moved ? 0.0f : 1.0f);
    }
}

/// A square whose normal map, turned by its transform or in its coordinates, tilts each quarter
/// another way. Its tangents run with its coordinates.
scene::Scene bumpedSquare(bool byTransform, bool withTangents, float angle) {
    io::GltfPrimitive square = testing::square();
    const glm::mat3x2 turn(std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle),
                           0.1f, 0.2f);
    if (!byTransform) {
        for (glm::vec2& uv : square.uvs[0]) {
            uv = turn * glm::vec3(uv, 1.0f);
        }
    }
    if (withTangents) {
        const float turned = byTransform ? 0.0f : angle; // with v down the image
        square.tangents.assign(4, {std::cos(turned), -std::sin(turned), 0.0f, 1.0f});
    }
    io::GltfMaterial material = testing::blinnPhong(glm::vec3(0.5f), glm::vec3(0.5f), 30.0f);
    material.normalTexture.texture = 0;
    if (byTransform) {
        material.normalTexture.uvTransform = turn;
    }
    io::GltfFile file = testing::fileOf(square, material);
    core::Texels map(2, 2);
    map.bytes() = {200, 128, 220, 255, 128, 200, 220, 255, 60, 128, 220, 255, 128, 60, 220, 255};
    file.images.push_back(map);
    io::GltfTexture texture;
    texture.image = 0;
    texture.magnification = texture.minification = io::Filter::Nearest;
    texture.mip = io::MipFilter::None;
    file.textures.push_back(texture);
    return scene::buildScene(std::move(file));
}

// KHR_texture_transform moves where the map is read, and which way its bumps lean: as if the mesh
// had had the turned coordinates, and the tangents of those.
TEST_F(Rendering, ATurnedNormalMapIsReadAsByTurnedCoordinates) {
    for (const bool tangents : {false, true}) {
        const auto drawn = [&](bool byTransform, float angle) {
            const scene::Scene scene = bumpedSquare(byTransform, tangents, angle);
            auto frame = renderer(scene)->render(testing::frontView(scene), small());
            EXPECT_TRUE(frame.ok());
            return frame->radiance.pixels();
        };
        const std::vector<float> transformed = drawn(true, 0.6f);
        const std::vector<float> turned = drawn(false, 0.6f);
        int differing = 0; // texel edges may fall on the other side of a pixel's centre
        for (std::size_t i = 0; i < transformed.size(); ++i) {
            differing += std::abs(transformed[i] - turned[i]) > 1e-4f * (1.0f + turned[i]) ? 1 : 0;
        }
        EXPECT_LT(differing, static_cast<int>(transformed.size()) / 500) << tangents;
        const std::vector<float> straight = drawn(true, 0.0f);
        int moved = 0;
        for (std::size_t i = 0; i < transformed.size(); ++i) {
            moved += std::abs(transformed[i] - straight[i]) > 0.02f ? 1 : 0;
        }
        EXPECT_GT(moved, static_cast<int>(transformed.size()) / 50) << tangents;
    }
}

} // namespace
} // namespace lodestar

// SPDX-License-Identifier: MIT
//
// What a document gives of a material stands in place of that alone: textured roughness and
// metalness stay.
#include "lodestar/lobes.glsl"
#include "scene/renderer.h"
#include "support/gl_fixture.h"
#include "support/shapes.h"

namespace lodestar {
namespace {

constexpr int kTexels = 4;

/// A sphere whose base colour, roughness and metalness are textures.
/// @param roughness of all texels, 255ths; -1: each another
io::GltfFile textured(int roughness) {
    io::GltfMaterial material;
    material.baseColor = {0.9f, 0.8f, 0.7f, 1.0f};
    material.baseColorTexture.texture = 0;
    material.metallicRoughnessTexture.texture = 1;
    io::GltfFile file = testing::fileOf(testing::sphere(), material);
    core::Texels colors(kTexels, kTexels);
    core::Texels surface(kTexels, kTexels);
    for (int i = 0; i < kTexels * kTexels; ++i) {
        const auto at = static_cast<std::size_t>(4 * i);
        const std::uint8_t color[] = {static_cast<std::uint8_t>(255 - 13 * i),
                                      static_cast<std::uint8_t>(40 + 11 * i), 120, 255};
        const std::uint8_t values[] = {
            0, static_cast<std::uint8_t>(roughness >= 0 ? roughness : 60 + 10 * i),
            static_cast<std::uint8_t>(i % 3 == 0 ? 255 : 17 * (i % 5)), 255};
        std::copy_n(color, 4, colors.bytes().begin() + static_cast<std::ptrdiff_t>(at));
        std::copy_n(values, 4, surface.bytes().begin() + static_cast<std::ptrdiff_t>(at));
    }
    file.images = {colors, surface};
    file.textures.resize(2);
    file.textures[0].image = 0;
    file.textures[1].image = 1;
    return file;
}

class GivenMaterials : public testing::GlTest {
protected:
    core::Image picture(const scene::Scene& scene) {
        auto renderer = scene::Renderer::make(device(), scene);
        EXPECT_TRUE(renderer.ok());
        (*renderer)->setEnvironment(
            "faces",
            lighting::cubeFromAnalytic(*lighting::parseAnalytic("faces:1;0.2;3;0.1;0.5;2"), 32));
        scene::RenderSettings settings;
        settings.width = settings.height = 64;
        auto frame = (*renderer)->render(testing::frontView(scene), settings);
        EXPECT_TRUE(frame.ok());
        return frame->radiance;
    }
    static double greatest(const core::Image& a, const core::Image& b) {
        double most = 0.0;
        for (std::size_t i = 0; i < a.pixels().size(); ++i) {
            most = std::max(most, static_cast<double>(std::abs(a.pixels()[i] - b.pixels()[i])));
        }
        return most;
    }
};

// Where all texels are as rough, roughness is one exponent: giving it is the same picture, to the
// half floats of a light of 3.
TEST_F(GivenMaterials, AnExponentStandsInRoughnesssPlaceAlone) {
    constexpr int kRoughness = 102;
    const scene::Scene rough = scene::buildScene(textured(kRoughness));
    scene::Scene given = scene::buildScene(textured(-1));
    const core::Image before = picture(given);
    given.materials.front().exponent = shader::lodestar_exponentFromRoughness(kRoughness / 255.0f);
    const core::Image after = picture(given);
    EXPECT_LT(greatest(after, picture(rough)), 2e-3 * 3.0);
    EXPECT_GT(greatest(after, before), 0.05);
}

TEST_F(GivenMaterials, ReflectancesStandForThemselves) {
    scene::Scene scene = scene::buildScene(textured(150));
    const core::Image before = picture(scene);
    scene.materials.front().f0 = glm::vec3(0.0f);
    const core::Image without = picture(scene);
    scene.materials.front().f0.reset();
    scene.materials.front().diffuse = glm::vec3(0.0f);
    const core::Image glossy = picture(scene);
    scene.materials.front().f0 = glm::vec3(0.0f);
    const core::Image neither = picture(scene);
    // Fresnel's sum is not linear in F0, but the diffuse term is what it adds.
    EXPECT_GT(greatest(before, without), 0.05);
    EXPECT_GT(greatest(before, glossy), 0.05);
    EXPECT_GT(greatest(glossy, neither), 0.05);
    // A diffuse reflectance is multiplied by the base colour's texture, as a file's own is.
    scene::Scene direct = scene::buildScene(textured(150));
    io::GltfMaterial& material = direct.materials.front();
    material.blinnPhong =
        testing::blinnPhong({0.3f, 0.6f, 0.9f}, glm::vec3(0.1f), 20.0f).blinnPhong;
    scene.materials.front().diffuse = glm::vec3(0.3f, 0.6f, 0.9f);
    scene.materials.front().f0 = glm::vec3(0.1f);
    scene.materials.front().exponent = 20.0f;
    EXPECT_LT(greatest(picture(scene), picture(direct)), 2e-3 * 3.0);
}

} // namespace
} // namespace lodestar

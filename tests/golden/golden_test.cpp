// SPDX-License-Identifier: MIT
//
// Small pictures that must stay what they are. Each golden has three thresholds and a property that
// does not depend on the picture kept; each must fail against every other golden and against
// planted faults. `golden-pictures --update NAME` writes one anew: look at it before you commit it.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>

#include "lighting/environment.h"
#include "lodestar/lobes.glsl"
#include "scene/renderer.h"
#include "support/gl_fixture.h"
#include "support/picture.h"
#include "support/shapes.h"

namespace lodestar::testing {
namespace {

constexpr int kSide = 64;

/// A fault planted in the materials of a scene.
struct Fault {
    const char* name = "none";
    float exponentFactor = 1.0f; ///< of s
    float levelShift = 0.0f;     ///< mip levels: s + 1 is divided by 4 for each
    float diffuseFactor = 1.0f;
};

constexpr Fault kFaults[] = {
    {"exponent doubled", 2.0f, 0.0f, 1.0f},
    {"level + 1", 1.0f, 1.0f, 1.0f},
    {"divided by pi once more", 1.0f, 0.0f, 0.318309886f},
};

io::GltfMaterial material(const glm::vec3& diffuse, const glm::vec3& f0, float exponent,
                          const Fault& fault) {
    const float shifted = (exponent + 1.0f) * std::exp2(-2.0f * fault.levelShift) - 1.0f;
    return blinnPhong(diffuse * fault.diffuseFactor, f0,
                      std::max(shifted, 0.0f) * fault.exponentFactor);
}

/// Four shapes in a square, each in its own material.
io::GltfFile fourOf(const io::GltfPrimitive& shape,
                    const std::array<io::GltfMaterial, 4>& materials) {
    io::GltfFile file;
    for (int i = 0; i < 4; ++i) {
        io::GltfPrimitive part = shape;
        part.material = i;
        file.meshes.push_back({"shape", {part}, {}});
        file.materials.push_back(materials[static_cast<std::size_t>(i)]);
        io::GltfNode node;
        node.mesh = i;
        node.translation = {i % 2 == 0 ? -1.05f : 1.05f, i < 2 ? 1.05f : -1.05f, 0.0f};
        file.nodes.push_back(node);
    }
    file.scenes.push_back({"four", {0, 1, 2, 3}});
    file.defaultScene = 0;
    return file;
}

std::array<io::GltfMaterial, 4> fourMaterials(const Fault& fault) {
    const glm::vec3 gold(1.0f, 0.71f, 0.29f);
    return {material(glm::vec3(0.7f, 0.2f, 0.1f), glm::vec3(0.04f), 8.0f, fault),
            material(glm::vec3(0.1f, 0.3f, 0.6f), glm::vec3(0.2f), 120.0f, fault),
            material(glm::vec3(0.05f), gold, 30.0f, fault),
            material(glm::vec3(0.3f), glm::vec3(0.5f), 1000.0f, fault)};
}

scene::Scene fourSpheres(const Fault& fault) {
    return scene::buildScene(fourOf(sphere(32, 64), fourMaterials(fault)));
}

/// KHR_texture_transform: one picture of four colours, as it is, turned, scaled and moved.
scene::Scene transformed(const Fault& fault) {
    std::array<io::GltfMaterial, 4> materials;
    const glm::mat3x2 transforms[] = {glm::mat3x2(1.0f),
                                      glm::mat3x2(0.8f, -0.6f, 0.6f, 0.8f, 0.1f, 0.2f),
                                      glm::mat3x2(3.0f, 0.0f, 0.0f, 2.0f, 0.0f, 0.0f),
                                      glm::mat3x2(1.0f, 0.0f, 0.0f, 1.0f, 0.25f, 0.5f)};
    for (std::size_t i = 0; i < 4; ++i) {
        materials[i] = material(glm::vec3(0.9f), glm::vec3(0.1f), 30.0f, fault);
        materials[i].baseColorTexture.texture = 0;
        if (i > 0) {
            materials[i].baseColorTexture.uvTransform = transforms[i];
        }
    }
    io::GltfFile file = fourOf(square(), materials);
    core::Texels colors(2, 2);
    // 26 is 0.1, 230 is 0.9 of 255.
    colors.bytes() = {255, 26, 26, 255, 26, 255, 26, 255, 26, 26, 255, 255, 230, 230, 26, 255};
    file.images.push_back(colors);
    io::GltfTexture texture;
    texture.image = 0;
    texture.magnification = texture.minification = io::Filter::Nearest;
    texture.mip = io::MipFilter::None;
    file.textures.push_back(texture);
    return scene::buildScene(std::move(file));
}

/// KHR_materials_unlit: two of the four take no light.
scene::Scene unlit(const Fault& fault) {
    std::array<io::GltfMaterial, 4> materials = fourMaterials(fault);
    materials[0].unlit = materials[3].unlit = true;
    materials[0].baseColor = {0.9f, 0.5f, 0.1f, 1.0f};
    materials[3].baseColor = {0.1f, 0.2f, 0.8f, 1.0f};
    return scene::buildScene(fourOf(sphere(32, 64), materials));
}

/// Vertex colours: red and blue over the sphere's longitude, green over its height.
scene::Scene vertexColors(const Fault& fault) {
    io::GltfPrimitive shape = sphere(32, 64);
    for (const glm::vec3& p : shape.positions) {
        shape.colors.emplace_back(0.5f + 0.5f * p.x, 0.5f + 0.5f * p.y, 0.5f - 0.5f * p.x, 1.0f);
    }
    return scene::buildScene(fourOf(shape, fourMaterials(fault)));
}

/// KHR_materials_ior and _specular: none, water, diamond, and a coloured half.
scene::Scene dielectrics(const Fault& fault) {
    std::array<io::GltfMaterial, 4> materials;
    for (std::size_t i = 0; i < 4; ++i) {
        const float exponent = *material({}, {}, 40.0f, fault).blinnPhong->exponent;
        materials[i].metallic = 0.0f;
        materials[i].baseColor = {glm::vec3(0.3f) * fault.diffuseFactor, 1.0f};
        materials[i].roughness = shader::lodestar_roughnessFromExponent(exponent);
    }
    materials[0].specular = 0.0f;
    materials[1].ior = 1.33f;
    materials[2].ior = 2.42f;
    materials[3].ior = 2.42f;
    materials[3].specular = 0.5f;
    materials[3].specularColor = {2.0f, 1.0f, 0.2f};
    return scene::buildScene(fourOf(sphere(32, 64), materials));
}

/// Grey on white under a sky with a step at its horizon and a sun that the day moves and dims.
std::vector<lighting::DayLight> skyAndSun() {
    lighting::DayLight sky;
    sky.keys = {{12.0,
                 {{{90, {0.1, 0.25, 0.7}, 0},
                   {0, {0.8, 0.85, 0.9}, 0},
                   {0, {0.25, 0.2, 0.15}, 0},
                   {-90, {0.1, 0.08, 0.06}, 0}}},
                 glm::dvec3(1.0),
                 {}},
                {19.0,
                 {{{90, {0.1, 0.12, 0.35}, 0},
                   {0, {1.2, 0.6, 0.25}, 0},
                   {0, {0.1, 0.08, 0.07}, 0},
                   {-90, {0.04, 0.03, 0.03}, 0}}},
                 glm::dvec3(1.0),
                 {}}};
    lighting::DayLight sun;
    sun.kind = lighting::LightKind::Sun;
    const lighting::Gradient disc{
        {{0, {1, 1, 1}, 6}, {3, {1, 1, 1}, 6}, {3, {1, 1, 1}, 0}, {25, {0, 0, 0}, 0}}};
    sun.keys = {{12.0, disc, {1.0, 0.95, 0.9}, glm::normalize(glm::dvec3(0.3, 0.9, 0.6))},
                {19.0, disc, {1.0, 0.5, 0.2}, glm::normalize(glm::dvec3(-0.8, 0.15, 0.5))}};
    std::vector<lighting::DayLight> lights = {sky, sun};
    core::Tally warnings;
    for (lighting::DayLight& light : lights) {
        light = *lighting::repaired(light, warnings);
    }
    return lights;
}

struct Golden {
    const char* name;
    lighting::AnalyticEnvironment environment;
    const char* specular;
    const char* diffuse;
    bool backdrop;
    scene::Scene (*scene)(const Fault& fault) = fourSpheres;
    /// Thresholds on |a - b| / (1 + a): the largest a pixel may reach, the mean, and the share of
    /// pixels allowed beyond 1/255. Reasons in docs/testing.md.
    double largest = 0.5, mean = 1e-3, failing = 1e-3;
    std::vector<lighting::DayLight> (*lights)() = nullptr; ///< in the environment's place
    double hour = 12.0;
};

const lighting::FacesEnvironment kFaces{{glm::dvec3(1.5, 0.2, 0.1), glm::dvec3(0.1, 0.6, 0.2),
                                         glm::dvec3(0.2, 0.4, 1.6), glm::dvec3(0.3, 0.25, 0.2),
                                         glm::dvec3(0.9, 0.9, 0.8), glm::dvec3(0.02)}};

/// What bounds the pictures under skyAndSun(): its disc's radiance.
const lighting::ConstantEnvironment kDisc{glm::dvec3(64.0)};

const Golden kGoldens[] = {
    {"sky-tent-irradiance", lighting::ClearSkyEnvironment{}, "tent", "irradiance", true},
    {"sky-mip-lowest-mip", lighting::ClearSkyEnvironment{}, "mip", "lowest-mip", false},
    {"faces-mip-floor-sh9", kFaces, "mip-floor", "sh9", false},
    {"disc-tent-sh9",
     lighting::DiscEnvironment{glm::normalize(glm::dvec3(0.48, 0.6, 0.64)), 0.2, glm::dvec3(20.0),
                               glm::dvec3(0.1)},
     "tent", "sh9", true},
    {"texture-transform", kFaces, "tent", "irradiance", false, transformed},
    {"unlit", kFaces, "tent", "irradiance", false, unlit},
    {"vertex-colors", kFaces, "tent", "irradiance", false, vertexColors},
    {"ior-specular", kFaces, "tent", "irradiance", false, dielectrics},
    {"day-noon", kDisc, "tent", "irradiance", true, fourSpheres, 0.5, 1e-3, 1e-3, skyAndSun, 12.0},
    {"day-dusk", kDisc, "tent", "irradiance", true, fourSpheres, 0.5, 1e-3, 1e-3, skyAndSun, 18.5},
};

class Goldens : public GlTest {
public:
    static std::string path(const Golden& golden) {
        return std::string(LODESTAR_TEST_DATA "/golden/images/").append(golden.name).append(".exr");
    }
    core::Image render(const Golden& golden, const Fault& fault = {}) {
        const scene::Scene scene = golden.scene(fault);
        auto renderer = scene::Renderer::make(device(), scene);
        EXPECT_TRUE(renderer.ok());
        if (golden.lights != nullptr) {
            (*renderer)->setLights(golden.lights());
        } else {
            (*renderer)->setEnvironment(golden.name,
                                        lighting::cubeFromAnalytic(golden.environment, 64));
        }
        scene::RenderSettings settings;
        settings.hour = golden.hour;
        settings.width = settings.height = kSide;
        settings.backdrop = golden.backdrop;
        settings.specular = *lighting::parseEstimator(golden.specular, lighting::Term::Glossy);
        settings.diffuse = *lighting::parseEstimator(golden.diffuse, lighting::Term::Diffuse);
        auto frame = (*renderer)->render(frontView(scene, 6.5f), settings);
        EXPECT_TRUE(frame.ok());
        return std::move(frame->radiance);
    }
    void TestBody() override {}
    void start() { SetUp(); }
    void stop() { TearDown(); }
};

/// Differences relative to 1 + the golden's value, so that bright pixels do not rule.
Difference relative(const core::Image& golden, const core::Image& actual) {
    core::Image a = golden;
    core::Image b = actual;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        const float scale = 1.0f / (1.0f + golden.pixels()[i]);
        a.pixels()[i] *= scale;
        b.pixels()[i] *= scale;
    }
    return compare(a, b, 1.0 / 255.0);
}

bool passes(const Golden& golden, const core::Image& kept, const core::Image& actual) {
    const Difference d = relative(kept, actual);
    return d.largest <= golden.largest && d.mean <= golden.mean &&
           d.failingFraction <= golden.failing;
}

TEST_F(Goldens, PicturesAreAsKept) {
    for (const Golden& golden : kGoldens) {
        const core::Image kept = readPicture(path(golden));
        const core::Image actual = render(golden);
        const Difference d = relative(kept, actual);
        EXPECT_TRUE(passes(golden, kept, actual))
            << golden.name << ": largest " << d.largest << ", mean " << d.mean << ", beyond 1/255 "
            << d.failingFraction;
        if (!passes(golden, kept, actual)) {
            const std::string failed = std::string(golden.name) + "-actual.exr";
            EXPECT_TRUE(io::writeImage(failed, actual).ok());
        }
        // The property: light is neither made nor lost. No pixel is brighter than the environment's
        // brightest texel, none negative, and the mean lies between its darkest and brightest.
        const lighting::Cubemap map = lighting::cubeFromAnalytic(golden.environment, 64);
        float brightest = 0.0f;
        for (const glm::vec4& texel : map.level(0)) {
            brightest = std::max({brightest, texel.r, texel.g, texel.b});
        }
        const auto [low, high] =
            std::minmax_element(actual.pixels().begin(), actual.pixels().end());
        EXPECT_GE(*low, 0.0f) << golden.name;
        EXPECT_LE(*high, std::max(brightest, 1.0f) * 1.001f) << golden.name;
    }
}

TEST_F(Goldens, EachFailsAgainstEveryOtherAndAgainstPlantedFaults) {
    for (const Golden& golden : kGoldens) {
        const core::Image kept = readPicture(path(golden));
        for (const Golden& other : kGoldens) {
            if (&other != &golden) {
                EXPECT_FALSE(passes(golden, kept, readPicture(path(other))))
                    << golden.name << " " << other.name;
            }
        }
        for (const Fault& fault : kFaults) {
            const core::Image faulty = render(golden, fault);
            const Difference d = relative(kept, faulty);
            std::printf("%-22s %-24s mean %.5f, beyond 1/255 %.4f\n", golden.name, fault.name,
                        d.mean, d.failingFraction);
            EXPECT_FALSE(passes(golden, kept, faulty)) << golden.name << " " << fault.name;
        }
    }
}

int update(const char* name) {
    for (const Golden& golden : kGoldens) {
        if (std::strcmp(golden.name, name) == 0) {
            Goldens fixture;
            fixture.start();
            const auto written = io::writeImage(Goldens::path(golden), fixture.render(golden));
            fixture.stop();
            std::printf("%s: %s\n", name, written ? "written" : written.error().message().c_str());
            return written ? 0 : 1;
        }
    }
    std::printf("no golden '%s'\n", name);
    return 2;
}

} // namespace
} // namespace lodestar::testing

int main(int argc, char** argv) {
    if (argc == 3 && std::strcmp(argv[1], "--update") == 0) {
        return lodestar::testing::update(argv[2]);
    }
    ::testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}

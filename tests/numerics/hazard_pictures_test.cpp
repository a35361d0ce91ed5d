// SPDX-License-Identifier: MIT
//
// The hazards of docs/numerics.md on screen, where they can show: each picture beside one that the
// hazard cannot touch, or beside its closed form.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>

#include "lighting/day.h"
#include "lighting/environment.h"
#include "lighting/lookup.h"
#include "scene/renderer.h"
#include "support/gl_fixture.h"
#include "support/shapes.h"

namespace lodestar {
namespace {

constexpr int kSide = 48;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

scene::RenderSettings small(bool backdrop = false) {
    scene::RenderSettings settings;
    settings.width = settings.height = kSide;
    settings.backdrop = backdrop;
    return settings;
}

scene::Scene whiteSphere() {
    return scene::buildScene(testing::fileOf(
        testing::sphere(), testing::blinnPhong(glm::vec3(0.5f), glm::vec3(0.3f), 20.0f)));
}

bool allFinite(const core::Image& image) {
    return std::all_of(image.pixels().begin(), image.pixels().end(),
                       [](float value) { return std::isfinite(value); });
}

float largest(const core::Image& image) {
    float most = 0.0f;
    for (std::size_t i = 0; i < image.pixels().size(); i += 4) {
        most = std::max({most, image.pixels()[i], image.pixels()[i + 1], image.pixels()[i + 2]});
    }
    return most;
}

lighting::DayLight light(lighting::LightKind kind, std::vector<lighting::DayKey> keys,
                         const glm::dvec3& axis = {0.0, 1.0, 0.0}) {
    lighting::DayLight result;
    result.kind = kind;
    result.axis = axis;
    result.keys = std::move(keys);
    result.visibility = false;
    core::Tally warnings;
    return *lighting::repaired(result, warnings);
}

class HazardPictures : public testing::GlTest {
protected:
    std::unique_ptr<scene::Renderer> rendererOf(const scene::Scene& scene) {
        auto made = scene::Renderer::make(device(), scene);
        EXPECT_TRUE(made.ok());
        return std::move(*made);
    }
    core::Image shown(scene::Renderer& renderer, const scene::View& view,
                      const scene::RenderSettings& settings, std::uint64_t repaired = 0) {
        auto frame = renderer.render(view, settings);
        EXPECT_TRUE(frame.ok()) << frame.error().message();
        EXPECT_EQ(frame->repairedPixels, repaired);
        EXPECT_TRUE(allFinite(frame->radiance));
        return std::move(frame->radiance);
    }
    /// What a camera at the origin of an empty scene sees straight ahead.
    float ahead(scene::Renderer& renderer, const scene::Scene& empty, const glm::vec3& target,
                const scene::RenderSettings& settings) {
        scene::CameraRequest request;
        request.eye = glm::vec3(0.0f);
        request.target = target;
        request.verticalFov = 0.01f;
        return shown(renderer, *scene::chooseView(empty, request, 1.0f), settings)
            .at(kSide / 2, kSide / 2)[0];
    }
};

// 2, 3: an exponent that is none shows what the one does that it is repaired to, bit by bit.
TEST_F(HazardPictures, InvalidExponentsShowTheirRepair) {
    const scene::Scene scene = whiteSphere();
    const auto renderer = rendererOf(scene);
    const scene::View view = testing::frontView(scene);
    const std::vector<lighting::DayLight> sun{
        light(lighting::LightKind::Sun,
              {{12.0, {{{0, {9, 8, 7}, 0}, {30, {0, 0, 0}, 0}}}, glm::dvec3(1.0), {}}},
              glm::normalize(glm::dvec3(0.3, 0.4, 0.8)))};
    const auto picture = [&](float exponent) {
        scene::RenderSettings settings = small();
        settings.materialOverride =
            scene::MaterialOverride{glm::vec3(0.5f), glm::vec3(0.4f), exponent};
        return shown(*renderer, view, settings);
    };
    for (const bool lights : {false, true}) {
        renderer->setEnvironment("sky",
                                 lighting::cubeFromAnalytic(lighting::ClearSkyEnvironment{}, 32));
        renderer->setLights(lights ? sun : std::vector<lighting::DayLight>{});
        const core::Image rough = picture(0.0f);
        const core::Image mirror = picture(1e7f);
        EXPECT_NE(rough.pixels(), mirror.pixels());
        for (const float exponent : {kNan, -3.0f, -kInfinity}) {
            EXPECT_EQ(picture(exponent).pixels(), rough.pixels()) << exponent;
        }
        for (const float exponent : {1e30f, kInfinity}) {
            EXPECT_EQ(picture(exponent).pixels(), mirror.pixels()) << exponent;
        }
    }
}

// 4, 5, 6: the highlight of a lamp at the eye on a square, cos(angle)^s of the angle to its normal.
// The cosine's own steps of 6e-8 would be 0.3 % of the peak at s = 1e5, and more than all of it at
// 1e7. A point's place is off by 1e-6 m of 3.5 m: 3e-7 of the angle, which the power's slope, at
// most sqrt(s / e), makes 2e-4 of the peak at 1e7.
TEST_F(HazardPictures, SharpHighlightsOfALampHaveTheirClosedForm) {
    io::GltfFile file =
        testing::fileOf(testing::square(), testing::blinnPhong({}, glm::vec3(1.0f), 0.0f));
    io::GltfLight lamp;
    lamp.intensity = 10.0f;
    file.lights.push_back(lamp);
    io::GltfNode node;
    node.light = 0;
    node.translation = {0.0f, 0.0f, 3.5f};
    file.nodes.push_back(node);
    file.scenes[0].roots.push_back(1);
    const scene::Scene scene = scene::buildScene(file);
    const auto renderer = rendererOf(scene);
    renderer->setEnvironment("dark", lighting::Cubemap(4));
    for (const double s : {1e3, 1e5, 1e7}) {
        scene::RenderSettings settings = small();
        settings.materialOverride =
            scene::MaterialOverride{glm::vec3(0.0f), glm::vec3(1.0f), static_cast<float>(s)};
        scene::CameraRequest request;
        request.eye = glm::vec3(0.0f, 0.0f, 3.5f);
        request.target = glm::vec3(0.0f);
        const double half = 2.0 / std::sqrt(s); // to 13 % of the peak
        request.verticalFov = static_cast<float>(2.0 * half);
        const core::Image image =
            shown(*renderer, *scene::chooseView(scene, request, 1.0f), settings);
        const double peak = (s + 2.0) * (s + 4.0) /
                            (8.0 * std::numbers::pi * (std::exp2(-0.5 * s) + s)) * 10.0 /
                            (3.5 * 3.5);
        for (int x = 0; x < kSide; ++x) {
            const double tangent = std::tan(half) * (2.0 * (x + 0.5) / kSide - 1.0);
            const double up = std::tan(half) / kSide;
            const double squared = tangent * tangent + up * up;
            // Lamp and eye are one: h = v, and n.l and the distance are the plane's.
            const double expected =
                peak * std::exp(-0.5 * s * std::log1p(squared)) * std::pow(1.0 + squared, -1.5);
            EXPECT_NEAR(static_cast<double>(image.at(x, kSide / 2 - 1)[0]), expected, 1e-3 * peak)
                << s << " " << x;
        }
    }
}

// 7, 8: a sun of irradiance 10 within 0.2666 degrees has radiance 147020, beyond a half float.
TEST_F(HazardPictures, ASunsRadianceIsBeyondHalfFloats) {
    const scene::Scene empty = scene::buildScene(io::GltfFile{});
    const auto renderer = rendererOf(empty);
    for (const float radiance : {65504.0f, 65519.0f, 65520.0f, 147020.615f}) {
        renderer->setEnvironment(
            "lamp",
            lighting::cubeFromAnalytic(
                lighting::DiscEnvironment{
                    {0, 0, 1}, 0.5, glm::dvec3(static_cast<double>(radiance)), glm::dvec3(0.1)},
                32));
        // Stored with a scale, to a half float's eleven bits.
        EXPECT_NEAR(ahead(*renderer, empty, {0, 0, 1}, small(true)) / radiance, 1.0f, 0x1p-11f);
    }
}

// 9, 10: six faces with every kind of bad texel show what their repair shows.
TEST_F(HazardPictures, BadTexelsShowTheirRepair) {
    std::array<core::Image, 6> bad, good;
    for (std::size_t face = 0; face < 6; ++face) {
        bad[face] = core::Image(8, 8, 3);
        for (std::size_t i = 0; i < bad[face].pixels().size(); ++i) {
            bad[face].pixels()[i] = 0.1f + 0.01f * static_cast<float>(i % 17);
        }
        good[face] = bad[face];
        const float wrong[] = {kNan, -kInfinity, -0.0039f, kInfinity};
        const float right[] = {0.0f, 0.0f, 0.0f, 1e9f};
        for (std::size_t k = 0; k < 4; ++k) {
            bad[face].pixels()[31 * k + face] = wrong[k];
            good[face].pixels()[31 * k + face] = right[k];
        }
        core::Tally warnings;
        lighting::repairRadiance(bad[face], warnings);
        EXPECT_EQ(warnings.counts().size(), 3u);
    }
    const scene::Scene scene = whiteSphere();
    const auto renderer = rendererOf(scene);
    const scene::View view = testing::frontView(scene);
    renderer->setEnvironment("good", lighting::cubeFromFaces(good, 8));
    const core::Image expected = shown(*renderer, view, small(true));
    renderer->setEnvironment("bad", lighting::cubeFromFaces(bad, 8));
    EXPECT_EQ(shown(*renderer, view, small(true)).pixels(), expected.pixels());
    EXPECT_GT(largest(expected), 1e6f); // the repaired infinity is seen, and lights
}

// 12: a lamp lights a white sphere as brightly wherever it stands: the irradiance cube is within
// 0.5 % of the exact sum (docs/estimators.md). The published chain's last level holds 1.74 of a
// lamp at a corner and 0.63 of one at a centre.
TEST_F(HazardPictures, ALampIsAsBrightInAnyFace) {
    const scene::Scene scene = whiteSphere();
    const auto renderer = rendererOf(scene);
    const glm::vec3 axes[] = {{0, 0, 1},
                              {1, 0, 0},
                              {0, -1, 0},
                              glm::vec3(0.57735027f),
                              {-0.57735027f, 0.57735027f, -0.57735027f}};
    const auto light = [&](const glm::vec3& axis, const char* diffuse) {
        renderer->setEnvironment("lamp",
                                 lighting::cubeFromAnalytic(
                                     lighting::DiscEnvironment{glm::dvec3(axis), 0.0873,
                                                               glm::dvec3(100.0), glm::dvec3(0.05)},
                                     64));
        scene::RenderSettings settings = small();
        settings.diffuse = *lighting::parseEstimator(diffuse, lighting::Term::Diffuse);
        settings.materialOverride = scene::MaterialOverride{glm::vec3(1.0f), glm::vec3(0.0f), 0.0f};
        scene::CameraRequest request;
        request.eye = 3.5f * axis;
        request.target = glm::vec3(0.0f);
        request.verticalFov = 0.7f;
        const core::Image image =
            shown(*renderer, *scene::chooseView(scene, request, 1.0f), settings);
        double sum = 0.0;
        for (std::size_t i = 0; i < image.pixels().size(); i += 4) {
            sum += static_cast<double>(image.pixels()[i]);
        }
        return sum;
    };
    const double first = light(axes[0], "irradiance");
    for (const glm::vec3& axis : axes) {
        EXPECT_NEAR(light(axis, "irradiance") / first, 1.0, 2.0 * 0.005);
    }
    EXPECT_GT(light(axes[3], "lowest-mip") / light(axes[0], "lowest-mip"), 1.5);
}

// 15: faces of one texel, +X to -Z 1 to 6: where two meet, their mean, and three at the corner.
// Weights have eight bits on some drivers: 2^-8 of the range.
TEST_F(HazardPictures, FacesOfOneTexelMeet) {
    lighting::Cubemap cube(1);
    for (int face = 0; face < 6; ++face) {
        cube.texel(face, 0, 0) = glm::vec4(static_cast<float>(face + 1));
    }
    const scene::Scene empty = scene::buildScene(io::GltfFile{});
    const auto renderer = rendererOf(empty);
    renderer->setEnvironment("faces", cube);
    const float allowed = 5.0f / 256.0f + 0.01f; // and what half a pixel off the middle changes
    EXPECT_NEAR(ahead(*renderer, empty, {1, 1, 0}, small(true)), 2.0f, allowed);
    EXPECT_NEAR(ahead(*renderer, empty, {1, 1, 1}, small(true)), 3.0f, allowed);
    EXPECT_NEAR(ahead(*renderer, empty, {1, 0, 0}, small(true)), 1.0f, allowed);
}

// 16: a mirror that is flat, seen by a camera without perspective: one reflection, no footprint.
TEST_F(HazardPictures, AFlatMirrorHasNoFootprint) {
    const scene::Scene scene = scene::buildScene(
        testing::fileOf(testing::square(), testing::blinnPhong({}, glm::vec3(1.0f), 1e7f)));
    const auto renderer = rendererOf(scene);
    renderer->setEnvironment("sky",
                             lighting::cubeFromAnalytic(lighting::ClearSkyEnvironment{}, 64));
    scene::View view;
    view.perspective = false; // the square fills the picture
    view.towardsViewer = glm::normalize(glm::vec3(0.0f, 0.1f, 1.0f));
    for (const char* name : {"tent", "mip", "mip-floor", "bias:0"}) {
        scene::RenderSettings settings = small();
        settings.specular = *lighting::parseEstimator(name, lighting::Term::Glossy);
        const core::Image image = shown(*renderer, view, settings);
        const float* first = image.at(0, 0);
        EXPECT_GT(first[2], 0.0f) << name;
        for (std::size_t i = 0; i < image.pixels().size(); ++i) {
            ASSERT_EQ(image.pixels()[i], first[i % 4]) << name;
        }
    }
}

// 17, 18: a disc straight ahead, where r.l may be 1.0000001 and an arc cosine steps by 0.02
// degrees. Roots are halves: 2^-10.
TEST_F(HazardPictures, ADiscIsWholeAtItsAxis) {
    const scene::Scene empty = scene::buildScene(io::GltfFile{});
    const auto renderer = rendererOf(empty);
    for (const glm::dvec3& axis : {glm::dvec3(0, 0, 1), glm::normalize(glm::dvec3(1, 2, 3)),
                                   glm::normalize(glm::dvec3(-7, 1, 4))}) {
        renderer->setLights({light(
            lighting::LightKind::Sun,
            {{12.0, {{{0, glm::dvec3(1), 15}, {0.27, glm::dvec3(1), 15}}}, glm::dvec3(1.0), {}}},
            axis)});
        scene::CameraRequest request;
        request.eye = glm::vec3(0.0f);
        request.target = glm::vec3(axis);
        request.verticalFov = static_cast<float>(0.4 * std::numbers::pi / 180.0); // within the disc
        const core::Image image =
            shown(*renderer, *scene::chooseView(empty, request, 1.0f), small(true));
        for (int x = kSide / 4; x < 3 * kSide / 4; ++x) {
            EXPECT_NEAR(image.at(x, kSide / 2)[0], 32768.0f, 32768.0f * 0x1p-10f) << x;
        }
    }
}

// 19: normals of no length, and triangles without area.
TEST_F(HazardPictures, ZeroNormalsAreFinite) {
    io::GltfPrimitive shape = testing::sphere(16, 32);
    for (std::size_t i = 0; i < shape.normals.size(); i += 3) {
        shape.normals[i] = glm::vec3(0.0f);
    }
    shape.indices.insert(shape.indices.end(), {5, 5, 5, 7, 8, 8});
    io::GltfFile file =
        testing::fileOf(shape, testing::blinnPhong(glm::vec3(0.5f), glm::vec3(0.3f), 20.0f));
    io::GltfLight lamp;
    file.lights.push_back(lamp);
    io::GltfNode node;
    node.light = 0; // within the sphere: l = -n, and v = -l for some
    file.nodes.push_back(node);
    file.scenes[0].roots.push_back(1);
    const scene::Scene scene = scene::buildScene(file);
    const auto renderer = rendererOf(scene);
    renderer->setEnvironment("sky",
                             lighting::cubeFromAnalytic(lighting::ClearSkyEnvironment{}, 32));
    const core::Image image = shown(*renderer, testing::frontView(scene), small());
    EXPECT_GT(largest(image), 0.0f);
    for (glm::vec3& normal : file.meshes[0].primitives[0].normals) {
        normal = glm::vec3(0.0f);
    }
    const scene::Scene none = scene::buildScene(file);
    const auto second = rendererOf(none);
    second->setEnvironment("sky", lighting::cubeFromAnalytic(lighting::ClearSkyEnvironment{}, 32));
    shown(*second, testing::frontView(none), small());
}

// 23: a lamp of 10 degrees leaves nine coefficients negative on the far side; none is shown.
TEST_F(HazardPictures, RingingIsNotShown) {
    const scene::Scene scene = whiteSphere();
    const auto renderer = rendererOf(scene);
    const glm::dvec3 axis = glm::normalize(glm::dvec3(1.0, 0.2, -0.3));
    renderer->setEnvironment(
        "lamp", lighting::cubeFromAnalytic(
                    lighting::DiscEnvironment{axis, 0.17, glm::dvec3(100.0), glm::dvec3(0.0)}, 32));
    scene::RenderSettings settings = small();
    settings.diffuse = *lighting::parseEstimator("sh9", lighting::Term::Diffuse);
    settings.materialOverride = scene::MaterialOverride{glm::vec3(1.0f), glm::vec3(0.0f), 0.0f};
    const core::Image image = shown(*renderer, testing::frontView(scene), settings);
    int dark = 0;
    for (std::size_t i = 0; i < image.pixels().size(); i += 4) {
        ASSERT_GE(image.pixels()[i], 0.0f);
        dark += image.pixels()[i + 3] > 0.0f && image.pixels()[i] == 0.0f ? 1 : 0;
    }
    EXPECT_GT(dark, 20); // where they are clamped
}

// 28: two stops at one place are a step, the sky's at its horizon.
TEST_F(HazardPictures, AHorizonIsAStep) {
    const scene::Scene empty = scene::buildScene(io::GltfFile{});
    const auto renderer = rendererOf(empty);
    renderer->setLights({light(lighting::LightKind::Sky, {{12.0,
                                                           {{{90, glm::dvec3(3), 0},
                                                             {0, glm::dvec3(3), 0},
                                                             {0, glm::dvec3(1), 0},
                                                             {-90, glm::dvec3(1), 0}}},
                                                           glm::dvec3(1.0),
                                                           {}}})});
    scene::CameraRequest request;
    request.eye = glm::vec3(0.0f);
    request.target = glm::vec3(0.3f, 0.0f, 1.0f);
    request.verticalFov = 0.5f;
    const core::Image image =
        shown(*renderer, *scene::chooseView(empty, request, 1.0f), small(true));
    // Roots as halves: 2^-10; 2048 columns blur less than a pixel either side.
    for (int y = 0; y < kSide; ++y) {
        const float value = image.at(kSide / 2, y)[0];
        if (y != kSide / 2 - 1 && y != kSide / 2) {
            EXPECT_NEAR(value, y < kSide / 2 ? 3.0f : 1.0f, 3.0f * 0x1p-10f) << y;
        }
        EXPECT_GE(value, 0.99f);
        EXPECT_LE(value, 3.01f);
    }
}

// 29, 30, 31: hours beyond the day show those within; at a key's own hour nothing of a bright other
// one is left; a sun whose axis turns over is finite all the way.
TEST_F(HazardPictures, HoursWrapAndKeysAreTheirOwn) {
    const scene::Scene empty = scene::buildScene(io::GltfFile{});
    const auto renderer = rendererOf(empty);
    const auto key = [](double hour, double radiance, const glm::dvec3& axis) {
        return lighting::DayKey{hour,
                                {{{0, glm::dvec3(radiance), 0}, {60, glm::dvec3(radiance), 0}}},
                                glm::dvec3(1.0),
                                axis};
    };
    renderer->setLights(
        {light(lighting::LightKind::Sun,
               {key(1.0, 1e8, {0, 0, 1}), key(13.0, 1.0, {0, 0, 1}), key(22.0, 1.0, {0, 0, -1})})});
    const auto at = [&](double hour) {
        scene::RenderSettings settings = small(true);
        settings.hour = hour;
        return ahead(*renderer, empty, {0, 0, 1}, settings);
    };
    EXPECT_NEAR(at(13.0), 1.0f, 0x1p-9f);
    EXPECT_NEAR(at(1.0), 1e8f, 1e8f * 0x1p-9f);
    for (const double hour : {0.0, 7.25, 23.5}) {
        EXPECT_EQ(at(hour), at(hour + 24.0)) << hour;
        EXPECT_EQ(at(hour), at(hour - 48.0)) << hour;
    }
    // A nanohour before midnight is not the far end of the day.
    EXPECT_NEAR(at(-1e-9), at(0.0), at(0.0) * 0x1p-9f);
    EXPECT_NEAR(at(24.0 - 1e-9), at(0.0), at(0.0) * 0x1p-9f);
    // Halfway from +Z to -Z the disc of 60 degrees is a quarter turn away.
    EXPECT_EQ(at(17.5), 0.0f);
    EXPECT_GT(at(14.0), 0.5f);
}

} // namespace
} // namespace lodestar

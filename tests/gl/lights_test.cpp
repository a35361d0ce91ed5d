// SPDX-License-Identifier: MIT
//
// Skies and suns on screen: furnace, a sphere against double precision, shadows against rays, and
// that what has not changed costs nothing.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include "scene/renderer.h"
#include "support/exact_light.h"
#include "support/gl_fixture.h"
#include "support/shapes.h"

#include "sphere_pixels.h"

#include "lodestar/display.glsl"
#include "lodestar/sun.glsl"

namespace lodestar {
namespace {

using lighting::DayLight;
using lighting::LightKind;
using testing::ExactLight;
using testing::Lobe;
using testing::lobeOf;
using testing::SpherePixel;
using testing::spherePixels;

class Lights : public testing::GlTest {};

DayLight constantSky() {
    DayLight sky;
    sky.name = "sky";
    for (const double hour : {3.0, 9.5, 20.0}) {
        sky.keys.push_back({hour, {{{90.0, glm::dvec3(1.0), 0.0}}}, glm::dvec3(1.0), {}});
    }
    return sky;
}

DayLight paintedSky() {
    DayLight sky;
    sky.name = "sky";
    const lighting::Gradient noon{{{90, {0.1, 0.2, 0.6}, 0},
                                   {25, {0.3, 0.4, 0.7}, 0},
                                   {0, {0.9, 0.9, 0.8}, 0},
                                   {0, {0.2, 0.18, 0.15}, 0},
                                   {-90, {0.15, 0.14, 0.12}, 0}}};
    lighting::Gradient dusk = noon;
    dusk.stops[2].color = {1.2, 0.5, 0.2};
    sky.keys = {{12.0, noon, glm::dvec3(1.0), {}}, {19.0, dusk, {0.6, 0.5, 0.5}, {}}};
    return sky;
}

/// A disc of 0.27 degrees, and a glow that the layout's figures count too.
DayLight paintedSun(const glm::dvec3& axis) {
    DayLight sun;
    sun.name = "sun";
    sun.kind = LightKind::Sun;
    sun.axis = glm::normalize(axis);
    const lighting::Gradient disc{{{0, {1, 0.9, 0.8}, 15},
                                   {0.27, {1, 0.9, 0.8}, 15},
                                   {0.27, {1, 0.8, 0.6}, 3},
                                   {5, {1, 0.7, 0.4}, 0},
                                   {60, {0, 0, 0}, 0}}};
    sun.keys = {{12.0, disc, glm::dvec3(1.0), {}}, {19.0, disc, {0.5, 0.3, 0.1}, {}}};
    return sun;
}

std::vector<DayLight> inOrder(std::vector<DayLight> lights) {
    core::Tally warnings;
    for (DayLight& light : lights) {
        light = *lighting::repaired(light, warnings);
    }
    return lights;
}

scene::Scene whiteSphere(int rings) {
    return scene::buildScene(
        testing::fileOf(testing::sphere(rings, 2 * rings), testing::blinnPhong({}, {}, 0.0f)));
}

TEST_F(Lights, FurnaceShowsOne) {
    const scene::Scene scene = whiteSphere(48);
    auto renderer = scene::Renderer::make(device(), scene);
    ASSERT_TRUE(renderer.ok());
    scene::RenderSettings settings;
    settings.width = settings.height = 48;
    settings.backdrop = false;
    for (const lighting::RsrmLayout& layout :
         {lighting::kRsrm, lighting::kRsrmSmall, lighting::kRsrmReference}) {
        (*renderer)->setLights(inOrder({constantSky()}), layout);
        for (const double hour : {0.0, 3.0, 6.7, 12.0, 23.9}) {
            settings.hour = hour;
            for (const float exponent : {0.0f, 1.0f, 8.0f, 300.0f, 2048.0f, 1e5f, 1e7f}) {
                for (const bool mirror : {false, true}) {
                    settings.materialOverride = scene::MaterialOverride{
                        glm::vec3(mirror ? 0.0f : 1.0f), glm::vec3(mirror ? 1.0f : 0.0f), exponent};
                    auto frame = (*renderer)->render(testing::frontView(scene), settings);
                    ASSERT_TRUE(frame.ok()) << frame.error().message();
                    int covered = 0;
                    for (std::size_t i = 0; i < frame->radiance.pixels().size(); i += 4) {
                        if (frame->radiance.pixels()[i + 3] > 0.0f) {
                            ++covered;
                            ASSERT_NEAR(frame->radiance.pixels()[i], 1.0f, 1e-3f)
                                << hour << " h, exponent " << exponent;
                        }
                    }
                    EXPECT_GT(covered, 500);
                }
            }
        }
    }
}

/// A sun's radiance over the Blinn-Phong lobe, by the lookup that stands for it
/// (docs/derivations/sun.md).
double sunOver(const ExactLight& sun, double spread, const SpherePixel& pixel, double exponent) {
    const Lobe round = lobeOf(pixel, exponent);
    if (std::isinf(exponent)) {
        return sun.filtered(round.direction, exponent).g;
    }
    const shader_double::LodestarSunLookup looked = shader_double::lodestar_sunLookup(
        pixel.normal, pixel.view, exponent, round.direction, round.exponent, sun.axis, spread);
    return sun.filteredAt(2.0 * std::asin(looked.halfChord), looked.exponent).g;
}

/// How far a picture of the white sphere is from double precision, lit by the lobes that the
/// lookups ask for.
double worstError(const core::Image& picture, int side, const std::vector<DayLight>& lights,
                  double hour, double exponent) {
    const ExactLight sky(lights[0], hour);
    const ExactLight sun(lights[1], hour);
    const double spread = sun.spread();
    double worst = 0.0;
    int compared = 0;
    for (const SpherePixel& pixel : spherePixels(side)) {
        const Lobe lobe = lobeOf(pixel, exponent);
        if (std::isinf(exponent) &&
            (sky.toStep(lobe.direction, 0.5 * std::numbers::pi) < 0.002 ||
             sun.toStep(lobe.direction, 0.27 * std::numbers::pi / 180) < 0.002)) {
            continue; // a step falls within the pixel
        }
        const double expected =
            sky.filtered(lobe.direction, lobe.exponent).g + sunOver(sun, spread, pixel, exponent);
        const auto got = static_cast<double>(picture.at(pixel.x, pixel.y)[1]);
        worst = std::max(worst, std::abs(got - expected) / expected);
        ++compared;
    }
    EXPECT_GT(compared, 300);
    return worst;
}

// Of the value a texel of a sun's map is off by .112 at most in the default layout, .021 in the
// reference's (docs/derivations/rsrm.md's table), which shows that the rest is right.
TEST_F(Lights, ASphereEqualsDoublePrecision) {
    constexpr int kSide = 28;
    const scene::Scene scene = whiteSphere(256);
    auto renderer = scene::Renderer::make(device(), scene);
    ASSERT_TRUE(renderer.ok());
    const std::vector<DayLight> lights = inOrder({paintedSky(), paintedSun({0.5, 0.6, 0.7})});
    scene::RenderSettings settings;
    settings.width = settings.height = kSide;
    settings.backdrop = false;
    settings.hour = 14.5;
    const double infinity = std::numeric_limits<double>::infinity();
    for (const auto& [layout, bound] :
         {std::pair(lighting::kRsrm, 0.112), std::pair(lighting::kRsrmReference, 0.021)}) {
        (*renderer)->setLights(lights, layout);
        for (const double exponent : {0.0, 8.0, 64.0, 512.0, infinity}) {
            settings.materialOverride = scene::MaterialOverride{
                glm::vec3(0.0f), glm::vec3(1.0f), static_cast<float>(std::min(exponent, 1e7))};
            auto frame = (*renderer)->render(testing::frontView(scene), settings);
            ASSERT_TRUE(frame.ok());
            const double worst =
                worstError(frame->radiance, kSide, lights, settings.hour, exponent);
            std::printf("%d rows, exponent %g: worst %.4f of the value\n", layout.rows, exponent,
                        worst);
            EXPECT_LT(worst, bound) << "exponent " << exponent;
        }
    }
}

/// Radiance over the lobes of some pixels under a light at its keys, [key][pixel]: what moves in
/// between, the axis being fixed, is the blend.
std::vector<std::vector<double>> atKeys(const DayLight& light, const std::vector<Lobe>& lobes) {
    std::vector<std::vector<double>> values;
    for (const lighting::DayKey& key : light.keys) {
        const ExactLight exact(light, key.hour);
        values.emplace_back();
        for (const Lobe& lobe : lobes) {
            values.back().push_back(exact.filtered(lobe.direction, lobe.exponent).g);
        }
    }
    return values;
}

// In a picture exposed for its brightest pixel a minute moves a pixel by at most an eight-bit step
// more than the reference moves. Texels are rounded anew every minute, by at most 1/256 of the
// brightest channel's root: 0.8 % of the value, 1.055 / 2.4 of that in sRGB, 0.0034 where the value
// is 1.
TEST_F(Lights, AScrubOfADayMovesAsDoublePrecision) {
    constexpr int kSide = 16;
    const scene::Scene scene = whiteSphere(48);
    auto renderer = scene::Renderer::make(device(), scene);
    ASSERT_TRUE(renderer.ok());
    DayLight sun = paintedSun({0.5, 0.6, 0.7});
    sun.keys.push_back({23.5, sun.keys[0].gradient, {0.1, 0.2, 0.4}, {}});
    const std::vector<DayLight> lights = inOrder({paintedSky(), sun});
    (*renderer)->setLights(lights);
    scene::RenderSettings settings;
    settings.width = settings.height = kSide;
    settings.backdrop = false;
    settings.materialOverride = scene::MaterialOverride{glm::vec3(0.0f), glm::vec3(1.0f), 64.0f};
    const std::vector<SpherePixel> pixels = spherePixels(kSide);
    std::vector<Lobe> lobes;
    for (const SpherePixel& pixel : pixels) {
        lobes.push_back(lobeOf(pixel, 64.0));
    }
    const std::vector<std::vector<double>> keys[] = {atKeys(lights[0], lobes),
                                                     atKeys(lights[1], lobes)};
    const auto referenceAt = [&](double hour) {
        std::vector<double> values(pixels.size());
        for (std::size_t light = 0; light < 2; ++light) {
            const lighting::KeyBlend blend = lighting::momentAt(lights[light], hour).keys;
            for (std::size_t i = 0; i < values.size(); ++i) {
                values[i] += (1.0 - blend.t) * keys[light][blend.from][i] +
                             blend.t * keys[light][blend.to][i];
            }
        }
        return values;
    };
    double peak = 0.0;
    for (int hour = 0; hour < 24; ++hour) {
        const std::vector<double> values = referenceAt(hour);
        peak = std::max(peak, *std::max_element(values.begin(), values.end()));
    }
    const auto displayed = [&](double radiance) {
        return shader_double::lodestar_srgbFromLinear(radiance / peak);
    };
    std::vector<double> before, referenceBefore;
    double worst = 0.0, worstRadiance = 0.0, moved = 0.0;
    for (int minute = -1; minute < 24 * 60; ++minute) {
        settings.hour = std::fmod(minute / 60.0 + 24.0, 24.0);
        auto frame = (*renderer)->render(testing::frontView(scene), settings);
        ASSERT_TRUE(frame.ok());
        std::vector<double> now;
        for (const SpherePixel& pixel : pixels) {
            now.push_back(static_cast<double>(frame->radiance.at(pixel.x, pixel.y)[1]));
        }
        const std::vector<double> reference = referenceAt(settings.hour);
        for (std::size_t i = 0; i < before.size(); ++i) {
            const auto moreThan = [&](const auto& of) {
                return std::abs(of(now[i]) - of(before[i])) -
                       std::abs(of(reference[i]) - of(referenceBefore[i]));
            };
            worst = std::max(worst, moreThan(displayed));
            worstRadiance = std::max(worstRadiance, moreThan([](double value) { return value; }));
            moved = std::max(moved, std::abs(reference[i] - referenceBefore[i]));
        }
        before = now;
        referenceBefore = reference;
    }
    std::printf(
        "a minute moves a pixel by at most %.5f of the peak; by %.5f more than it should, by "
        "%.2f of an eight-bit step on a display\n",
        moved / peak, worstRadiance / peak, 255.0 * worst);
    EXPECT_GT(pixels.size(), 100u);
    EXPECT_GT(moved, 1e-4 * peak);
    EXPECT_LE(worst, 1.0 / 255.0);
}

std::vector<std::string> running(const plan::EffectPlan& plan) {
    std::vector<std::string> names;
    for (const plan::Effect& effect : plan.effects) {
        if (effect.decision == plan::Decision::Run && effect.effect != "draw") {
            names.push_back(effect.effect + " " + effect.subject);
        }
    }
    return names;
}

TEST_F(Lights, WhatHasNotChangedCostsNothing) {
    const scene::Scene scene = whiteSphere(32);
    auto renderer = scene::Renderer::make(device(), scene);
    ASSERT_TRUE(renderer.ok());
    DayLight sun = paintedSun({0.0, 1.0, 0.0});
    sun.path = lighting::SunPath{0.7, 172, {0.0, 0.0, -1.0}};
    (*renderer)->setLights(inOrder({paintedSky(), sun}));
    scene::RenderSettings settings;
    settings.width = settings.height = 32;
    const auto frameAt = [&](double hour) {
        settings.hour = hour;
        auto frame = (*renderer)->render(testing::frontView(scene), settings);
        EXPECT_TRUE(frame.ok());
        return std::move(*frame);
    };
    const scene::Frame noon = frameAt(13.0);
    EXPECT_TRUE(noon.plan->runs("rsrm-blend"));
    EXPECT_TRUE(noon.plan->runs("shadow-map"));
    const scene::Frame again = frameAt(13.0);
    EXPECT_EQ(running(*again.plan), (std::vector<std::string>{"backdrop lights"}));
    EXPECT_EQ(again.counters.passes, 1u);
    EXPECT_EQ(noon.counters.passes, 2u) << "the shadow map and the picture";
    // Night: the sky alone is blended, the sun has no map, no pass and no term.
    const scene::Frame night = frameAt(1.0);
    EXPECT_EQ(night.counters.passes, 1u);
    EXPECT_EQ(running(*night.plan),
              (std::vector<std::string>{"rsrm-blend sky", "backdrop lights"}));
    EXPECT_EQ(night.plan->rsrmLights.size(), 1u);
    EXPECT_LT(night.counters.uploadBytes, noon.counters.uploadBytes);
    // Over midnight nothing jumps: a minute moves the blend by 1/1020 of the keys' difference.
    const scene::Frame before = frameAt(23.999);
    const scene::Frame after = frameAt(0.001);
    for (std::size_t i = 0; i < before.radiance.pixels().size(); ++i) {
        ASSERT_NEAR(before.radiance.pixels()[i], after.radiance.pixels()[i], 2e-3f);
    }
}

/// A floor and a smaller square before it, seen from where the sun is not.
scene::Scene floorAndBlocker() {
    io::GltfFile file =
        testing::fileOf(testing::square(), testing::blinnPhong(glm::vec3(1.0f), {}, 0.0f));
    file.materials[0].doubleSided = true;
    file.nodes[0].scale = glm::vec3(2.0f);
    io::GltfNode blocker = file.nodes[0];
    blocker.name = "blocker";
    blocker.scale = glm::vec3(0.5f);
    blocker.translation = {0.0f, 0.0f, 1.0f};
    file.nodes.push_back(blocker);
    file.scenes[0].roots.push_back(1);
    return scene::buildScene(std::move(file));
}

TEST_F(Lights, ARepaintedLightUploadsItselfAloneAndLooksAsSetAnew) {
    const scene::Scene scene = whiteSphere(32);
    auto kept = scene::Renderer::make(device(), scene);
    auto anew = scene::Renderer::make(device(), scene);
    ASSERT_TRUE(kept.ok() && anew.ok());
    scene::RenderSettings settings;
    settings.width = settings.height = 32;
    settings.hour = 15.0;
    std::vector<DayLight> lights = {paintedSky(), paintedSun({0.4, 0.8, 0.3})};
    const auto uploads = [&](scene::Renderer& renderer) {
        auto frame = renderer.render(testing::frontView(scene), settings);
        EXPECT_TRUE(frame.ok());
        const auto ran = [&](const std::string& subject) {
            return std::count_if(frame->plan->effects.begin(), frame->plan->effects.end(),
                                 [&](const plan::Effect& effect) {
                                     return effect.effect == "rsrm-blend" &&
                                            effect.subject == subject &&
                                            effect.decision == plan::Decision::Run;
                                 });
        };
        return std::pair(std::pair(ran("sky"), ran("sun")), frame->radiance.pixels());
    };
    (*kept)->setLights(inOrder(lights));
    EXPECT_EQ(uploads(**kept).first, std::pair(1L, 1L));
    (*kept)->setLights(inOrder(lights));
    EXPECT_EQ(uploads(**kept).first, std::pair(0L, 0L)) << "nothing was painted";
    lights[0].keys[1].gradient.stops[0].color = {0.0, 2.0, 0.0};
    (*kept)->setLights(inOrder(lights));
    (*anew)->setLights(inOrder(lights));
    const auto painted = uploads(**kept);
    EXPECT_EQ(painted.first, std::pair(1L, 0L));
    EXPECT_EQ(painted.second, uploads(**anew).second);
}

TEST_F(Lights, ShadowsFallWhereRaysSay) {
    const scene::Scene scene = floorAndBlocker();
    auto renderer = scene::Renderer::make(device(), scene);
    ASSERT_TRUE(renderer.ok());
    constexpr int kSide = 96;
    scene::RenderSettings settings;
    settings.width = settings.height = kSide;
    settings.backdrop = false;
    settings.hour = 12.0;
    DayLight sun = paintedSun({0.7, 0.4, 1.0});
    sun.keys[0].gradient.stops.resize(2);
    sun.keys.resize(1);
    const glm::dvec3 axis = sun.axis;
    (*renderer)->setLights(inOrder({sun}));
    auto shadowed = (*renderer)->render(testing::frontView(scene, 6.0f), settings);
    ASSERT_TRUE(shadowed.ok());
    sun.visibility = false;
    (*renderer)->setLights(inOrder({sun}));
    auto open = (*renderer)->render(testing::frontView(scene, 6.0f), settings);
    ASSERT_TRUE(open.ok());
    EXPECT_FALSE(open->plan->runs("shadow-map"));
    int dark = 0, bright = 0;
    // Texels of 2 x 2.9 / 2048: filtering and the offset along the normal reach 4 of them.
    constexpr double kMargin = 0.012;
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            const glm::dvec2 ndc(2.0 * (x + 0.5) / kSide - 1.0, 1.0 - 2.0 * (y + 0.5) / kSide);
            const glm::dvec2 slope = ndc * std::tan(0.35);
            const glm::dvec2 atBlocker = slope * 5.0;
            const glm::dvec2 atFloor = slope * 6.0;
            const double nearest = std::max(std::abs(atBlocker.x), std::abs(atBlocker.y)) - 0.5;
            if (std::abs(nearest) < 0.05 ||
                std::max(std::abs(atFloor.x), std::abs(atFloor.y)) > 1.98) {
                continue;
            }
            double inside = 1.0; // of the blocker's own shadow region: far outside
            if (nearest > 0.0) {
                const glm::dvec2 hit = atFloor + glm::dvec2(axis) / axis.z;
                inside = std::max(std::abs(hit.x), std::abs(hit.y)) - 0.5;
            }
            if (std::abs(inside) < kMargin) {
                continue;
            }
            const double ratio = static_cast<double>(shadowed->radiance.at(x, y)[0]) /
                                 static_cast<double>(open->radiance.at(x, y)[0]);
            EXPECT_NEAR(ratio, inside < 0.0 ? 0.0 : 1.0, 1e-3) << x << ", " << y;
            (inside < 0.0 ? dark : bright) += 1;
        }
    }
    EXPECT_GT(dark, 100);
    EXPECT_GT(bright, 1000);
}

} // namespace
} // namespace lodestar

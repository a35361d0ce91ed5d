// SPDX-License-Identifier: MIT
//
// Maps whose rows were given one by one, on screen: what the CPU reads of the same texels.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <glm/geometric.hpp>

#include "lighting/day_lookup.h"
#include "scene/renderer.h"
#include "support/gl_fixture.h"
#include "support/shapes.h"

#include "sphere_pixels.h"

#include "lodestar/sun.glsl"

namespace lodestar {
namespace {

using lighting::DayLight;

class Rows : public testing::GlTest {};

std::vector<DayLight> skyAndSun() {
    DayLight sky;
    sky.keys = {{12.0,
                 {{{90, {0.1, 0.2, 0.6}, 0},
                   {0, {0.9, 0.9, 0.8}, 0},
                   {0, {0.2, 0.18, 0.15}, 0},
                   {-90, {0.15, 0.14, 0.12}, 0}}},
                 glm::dvec3(1.0),
                 {}}};
    DayLight sun;
    sun.kind = lighting::LightKind::Sun;
    sun.axis = glm::normalize(glm::dvec3(0.5, 0.6, 0.7));
    sun.keys = {{12.0,
                 {{{0, {1, 0.9, 0.8}, 13},
                   {1.5, {1, 0.9, 0.8}, 13},
                   {1.5, {1, 0.8, 0.6}, 3},
                   {60, {0, 0, 0}, 0}}},
                 glm::dvec3(1.0),
                 {}}};
    core::Tally warnings;
    return {*lighting::repaired(sky, warnings), *lighting::repaired(sun, warnings)};
}

/// What a driver may be off the CPU's exact bilinear filter: weights of eight bits, half a step of
/// 1/256 of a row and of a column, as much for the roundings of coordinates, and normals of a mesh
/// that are turned by 1e-4. A column is 2.3 degrees at most, .0088 / 256 * 2 radians of it.
double allowedAt(lighting::DayLookup& maps, const lighting::RsrmLayout& layout,
                 const testing::Lobe& lobe, double expected) {
    constexpr double kTurn = 0.04 / 256.0 + 1e-4;
    const glm::dvec3 x = glm::normalize(glm::cross(lobe.direction, glm::dvec3(0.3, 0.5, -0.8)));
    const glm::dvec3 y = glm::cross(lobe.direction, x);
    double turned = 0.0;
    for (const glm::dvec3& side : {x, -x, y, -y}) {
        const glm::dvec3 beside = glm::normalize(lobe.direction + kTurn * side);
        turned = std::max(turned,
                          std::abs(maps.lookup(12.0, beside, lobe.exponent).radiance.g - expected));
    }
    // Linear between rows in log(s + 1), the widest step of them.
    double step = 0.0;
    const std::vector<double> rows = lighting::rowExponents(layout);
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
        step = std::max(step, std::log((rows[i + 1] + 1.0) / (rows[i] + 1.0)));
    }
    double moved = 0.0;
    for (const double way : {-1.0, 1.0}) {
        const double s = (lobe.exponent + 1.0) * std::exp(way * step / 256.0) - 1.0;
        moved =
            std::max(moved, std::abs(maps.lookup(12.0, lobe.direction, s).radiance.g - expected));
    }
    return 2.0 * turned + moved + 1e-4 * expected; // both axes; roots in half a thousandth
}

/// A sky's and a sun's maps on the CPU.
struct Maps {
    lighting::DayLookup sky, sun;
    Maps(const std::vector<DayLight>& lights, const lighting::RsrmLayout& layout)
        : sky({lights[0]}, layout), sun({lights[1]}, layout) {}
};

/// Where a sun's map is read for a pixel, as a direction.
testing::Lobe sunLobe(const testing::SpherePixel& pixel, double exponent, const DayLight& sun) {
    const testing::Lobe round = testing::lobeOf(pixel, exponent);
    const glm::dvec3 axis = lighting::momentAt(sun, 12.0).axis;
    const double spread = lighting::spread(lighting::unfiltered(
        lighting::RadianceProfile(sun.keys.front().gradient, lighting::LightKind::Sun)));
    const auto looked = shader_double::lodestar_sunLookup(
        pixel.normal, pixel.view, exponent, round.direction, round.exponent, axis, spread);
    const double half = looked.halfChord;
    const glm::dvec3 aside = glm::normalize(glm::cross(axis, glm::dvec3(0.3, 0.5, -0.8)));
    return {(1.0 - 2.0 * half * half) * axis + 2.0 * half * std::sqrt(1.0 - half * half) * aside,
            looked.exponent};
}

TEST_F(Rows, APictureIsWhatTheCpuReads) {
    constexpr int kSide = 24;
    const scene::Scene scene = scene::buildScene(
        testing::fileOf(testing::sphere(256, 512), testing::blinnPhong({}, {}, 0.0f)));
    auto renderer = scene::Renderer::make(device(), scene);
    ASSERT_TRUE(renderer.ok());
    scene::RenderSettings settings;
    settings.width = settings.height = kSide;
    settings.backdrop = false;
    settings.hour = 12.0;
    const std::vector<DayLight> lights = skyAndSun();
    // A few rows; as many as there may be, so that all of the table is read; two of one octave,
    // below which and above which are the lookups.
    std::vector<double> many;
    for (int i = 0; i < lighting::kMostOwnRows; ++i) {
        many.push_back(1.5 * std::pow(1.3, i + 0.02 * i * i));
    }
    for (const std::vector<double>& rows :
         {std::vector<double>{1.0, 5.0, 40.0, 700.0}, many, std::vector<double>{20.0, 60.0}}) {
        const lighting::RsrmLayout layout = lighting::rsrmWithRows(rows);
        (*renderer)->setLights(lights, layout);
        Maps maps(lights, layout);
        Maps usual(lights, lighting::kRsrm);
        int others = 0;
        for (const float exponent : {4.0f, 30.0f, 200.0f, 2500.0f}) {
            settings.materialOverride =
                scene::MaterialOverride{glm::vec3(0.0f), glm::vec3(1.0f), exponent};
            auto frame = (*renderer)->render(testing::frontView(scene), settings);
            ASSERT_TRUE(frame.ok()) << frame.error().message();
            for (const plan::Features features : frame->plan->drawFeatures) {
                EXPECT_TRUE(plan::has(features, plan::Feature::RsrmRows));
            }
            double worst = 0.0;
            int compared = 0;
            for (const testing::SpherePixel& pixel : testing::spherePixels(kSide)) {
                const testing::Lobe lobe = testing::lobeOf(pixel, static_cast<double>(exponent));
                const testing::Lobe sun = sunLobe(pixel, static_cast<double>(exponent), lights[1]);
                const auto over = [&](Maps& read) {
                    return std::pair(
                        read.sky.lookup(12.0, lobe.direction, lobe.exponent).radiance.g,
                        read.sun.lookup(12.0, sun.direction, sun.exponent).radiance.g);
                };
                const auto [bySky, bySun] = over(maps);
                const double expected = bySky + bySun;
                const double allowed = allowedAt(maps.sky, layout, lobe, bySky) +
                                       allowedAt(maps.sun, layout, sun, bySun);
                const auto got = static_cast<double>(frame->radiance.at(pixel.x, pixel.y)[1]);
                ASSERT_NEAR(got, expected, allowed) << rows.size() << " rows, s " << exponent
                                                    << " at " << pixel.x << " " << pixel.y;
                worst = std::max(worst, std::abs(got - expected) / allowed);
                const auto [skyByOthers, sunByOthers] = over(usual);
                const double byOthers = skyByOthers + sunByOthers;
                others += std::abs(byOthers - expected) > allowed ? 1 : 0;
                ++compared;
            }
            EXPECT_GT(compared, 200);
            std::printf("%zu rows, exponent %g: %.2f of the bound\n", rows.size(),
                        static_cast<double>(exponent), worst);
        }
        EXPECT_GT(others, 100) << "the default rows would be seen";
    }
}

TEST_F(Rows, MovedRowsLookAsRowsSetAnew) {
    const scene::Scene scene = scene::buildScene(
        testing::fileOf(testing::sphere(32, 64), testing::blinnPhong({}, glm::vec3(1.0f), 30.0f)));
    auto kept = scene::Renderer::make(device(), scene);
    auto anew = scene::Renderer::make(device(), scene);
    ASSERT_TRUE(kept.ok() && anew.ok());
    scene::RenderSettings settings;
    settings.width = settings.height = 32;
    settings.hour = 12.0;
    const auto pictureOf = [&](scene::Renderer& renderer, const std::vector<double>& rows) {
        renderer.setLights(skyAndSun(), lighting::rsrmWithRows(rows));
        auto frame = renderer.render(testing::frontView(scene), settings);
        EXPECT_TRUE(frame.ok());
        return frame->radiance.pixels();
    };
    const auto usual = pictureOf(**kept, {});
    const auto first = pictureOf(**kept, {1.0, 10.0, 100.0});
    const auto second = pictureOf(**kept, {1.0, 60.0, 100.0});
    const auto third = pictureOf(**kept, {1.0, 60.0, 100.0, 400.0});
    EXPECT_NE(first, second);
    EXPECT_EQ(second, pictureOf(**anew, {1.0, 60.0, 100.0}));
    EXPECT_EQ(third, pictureOf(**anew, {1.0, 60.0, 100.0, 400.0}));
    EXPECT_EQ(pictureOf(**kept, {}), usual);
    EXPECT_EQ(pictureOf(**kept, {1.0, 10.0, 100.0}), first);
}

} // namespace
} // namespace lodestar

// SPDX-License-Identifier: MIT
//
// Which way round: six coloured faces seen in a mirror and as the backdrop, and seams.
#include <cmath>

#include "lighting/environment.h"
#include "scene/renderer.h"
#include "shader_text.h"
#include "support/gl_fixture.h"
#include "support/shapes.h"

namespace lodestar {
namespace {

class Orientation : public testing::GlTest {
protected:
    core::Image render(const scene::Scene& scene, const scene::View& view, bool backdrop,
                       const lighting::Cubemap& map, float exponent = 1e7f) {
        auto renderer = scene::Renderer::make(device(), scene);
        EXPECT_TRUE(renderer.ok());
        (*renderer)->setEnvironment("faces", map);
        scene::RenderSettings settings;
        settings.width = settings.height = 128;
        settings.backdrop = backdrop;
        settings.materialOverride =
            scene::MaterialOverride{glm::vec3(0.0f), glm::vec3(1.0f), exponent};
        auto frame = (*renderer)->render(view, settings);
        EXPECT_TRUE(frame.ok());
        return std::move(frame->radiance);
    }
};

const lighting::FacesEnvironment kFaces{{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0),
                                         glm::dvec3(0, 0, 1), glm::dvec3(1, 1, 0),
                                         glm::dvec3(0, 1, 1), glm::dvec3(1, 0, 1)}};

TEST_F(Orientation, BackdropShowsTheFaceThatTheViewLooksAt) {
    const scene::Scene empty = scene::buildScene(io::GltfFile{});
    const lighting::Cubemap map = lighting::cubeFromAnalytic(kFaces, 32);
    const glm::vec3 directions[] = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                    {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    for (std::size_t face = 0; face < 6; ++face) {
        scene::CameraRequest request;
        request.eye = glm::vec3(0.0f);
        request.target = directions[face];
        const core::Image image =
            render(empty, *scene::chooseView(empty, request, 1.0f), true, map);
        const float* center = image.at(64, 64);
        for (int c = 0; c < 3; ++c) {
            EXPECT_FLOAT_EQ(center[c], static_cast<float>(kFaces.radiance[face][c]))
                << "face " << face;
        }
    }
}

TEST_F(Orientation, MirrorSphereReflectsUnflipped) {
    // Seen from +Z, a mirror ball shows +X on its right, +Y at its top, +Z (behind the viewer) in
    // the middle: reflections at 45 degrees of slope look sideways.
    const scene::Scene scene =
        scene::buildScene(testing::fileOf(testing::sphere(), testing::blinnPhong({}, {}, 0.0f)));
    scene::CameraRequest request;
    request.eye = glm::vec3(0.0f, 0.0f, 40.0f);
    request.target = glm::vec3(0.0f);
    request.verticalFov = 2.0f * std::atan(1.05f / 40.0f);
    const core::Image image = render(scene, *scene::chooseView(scene, request, 1.0f), false,
                                     lighting::cubeFromAnalytic(kFaces, 64));
    const float slope = std::sqrt(0.5f) / 1.05f;
    const auto pixel = [&](float x, float y) {
        return image.at(static_cast<int>(64.0f + 64.0f * x), static_cast<int>(64.0f - 64.0f * y));
    };
    const std::pair<const float*, int> expected[] = {{pixel(slope, 0), 0},
                                                     {pixel(-slope, 0), 1},
                                                     {pixel(0, slope), 2},
                                                     {pixel(0, -slope), 3},
                                                     {pixel(0, 0), 4}};
    for (const auto& [value, face] : expected) {
        for (int c = 0; c < 3; ++c) {
            EXPECT_FLOAT_EQ(value[c],
                            static_cast<float>(kFaces.radiance[static_cast<std::size_t>(face)][c]))
                << "face " << face;
        }
    }
}

TEST_F(Orientation, GpuFetchesTheTexelThatTheCpuFetches) {
    // Random texels, random directions: the driver's seamless trilinear fetch against ours.
    // Hardware may quantise filter weights to 8 bits: 2^-8 of the range a level, two levels.
    lighting::Cubemap map(16, 5);
    std::uint32_t state = 7;
    const auto random = [&] {
        state = state * 1664525u + 1013904223u;
        return static_cast<float>(state >> 8) / 16777216.0f;
    };
    for (int level = 0; level < map.levelCount(); ++level) {
        for (glm::vec4& texel : map.level(level)) {
            texel = {random(), random(), random(), 1.0f};
        }
    }
    std::vector<glm::vec4> lookups;
    while (lookups.size() < 4096) {
        const glm::vec3 d(2 * random() - 1, 2 * random() - 1, 2 * random() - 1);
        if (const float length = glm::length(d); length > 0.1f && length < 1.0f) {
            lookups.emplace_back(d / length, 4.0f * random());
        }
    }
    const std::vector<glm::vec4> fetched = testing::fetchCube(device(), map, lookups);
    ASSERT_EQ(fetched.size(), lookups.size());
    int corner = 0;
    for (std::size_t i = 0; i < lookups.size(); ++i) {
        const glm::vec4 expected = map.sample(glm::vec3(lookups[i]), lookups[i].w);
        const float error = glm::length(glm::vec3(fetched[i] - expected));
        if (error > 2.0f * std::sqrt(3.0f) / 256.0f) {
            // The three-face corner is where drivers differ: within one texel of it.
            const glm::vec3 a = glm::abs(glm::vec3(lookups[i]));
            const float largest = std::max({a.x, a.y, a.z});
            const float smallest = std::min({a.x, a.y, a.z});
            const float coarse = 1.0f - 2.0f * std::exp2(std::ceil(lookups[i].w)) / 16.0f;
            EXPECT_GE(smallest / largest, coarse) << "at lookup " << i << " error " << error;
            ++corner;
        }
    }
    EXPECT_LT(corner, static_cast<int>(lookups.size()) / 10);
}

} // namespace
} // namespace lodestar

// SPDX-License-Identifier: MIT
//
// White furnace on the GPU: under constant radiance 1 a white surface shows 1 everywhere, whatever
// the estimator and the exponent.
#include <cmath>
#include <string>

#include "lighting/environment.h"
#include "scene/renderer.h"
#include "support/gl_fixture.h"
#include "support/shapes.h"

namespace lodestar {
namespace {

class Furnace : public testing::GlTest {};

constexpr float kExponents[] = {0.0f,   0.5f,    1.0f,     4.0f, 32.0f,
                                256.0f, 4096.0f, 65536.0f, 1e6f, 1e7f};

/// Largest |radiance - 1| over covered pixels; fails if nothing is covered.
float worstError(const core::Image& image) {
    float worst = 0.0f;
    int covered = 0;
    for (std::size_t i = 0; i < image.pixels().size(); i += 4) {
        if (image.pixels()[i + 3] > 0.0f) {
            ++covered;
            for (std::size_t c = 0; c < 3; ++c) {
                worst = std::max(worst, std::abs(image.pixels()[i + c] - 1.0f));
            }
        }
    }
    EXPECT_GT(covered, 1000);
    return worst;
}

TEST_F(Furnace, EveryEstimatorAndExponentShowsOne) {
    const scene::Scene scene =
        scene::buildScene(testing::fileOf(testing::sphere(), testing::blinnPhong({}, {}, 0.0f)));
    auto renderer = scene::Renderer::make(device(), scene);
    ASSERT_TRUE(renderer.ok()) << renderer.error().message();
    (*renderer)->setEnvironment("constant",
                                lighting::cubeFromAnalytic(lighting::ConstantEnvironment{}, 64));
    scene::RenderSettings settings;
    settings.width = settings.height = 96;
    settings.backdrop = false;
    const std::pair<const char*, const char*> estimators[] = {{"tent", "irradiance"},
                                                              {"mip", "sh9"},
                                                              {"mip-floor", "lowest-mip"},
                                                              {"bias:3.5", "bias:5"},
                                                              {"bias:2:vertex", "irradiance"},
                                                              {"ring:3", "irradiance"},
                                                              {"ring:7", "sh9"},
                                                              {"taps:16", "irradiance"},
                                                              {"prefiltered", "irradiance"}};
    for (const auto& [specular, diffuse] : estimators) {
        settings.specular = *lighting::parseEstimator(specular, lighting::Term::Glossy);
        settings.diffuse = *lighting::parseEstimator(diffuse, lighting::Term::Diffuse);
        for (const float exponent : kExponents) {
            for (const bool mirror : {false, true}) {
                settings.materialOverride = scene::MaterialOverride{
                    glm::vec3(mirror ? 0.0f : 1.0f), glm::vec3(mirror ? 1.0f : 0.0f), exponent};
                auto frame = (*renderer)->render(testing::frontView(scene), settings);
                ASSERT_TRUE(frame.ok()) << frame.error().message();
                EXPECT_EQ(frame->repairedPixels, 0u);
                // Half floats hold 1 exactly; what is left is float rounding of (1 - F) + F and,
                // for sh9, of nine terms: 16 operations of 2^-24 each, far below 1e-5.
                EXPECT_LT(worstError(frame->radiance), 1e-5f)
                    << specular << "/" << diffuse << " exponent " << exponent
                    << (mirror ? " f0 1" : " k_L 1");
            }
        }
    }
}

} // namespace
} // namespace lodestar

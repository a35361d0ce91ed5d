// SPDX-License-Identifier: MIT
//
// The forms of lobes and of Fresnel's reflectance on screen, beside their closed forms.
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "lighting/environment.h"
#include "scene/renderer.h"
#include "support/gl_fixture.h"
#include "support/shapes.h"

namespace lodestar {
namespace {

constexpr int kSide = 48;
constexpr double kDistance = 3.5;

class Forms : public testing::GlTest {
protected:
    core::Image shown(const scene::Scene& scene, const scene::View& view,
                      const scene::RenderSettings& settings, lighting::Cubemap environment) {
        auto renderer = scene::Renderer::make(device(), scene);
        EXPECT_TRUE(renderer.ok());
        (*renderer)->setEnvironment("map", std::move(environment));
        auto frame = (*renderer)->render(view, settings);
        EXPECT_TRUE(frame.ok()) << frame.error().message();
        return std::move(frame->radiance);
    }
};

scene::RenderSettings small() {
    scene::RenderSettings settings;
    settings.width = settings.height = kSide;
    settings.backdrop = false;
    return settings;
}

/// A square under a lamp that stands where the camera does.
scene::Scene squareUnderALamp(float exponent) {
    io::GltfFile file =
        testing::fileOf(testing::square(), testing::blinnPhong({}, glm::vec3(1.0f), exponent));
    io::GltfLight lamp;
    lamp.intensity = 10.0f;
    file.lights.push_back(lamp);
    io::GltfNode node;
    node.light = 0;
    node.translation = {0.0f, 0.0f, static_cast<float>(kDistance)};
    file.nodes.push_back(node);
    file.scenes[0].roots.push_back(1);
    return scene::buildScene(file);
}

// h = v = l: the lobe of the angle to the normal, n.l, and the distance's square. Places are off by
// 1e-6 m of 3.5 m, half floats of the frame by none (it is float): 1e-4 of the peak is left to the
// driver's exp, which may be off by 3 + 2 |y| units.
TEST_F(Forms, AHighlightIsTheFormThatWasAskedFor) {
    for (const double s : {2.0, 16.0, 400.0}) {
        const scene::Scene scene = squareUnderALamp(static_cast<float>(s));
        scene::CameraRequest request;
        request.eye = glm::vec3(0.0f, 0.0f, static_cast<float>(kDistance));
        request.target = glm::vec3(0.0f);
        const double half = std::min(1.5 / std::sqrt(s), 0.27); // the square is 0.28 wide
        request.verticalFov = static_cast<float>(2.0 * half);
        const scene::View view = *scene::chooseView(scene, request, 1.0f);
        const double peak = (s + 2.0) * (s + 4.0) /
                            (8.0 * std::numbers::pi * (std::exp2(-0.5 * s) + s)) * 10.0 /
                            (kDistance * kDistance);
        double most = 0.0;
        for (const lighting::LobeForm form : {lighting::LobeForm::Power, lighting::LobeForm::Sg}) {
            scene::RenderSettings settings = small();
            settings.lobes = form;
            const core::Image image = shown(scene, view, settings, lighting::Cubemap(4));
            for (int x = 0; x < kSide; ++x) {
                const double tangent = std::tan(half) * (2.0 * (x + 0.5) / kSide - 1.0);
                const double up = std::tan(half) / kSide;
                const double squared = tangent * tangent + up * up;
                const double cosine = 1.0 / std::sqrt(1.0 + squared);
                const double power = std::pow(cosine, s);
                const double gaussian = std::exp(-(s + 0.75) * (1.0 - cosine));
                const double lobe = form == lighting::LobeForm::Sg ? gaussian : power;
                EXPECT_NEAR(static_cast<double>(image.at(x, kSide / 2 - 1)[0]),
                            peak * lobe * std::pow(cosine, 3.0), 1e-4 * peak)
                    << s << " " << x;
                most = std::max(most, std::abs(power - gaussian));
            }
        }
        EXPECT_GT(most, 3e-4) << "the two forms cannot be told apart";
    }
}

// Under a constant environment of 1 a black surface shows its reflectance. An exponent of 1e7: no
// roughness to speak of, (2 / 1e7)^(1/4) = .0211.
TEST_F(Forms, AFurnaceShowsFresnelsForm) {
    const scene::Scene scene = scene::buildScene(
        testing::fileOf(testing::square(), testing::blinnPhong({}, glm::vec3(0.04f), 1e7f)));
    for (const double cosine : {1.0, 0.6, 0.26, 0.06}) {
        scene::View view;
        view.perspective = false;
        view.towardsViewer = glm::vec3(0.0f, static_cast<float>(std::sqrt(1.0 - cosine * cosine)),
                                       static_cast<float>(cosine));
        const double weights[] = {std::pow(1.0 - cosine, 5.0),
                                  std::exp2((-5.55473 * cosine - 6.98316) * cosine)};
        for (const lighting::FresnelForm form :
             {lighting::FresnelForm::Schlick, lighting::FresnelForm::Sg}) {
            scene::RenderSettings settings = small();
            settings.fresnel = form;
            lighting::Cubemap white(4);
            for (int face = 0; face < 6; ++face) {
                for (int i = 0; i < 16; ++i) {
                    white.texel(face, i % 4, i / 4) = glm::vec4(1.0f);
                }
            }
            const core::Image image = shown(scene, view, settings, white);
            const double limit = 1.0 - std::pow(2.0 / (1e7 + 2.0), 0.25);
            const double weight = weights[form == lighting::FresnelForm::Sg ? 1 : 0];
            // Ten roundings of the reflectance, filtering of ones by as many.
            EXPECT_NEAR(static_cast<double>(image.at(kSide / 2, kSide / 2)[0]),
                        0.04 + (limit - 0.04) * weight, 3e-6)
                << cosine;
        }
    }
}

} // namespace
} // namespace lodestar

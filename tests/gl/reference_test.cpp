// SPDX-License-Identifier: MIT
//
// Pictures by many taps against sums over all texels in double precision, at single pixels.
#include <cmath>
#include <cstdio>

#include <glm/gtc/matrix_transform.hpp>

#include "lighting/environment.h"
#include "lighting/lookup.h"
#include "scene/renderer.h"
#include "support/gl_fixture.h"
#include "support/shapes.h"

namespace lodestar {
namespace {

constexpr int kSide = 4;      ///< pixels of a picture
constexpr int kX = 2, kY = 1; ///< the one looked at

class Reference : public testing::GlTest {
protected:
    /// A square's middle seen from an angle to its normal, degrees, so near that a pixel is far
    /// smaller than a texel of the environment.
    static scene::View towards(const scene::Scene& scene, float angle, float azimuth) {
        const float theta = glm::radians(angle);
        const float phi = glm::radians(azimuth);
        scene::CameraRequest request;
        request.eye = 2.0f * glm::vec3(std::sin(theta) * std::cos(phi),
                                       std::sin(theta) * std::sin(phi), std::cos(theta));
        request.target = glm::vec3(0.0f);
        request.verticalFov = 0.01f;
        return *scene::chooseView(scene, request, 1.0f);
    }
    static scene::RenderSettings settings() {
        scene::RenderSettings settings;
        settings.width = kSide;
        settings.height = kSide;
        return settings;
    }
    /// Towards the viewer from where a pixel's centre meets the plane z = 0.
    static glm::dvec3 viewAt(const scene::View& view, int x, int y) {
        const glm::dmat4 worldFromClip = glm::inverse(glm::dmat4(view.clipFromWorld()));
        const glm::dvec2 ndc((x + 0.5) / kSide * 2.0 - 1.0, 1.0 - (y + 0.5) / kSide * 2.0);
        const glm::dvec4 far = worldFromClip * glm::dvec4(ndc, 0.5, 1.0);
        const glm::dvec3 eye(view.position);
        const glm::dvec3 along = glm::dvec3(far) / far.w - eye;
        return glm::normalize(along *
                              (eye.z / along.z)); // from the point at eye - along eye.z / along.z
    }
    static scene::Scene squareOf(const glm::vec3& diffuse, const glm::vec3& f0, float exponent) {
        return scene::buildScene(
            testing::fileOf(testing::square(), testing::blinnPhong(diffuse, f0, exponent)));
    }
    std::unique_ptr<scene::Renderer> renderer(const scene::Scene& scene,
                                              const lighting::Cubemap& base) {
        auto made = scene::Renderer::make(device(), scene);
        EXPECT_TRUE(made.ok());
        (*made)->setEnvironment("map", base);
        return std::move(*made);
    }
    /// A pixel by so many taps in so many passes; by the settings' estimators for none.
    static double pixel(scene::Renderer& renderer, const scene::View& view,
                        const scene::RenderSettings& settings, int taps, int passes = 1) {
        double sum = 0.0;
        for (int pass = 0; pass < passes; ++pass) {
            auto picture = renderer.redraw(
                view, settings,
                taps > 0 ? std::optional(scene::ReferenceTaps{pass, passes, taps}) : std::nullopt);
            EXPECT_TRUE(picture.ok());
            sum += static_cast<double>(picture->at(kX, kY)[0]) / passes;
        }
        return sum;
    }
};

/// Sums of squares, for relative RMS errors.
struct Errors {
    double squares = 0.0;
    double truth = 0.0;
    void add(double value, double exact) {
        squares += (value - exact) * (value - exact);
        truth += exact * exact;
    }
    [[nodiscard]] double rms() const { return std::sqrt(squares / truth); }
};

// A lamp of 5 degrees, the sun, edges, and exponents from Lambert's lobe to one of few texels.
// docs/estimators.md promises 2 % RMS of each row at 1024 taps, twice the .010 that the worst of
// these has. Taps that stand for a sixteenth as much halve all rows' error together at least; it is
// far below that of `mip`, so that the reference of another lobe would show.
TEST_F(Reference, ManyTapsAreTheSumOverAllTexels) {
    constexpr int kWidth = 64;
    const auto analytic = [](const char* text) {
        return lighting::cubeFromAnalytic(*lighting::parseAnalytic(text), kWidth);
    };
    const std::pair<const char*, lighting::Cubemap> maps[] = {
        {"faces", analytic("faces:1;0.2;3;0.1;0.5;2")},
        {"lamp", analytic("disc:0.577,0.577,0.577,5,100,0.05")},
        {"sky", lighting::cubeFromAnalytic(lighting::ClearSkyEnvironment{}, kWidth)}};
    Errors few, many, mip;
    for (const auto& [name, base] : maps) {
        for (const float exponent : {0.0f, 4.0f, 64.0f, 512.0f}) {
            const scene::Scene scene = squareOf(glm::vec3(0.0f), glm::vec3(1.0f), exponent);
            auto made = renderer(scene, base);
            Errors row;
            for (int i = 0; i < 8; ++i) {
                const auto step = static_cast<float>(i);
                const scene::View view = towards(scene, 10.0f * step, 137.5f * step);
                scene::RenderSettings published = settings();
                published.specular.kind = lighting::EstimatorKind::Mip;
                ASSERT_TRUE(made->render(view, published).ok());
                const double exact =
                    lighting::referenceBlinnPhong(base, glm::dvec3(0, 0, 1), viewAt(view, kX, kY),
                                                  static_cast<double>(exponent))
                        .x;
                row.add(pixel(*made, view, published, 1024), exact);
                many.add(pixel(*made, view, published, 4096) / exact, 1.0);
                few.add(pixel(*made, view, published, 256) / exact, 1.0);
                mip.add(pixel(*made, view, published, 0) / exact, 1.0);
            }
            std::printf("%s %g: %.4f\n", name, static_cast<double>(exponent), row.rms());
            EXPECT_LT(row.rms(), 0.02) << name << ", exponent " << exponent;
        }
    }
    std::printf("256 taps %.4f, 4096 taps %.4f, mip %.3f\n", few.rms(), many.rms(), mip.rms());
    EXPECT_LT(many.rms(), 0.5 * few.rms());
    EXPECT_GT(mip.rms(), 20.0 * many.rms());
}

// The fine irradiance: 2e-4 of its blocks, a sixteenth of the .005 of 16 texels a side, and half
// floats' 5e-4.
TEST_F(Reference, DiffuseLightIsTheFineCubes) {
    const lighting::Cubemap base = lighting::cubeFromAnalytic(lighting::ClearSkyEnvironment{}, 64);
    const scene::Scene scene = squareOf(glm::vec3(1.0f), glm::vec3(0.0f), 0.0f);
    auto made = renderer(scene, base);
    const scene::View view = towards(scene, 30.0f, 0.0f);
    scene::RenderSettings published = settings();
    published.diffuse.kind = lighting::EstimatorKind::LowestMip;
    ASSERT_TRUE(made->render(view, published).ok());
    const double exact = lighting::referencePhong(base, glm::dvec3(0, 0, 1), 1.0).x;
    EXPECT_NEAR(pixel(*made, view, published, 64) / exact, 1.0, 1.1e-3);
    EXPECT_GT(std::abs(pixel(*made, view, published, 0) / exact - 1.0), 0.02) << "the coarsest mip";
}

TEST_F(Reference, PassesShareTheTaps) {
    const lighting::Cubemap base = lighting::cubeFromAnalytic(lighting::ClearSkyEnvironment{}, 64);
    const scene::Scene scene = squareOf(glm::vec3(0.3f), glm::vec3(0.5f), 20.0f);
    auto made = renderer(scene, base);
    const scene::View view = towards(scene, 50.0f, 40.0f);
    ASSERT_TRUE(made->render(view, settings()).ok());
    // A pass divides by its own weights: in a mean of passes of 64 that costs their variance, 1/64
    // of the weights' own, at most.
    const double whole = pixel(*made, view, settings(), 1024);
    EXPECT_NEAR(pixel(*made, view, settings(), 1024, 16) / whole, 1.0, 1.0 / 64);
    EXPECT_NE(pixel(*made, view, settings(), 1024, 16), whole);
}

// All that is not the environment's is the frame's own: where it has no part, the two are one.
TEST_F(Reference, WhatTheEnvironmentHasNoPartInIsTheFrames) {
    const lighting::Cubemap base =
        lighting::cubeFromAnalytic(lighting::ConstantEnvironment{glm::dvec3(1.0)}, 16);
    io::GltfMaterial unlit = testing::blinnPhong({}, glm::vec3(0.0f), 1.0f);
    unlit.blinnPhong.reset();
    unlit.unlit = true;
    unlit.baseColor = glm::vec4(0.25f, 0.5f, 0.75f, 1.0f);
    const scene::Scene scene = scene::buildScene(testing::fileOf(testing::square(), unlit));
    auto made = renderer(scene, base);
    scene::View view = testing::frontView(scene, 6.0f); // the square does not fill it
    scene::RenderSettings larger = settings();
    larger.width = larger.height = 16;
    auto frame = made->render(view, larger);
    auto again = made->redraw(view, larger, {});
    auto reference = made->redraw(view, larger, scene::ReferenceTaps{0, 1, 16});
    ASSERT_TRUE(frame.ok() && again.ok() && reference.ok());
    EXPECT_EQ(again->pixels(), reference->pixels());
    EXPECT_EQ(again->at(8, 8)[1], frame->radiance.at(8, 8)[1]);
    EXPECT_EQ(again->at(0, 0)[3], 0.0f) << "no backdrop";
    EXPECT_EQ(frame->radiance.at(0, 0)[3], 1.0f);
}

} // namespace
} // namespace lodestar

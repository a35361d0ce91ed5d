// SPDX-License-Identifier: MIT
//
// Light probes that keep the sky's part apart: against those that compose each sky anew, over
// intensities and tints, and that a factor is no work.
#include <algorithm>
#include <cmath>
#include <variant>

#include <glm/common.hpp>

#include "scene/renderer.h"
#include "support/gl_fixture.h"
#include "support/probe_world.h"

namespace lodestar {
namespace {

using testing::blinnPhong;
using testing::ProbeWorld;

constexpr int kWidth = 32;

/// A glowing wall and a dark one under the sky, seen by balls that are captured by nothing.
scene::Scene courtyard(lighting::ProbeRelight relight) {
    ProbeWorld world;
    world.box("lamp", {-3, -1, -3}, {-2.5f, 2, 3}, testing::glowing(glm::vec3(0.6f, 0.3f, 0.1f)));
    world.box("wall", {2, -1, -3}, {2.5f, 3, 3}, testing::glowing(glm::vec3(0.0f)));
    world.ball("matt", {-0.6f, 0, 0}, 0.5f, blinnPhong(glm::vec3(0.8f), glm::vec3(0.0f), 0.0f), 2);
    world.ball("glossy", {0.6f, 0, 0}, 0.5f, blinnPhong(glm::vec3(0.0f), glm::vec3(0.9f), 30.0f),
               2);
    lighting::Probe& probe = world.probe("here", {0, 0, 0}, {12, 12, 12}, 0.5);
    probe.capture.resolution = kWidth;
    probe.capture.layers = 1;
    probe.relight = relight;
    return world.make();
}

/// Tints at 6, 12 and 18 h of one gradient; from 18 to 6 h another comes.
lighting::DayLight day(double brightness, const glm::dvec3& noon, const glm::dvec3& evening) {
    const lighting::Gradient gradient{{{90, brightness * glm::dvec3(0.2, 0.4, 0.9), 0},
                                       {5, brightness * glm::dvec3(0.9, 0.8, 0.7), 0},
                                       {-90, brightness * glm::dvec3(0.01), 0}}};
    const lighting::Gradient night{{{90, brightness * glm::dvec3(0.01, 0.02, 0.05), 0},
                                    {-90, brightness * glm::dvec3(0.05), 0}}};
    lighting::DayLight sky;
    sky.name = "sky";
    sky.keys = {{6.0, gradient, glm::dvec3(1.0), {}},
                {12.0, gradient, noon, {}},
                {18.0, gradient, evening, {}},
                {21.0, night, glm::dvec3(1.0), {}}};
    core::Tally warnings;
    return *lighting::repaired(sky, warnings);
}

class ProbeRatio : public testing::ProbeTest {
protected:
    void SetUp() override {
        testing::ProbeTest::SetUp();
        settings_ = small(32);
        settings_.lightThreshold = 1e9;
    }
    /// The two ways under one sky.
    void shine(const lighting::DayLight& sky) {
        composing_ = rendererOf(scenes_[0]);
        ratio_ = rendererOf(scenes_[1]);
        composing_->setLights({sky});
        ratio_->setLights({sky});
    }
    scene::Frame draw(scene::Renderer& renderer, double hour) {
        settings_.hour = hour;
        return frameOf(renderer, testing::lookAt(scenes_[0], {0, 0.3f, 4}, {0, 0, 0}), settings_);
    }
    /// Each texel of each level, and the pictures, against each other.
    /// Of a sum of positive terms: both parts and their sum are rounded to half floats, 2^-11 each
    /// time, at level 0 and at each level that it is filtered through; the sky's gradient is stored
    /// as roots of half floats, 2^-10 of it at either hour. Of what is less than 2^-14 each
    /// rounding is 2^-24 on a driver that cuts off, the factor times as much in the sky's part.
    void compare(double hour, double greatest) {
        const core::Image composed = draw(*composing_, hour).radiance;
        const core::Image factored = draw(*ratio_, hour).radiance;
        double brightest = 0.0;
        const auto bound = [&](int level, double total) {
            return (3.0 + level) * 0x1p-10 * total + (2.0 + greatest) * (level + 1) * 0x1p-24;
        };
        int compared = 0;
        for (int level = 0; level < 6; ++level) {
            for (int face = 0; face < 6; ++face) {
                const core::Image a = composing_->readProbe(0, face, level);
                const core::Image b = ratio_->readProbe(0, face, level);
                ASSERT_EQ(a.pixels().size(), b.pixels().size());
                for (std::size_t i = 0; i < a.pixels().size(); ++i) {
                    const double x = static_cast<double>(a.pixels()[i]);
                    const double y = static_cast<double>(b.pixels()[i]);
                    ASSERT_LE(std::abs(x - y), bound(level, std::max(x, y)))
                        << hour << " h, level " << level << ", face " << face << ": " << x << ", "
                        << y;
                    brightest = i % 4 < 3 ? std::max(brightest, x) : brightest;
                    ++compared;
                }
            }
        }
        EXPECT_GE(compared, 6 * 4 * kWidth * kWidth);
        // Irradiance has two roundings more, and a kernel whose absolute values sum up to less
        // than 1.2; its tile is a half float again.
        for (std::size_t i = 0; i < composed.pixels().size(); ++i) {
            ASSERT_NEAR(composed.pixels()[i], factored.pixels()[i], 1.2 * bound(8, brightest));
        }
    }

    scene::Scene scenes_[2] = {courtyard(lighting::ProbeRelight::Compose),
                               courtyard(lighting::ProbeRelight::Ratio)};
    scene::RenderSettings settings_;
    std::unique_ptr<scene::Renderer> composing_, ratio_;
};

// Between keys of one gradient the sky is a factor's; what was composed at 6 h serves until 18 h.
TEST_F(ProbeRatio, IsWhatComposingMakesOfIntensitiesAndTints) {
    struct Case {
        double brightness;
        glm::dvec3 noon, evening;
    };
    const Case cases[] = {
        {1.0, glm::dvec3(3.0), glm::dvec3(0.25)},   {1.0, {1.5, 1.0, 0.5}, {0.9, 0.3, 0.1}},
        {1.0, glm::dvec3(15.9), glm::dvec3(0.0)},   {1.0, {1.0, 0.0, 0.0}, {0.0, 1.0, 1.0}},
        {1e-5, glm::dvec3(15.9), glm::dvec3(0.01)}, // half floats without all of their digits
        {2e5, glm::dvec3(2.0), glm::dvec3(1e-4)},   // beyond half floats, times a power of two
    };
    for (const Case& one : cases) {
        shine(day(one.brightness, one.noon, one.evening));
        for (const double hour : {6.0, 7.5, 9.0, 12.0}) {
            compare(hour, 15.9);
            if (hour > 6.0) {
                EXPECT_TRUE(draw(*ratio_, hour).plan->probeWork.empty()) << hour;
            }
        }
        for (const double hour : {13.0, 17.0, 18.0}) { // a channel that was black composes
            compare(hour, 15.9);
        }
    }
}

// No call, no pass, no texel of the probe's; the new sky's own map and a block of uniforms alone.
TEST_F(ProbeRatio, AFactorIsNoWork) {
    shine(day(1.0, {0.8, 0.7, 0.6}, glm::dvec3(0.3)));
    EXPECT_EQ(draw(*ratio_, 6.0).counters.probeFaces, 6u);
    const gl::WorkCounters still = draw(*ratio_, 6.0).counters;
    const scene::Frame later = draw(*ratio_, 12.0);
    EXPECT_EQ(later.counters.probeFaces, 0u);
    EXPECT_EQ(later.counters.passes, still.passes);
    EXPECT_EQ(later.counters.draws, still.draws);
    std::uint64_t skies = 0;
    for (const plan::Effect& effect : later.plan->effects) {
        skies += effect.effect == "rsrm-blend" ? effect.cost.texelsWritten : 0u;
    }
    EXPECT_EQ(later.counters.texelsWritten, still.texelsWritten + skies);
    EXPECT_NE(plan::planText(*later.plan)
                  .find("Probe 'here': sky 0.8, 0.7, 0.6 times as bright: a factor, no pass"),
              std::string::npos);
    EXPECT_TRUE(draw(*composing_, 6.0).plan->runs("probe-compose"));
    EXPECT_TRUE(draw(*composing_, 12.0).plan->runs("probe-compose"));
}

// Another gradient, or more than half floats bear, is composed, as what is foreseen of it says.
TEST_F(ProbeRatio, AnotherShapeIsComposed) {
    shine(day(1.0, glm::dvec3(20.0), glm::dvec3(1.0)));
    for (const double hour : {6.0, 12.0, 19.0, 20.0}) {
        compare(hour, 1.0);
    }
    draw(*ratio_, 18.0);
    for (const double hour : {6.0, 19.5, 18.0, 12.0}) { // 20 times as bright: beyond the bound
        const scene::Frame frame = draw(*ratio_, hour);
        if (hour == 6.0) {
            EXPECT_TRUE(frame.plan->probeWork.empty()); // as bright as at 18 h
            continue;
        }
        plan::Cost foreseen;
        for (const plan::Effect& effect : frame.plan->effects) {
            foreseen.passes += effect.cost.passes;
            foreseen.texelsWritten += effect.cost.texelsWritten;
        }
        EXPECT_EQ(frame.plan->probeWork.size(), 1u) << hour;
        EXPECT_EQ(frame.counters.passes, foreseen.passes + 1) << hour;
        EXPECT_EQ(frame.counters.texelsWritten, foreseen.texelsWritten + 32 * 32) << hour;
    }
}

// What fades out goes on with its factor: no frame of a fade differs from a composing probe's.
TEST_F(ProbeRatio, FadesFromASkyThatHasAFactor) {
    shine(day(1.0, glm::dvec3(0.25), glm::dvec3(1.0)));
    draw(*composing_, 6.0);
    draw(*ratio_, 6.0);
    compare(12.0, 1.0);
    composing_->requestProbe(0);
    ratio_->requestProbe(0);
    for (scene::Scene& scene : scenes_) { // the lamp moves, so that there is something to fade
        const auto lamp = std::find_if(scene.nodes.begin(), scene.nodes.end(),
                                       [](const scene::Node& node) { return node.name == "lamp"; });
        lamp->parentFromNode[3].y += 0.7f;
        scene::updateTransforms(scene);
    }
    settings_.faceBudget = 2;
    bool fades = false;
    for (int i = 0; i < 8; ++i) {
        compare(12.0, 1.0);
        const scene::Frame frame = draw(*ratio_, 12.0);
        draw(*composing_, 12.0);
        for (const plan::ProbeWork& work : frame.plan->probeWork) {
            fades = fades || work.fadeLeft > 1;
        }
    }
    EXPECT_TRUE(fades);
}

} // namespace
} // namespace lodestar

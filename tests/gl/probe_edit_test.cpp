// SPDX-License-Identifier: MIT
//
// Light probes that are added, changed and taken away while the scene is drawn.
#include "support/probe_world.h"

namespace lodestar {
namespace {

using testing::blinnPhong;
using testing::constantSky;
using testing::glowing;
using testing::lookAt;
using testing::ProbeWorld;

class ProbeEdit : public testing::ProbeTest {
protected:
    void SetUp() override {
        testing::ProbeTest::SetUp();
        if (IsSkipped()) {
            return;
        }
        ProbeWorld world;
        world.ball("ball", {0, 0, 0}, 1.0f, blinnPhong(glm::vec3(0.0f), glm::vec3(0.9f), 4096.0f),
                   2u);
        // What glows alone is captured alike, whichever probes there were when it was.
        world.box("floor", {-4, -1.5f, -4}, {4, -1.2f, 4}, glowing({0.6f, 0.1f, 0.1f}), 1u);
        scene_ = world.make();
        renderer_ = rendererOf(scene_);
        renderer_->setEnvironment("sky", constantSky(1.0));
    }
    static lighting::Probe at(const std::string& name, const glm::dvec3& position) {
        lighting::Probe probe;
        probe.name = name;
        probe.position = position;
        probe.capture.resolution = 32;
        probe.influence.size = glm::dvec3(4.0);
        probe.capture.layers = 1u; // not the ball
        return probe;
    }
    void set(const std::vector<lighting::Probe>& probes,
             const std::vector<scene::ProbeMap>& maps = {}) {
        core::Tally warnings;
        scene::setProbes(scene_, probes, maps, warnings);
        scene::updateTransforms(scene_);
        renderer_->probesChanged();
    }
    scene::Frame draw() { return frameOf(*renderer_, lookAt(scene_, {0, 1, 5}, {}), small(48)); }
    scene::Scene scene_;
    std::unique_ptr<scene::Renderer> renderer_;
};

TEST_F(ProbeEdit, APictureAfterEditsIsThatOfAFreshRenderer) {
    draw();
    set({at("a", {0, 0.3, 0}), at("b", {1, 0, 0})});
    draw();
    set({at("b", {1, 0, 0}), at("c", {0, 0.2, 0.5})});
    draw();
    const core::Image edited = draw().radiance;
    const auto fresh = rendererOf(scene_);
    fresh->setEnvironment("sky", constantSky(1.0));
    frameOf(*fresh, lookAt(scene_, {0, 1, 5}, {}), small(48));
    EXPECT_EQ(edited.pixels(),
              frameOf(*fresh, lookAt(scene_, {0, 1, 5}, {}), small(48)).radiance.pixels());
}

TEST_F(ProbeEdit, WhatIsAsBeforeIsNotCapturedAgain) {
    set({at("a", {0, 0.3, 0}), at("b", {1, 0, 0})});
    EXPECT_EQ(draw().counters.probeFaces, 12u);
    EXPECT_EQ(draw().counters.probeFaces, 0u);
    lighting::Probe tinted = at("a", {0, 0.3, 0});
    tinted.tint = {1.0, 0.5, 0.25};
    set({tinted, at("b", {1, 0, 0})});
    EXPECT_EQ(draw().counters.probeFaces, 0u) << "a tint is a factor";
    set({at("b", {1, 0, 0})});
    EXPECT_EQ(draw().counters.probeFaces, 0u) << "one is taken away";
    EXPECT_TRUE(renderer_->isProbeReady(0));
    lighting::Probe moved = at("b", {1, 0.5, 0});
    moved.update = lighting::ProbeUpdate::Once; // however seldom it captures by itself
    set({moved});
    EXPECT_TRUE(renderer_->isProbeReady(0)) << "it shows nothing until it is captured anew";
    EXPECT_EQ(draw().counters.probeFaces, 6u);
    moved.capture.resolution = 16;
    set({moved});
    EXPECT_EQ(draw().counters.probeFaces, 6u);
}

TEST_F(ProbeEdit, ThousandEditsGainNothing) {
    set({at("a", {0, 0.3, 0}), at("b", {1, 0, 0})});
    draw();
    set({at("a", {0, 0.3, 0})});
    draw();
    const std::uint64_t textures = draw().counters.textureBytes;
    for (int i = 0; i < 1000; ++i) {
        lighting::Probe other = at("b", {1, 0, 0});
        other.capture.resolution = 8 << (i % 3);
        i % 2 == 0 ? set({at("a", {0, 0.3, 0}), other}) : set({at("a", {0, 0.3, 0})});
        if (i % 100 < 4) {
            draw();
        }
    }
    set({at("a", {0, 0.3, 0})});
    // A face of a size that was drawn waits in a cube of its own: six texels of 8 bytes each.
    std::uint64_t waiting = 0;
    for (const std::uint64_t width : {8u, 16u, 32u}) {
        waiting += 6 * width * width * 8 + width * width * 4 * (8 + 4);
    }
    EXPECT_LE(draw().counters.textureBytes, textures + waiting);
}

} // namespace
} // namespace lodestar

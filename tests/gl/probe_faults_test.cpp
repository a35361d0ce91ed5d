// SPDX-License-Identifier: MIT
//
// Light probes where something is broken: radiance that is no number, memory that is refused
// anywhere, renderers that come and go.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <string>
#include <unistd.h>
#include <vector>

#include <epoxy/gl.h>
#include <glm/geometric.hpp>

#include "lighting/environment.h"
#include "scene/renderer.h"
#include "support/gl_fixture.h"
#include "support/probe_world.h"

namespace lodestar {
namespace {

using testing::blinnPhong;
using testing::glowing;
using testing::ProbeWorld;

class ProbeFaults : public testing::ProbeTest {};

/// Level by level, face by face, what a probe lights with.
std::vector<core::Image> lightOf(const scene::Renderer& renderer, std::size_t probe) {
    std::vector<core::Image> all;
    for (int level = 0;; ++level) {
        for (int face = 0; face < 6; ++face) {
            core::Image image = renderer.readProbe(probe, face, level);
            if (image.empty()) {
                return all;
            }
            all.push_back(std::move(image));
        }
    }
}

/// A plate before a wall, seen by the probe as whole texels of +Z, 26 to 37, all of them behind the
/// eye; balls that read the probe at all levels.
scene::Scene withPlate(const io::GltfMaterial& plate) {
    ProbeWorld world;
    world.box("plate", {-0.75f, 0.25f, 4.0f}, {0.75f, 1.75f, 4.1f}, plate, 1);
    world.box("wall", {-9, -8, 4.5f}, {9, 10, 4.6f}, glowing(glm::vec3(0.25f, 0.5f, 1.0f)), 1);
    world.box("ground", {-4, -1.2f, -4}, {4, -1, 4}, glowing(glm::vec3(0.3f, 0.2f, 0.1f)), 1);
    world.ball("matt", {-0.5f, 0, 0}, 0.4f, blinnPhong(glm::vec3(0.8f), glm::vec3(0.0f), 0.0f), 2);
    world.ball("mirror", {0.5f, 0, 0}, 0.4f, blinnPhong(glm::vec3(0.0f), glm::vec3(0.8f), 4.0f), 2);
    lighting::Probe& probe = world.probe("here", {0, 1, 0}, {6, 6, 6}, 0.5);
    probe.capture.layers = 1;
    probe.capture.resolution = 64;
    return world.make();
}

struct Shown {
    std::vector<core::Image> light;
    core::Image picture;
};

// A host's or a scene's emission may be anything. Each broken channel is as if it were the value
// that it is repaired to, bit by bit in every level and in the picture, which reads irradiance too.
TEST_F(ProbeFaults, BrokenEmissionHurtsItsOwnTexelsAlone) {
    const auto shown = [&](const glm::vec3& emission, std::size_t warnings) {
        const scene::Scene scene = withPlate(glowing(emission));
        auto renderer = rendererOf(scene);
        renderer->setEnvironment("grey", testing::constantSky(0.5));
        const scene::View view = testing::lookAt(scene, {0, 0, 3}, {0, 0, 0}, 0.6f);
        const scene::Frame frame = frameOf(*renderer, view, small(64));
        EXPECT_EQ(frame.repairedPixels, 0u) << "the plate is not in the picture";
        EXPECT_EQ(renderer->probeWarnings().counts().size(), warnings);
        return Shown{lightOf(*renderer, 0), frame.radiance};
    };
    constexpr float kInfinite = std::numeric_limits<float>::infinity();
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    const Shown dark = shown(glm::vec3(0.0f, 0.7f, 0.0f), 0);
    const Shown cut = shown(glm::vec3(1e10f, 0.7f, 1e10f), 1); // half floats hold 2.1e9 beside 1e9
    ASSERT_GT(dark.light.size(), 6u * 4u);
    EXPECT_EQ(dark.light[4].at(32, 32)[0], 0.0f); // of +Z
    EXPECT_EQ(dark.light[4].at(38, 32)[0], 0.25f);
    EXPECT_GT(cut.light[4].at(32, 32)[0], 1e9f);
    const struct {
        const char* name;
        glm::vec3 emission;
        const Shown& same;
    } cases[] = {{"NaN", {kNan, 0.7f, kNan}, dark},
                 {"negative", {-5.0f, 0.7f, -kInfinite}, dark},
                 {"infinite", {kInfinite, 0.7f, 3e38f}, cut}};
    for (const auto& each : cases) {
        const Shown broken = shown(each.emission, 1);
        ASSERT_EQ(broken.light.size(), each.same.light.size()) << each.name;
        for (std::size_t i = 0; i < broken.light.size(); ++i) {
            for (std::size_t k = 0; k < broken.light[i].pixels().size(); ++k) {
                ASSERT_TRUE(std::isfinite(broken.light[i].pixels()[k])) << each.name << " " << i;
                ASSERT_EQ(broken.light[i].pixels()[k], each.same.light[i].pixels()[k])
                    << each.name << ", image " << i << ", value " << k;
            }
        }
        ASSERT_EQ(broken.picture.pixels(), each.same.picture.pixels()) << each.name;
    }
}

/// Objects of OpenGL that are alive, of names up to 4,096.
std::size_t aliveObjects() {
    std::size_t count = 0;
    for (GLuint name = 1; name <= 4096; ++name) {
        for (const GLboolean alive :
             {glIsTexture(name), glIsFramebuffer(name), glIsRenderbuffer(name), glIsBuffer(name),
              glIsProgram(name), glIsShader(name), glIsSampler(name), glIsVertexArray(name),
              glIsQuery(name)}) {
            count += alive;
        }
    }
    return count;
}

std::size_t residentKilobytes() {
    std::ifstream file("/proc/self/statm");
    std::size_t total = 0, resident = 0;
    file >> total >> resident;
    return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) / 1024;
}

// Probes of other sizes each time, drawn, then ended. A cube of 32 texels that is left takes 65 kB.
TEST_F(ProbeFaults, ProbesThatComeAndGoLeaveNothing) {
    std::size_t objects = 0, resident = 0;
    std::uint64_t bytes = 0;
    for (int i = 0; i < 150; ++i) {
        {
            ProbeWorld world;
            world.ball("ball", {0, 0, 0}, 0.5f, blinnPhong(glm::vec3(0.5f), glm::vec3(0.1f), 20.0f),
                       2);
            for (int k = 0; k < 3; ++k) {
                lighting::Probe& probe = world.probe("probe", {0.2 * k, 1, 0}, {5, 5, 5}, 0.5);
                probe.capture.resolution = 1 + (17 * i + 31 * k) % 48;
                probe.capture.layers = 1;
            }
            const scene::Scene scene = world.make();
            auto renderer = rendererOf(scene);
            renderer->setEnvironment("grey", testing::constantSky(0.4));
            scene::RenderSettings settings = small(8);
            settings.probeBudgetMs = 1e6; // times are measured, too
            for (int frame = 0; frame < 3; ++frame) {
                frameOf(*renderer, testing::lookAt(scene, {0, 1, 5}, {0, 0, 0}), settings);
            }
        }
        if (i == 0) {
            objects = aliveObjects();
            bytes = device().counters().textureBytes;
        }
        if (i == 30) {
            resident = residentKilobytes();
        }
    }
    EXPECT_EQ(aliveObjects(), objects);
    EXPECT_EQ(device().counters().textureBytes, bytes);
    EXPECT_LT(residentKilobytes(), resident + 2048);
}

/// Refuses the allocations of textures and renderbuffers after the first so many, as a driver does
/// that has no memory left: nothing happens but an error that is told once.
class Refusal {
public:
    explicit Refusal(int allowed) {
        left = allowed;
        refused = false;
        pending = false;
        glGetError(); // each has been called, so that these are the driver's
        image = epoxy_glTexImage2D;
        samples = epoxy_glRenderbufferStorageMultisample;
        error = epoxy_glGetError;
        epoxy_glTexImage2D = &Refusal::texImage;
        epoxy_glRenderbufferStorageMultisample = &Refusal::storage;
        epoxy_glGetError = &Refusal::getError;
    }
    ~Refusal() {
        epoxy_glTexImage2D = image;
        epoxy_glRenderbufferStorageMultisample = samples;
        epoxy_glGetError = error;
    }
    Refusal(const Refusal&) = delete;
    Refusal& operator=(const Refusal&) = delete;
    [[nodiscard]] static bool happened() { return refused; }

private:
    static bool refuses() {
        const bool none = left-- <= 0;
        refused = refused || none;
        pending = pending || none;
        return none;
    }
    static void texImage(GLenum target, GLint level, GLint format, GLsizei width, GLsizei height,
                         GLint border, GLenum of, GLenum type, const void* pixels) {
        if (!refuses()) {
            image(target, level, format, width, height, border, of, type, pixels);
        }
    }
    static void storage(GLenum target, GLsizei count, GLenum format, GLsizei width,
                        GLsizei height) {
        if (!refuses()) {
            samples(target, count, format, width, height);
        }
    }
    static GLenum getError() {
        return std::exchange(pending, false) ? GLenum{GL_OUT_OF_MEMORY} : error();
    }

    static inline int left = 0;
    static inline bool refused = false, pending = false;
    static inline PFNGLTEXIMAGE2DPROC image = nullptr;
    static inline PFNGLRENDERBUFFERSTORAGEMULTISAMPLEPROC samples = nullptr;
    static inline PFNGLGETERRORPROC error = nullptr;
};

// A second room comes into view and there is no memory for a part of what its probe needs, be it
// the first or the last: what the first room's holds stays as it was, and once there is memory the
// second is lit as if there always had been.
TEST_F(ProbeFaults, MemoryRefusedHalfWayLeavesWhatWasCaptured) {
    ProbeWorld world;
    for (int i = 0; i < 2; ++i) {
        const float x = 20.0f * static_cast<float>(i);
        world.ball("ball", {x, 0, 0}, 0.5f, blinnPhong(glm::vec3(0.5f), glm::vec3(0.1f), 20.0f), 2);
        world.box("lamp", {x - 1, 2, -1}, {x + 1, 2.2f, 1}, glowing(glm::vec3(1.0f + x)), 1);
        lighting::Probe& probe =
            world.probe("room " + std::to_string(i), {x, 1, 0}, {6, 6, 6}, 0.5);
        probe.capture.resolution = i == 0 ? 16 : 8;
        probe.capture.layers = 1;
    }
    const scene::Scene scene = world.make();
    const auto viewOf = [&](float x) { return testing::lookAt(scene, {x, 0, 3}, {x, 0, 0}, 0.6f); };
    const auto renderer = [&] {
        auto made = rendererOf(scene);
        made->setEnvironment("grey", testing::constantSky(0.5));
        frameOf(*made, viewOf(0.0f), small(16));
        return made;
    };
    auto whole = renderer();
    const core::Image first = frameOf(*whole, viewOf(0.0f), small(16)).radiance;
    const core::Image second = frameOf(*whole, viewOf(20.0f), small(16)).radiance;
    const std::vector<core::Image> held = lightOf(*whole, 0);
    int refusals = 0, failed = 0;
    for (bool happened = true; happened; ++refusals) {
        auto one = renderer();
        {
            const Refusal refusal(refusals);
            const auto frame = one->render(viewOf(20.0f), small(16));
            happened = Refusal::happened();
            failed += frame.ok() ? 0 : 1;
            if (!frame.ok()) {
                EXPECT_NE(frame.error().message().find("the driver"), std::string::npos);
            }
        }
        const std::vector<core::Image> now = lightOf(*one, 0);
        ASSERT_EQ(now.size(), held.size()) << refusals;
        for (std::size_t i = 0; i < now.size(); ++i) {
            ASSERT_EQ(now[i].pixels(), held[i].pixels()) << refusals;
        }
        EXPECT_EQ(frameOf(*one, viewOf(0.0f), small(16)).radiance.pixels(), first.pixels());
        const core::Image later = frameOf(*one, viewOf(20.0f), small(16)).radiance;
        if (one->probeWarnings().empty()) { // not made smaller
            EXPECT_EQ(later.pixels(), second.pixels()) << refusals;
        } else {
            EXPECT_NEAR(later.at(8, 8)[1], second.at(8, 8)[1], 0.2f * second.at(8, 8)[1]);
        }
    }
    std::printf("%d allocations, %d frames that failed\n", refusals - 1, failed);
    EXPECT_GT(refusals, 20);
    EXPECT_GT(failed, 0);
}

} // namespace
} // namespace lodestar

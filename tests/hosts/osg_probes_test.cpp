// SPDX-License-Identifier: MIT
//
// A document's light probes in OpenSceneGraph: the built-in renderer's pictures; a closed room
// keeps the sky out.
#include <string>

#include <gtest/gtest.h>

#include "host_pictures.h"
#include "support/probe_world.h"

namespace lodestar::testing {
namespace {

/// What a room holds.
struct Room {
    bool window = true; ///< the wall towards +Z is left out
    bool mirror = true; ///< a panel on the back wall
    bool ball = false;  ///< polished, not quite a mirror
};

/// A room of 4 x 3 x 4 metres.
std::string room(const TemporaryFolder& folder, const Room& with) {
    GltfBuilder file;
    const auto polished = [&](double f0, const nlohmann::json& exponent) {
        return file.add(
            "materials",
            {{"extras",
              {{"lodestar",
                {{"diffuse", {0.2, 0.2, 0.25}}, {"f0", {f0, f0, f0}}, {"exponent", exponent}}}}}});
    };
    const auto box = [&](const glm::vec3& low, const glm::vec3& high, int material) {
        const glm::vec3 c = 0.5f * (low + high), h = 0.5f * (high - low);
        io::GltfPrimitive shape = cube();
        shape.uvs[0].resize(shape.positions.size());
        file.show({file.primitive(shape, material)},
                  {{"translation", {c.x, c.y, c.z}}, {"scale", {h.x, h.y, h.z}}});
    };
    const int stone = file.lambert(0.7f, 0.6f, 0.5f);
    box({-2.25f, -0.25f, -2.25f}, {2.25f, 0.0f, 2.25f}, stone);
    box({-2.25f, 3.0f, -2.25f}, {2.25f, 3.25f, 2.25f}, stone);
    box({-2.25f, 0.0f, -2.25f}, {-2.0f, 3.0f, 2.25f}, file.lambert(0.7f, 0.15f, 0.1f));
    box({2.0f, 0.0f, -2.25f}, {2.25f, 3.0f, 2.25f}, stone);
    box({-2.0f, 0.0f, -2.25f}, {2.0f, 3.0f, -2.0f}, stone);
    if (!with.window) {
        box({-2.0f, 0.0f, 2.0f}, {2.0f, 3.0f, 2.25f}, stone);
    }
    if (with.mirror) {
        box({-1.0f, 0.5f, -2.0f}, {1.0f, 2.5f, -1.9375f}, polished(0.6, 1e6));
    }
    if (with.ball) {
        file.show(
            {file.primitive(sphere(48, 96), polished(0.5, 300))},
            {{"name", "ball"}, {"translation", {0, 0.75, -0.5}}, {"scale", {0.75, 0.75, 0.75}}});
    }
    return file.write(folder).string();
}

/// @param probe of the room; empty: none
std::string lighting(const TemporaryFolder& folder, const std::string& probe,
                     const std::string& more = {}) {
    return day(folder, "\"probes\": [" + probe + "], " + more);
}

constexpr const char* kRoom = R"({"name": "room", "position": [0.3, 1.6, 0.6],
    "capture": {"resolution": 64, "near": 0.05, "far": 50}, "exterior": false,
    "influence": {"shape": "box", "center": [-0.3, -0.1, -0.6], "size": [4.1, 3.1, 4.1], "blend": 0.2},
    "proxy": {"shape": "box", "center": [-0.3, -0.1, -0.6], "size": [4, 3, 4]}})";

constexpr const char* kInside = " --eye 0,1.5,1.75 --target 0,1.5,-1 --fov 75";

core::Image byOsg(const TemporaryFolder& folder, const std::string& scene, const std::string& light,
                  const char* view = kInside) {
    return drawn(program("lodestar-host-osg"), folder, scene, light, "9", view);
}
core::Image byUs(const TemporaryFolder& folder, const std::string& scene, const std::string& light,
                 const char* view = kInside) {
    return drawn(program("lodestar") + " render --samples 1 --no-backdrop", folder, scene, light,
                 "9", view);
}

// Captured, composed, corrected for parallax, looked up: all by the same rules.
TEST(OsgProbes, ARoomIsLitAsOurs) {
    const TemporaryFolder folder, other;
    const std::string scene = room(folder, {});
    const std::string light = lighting(folder, kRoom);
    const core::Image own = byUs(folder, scene, light);
    EXPECT_TRUE(passes(byOsg(folder, scene, light), own, "a room with a probe"));
    EXPECT_FALSE(passes(byOsg(folder, scene, lighting(other, "")), own, "without it"));
}

} // namespace
} // namespace lodestar::testing

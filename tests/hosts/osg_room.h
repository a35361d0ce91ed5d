// SPDX-License-Identifier: MIT
//
// A room with a light probe, drawn by OpenSceneGraph and by the built-in renderer, and the gate
// that their pictures pass.
#pragma once

#include <cstdio>
#include <string>

#include "host_pictures.h"
#include "support/probe_world.h"

namespace lodestar::testing {

/// What a room holds.
struct Room {
    bool window = true;           ///< the wall towards +Z is left out
    bool mirror = true;           ///< a panel on the back wall
    bool ball = false;            ///< that shines
    double exponent = 300.0;      ///< the ball's
    bool block = false;           ///< of stone, to the right of the eye
    unsigned layers = 0xffffffff; ///< of the block
};

/// A room of 4 x 3 x 4 metres.
inline std::string room(const TemporaryFolder& folder, const Room& with) {
    GltfBuilder file;
    const auto polished = [&](double f0, const nlohmann::json& exponent) {
        return file.add(
            "materials",
            {{"extras",
              {{"lodestar",
                {{"diffuse", {0.2, 0.2, 0.25}}, {"f0", {f0, f0, f0}}, {"exponent", exponent}}}}}});
    };
    const auto box = [&](const glm::vec3& low, const glm::vec3& high, int material,
                         unsigned layers = 0xffffffff) {
        const glm::vec3 c = 0.5f * (low + high), h = 0.5f * (high - low);
        io::GltfPrimitive shape = cube();
        shape.uvs[0].resize(shape.positions.size());
        file.show({file.primitive(shape, material)},
                  {{"translation", {c.x, c.y, c.z}},
                   {"scale", {h.x, h.y, h.z}},
                   {"extras", {{"lodestar", {{"layers", layers}}}}}});
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
    if (with.block) {
        box({0.6f, 0.0f, 0.3f}, {1.8f, 1.4f, 1.2f}, stone, with.layers);
    }
    if (with.ball) {
        file.show(
            {file.primitive(sphere(48, 96), polished(0.5, with.exponent))},
            {{"name", "ball"}, {"translation", {0, 0.75, -0.5}}, {"scale", {0.75, 0.75, 0.75}}});
    }
    return file.write(folder).string();
}

/// A painted sky, and a probe of the room; empty: none.
inline std::string lighting(const TemporaryFolder& folder, const std::string& probe) {
    return folder
        .write("sky.lodestar.json", R"({"lodestar": 1, "probes": [)" + probe + R"(], "lights": [
            {"name": "sky", "kind": "sky", "keys": [{"hour": 12, "gradient": {"stops": [
            {"at": 90, "color": [0.6, 1.2, 3.0]}, {"at": 0, "color": [3.0, 3.2, 3.4]},
            {"at": 0, "color": [1.0, 0.8, 0.6]}, {"at": -90, "color": [0.5, 0.4, 0.3]}]}}]}]})")
        .string();
}

inline constexpr const char* kRoom = R"({"name": "room", "position": [0.3, 1.6, 0.6],
    "capture": {"resolution": 64, "near": 0.05, "far": 50}, "exterior": false,
    "influence": {"shape": "box", "center": [-0.3, -0.1, -0.6], "size": [4.1, 3.1, 4.1], "blend": 0.2},
    "proxy": {"shape": "box", "center": [-0.3, -0.1, -0.6], "size": [4, 3, 4]}})";

inline constexpr const char* kInside = " --eye 0,1.5,1.75 --target 0,1.5,-1 --fov 75";

inline core::Image byOsg(const TemporaryFolder& folder, const std::string& scene,
                         const std::string& light, const char* view = kInside) {
    return drawn(program("lodestar-host-osg"), folder, scene, light, "9", view);
}
inline core::Image byUs(const TemporaryFolder& folder, const std::string& scene,
                        const std::string& light, const char* view = kInside) {
    return drawn(program("lodestar") + " render --samples 1 --no-backdrop", folder, scene, light,
                 "9", view);
}

/// At most two steps of 8 bits, a twentieth of one in the mean.
inline bool near(const core::Image& a, const core::Image& b, const char* what) {
    EXPECT_FALSE(a.empty() || b.empty());
    const Difference d = compare(a, b, 2.5 / 255.0);
    std::printf("%s: largest %.2f / 255, mean %.4f / 255\n", what, 255.0 * d.largest,
                255.0 * d.mean);
    return d.largest <= 2.5 / 255.0 && d.mean <= 0.05 / 255.0;
}

} // namespace lodestar::testing

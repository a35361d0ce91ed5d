// SPDX-License-Identifier: MIT
//
// The scene and the document that hosts are compared under, and the gate that their pictures pass.
#pragma once

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "golden/gltf_builder.h"
#include "io/image_file.h"
#include "support/picture.h"
#include "support/shapes.h"

namespace lodestar::testing {

/// Three spheres: rough, metallic, polished; the last one moved by the caller.
inline std::string spheres(const TemporaryFolder& folder, double x) {
    GltfBuilder file;
    const io::GltfPrimitive shape = sphere(48, 96);
    const int rough = file.lambert(0.7f, 0.3f, 0.2f);
    const int metal = file.add(
        "materials", {{"pbrMetallicRoughness",
                       {{"baseColorFactor", {1.0, 0.77, 0.34, 1.0}}, {"roughnessFactor", 0.35}}}});
    const int polished = file.add(
        "materials",
        {{"extras",
          {{"lodestar",
            {{"diffuse", {0.1, 0.15, 0.3}}, {"f0", {0.3, 0.3, 0.3}}, {"exponent", 900}}}}}});
    file.show({file.primitive(shape, rough)}, {{"translation", {-2.2, 0, 0}}});
    file.show({file.primitive(shape, metal)}, {{"scale", {1.0, 0.7, 1.0}}});
    file.show({file.primitive(shape, polished)}, {{"translation", {x, 0.3, 0}},
                                                  {"rotation", {0.0, 0.0, 0.3826834, 0.9238795}},
                                                  {"scale", {0.8, 1.0, 0.8}}});
    return file.write(folder).string();
}

/// A sky and a sun that the day moves; the sun casts no shadow, for that is the host's own.
/// @param more members of the document  @param ofSky members of the sky
inline std::string day(const TemporaryFolder& folder, const std::string& more = {},
                       const std::string& ofSky = {}) {
    return folder
        .write("day.lodestar.json", R"({"lodestar": 1, )" + more + R"("lights": [
        {"name": "sky", "kind": "sky", )" +
                                        ofSky + R"("keys": [
            {"hour": 12, "gradient": {"stops": [{"at": 90, "color": [0.1, 0.25, 0.7]}, {"at": 0, "color": [0.8, 0.85, 0.9]},
                {"at": 0, "color": [0.25, 0.2, 0.15]}, {"at": -90, "color": [0.1, 0.08, 0.06]}]}},
            {"hour": 20, "tint": [0.4, 0.3, 0.5], "gradient": {"stops": [{"at": 90, "color": [0.1, 0.12, 0.35]},
                {"at": 0, "color": [1.2, 0.6, 0.25]}, {"at": -90, "color": [0.04, 0.03, 0.03]}]}}]},
        {"name": "sun", "kind": "sun", "visibility": false, "path": {"latitude": 45, "dayOfYear": 170}, "keys": [
            {"hour": 12, "gradient": {"stops": [{"at": 0, "color": [1, 0.95, 0.9], "ev": 12}, {"at": 0.5, "color": [1, 0.95, 0.9], "ev": 12},
                {"at": 0.5, "color": [1, 1, 1]}, {"at": 20, "color": [0, 0, 0]}]}}]}]})")
        .string();
}

inline std::string program(const std::string& name) {
    const std::string own = LODESTAR_EXECUTABLE;
    return own.substr(0, own.rfind('/') + 1) + name;
}

inline constexpr const char* kView = " --eye 0,1,7 --target 0,0,0 --fov 45";

inline core::Image drawn(const std::string& command, const TemporaryFolder& folder,
                         const std::string& scene, const std::string& lighting,
                         const std::string& hour, const char* view = kView) {
    const std::string out = (folder / "drawn.png").string();
    std::filesystem::remove(out); // no picture of before is read
    const std::string whole = command + " " + scene + " --lighting " + lighting + " -o " + out +
                              " --size 240x120" + view + " --hour " + hour;
    EXPECT_EQ(std::system(whole.c_str()), 0) << whole;
    return readPicture(out);
}

/// A room with a bright window, its walls of three colours.
inline void writeRoom(const std::filesystem::path& path) {
    core::Image panorama(128, 64, 3);
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 128; ++x) {
            const bool window = x > 70 && x < 84 && y > 18 && y < 30;
            const float wall = 0.1f + 0.2f * static_cast<float>(x / 43);
            const float lit = window ? 24.0f : wall * (y < 32 ? 1.0f : 0.4f);
            const float texel[3] = {lit, lit * 0.9f, lit * (window ? 0.8f : 0.5f)};
            std::copy(std::begin(texel), std::end(texel), panorama.at(x, y));
        }
    }
    ASSERT_TRUE(io::writeImage(path, panorama));
}

/// The gate: at most two steps of 8 bits anywhere, a hundredth of one in the mean.
inline bool passes(const core::Image& a, const core::Image& b, const char* what) {
    EXPECT_FALSE(a.empty() || b.empty());
    const Difference d = compare(a, b, 2.5 / 255.0);
    std::printf("%s: largest %.2f / 255, mean %.4f / 255\n", what, 255.0 * d.largest,
                255.0 * d.mean);
    return d.largest <= 2.5 / 255.0 && d.mean <= 0.01 / 255.0;
}

} // namespace lodestar::testing

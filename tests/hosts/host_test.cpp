// SPDX-License-Identifier: MIT
//
// The same scene under the same document in another engine (LODESTAR_HOST) and in the built-in
// renderer.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "golden/gltf_builder.h"
#include "io/image_file.h"
#include "support/picture.h"
#include "support/shapes.h"

namespace lodestar::testing {
namespace {

/// Three spheres: rough, metallic, polished; the last one moved by the caller.
std::string spheres(const TemporaryFolder& folder, double x) {
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
std::string day(const TemporaryFolder& folder, const std::string& more = {},
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

std::string program(const std::string& name) {
    const std::string own = LODESTAR_EXECUTABLE;
    return own.substr(0, own.rfind('/') + 1) + name;
}

constexpr const char* kView = " --eye 0,1,7 --target 0,0,0 --fov 45";

core::Image drawn(const std::string& command, const TemporaryFolder& folder,
                  const std::string& scene, const std::string& lighting, const std::string& hour,
                  const char* view = kView) {
    const std::string out = (folder / "drawn.png").string();
    std::filesystem::remove(out); // no picture of before is read
    const std::string whole = command + " " + scene + " --lighting " + lighting + " -o " + out +
                              " --size 240x120" + view + " --hour " + hour;
    EXPECT_EQ(std::system(whole.c_str()), 0) << whole;
    return readPicture(out);
}

core::Image byHost(const TemporaryFolder& folder, const std::string& scene,
                   const std::string& lighting, const std::string& hour) {
    return drawn(program(LODESTAR_HOST), folder, scene, lighting, hour);
}

core::Image byUs(const TemporaryFolder& folder, const std::string& scene,
                 const std::string& lighting, const std::string& hour) {
    return drawn(program("lodestar") + " render --samples 1 --no-backdrop", folder, scene, lighting,
                 hour);
}

/// The gate: at most two steps of 8 bits anywhere, a hundredth of one in the mean.
bool passes(const core::Image& a, const core::Image& b, const char* what) {
    EXPECT_FALSE(a.empty() || b.empty());
    const Difference d = compare(a, b, 2.5 / 255.0);
    std::printf("%s: largest %.2f / 255, mean %.4f / 255\n", what, 255.0 * d.largest,
                255.0 * d.mean);
    return d.largest <= 2.5 / 255.0 && d.mean <= 0.01 / 255.0;
}

TEST(Host, ADocumentLightsItAsItLightsUs) {
    const TemporaryFolder folder;
    const std::string lighting = day(folder);
    const std::string scene = spheres(folder, 2.2);
    for (const std::string hour : {"9", "17.5", "22"}) {
        EXPECT_TRUE(passes(byHost(folder, scene, lighting, hour),
                           byUs(folder, scene, lighting, hour), ("hour " + hour).c_str()));
    }
    // What moves is moved in both.
    const TemporaryFolder other;
    const std::string moved = spheres(other, 1.7);
    const core::Image own = byUs(folder, moved, lighting, "9");
    EXPECT_TRUE(passes(byHost(folder, moved, lighting, "9"), own, "moved"));
    // What must fail the gate: another hour, another place.
    EXPECT_FALSE(passes(byHost(folder, moved, lighting, "9.5"), own, "half an hour later"));
    EXPECT_FALSE(passes(byHost(folder, scene, lighting, "9"), own, "not moved"));
}

/// A room with a bright window, its walls of three colours.
void writePanorama(const std::filesystem::path& path) {
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

TEST(Host, ADocumentsEnvironmentLightsIt) {
    const TemporaryFolder folder;
    writePanorama(folder / "room.exr");
    const std::string scene = spheres(folder, 2.2);
    const std::string room =
        R"("environment": {"source": "room.exr", "rotation": 35, "ev": 0.5}, )";
    const std::string beside = day(folder, room, R"("add": true, )");
    const core::Image own = byUs(folder, scene, beside, "9");
    EXPECT_TRUE(passes(byHost(folder, scene, beside, "9"), own, "environment, sky and sun"));
    // The other documents must fail the gate: no environment, a sky in its place, another way up.
    EXPECT_FALSE(passes(byHost(folder, scene, day(folder), "9"), own, "without it"));
    EXPECT_FALSE(passes(byHost(folder, scene, day(folder, room), "9"), own, "a sky in its place"));
    const std::string turned = R"("environment": {"source": "room.exr", "ev": 0.5}, )";
    EXPECT_FALSE(passes(byHost(folder, scene, day(folder, turned, R"("add": true, )"), "9"), own,
                        "not turned"));
    // Alone.
    const std::string alone =
        folder
            .write("room.lodestar.json",
                   R"({"lodestar": 1, "environment": {"source": "room.exr"}})")
            .string();
    EXPECT_TRUE(passes(byHost(folder, scene, alone, "9"), byUs(folder, scene, alone, "9"),
                       "environment alone"));
}

TEST(Host, TheHostsAreCalledAlike) {
    const TemporaryFolder folder;
    const std::string lighting = day(folder);
    const std::string scene = spheres(folder, 2.2);
    // Without a view each shows the whole scene, from the same place.
    const core::Image builtin =
        drawn(program("lodestar-host-builtin"), folder, scene, lighting, "9", "");
    EXPECT_TRUE(passes(drawn(program(LODESTAR_HOST), folder, scene, lighting, "9", ""), builtin,
                       "the scene framed"));
    EXPECT_FALSE(passes(byHost(folder, scene, lighting, "9"), builtin, "from elsewhere"));
}

TEST(Host, ADocumentsMaterialsStandOverTheFiles) {
    const TemporaryFolder folder, plain;
    const std::string scene = spheres(folder, 2.2);
    const std::string lighting =
        day(folder, R"("materials": {"#1": {"exponent": 200, "f0": [0.2, 0.5, 0.3]},
                                     "#2": {"diffuse": [0.4, 0.1, 0.1]}}, )");
    const core::Image own = byUs(folder, scene, lighting, "9");
    EXPECT_TRUE(passes(byHost(folder, scene, lighting, "9"), own, "materials"));
    EXPECT_FALSE(passes(byHost(folder, scene, day(plain), "9"), own, "without them"));
}

TEST(Host, ADocumentThatCannotLightIsSaid) {
    const TemporaryFolder folder;
    const std::string scene = spheres(folder, 2.2);
    const std::string said = (folder / "said").string();
    const std::pair<const char*, const char*> cases[] = {
        {R"({"lodestar": 1, "lights": [{"kind": "moon", "keys": []}]})", "(/lights/0/kind)"},
        {R"({"lodestar": 1})", "(/lights)"},
        {R"({"lodestar": 1, "environment": {"source": "../room.exr"}})", "(/environment/source)"}};
    for (const auto& [text, place] : cases) {
        const std::string file = folder.write("broken.lodestar.json", std::string(text)).string();
        for (const char* host : {LODESTAR_HOST, "lodestar-host-builtin"}) {
            const std::string command = program(host) + " " + scene + " --lighting " + file +
                                        " -o " + (folder / "x.png").string() + " --size 8x8 2>" +
                                        said;
            EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 3);
            std::ifstream answer(said);
            std::string line;
            std::getline(answer, line);
            EXPECT_NE(line.find(file), std::string::npos) << line;
            EXPECT_NE(line.find(place), std::string::npos) << line;
        }
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "x.png"));
}

} // namespace
} // namespace lodestar::testing

// SPDX-License-Identifier: MIT
//
// The command line as a contract: exit statuses, one-line errors, JSON that parses.
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/picture.h"
#include "support/run.h"

namespace lodestar::testing {
namespace {

/// The smallest scene: no meshes.
std::string emptyScene(const TemporaryFolder& folder) {
    const std::string path = folder.file("empty.gltf");
    std::ofstream(path) << R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[]}],"scene":0})";
    return path;
}

struct BadCall {
    const char* name;
    std::vector<std::string> arguments;
    int status;
    const char* mentions;
};

TEST(CommandLine, BadCallsSayOneLineAndTheirStatus) {
    const TemporaryFolder folder;
    const std::string scene = emptyScene(folder);
    const std::string out = folder.file("out.png");
    const BadCall calls[] = {
        {"no subcommand", {}, 2, "subcommand"},
        {"unknown subcommand", {"paint"}, 2, ""},
        {"no output", {"render", scene}, 2, "output"},
        {"bad extension", {"render", scene, "-o", folder.file("x.gif")}, 2, ".exr"},
        {"bad size", {"render", scene, "-o", out, "--size", "0x10"}, 2, "--size"},
        {"huge size", {"render", scene, "-o", out, "--size", "99999x10"}, 2, "--size"},
        {"bad estimator", {"render", scene, "-o", out, "--specular", "shiny"}, 2, "tent"},
        {"too few taps", {"render", scene, "-o", out, "--specular", "taps:0"}, 2, "1 to 1024"},
        {"ring of five", {"render", scene, "-o", out, "--specular", "ring:5"}, 2, "ring:7"},
        {"cpu estimator", {"render", scene, "-o", out, "--specular", "reference"}, 2, "sample"},
        {"lights' estimator without lights",
         {"render", scene, "-o", out, "--specular", "rsrm-published"},
         2,
         "there are none"},
        {"two estimators of lights",
         {"render", scene, "-o", out, "--specular", "rsrm-published", "--diffuse", "rsrm"},
         2,
         "one estimator"},
        {"bad field of view", {"render", scene, "-o", out, "--fov", "180"}, 2, "--fov"},
        {"bad eye", {"render", scene, "-o", out, "--eye", "1,2"}, 2, "--eye"},
        {"bad override",
         {"render", scene, "-o", out, "--override-material", "f0=2,0,0"},
         2,
         "[0, 1]"},
        {"unknown override",
         {"render", scene, "-o", out, "--override-material", "gloss=1"},
         2,
         "gloss"},
        {"bad samples", {"render", scene, "-o", out, "--samples", "3"}, 2, "samples"},
        {"error view of nothing lit",
         {"render", scene, "-o", out, "--error-view", folder.file("e.png")},
         2,
         "no surface"},
        {"error view in floats",
         {"render", scene, "-o", out, "--error-view", folder.file("e.exr")},
         2,
         ".png"},
        {"missing camera", {"render", scene, "-o", out, "--camera", "north"}, 2, "north"},
        {"no scene of that name", {"plan", scene, "--scene", "attic"}, 2, "no scene 'attic'"},
        {"missing scene", {"render", folder.file("none.gltf"), "-o", out}, 3, "none.gltf"},
        {"missing panorama",
         {"render", scene, "-o", out, "--environment", folder.file("none.hdr")},
         3,
         "none.hdr"},
        {"bad analytic",
         {"render", scene, "-o", out, "--environment", "constant:1,x,1"},
         2,
         "constant"},
        {"no folder", {"render", scene, "-o", folder.file("no/such/folder/out.png")}, 5, "out.png"},
        {"no folder for stats",
         {"render", scene, "-o", out, "--stats", folder.file("no/stats.json")},
         5,
         "stats.json"},
        {"bad exponent",
         {"sample", "--environment", "constant:1,1,1", "--lobe", "phong", "--exponent", "-1",
          "--direction", "0,0,1", "--estimator", "tent"},
         2,
         "exponent"},
        {"zero direction",
         {"sample", "--environment", "constant:1,1,1", "--lobe", "phong", "--exponent", "1",
          "--direction", "0,0,0", "--estimator", "tent"},
         2,
         "direction"},
        {"check of nothing", {"check", folder.file("none.glb")}, 3, "none.glb"},
    };
    for (const BadCall& call : calls) {
        SCOPED_TRACE(call.name);
        const RunResult run = runLodestar(call.arguments);
        EXPECT_EQ(run.status, call.status) << run.err;
        ASSERT_EQ(run.errorLines().size(), 1u) << run.err;
        EXPECT_EQ(run.errorLines()[0].rfind("lodestar: ", 0), 0u);
        EXPECT_NE(run.errorLines()[0].find(call.mentions), std::string::npos) << run.err;
    }
}

TEST(CommandLine, NoUsableOpenGlIsStatusFour) {
    const TemporaryFolder folder;
    const RunResult run = runLodestar({"render", emptyScene(folder), "-o", folder.file("x.png")},
                                      {"MESA_GL_VERSION_OVERRIDE=2.1"});
    EXPECT_EQ(run.status, 4);
    ASSERT_EQ(run.errorLines().size(), 1u) << run.err;
    EXPECT_NE(run.err.find("3.3"), std::string::npos) << run.err;
}

TEST(CommandLine, OpenGl33IsEnough) {
    const TemporaryFolder folder;
    const RunResult run =
        runLodestar({"render", emptyScene(folder), "-o", folder.file("x.png"), "--size", "32x32"},
                    {"MESA_GL_VERSION_OVERRIDE=3.3"});
    EXPECT_EQ(run.status, 0) << run.err;
}

TEST(CommandLine, HelpTeachesWithAnExample) {
    for (const char* command : {"render", "view", "plan", "sample", "check"}) {
        const RunResult run = runLodestar({command, "--help"});
        EXPECT_EQ(run.status, 0) << command;
        EXPECT_NE(run.out.find("Example"), std::string::npos) << command;
    }
    EXPECT_EQ(runLodestar({"--help"}).status, 0);
    EXPECT_EQ(runLodestar({"--version"}).status, 0);
}

TEST(CommandLine, PlanIsJsonAndAgreesWithTheCountersOfRender) {
    const TemporaryFolder folder;
    const std::string scene = emptyScene(folder);
    const RunResult planned = runLodestar({"plan", scene, "--environment", "gradient:0.1,1"});
    ASSERT_EQ(planned.status, 0) << planned.err;
    const nlohmann::json plan = nlohmann::json::parse(planned.out);
    std::uint64_t draws = 0;
    for (const nlohmann::json& effect : plan.at("effects")) {
        EXPECT_TRUE(effect.at("decision") == "run" || effect.at("decision") == "skip");
        EXPECT_FALSE(effect.at("reason").get<std::string>().empty());
        draws +=
            effect.at("decision") == "run" ? effect.at("cost").at("draws").get<std::uint64_t>() : 0;
    }
    const std::string stats = folder.file("stats.json");
    const RunResult rendered =
        runLodestar({"render", scene, "--environment", "gradient:0.1,1", "-o", folder.file("x.exr"),
                     "--size", "48x32", "--frames", "3", "--stats", stats});
    ASSERT_EQ(rendered.status, 0) << rendered.err;
    std::ifstream file(stats);
    const nlohmann::json report = nlohmann::json::parse(file);
    ASSERT_EQ(report.at("frames").size(), 3u);
    EXPECT_EQ(report.at("frames")[0].at("counters").at("draws"), draws);
    EXPECT_EQ(report.at("frames")[2].at("counters").at("shader_compilations"), 0);
    EXPECT_EQ(report.at("counters").at("gl_errors"), 0);
    for (const char* key : {"passes", "texels_written", "uploads", "upload_bytes",
                            "program_switches", "state_queries", "probe_faces", "texture_bytes"}) {
        EXPECT_TRUE(report.at("counters").contains(key)) << key;
    }
    EXPECT_EQ(report.at("plan").at("effects").size(), plan.at("effects").size());
    EXPECT_EQ(report.at("estimators").at("specular"), "tent");
}

TEST(CommandLine, ASceneIsChosenByNameOrNumber) {
    const TemporaryFolder folder;
    const std::string file = folder.file("two.gltf");
    std::ofstream(file) << R"({"asset": {"version": "2.0"}, "scene": 0,
        "scenes": [{"name": "hall", "nodes": [0]}, {"name": "attic", "nodes": [1]}],
        "nodes": [{"name": "table", "mesh": 0}, {"name": "chest", "mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"componentType": 5126, "count": 3, "type": "VEC3"}]})";
    const auto subject = [&](const std::vector<std::string>& scene) {
        std::vector<std::string> arguments = {"plan", file, "--environment", "constant:1,1,1"};
        arguments.insert(arguments.end(), scene.begin(), scene.end());
        const RunResult run = runLodestar(arguments);
        EXPECT_EQ(run.status, 0) << run.err;
        const nlohmann::json plan = nlohmann::json::parse(run.out);
        std::string names;
        for (const auto& effect : plan.at("effects")) {
            names += effect.at("effect") == "draw" ? effect.at("subject").get<std::string>() : "";
        }
        return names;
    };
    EXPECT_EQ(subject({}), "table/0");
    EXPECT_EQ(subject({"--scene", "attic"}), "chest/0");
    EXPECT_EQ(subject({"--scene", "1"}), "chest/0");
    EXPECT_EQ(subject({"--scene", "hall"}), "table/0");
}

/// How many pixels of the left and of the right half of a picture show something.
std::array<int, 2> coveredHalves(const std::string& picture) {
    const core::Image image = readPicture(picture);
    std::array<int, 2> halves{};
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            halves[x < image.width() / 2 ? 0 : 1] += image.at(x, y)[3] > 0.0f ? 1 : 0;
        }
    }
    return halves;
}

TEST(CommandLine, ASceneIsShownByNameAndByNumber) {
    const TemporaryFolder folder;
    const float corners[] = {-0.4f, 0, 0, 0.4f, 0, 0, 0, 0.4f, 0};
    std::ofstream(folder.file("corners.bin"), std::ios::binary)
        .write(reinterpret_cast<const char*>(corners), sizeof corners);
    const std::string file = folder.file("two.gltf");
    std::ofstream(file) << R"({"asset": {"version": "2.0"}, "scene": 1,
        "scenes": [{"name": "left", "nodes": [0]}, {"name": "right", "nodes": [1]}],
        "nodes": [{"mesh": 0, "translation": [-0.6, 0, 0]}, {"mesh": 0, "translation": [0.6, 0, 0]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [-0.4, 0, 0], "max": [0.4, 0.4, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"uri": "corners.bin", "byteLength": 36}]})";
    const std::pair<std::vector<std::string>, std::size_t> cases[] = {{{}, 1},
                                                                      {{"--scene", "left"}, 0},
                                                                      {{"--scene", "0"}, 0},
                                                                      {{"--scene", "right"}, 1},
                                                                      {{"--scene", "1"}, 1}};
    for (const auto& [choice, half] : cases) {
        const std::string out = folder.file("seen.exr");
        std::vector<std::string> call = {
            "render",       file,      "-o",       out,       "--size",        "64x64",
            "--eye",        "0,0.2,3", "--target", "0,0.2,0", "--environment", "constant:1,1,1",
            "--no-backdrop"};
        call.insert(call.end(), choice.begin(), choice.end());
        const RunResult run = runLodestar(call);
        ASSERT_EQ(run.status, 0) << run.err;
        EXPECT_GT(coveredHalves(out)[half], 20);
        EXPECT_EQ(coveredHalves(out)[1 - half], 0);
    }
}

TEST(CommandLine, FramesAreNumbered) {
    const TemporaryFolder folder;
    const RunResult run = runLodestar({"render", emptyScene(folder), "-o", folder.file("f%04d.png"),
                                       "--size", "16x16", "--frames", "2"});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_TRUE(std::filesystem::exists(folder.file("f0000.png")));
    EXPECT_TRUE(std::filesystem::exists(folder.file("f0001.png")));
}

/// A triangle that slides one to the right in two seconds; a second animation steps its scale. The
/// buffer: times 0 and 2; translations (0, 0, 0) and (1, 0, 0); scales (1, 1, 1) and (2, 2, 2);
/// corners (0, 0, 0), (1, 0, 0), (0, 1, 0). Floats, little-endian.
std::string movingScene(const TemporaryFolder& folder) {
    const float numbers[] = {0, 2, 0, 0, 0, 1, 0, 0, 1, 1, 1, 2, 2, 2, 0, 0, 0, 1, 0, 0, 0, 1, 0};
    std::ofstream(folder.file("moving.bin"), std::ios::binary)
        .write(reinterpret_cast<const char*>(numbers), sizeof numbers);
    const std::string path = folder.file("moving.gltf");
    std::ofstream(path) << R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 3}}]}],
        "buffers": [{"uri": "moving.bin", "byteLength": 92}],
        "bufferViews": [{"buffer": 0, "byteLength": 56}, {"buffer": 0, "byteOffset": 56, "byteLength": 36, "target": 34962}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [2]},
            {"bufferView": 0, "byteOffset": 8, "componentType": 5126, "count": 2, "type": "VEC3"},
            {"bufferView": 0, "byteOffset": 32, "componentType": 5126, "count": 2, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
        "animations": [
            {"name": "slide", "samplers": [{"input": 0, "output": 1}],
             "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]},
            {"name": "grow", "samplers": [{"input": 0, "output": 2, "interpolation": "STEP"}],
             "channels": [{"sampler": 0, "target": {"node": 0, "path": "scale"}}]}]})";
    return path;
}

TEST(CommandLine, CheckTellsWhatMovesAndForHowLong) {
    const TemporaryFolder folder;
    const RunResult run = runLodestar({"check", movingScene(folder)});
    ASSERT_EQ(run.status, 0) << run.err;
    const nlohmann::json json = nlohmann::json::parse(run.out);
    EXPECT_EQ(json.at("problems").size(), 0u) << json.at("problems");
    EXPECT_EQ(json.at("animations"), 2);
    EXPECT_EQ(json.at("animationList"), nlohmann::json::parse(R"([
        {"name": "slide", "duration": 2.0, "channels": [
            {"node": 0, "path": "translation", "interpolation": "LINEAR", "keys": 2}]},
        {"name": "grow", "duration": 2.0, "channels": [
            {"node": 0, "path": "scale", "interpolation": "STEP", "keys": 2}]}])"));
}

TEST(CommandLine, FramesShowTheAnimationAtTheirTimes) {
    const TemporaryFolder folder;
    const std::string scene = movingScene(folder);
    const auto render = [&](const std::string& out, const std::vector<std::string>& more) {
        std::vector<std::string> arguments = {"render",
                                              scene,
                                              "-o",
                                              folder.file(out),
                                              "--size",
                                              "32x32",
                                              "--environment",
                                              "constant:1,1,1",
                                              "--no-backdrop"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const RunResult run = runLodestar(arguments);
        EXPECT_EQ(run.status, 0) << run.err;
    };
    // Frame I of a sequence is the picture at --time + I / F, wherever it is drawn.
    render("s%04d.exr", {"--frames", "3", "--fps", "2", "--time", "0.5"});
    for (const auto& [frame, time] : {std::pair("s0000.exr", "0.5"), std::pair("s0001.exr", "1"),
                                      std::pair("s0002.exr", "1.5")}) {
        render("one.exr", {"--animation", "slide", "--time", time});
        EXPECT_EQ(readPicture(folder.file(frame)).pixels(),
                  readPicture(folder.file("one.exr")).pixels())
            << frame;
    }
    EXPECT_NE(readPicture(folder.file("s0000.exr")).pixels(),
              readPicture(folder.file("s0002.exr")).pixels());
    // Before the last key a STEP holds the first; a name and a number mean the same animation.
    render("step.exr", {"--animation", "grow", "--time", "1.9"});
    render("rest.exr", {"--animation", "1", "--time", "0"});
    render("grown.exr", {"--animation", "1", "--time", "2"});
    EXPECT_EQ(readPicture(folder.file("step.exr")).pixels(),
              readPicture(folder.file("rest.exr")).pixels());
    EXPECT_NE(readPicture(folder.file("grown.exr")).pixels(),
              readPicture(folder.file("rest.exr")).pixels());
}

TEST(CommandLine, ExrHoldsRadianceWhateverTheExposure) {
    const TemporaryFolder folder;
    const std::string scene = emptyScene(folder);
    const RunResult run =
        runLodestar({"render", scene, "--environment", "constant:3,2,1", "--exposure", "4", "-o",
                     folder.file("x.exr"), "--size", "8x8"});
    ASSERT_EQ(run.status, 0) << run.err;
    const core::Image image = readPicture(folder.file("x.exr"));
    EXPECT_FLOAT_EQ(image.at(4, 4)[0], 3.0f);
    EXPECT_FLOAT_EQ(image.at(4, 4)[2], 1.0f);
    EXPECT_FLOAT_EQ(image.at(4, 4)[3], 1.0f);
}

using nlohmann::json;

/// A scene of nothing under an EXT_lights_image_based of six files, each face of one colour.
std::string lightFromFiles(const TemporaryFolder& folder, const json& rotation) {
    const char* faces[] = {"px", "nx", "py", "ny", "pz", "nz"};
    json document = json::parse(
        R"({"asset": {"version": "2.0"}, "scene": 0, "extensionsUsed": ["EXT_lights_image_based"],
            "scenes": [{"extensions": {"EXT_lights_image_based": {"light": 0}}}]})");
    json light = {{"intensity", 2.0}, {"rotation", rotation}, {"specularImageSize", 4}};
    light["irradianceCoefficients"] = std::vector<std::vector<double>>(9, {0.0, 0.0, 0.0});
    for (int face = 0; face < 6; ++face) {
        core::Image image(4, 4, 4);
        for (int i = 0; i < 16; ++i) {
            float* texel = &image.pixels()[static_cast<std::size_t>(4 * i)];
            texel[0] = (face & 1) != 0 ? 0.8f : 0.4f; // as encoded
            texel[1] = (face & 2) != 0 ? 0.8f : 0.4f;
            texel[2] = (face & 4) != 0 ? 0.8f : 0.4f;
            texel[3] = 1.0f;
        }
        const std::string name = std::string("sky_") + faces[face] + ".png";
        EXPECT_TRUE(io::writeImage(folder.file(name), image).ok());
        document["images"].push_back({{"uri", name}});
        light["specularImages"][0].push_back(face);
    }
    document["extensions"]["EXT_lights_image_based"]["lights"] = {light};
    std::ofstream(folder.file("under.gltf")) << document.dump();
    return folder.file("under.gltf");
}

// Seen from within, each face is where GL has it; turned by 90 degrees about +Y, what was along +X
// is along -Z. Encoded values are decoded from sRGB and doubled by the intensity.
TEST(CommandLine, ALightOfFilesSurroundsItsScene) {
    const char* directions[] = {"1,0,0", "-1,0,0", "0,1,0.001", "0,-1,0.001", "0,0,1", "0,0,-1"};
    const int turned[] = {4, 5, 2, 3, 1, 0}; // the face seen along each
    const double root = std::sqrt(0.5);
    for (const bool turn : {false, true}) {
        const TemporaryFolder folder;
        const std::string scene =
            lightFromFiles(folder, turn ? json{0.0, root, 0.0, root} : json{0.0, 0.0, 0.0, 1.0});
        for (int along = 0; along < 6; ++along) {
            const std::string out = folder.file("seen.exr");
            const RunResult run =
                runLodestar({"render", scene, "-o", out, "--size", "4x4", "--environment-width",
                             "16", "--eye", "0,0,0", "--target", directions[along], "--fov", "10"});
            ASSERT_EQ(run.status, 0) << run.err;
            const int face = turn ? turned[along] : along;
            const core::Image seen = readPicture(out);
            for (int c = 0; c < 3; ++c) {
                const double encoded = std::round((face >> c & 1) != 0 ? 204.0 : 102.0) / 255.0;
                const double linear = 2.0 * std::pow((encoded + 0.055) / 1.055, 2.4);
                EXPECT_NEAR(static_cast<double>(seen.at(2, 2)[c]), linear, 2e-3 * linear)
                    << (turn ? "turned, along " : "along ") << directions[along] << " channel "
                    << c;
            }
        }
    }
}

} // namespace
} // namespace lodestar::testing

// SPDX-License-Identifier: MIT
//
// `lodestar bake`: maps read back against sums of their own, and calls that are refused.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/file.h"
#include "io/image_file.h"
#include "lighting/rsrm_layout.h"
#include "lighting/rsrm_weights.h"
#include "lighting/zonal.h"
#include "support/picture.h"
#include "support/run.h"

namespace lodestar::testing {
namespace {

using nlohmann::json;

/// A strip of one radiance, as a column of texels.
std::string constantStrip(const TemporaryFolder& folder, float value) {
    core::Image strip(1, 12, 3);
    std::fill(strip.pixels().begin(), strip.pixels().end(), value);
    std::string path = folder.file("constant.exr");
    EXPECT_TRUE(io::writeImage(path, strip).ok());
    return path;
}

/// A sky of two colours and a sun of 5 degrees, at fixed axes.
std::string document(const TemporaryFolder& folder) {
    std::string path = folder.file("two.lodestar.json");
    std::ofstream(path) << R"({"lodestar": 1, "lights": [
        {"name": "sky", "kind": "sky", "keys": [{"hour": 12, "gradient": {"stops": [
            {"at": 90, "color": [0.2, 0.4, 0.8]}, {"at": 0, "color": [1, 0.8, 0.6]},
            {"at": 0, "color": [0.2, 0.2, 0.2]}, {"at": -90, "color": [0.1, 0.1, 0.1]}]}}]},
        {"name": "sun", "kind": "sun", "axis": [0, 1, 0], "keys": [
            {"hour": 6, "gradient": {"stops": [{"at": 0, "color": [1, 1, 1], "ev": 3},
                                               {"at": 5, "color": [1, 1, 1], "ev": 3}]}},
            {"hour": 18, "tint": [0.5, 0.25, 0], "gradient": {"stops": [
                {"at": 0, "color": [1, 1, 1], "ev": 3}, {"at": 5, "color": [1, 1, 1], "ev": 3}]}}]}]})";
    return path;
}

/// Radiance of the document's sky at an elevation, in its green channel.
double skyGreen(double elevation) {
    return elevation > 0.0 ? 0.8 + (0.4 - 0.8) * elevation / 90.0
                           : 0.2 + (0.1 - 0.2) * -elevation / 90.0;
}

TEST(Bake, AConstantStaysItselfInEveryEncoding) {
    const TemporaryFolder folder;
    const std::string strip = constantStrip(folder, 2.5f);
    for (const std::string encoding : {"float", "half", "rgb9e5", "unorm8"}) {
        const std::string out = folder.file(encoding + ".exr");
        const RunResult run = runLodestar({"bake", strip, "-o", out, "--encoding", encoding,
                                           "--exponents", "0,1,64,2048", "--columns", "33"});
        ASSERT_EQ(run.status, 0) << run.err;
        const json answer = json::parse(run.out);
        EXPECT_EQ(answer["source"], "strip");
        EXPECT_EQ(answer["exponents"], (json{0.0, 1.0, 64.0, 2048.0}));
        const core::Image map = readPicture(out);
        ASSERT_EQ(map.width(), 33);
        ASSERT_EQ(map.height(), 4);
        // Nine bits of a root between 1 and 2: half a step of 1/256, doubled.
        const float tolerance = encoding == "rgb9e5" ? std::sqrt(2.5f) / 256.0f : 2.5f * 1e-3f;
        for (int row = 0; row < 4; ++row) {
            for (int column = 0; column < 33; ++column) {
                EXPECT_NEAR(map.at(column, row)[1], 2.5f, tolerance) << encoding;
            }
        }
    }
}

// 256 zones of equal angle hold a gradient's slope to .0004 of its peak (docs/derivations/rsrm.md).
TEST(Bake, ASkyEqualsASumOfItsOwn) {
    const TemporaryFolder folder;
    const std::string out = folder.file("sky.exr");
    const RunResult run = runLodestar({"bake", document(folder), "-o", out, "--light", "sky",
                                       "--exponents", "512,1,30", "--columns", "41", "--errors"});
    ASSERT_EQ(run.status, 0) << run.err;
    const json answer = json::parse(run.out);
    EXPECT_EQ(answer["kind"], "sky");
    EXPECT_EQ(answer["rows"], 3);
    EXPECT_EQ(answer["columns"], 41);
    EXPECT_EQ(answer["bytes"], 3 * 41 * 16);
    EXPECT_TRUE(answer["warnings"].empty()) << answer;
    ASSERT_EQ(answer["errors"].size(), 3u);
    for (const json& error : answer["errors"]) {
        EXPECT_GT(error, 0.0);
        EXPECT_LT(error, 0.0015);
    }
    const core::Image map = readPicture(out);
    const std::vector<double> angles = lighting::columnAngles(lighting::RsrmColumns::Refined, 41);
    const lighting::Zones zones{lighting::ZoneSpacing::EqualHeight, 4096};
    const std::vector<double> edges = lighting::zoneEdges(zones);
    const double exponents[] = {512.0, 1.0, 30.0}; // a row each, as given
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 41; ++column) {
            const std::vector<double> weights = lighting::ringWeights(
                angles[static_cast<std::size_t>(column)], edges, exponents[row]);
            double sum = 0.0;
            for (std::size_t j = 0; j < weights.size(); ++j) {
                sum += weights[j] *
                       skyGreen(90.0 - 90.0 / std::numbers::pi * (edges[j] + edges[j + 1]));
            }
            EXPECT_NEAR(static_cast<double>(map.at(column, row)[1]), sum, 0.0015 * 0.8)
                << exponents[row] << " column " << column;
        }
    }
}

// The same rows by `lodestar sample`, of a document with that sky alone, between two of its hours.
TEST(Bake, ARowIsWhatSampleAnswers) {
    const TemporaryFolder folder;
    const std::string lights = folder.file("sky.lodestar.json");
    std::ofstream(lights) << R"({"lodestar": 1, "lights": [{"kind": "sky", "keys": [
        {"hour": 6, "tint": [1, 0.5, 0.25], "gradient": {"stops": [
            {"at": 90, "color": [0.1, 0.2, 0.4]}, {"at": -90, "color": [0.8, 0.6, 0.4]}]}},
        {"hour": 12, "gradient": {"interpolation": "smooth", "stops": [
            {"at": 90, "color": [0.2, 0.4, 0.8]}, {"at": 0, "color": [1, 1, 1]},
            {"at": 0, "color": [0.2, 0.2, 0.2]}]}}]}]})";
    const std::string out = folder.file("sky.exr");
    const RunResult bake = runLodestar(
        {"bake", lights, "-o", out, "--hour", "10", "--exponents", "1,40,700", "--columns", "7"});
    ASSERT_EQ(bake.status, 0) << bake.err;
    const core::Image map = readPicture(out);
    const std::vector<double> angles = lighting::columnAngles(lighting::RsrmColumns::Refined, 7);
    const std::string batch = folder.file("batch");
    {
        std::ofstream lines(batch);
        for (const double exponent : {1.0, 40.0, 700.0}) {
            for (const double angle : angles) {
                lines << json{{"exponent", exponent},
                              {"direction", {std::sin(angle), std::cos(angle), 0.0}}}
                      << "\n";
            }
        }
    }
    const RunResult sample = runLodestar({"sample", "--batch", batch, "--lighting", lights,
                                          "--hour", "10", "--estimator", "reference"});
    ASSERT_EQ(sample.status, 0) << sample.err;
    std::istringstream answers(sample.out);
    std::string line;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 7; ++column) {
            ASSERT_TRUE(std::getline(answers, line));
            const json answer = json::parse(line);
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(static_cast<double>(map.at(column, row)[c]),
                            answer["radiance"][static_cast<std::size_t>(c)].get<double>(), 0.0015)
                    << "row " << row << ", column " << column;
            }
        }
    }
}

// On its axis a disc of angle a gives 1 - cos^(s + 1) a of its radiance; tints blend linearly. The
// zone that holds its edge, 0.0033 radians wide, is one mean: a quarter of the light in it, 8 x 101
// x 0.0872 x 0.0033 x 0.68, times the lobe's fall across it, 100 tan a x 0.0033: at most 0.0012.
TEST(Bake, ASunBlendsItsKeysAndHasItsClosedForm) {
    const TemporaryFolder folder;
    const std::string out = folder.file("sun.exr");
    const RunResult run = runLodestar({"bake", document(folder), "-o", out, "--light", "1",
                                       "--hour", "9", "--exponents", "1,100"});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(json::parse(run.out)["kind"], "sun");
    const core::Image map = readPicture(out);
    ASSERT_EQ(map.width(), 170);
    const double tints[] = {0.75 + 0.25 * 0.5, 0.75 + 0.25 * 0.25, 0.75};
    for (int row = 0; row < 2; ++row) {
        const double s = row == 0 ? 1.0 : 100.0;
        const double disc = 8.0 * (1.0 - std::pow(std::cos(5.0 * std::numbers::pi / 180.0), s + 1));
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(static_cast<double>(map.at(0, row)[c]), disc * tints[c], 0.0012);
        }
    }
}

// Stone's weights are sampled: where a lobe is narrower than a zone their sum is not 1.
TEST(Bake, ThePublishedLayoutShowsItsRowSums) {
    const TemporaryFolder folder;
    const std::string out = folder.file("published.exr");
    const RunResult run = runLodestar({"bake", constantStrip(folder, 1.0f), "-o", out, "--layout",
                                       "rsrm-published", "--exponents", "1,2048"});
    ASSERT_EQ(run.status, 0) << run.err;
    const core::Image map = readPicture(out);
    ASSERT_EQ(map.width(), 256);
    const auto sumAt = [](double zo, double s) {
        double sum = 0.0;
        for (int zone = 0; zone < 256; ++zone) {
            const double z = 1.0 - (2.0 * zone + 1.0) / 256.0;
            const double radius = std::sqrt((1.0 - z * z) * (1.0 - zo * zo));
            for (int k = 0; k < 128; ++k) {
                const double cosine =
                    z * zo + radius * std::cos(std::numbers::pi * (k + 0.5) / 128);
                sum += std::pow(std::max(cosine, 0.0), s);
            }
        }
        return sum * (s + 1.0) / (2.0 * std::numbers::pi) * 4.0 * std::numbers::pi /
               (256.0 * 128.0);
    };
    for (const int column : {0, 1, 128, 255}) {
        const double zo = 1.0 - (2.0 * column + 1.0) / 256.0;
        EXPECT_NEAR(static_cast<double>(map.at(column, 0)[0]), sumAt(zo, 1.0), 1e-4) << column;
        EXPECT_NEAR(static_cast<double>(map.at(column, 1)[0]), sumAt(zo, 2048.0),
                    1e-4 * std::max(sumAt(zo, 2048.0), 1.0))
            << column;
    }
    EXPECT_GT(map.at(0, 1)[0], 1.5f) << "on a zone's centre";
}

TEST(Bake, TheErrorsShowWhatTheEncodingLoses) {
    const TemporaryFolder folder;
    const std::string lights = document(folder);
    std::vector<double> errors;
    for (const std::string encoding : {"float", "half", "unorm8"}) {
        const RunResult run =
            runLodestar({"bake", lights, "-o", folder.file("map.exr"), "--light", "sun", "--errors",
                         "--exponents", "4,2048", "--encoding", encoding});
        ASSERT_EQ(run.status, 0) << run.err;
        errors.push_back(json::parse(run.out)["errors"][0]);
    }
    EXPECT_LT(errors[0], 1e-3);
    // A root in halves, of eleven bits, is off by 2^-11 of itself at most, its square by twice
    // that.
    EXPECT_LT(errors[1], errors[0] + 0.001);
    // Roots over that of the greatest, 8 at exponent 2048: a step of 1/255 at a root of sqrt(p /
    // 8), p / 8 = 1 - cos^5 5 degrees = .019: half a step is off by .0285 of p.
    EXPECT_GT(errors[2], 0.001);
    EXPECT_LT(errors[2], errors[0] + 0.03);
}

// Radiance beyond halves, 65504, and a texel below 0.
TEST(Bake, GreatRadianceAndBrokenTexels) {
    const TemporaryFolder folder;
    const std::string out = folder.file("map.exr");
    for (const std::string layout : {"rsrm", "rsrm-published"}) {
        const RunResult run =
            runLodestar({"bake", constantStrip(folder, 1e6f), "-o", out, "--layout", layout,
                         "--encoding", "half", "--exponents", "1"});
        ASSERT_EQ(run.status, 0) << run.err;
        const core::Image map = readPicture(out);
        for (int column = 0; column < map.width(); ++column) {
            // Halves, rounded once (a root's twice); the published weights' sum is off by 1e-3.
            EXPECT_NEAR(map.at(column, 0)[0], 1e6f, 2e3f) << layout;
        }
    }
    core::Image strip(1, 12, 3);
    std::fill(strip.pixels().begin(), strip.pixels().end(), 1.0f);
    strip.at(0, 5)[1] = -1.0f;
    const std::string path = folder.file("broken.exr");
    ASSERT_TRUE(io::writeImage(path, strip).ok());
    const RunResult run = runLodestar({"bake", path, "-o", out});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(json::parse(run.out)["warnings"].size(), 1u) << run.out;
    EXPECT_NE(run.err.find("broken.exr: radiance negative"), std::string::npos) << run.err;
    const core::Image map = readPicture(out);
    EXPECT_GE(*std::min_element(map.pixels().begin(), map.pixels().end()), 0.0f);
}

/// The value of a string attribute in an OpenEXR header: name, "string", size, text.
std::string attributeOf(const std::string& path, const std::string& name) {
    const auto bytes = io::readFile(path);
    if (!bytes) {
        return {};
    }
    const std::string text(bytes->begin(), bytes->end());
    const std::string key = name + '\0' + "string" + '\0';
    const std::size_t at = text.find(key);
    if (at == std::string::npos) {
        return {};
    }
    const auto size = static_cast<std::size_t>(static_cast<unsigned char>(text[at + key.size()]));
    return text.substr(at + key.size() + 4, size);
}

TEST(Bake, TheFileNamesItsLayout) {
    const TemporaryFolder folder;
    const std::string strip = constantStrip(folder, 1.0f);
    const std::string out = folder.file("map.exr");
    ASSERT_EQ(runLodestar({"bake", strip, "-o", out, "--exponents", "1"}).status, 0);
    EXPECT_EQ(attributeOf(out, "lodestar:layout"), "u2");
    ASSERT_EQ(
        runLodestar({"bake", strip, "-o", out, "--exponents", "1", "--layout", "rsrm-published"})
            .status,
        0);
    EXPECT_EQ(attributeOf(out, "lodestar:layout"), "published");
}

TEST(Bake, APanoramaIsAveragedAboutItsAxis) {
    const TemporaryFolder folder;
    core::Image panorama(64, 32, 3);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 64; ++x) {
            const float value = x >= 32 ? 3.0f : 1.0f; // the eastern half is +X
            std::fill_n(panorama.at(x, y), 3, value);
        }
    }
    const std::string path = folder.file("halves.exr");
    ASSERT_TRUE(io::writeImage(path, panorama).ok());
    const std::string out = folder.file("map.exr");
    RunResult run = runLodestar({"bake", path, "-o", out, "--exponents", "1,2000"});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_NEAR(json::parse(run.out)["residual"].get<double>(), 0.25, 0.01);
    EXPECT_NEAR(readPicture(out).at(80, 1)[0], 2.0f, 1e-3f);
    run = runLodestar({"bake", path, "-o", out, "--exponents", "1,2000", "--axis", "2,0,0"});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_LT(json::parse(run.out)["residual"].get<double>(), 0.02);
    const core::Image map = readPicture(out);
    EXPECT_NEAR(map.at(0, 1)[0], 3.0f, 1e-3f);
    EXPECT_NEAR(map.at(169, 1)[0], 1.0f, 1e-3f);
    // Lambert's lobe along the axis: 3 from the hemisphere about it.
    EXPECT_NEAR(map.at(0, 0)[0], 3.0f, 0.03f);
}

TEST(Bake, BadCallsSayOneLineAndTheirStatus) {
    const TemporaryFolder folder;
    const std::string strip = constantStrip(folder, 1.0f);
    const std::string lights = document(folder);
    const std::string out = folder.file("out.exr");
    core::Image odd(5, 3, 3);
    const std::string picture = folder.file("odd.exr");
    ASSERT_TRUE(io::writeImage(picture, odd).ok());
    const std::string panorama = folder.file("panorama.exr");
    ASSERT_TRUE(io::writeImage(panorama, core::Image(8, 4, 3)).ok());
    std::ofstream(folder.file("dark.lodestar.json")) << R"({"lodestar": 1})";
    struct Call {
        std::vector<std::string> arguments;
        int status;
        const char* mentions;
    };
    const Call calls[] = {
        {{"bake", strip}, 2, "output"},
        {{"bake", strip, "-o", folder.file("x.png")}, 2, ".exr"},
        {{"bake", strip, "-o", out, "--exponents", "1,nan"}, 2, "--exponents"},
        {{"bake", strip, "-o", out, "--exponents", "1,,2"}, 2, "--exponents"},
        {{"bake", strip, "-o", out, "--exponents", "-1"}, 2, "--exponents"},
        {{"bake", strip, "-o", out, "--exponents", "inf"}, 2, "--exponents"},
        {{"bake", strip, "-o", out, "--columns", "1"}, 2, "--columns"},
        {{"bake", strip, "-o", out, "--encoding", "bc6h"}, 2, "bc6h"},
        {{"bake", strip, "-o", out, "--layout", "cube"}, 2, "cube"},
        {{"bake", strip, "-o", out, "--kind", "moon"}, 2, "moon"},
        {{"bake", strip, "-o", out, "--axis", "0,1,0"}, 2, "--axis"},
        {{"bake", strip, "-o", out, "--hour", "3"}, 2, "--hour"},
        {{"bake", panorama, "-o", out, "--axis", "0,0,0"}, 2, "--axis"},
        {{"bake", panorama, "-o", out, "--axis", "0,nan,1"}, 2, "--axis"},
        {{"bake", panorama, "-o", out, "--axis", "1,0"}, 2, "--axis"},
        {{"bake", picture, "-o", out}, 3, "5 x 3"},
        {{"bake", folder.file("none.hdr"), "-o", out}, 3, "none.hdr"},
        {{"bake", folder.file("dark.lodestar.json"), "-o", out}, 3, "/lights"},
        {{"bake", lights, "-o", out, "--light", "moon"}, 2, "moon"},
        {{"bake", lights, "-o", out, "--light", "2"}, 2, "sky, sun"},
        {{"bake", lights, "-o", out, "--kind", "sun"}, 2, "--kind"},
        {{"bake", lights, "-o", folder.file("no/such/out.exr")}, 5, "out.exr"},
    };
    for (const Call& call : calls) {
        const RunResult run = runLodestar(call.arguments);
        EXPECT_EQ(run.status, call.status) << call.mentions << ": " << run.err;
        ASSERT_EQ(run.errorLines().size(), 1u) << run.err;
        EXPECT_NE(run.errorLines()[0].find(call.mentions), std::string::npos) << run.err;
        EXPECT_TRUE(run.out.empty());
        EXPECT_FALSE(io::readFile(out).ok()) << "nothing is written: " << call.mentions;
    }
}

TEST(Bake, APanoramaBecomesLightsThatCanBePainted) {
    const TemporaryFolder folder;
    core::Image panorama(64, 32, 3);
    std::fill(panorama.pixels().begin(), panorama.pixels().end(), 0.5f);
    for (int x = 0; x < 3; ++x) { // a sun of a texel, 45 degrees high
        panorama.at(40, 8)[x] = 800.0f;
    }
    const std::string picture = folder.file("park.exr");
    ASSERT_TRUE(io::writeImage(picture, panorama).ok());
    const std::string out = folder.file("park.lodestar.json");
    const RunResult run = runLodestar({"bake", picture, "-o", out});
    ASSERT_EQ(run.status, 0) << run.err;
    const json answer = json::parse(run.out);
    EXPECT_EQ(answer["source"], "panorama");
    EXPECT_NEAR(answer["sun"]["elevation"].get<double>(), 90.0 - 8.5 / 32.0 * 180.0, 0.1);
    // 799.5 over (2 pi / 64) (cos 45 - cos 50.625 degrees).
    EXPECT_NEAR(
        answer["sun"]["irradiance"][1].get<double>(),
        799.5 * 2.0 * std::numbers::pi / 64.0 *
            (std::cos(std::numbers::pi / 4.0) - std::cos(50.625 * std::numbers::pi / 180.0)),
        0.02);
    EXPECT_LT(answer["residual"].get<double>(), 1e-3);
    EXPECT_LT(answer["diffuse_error"].get<double>(), 0.02);
    // The document is whole, and lights.
    const RunResult lit = runLodestar(
        {"sample", "--lighting", out, "--hour", "9", "--lobe", "lambert", "--direction", "0,-1,0"});
    ASSERT_EQ(lit.status, 0) << lit.err;
    EXPECT_NEAR(json::parse(lit.out)["radiance"][1].get<double>(), 0.5, 0.01);

    // What is there is not lost.
    EXPECT_EQ(runLodestar({"bake", picture, "-o", out}).status, 5);
    EXPECT_EQ(runLodestar({"bake", picture, "-o", folder.file("b.json"), "--hour", "9"}).status, 2);
    EXPECT_EQ(runLodestar({"bake", picture, "-o", folder.file("b.exr"), "--keep-sun"}).status, 2);
    EXPECT_EQ(
        runLodestar({"bake", constantStrip(folder, 1.0f), "-o", folder.file("c.json")}).status, 3);
    const RunResult kept =
        runLodestar({"bake", picture, "-o", folder.file("kept.json"), "--keep-sun"});
    ASSERT_EQ(kept.status, 0) << kept.err;
    EXPECT_TRUE(json::parse(kept.out)["sun"].is_null());
}

} // namespace
} // namespace lodestar::testing

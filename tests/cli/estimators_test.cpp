// SPDX-License-Identifier: MIT
//
// Estimators of several fetches, and those that are chosen by tolerance, by command.
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/file.h"
#include "support/floor_scene.h"
#include "support/run.h"

namespace lodestar::testing {
namespace {

using nlohmann::json;

constexpr const char* kLamp = "disc:0.5,0.6,0.6,6,40,0.1";

json sample(const std::string& estimator) {
    const RunResult run =
        runLodestar({"sample", "--environment", kLamp, "--width", "64", "--exponent", "64",
                     "--direction", "0.5,0.5,0.6", "--estimator", estimator});
    EXPECT_EQ(run.status, 0) << run.err;
    return json::parse(run.out, nullptr, false);
}

TEST(Estimators, SampleSaysWhatAutoChose) {
    const json coarse = sample("auto:10");
    EXPECT_EQ(coarse.at("estimator"), "tent");
    EXPECT_EQ(coarse.at("radiance"), sample("tent").at("radiance"));
    double last = coarse.at("foreseen_error");
    for (const char* tolerance : {"auto:0.2", "auto:0.1", "auto:0.05", "auto:1e-6"}) {
        const json answer = sample(tolerance);
        EXPECT_LE(answer.at("foreseen_error").get<double>(), last) << tolerance;
        last = answer.at("foreseen_error");
        EXPECT_EQ(answer.at("radiance"),
                  sample(answer.at("estimator").get<std::string>()).at("radiance"));
    }
    EXPECT_GT(last, 1e-6); // nothing is as right as that, and it says so
    EXPECT_FALSE(sample("tent").contains("estimator"));
}

TEST(Estimators, WordsThatSayNothingAreRefused) {
    for (const char* name : {"auto:", "auto:0", "auto:-1", "auto:nan", "auto:11", "ring:5",
                             "taps:0", "taps:2000", "taps:x"}) {
        const RunResult run = runLodestar({"sample", "--environment", kLamp, "--exponent", "4",
                                           "--direction", "0,1,0", "--estimator", name});
        EXPECT_EQ(run.status, 2) << name;
        EXPECT_EQ(run.errorLines().size(), 1u) << run.err;
    }
}

/// A document that gives the floor, its only material, a mirror-like lobe and more.
std::string documentOf(const TemporaryFolder& folder, const json& more) {
    json material = {{"exponent", 200}, {"f0", {0.8, 0.8, 0.8}}};
    material.update(more);
    const std::string path = folder.file("floor.lodestar.json");
    std::ofstream(path) << json{
        {"lodestar", 1},
        {"environment", {{"source", kLamp}}},
        {"materials",
         {{"#0", material}}}}.dump();
    return path;
}

std::string pictureOf(const TemporaryFolder& folder, const json& material,
                      const std::vector<std::string>& more) {
    const std::string picture = folder.file("picture.png");
    std::vector<std::string> call = {"render",
                                     floorScene(folder),
                                     "--lighting",
                                     documentOf(folder, material),
                                     "--eye",
                                     "0,2,4",
                                     "--target",
                                     "0,0,0",
                                     "--size",
                                     "64x48",
                                     "--environment-width",
                                     "64",
                                     "-o",
                                     picture};
    call.insert(call.end(), more.begin(), more.end());
    const RunResult run = runLodestar(call);
    EXPECT_EQ(run.status, 0) << run.err;
    const auto bytes = io::readFile(picture);
    return bytes ? std::string(bytes->begin(), bytes->end()) : std::string();
}

// A material's own estimator draws what the frame's would, and not what the frame's does.
TEST(Estimators, AMaterialMayHaveItsOwn) {
    const TemporaryFolder folder;
    const std::string tent = pictureOf(folder, json::object(), {});
    const std::string ring = pictureOf(folder, json::object(), {"--specular", "ring:7"});
    EXPECT_TRUE(tent != ring); // bytes say nothing to people
    EXPECT_TRUE(pictureOf(folder, {{"specular", "ring:7"}}, {}) == ring);
    EXPECT_TRUE(pictureOf(folder, {{"specular", "tent"}}, {"--specular", "ring:7"}) == tent);
    EXPECT_TRUE(pictureOf(folder, {{"tolerance", 9.0}}, {"--specular", "ring:7"}) == tent);
}

// The floor under a document's light has no lamps: Fresnel's form shows, that of lobes has nothing
// to act on, and either is said.
TEST(Estimators, FormsOfLobesAndFresnel) {
    const TemporaryFolder folder;
    const json dielectric = {{"f0", {0.04, 0.04, 0.04}}};
    const std::string plain = pictureOf(folder, dielectric, {});
    EXPECT_TRUE(pictureOf(folder, dielectric, {"--lobes", "power", "--fresnel", "schlick"}) ==
                plain);
    EXPECT_TRUE(pictureOf(folder, dielectric, {"--lobes", "sg"}) == plain);
    const std::string stats = folder.file("stats.json");
    EXPECT_TRUE(pictureOf(folder, dielectric, {"--fresnel", "sg", "--stats", stats}) != plain);
    std::ifstream file(stats);
    const json said = json::parse(file);
    EXPECT_EQ(said.at("estimators").at("fresnel"), "sg");
    EXPECT_EQ(said.at("estimators").at("lobes"), "power");
    EXPECT_EQ(said.at("plan").at("features").dump().find("sg-lobes"), std::string::npos);
    EXPECT_NE(said.at("plan").at("features").dump().find("sg-fresnel"), std::string::npos);
    for (const std::vector<std::string>& wrong :
         {std::vector<std::string>{"--lobes", "gauss"}, {"--fresnel", "1"}, {"--lobes", ""}}) {
        std::vector<std::string> call = {"plan", floorScene(folder)};
        call.insert(call.end(), wrong.begin(), wrong.end());
        const RunResult run = runLodestar(call);
        EXPECT_EQ(run.status, 2) << wrong[0] << wrong[1];
        EXPECT_EQ(run.errorLines().size(), 1u) << run.err;
    }
}

TEST(Estimators, ThePlanSaysWhatAutoChoseAndWhy) {
    const TemporaryFolder folder;
    const RunResult run =
        runLodestar({"plan", floorScene(folder), "--lighting",
                     documentOf(folder, {{"tolerance", 0.05}}), "--environment-width", "64"});
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_NE(run.out.find("glossy light by "), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("within 5 %"), std::string::npos) << run.out;
    const RunResult other =
        runLodestar({"plan", floorScene(folder), "--lighting",
                     documentOf(folder, {{"specular", "mip"}}), "--environment-width", "64"});
    EXPECT_EQ(other.status, 0);
    EXPECT_NE(other.err.find("estimator of one material"), std::string::npos) << other.err;
}

} // namespace
} // namespace lodestar::testing

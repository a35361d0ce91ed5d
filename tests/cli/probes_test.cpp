// SPDX-License-Identifier: MIT
//
// Light probes from the command line: documents, budgets, the plan in JSON.
#include <fstream>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/floor_scene.h"
#include "support/picture.h"
#include "support/run.h"

namespace lodestar::testing {
namespace {

std::string documentWith(const TemporaryFolder& folder, const nlohmann::json& probes) {
    const nlohmann::json document = {
        {"lodestar", 1}, {"environment", {{"source", "constant:1,1,1"}}}, {"probes", probes}};
    const std::string path = folder.file("probes.lodestar.json");
    std::ofstream(path) << document.dump();
    return path;
}

const nlohmann::json kProbe = {{"name", "Yard"},
                               {"position", {0, 1, 0}},
                               {"capture", {{"resolution", 32}}},
                               {"influence", {{"size", {6, 6, 6}}, {"blend", 1}}}};

TEST(ProbesByCommand, TheBudgetHoldsAndThePlanNamesFaces) {
    const TemporaryFolder folder;
    const std::string scene = floorScene(folder);
    const std::string lighting = documentWith(folder, nlohmann::json::array({kProbe}));
    const std::vector<std::string> camera = {"--lighting", lighting,   "--eye",
                                             "0,3,4",      "--target", "0,0,0"};
    std::vector<std::string> plan = {"plan", scene};
    plan.insert(plan.end(), camera.begin(), camera.end());
    const RunResult planned = runLodestar(plan);
    ASSERT_EQ(planned.status, 0) << planned.err;
    bool captured = false;
    const nlohmann::json effects = nlohmann::json::parse(planned.out).at("effects");
    for (const nlohmann::json& effect : effects) {
        if (effect.at("effect") == "probe-capture") {
            captured = true;
            EXPECT_EQ(effect.at("subject"), "Yard");
            EXPECT_EQ(effect.at("faces"), (nlohmann::json{0, 1, 2, 3, 4, 5}));
        }
    }
    EXPECT_TRUE(captured);
    std::vector<std::string> render = {
        "render",         scene,   "-o",       folder.file("x.exr"),
        "--size",         "48x32", "--frames", "6",
        "--budget-faces", "2",     "--stats",  folder.file("stats.json")};
    render.insert(render.end(), camera.begin(), camera.end());
    const RunResult rendered = runLodestar(render);
    ASSERT_EQ(rendered.status, 0) << rendered.err;
    std::ifstream file(folder.file("stats.json"));
    const nlohmann::json report = nlohmann::json::parse(file);
    std::vector<int> faces;
    for (const nlohmann::json& frame : report.at("frames")) {
        faces.push_back(frame.at("counters").at("probe_faces").get<int>());
    }
    EXPECT_EQ(faces, (std::vector<int>{2, 2, 2, 0, 0, 0}));
    EXPECT_EQ(report.at("counters").at("probe_faces"), 6);
    // A white floor, but for the half of the sphere that shows the floor itself: nearly white.
    const core::Image picture = readPicture(folder.file("x.exr"));
    EXPECT_NEAR(picture.at(24, 16)[1], 1.0f, 0.05f);
}

TEST(ProbesByCommand, BrokenProbesAreRefusedOrCounted) {
    const TemporaryFolder folder;
    const std::string scene = floorScene(folder);
    const auto render = [&](const nlohmann::json& probe) {
        return runLodestar({"render", scene, "-o", folder.file("x.png"), "--size", "16x16",
                            "--lighting", documentWith(folder, nlohmann::json::array({probe}))});
    };
    nlohmann::json probe = kProbe;
    probe["capture"]["resolution"] = 0;
    RunResult refused = render(probe);
    EXPECT_EQ(refused.status, 3);
    EXPECT_NE(refused.err.find("/probes/0/capture/resolution"), std::string::npos) << refused.err;
    probe = kProbe;
    probe["source"] = "missing.hdr";
    refused = render(probe);
    EXPECT_EQ(refused.status, 3);
    EXPECT_NE(refused.err.find("missing.hdr"), std::string::npos) << refused.err;
    probe = kProbe;
    probe["node"] = "Gone";
    RunResult counted = render(probe);
    EXPECT_EQ(counted.status, 0);
    EXPECT_NE(counted.err.find("light probe at a node that the scene lacks"), std::string::npos)
        << counted.err;
    probe = kProbe;
    probe["influence"]["size"] = {0, 1, 1};
    counted = render(probe);
    EXPECT_EQ(counted.status, 0);
    EXPECT_NE(counted.err.find("light probe without an inside"), std::string::npos) << counted.err;
    probe = kProbe;
    probe["source"] = "constant:0.5,0.5,0.5"; // a file's light: nothing is captured
    EXPECT_EQ(render(probe).status, 0);
}

TEST(ProbesByCommand, AScenesOwnNodeCarriesItsProbe) {
    const TemporaryFolder folder;
    const std::string scene = floorScene(folder);
    nlohmann::json probe = kProbe;
    probe["node"] = "Floor";
    const RunResult done =
        runLodestar({"render", scene, "-o", folder.file("x.png"), "--size", "16x16", "--lighting",
                     documentWith(folder, nlohmann::json::array({probe})), "--stats",
                     folder.file("stats.json")});
    ASSERT_EQ(done.status, 0) << done.err;
    std::ifstream file(folder.file("stats.json"));
    EXPECT_EQ(nlohmann::json::parse(file).at("counters").at("probe_faces"), 6);
}

} // namespace
} // namespace lodestar::testing

// SPDX-License-Identifier: MIT
//
// `lodestar script`: commands from a file do what the editor does, and nothing is written where one
// is wrong.
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/run.h"

namespace lodestar::testing {
namespace {

constexpr const char* kSky =
    R"({"lodestar": 1, "lights": [{"kind": "sky", "keys": [{"hour": 6, "gradient": {"stops": [
        {"at": 90, "color": [0, 0, 1]}, {"at": -90, "color": [1, 0, 0]}]}}]}]})";

class Script : public ::testing::Test {
protected:
    void SetUp() override { write(sky_, kSky); }
    static void write(const std::string& path, const std::string& text) {
        std::ofstream(path) << text;
    }
    static std::string contents(const std::string& path) {
        std::stringstream text;
        text << std::ifstream(path).rdbuf();
        return text.str();
    }
    RunResult run(const std::string& commands, std::vector<std::string> more = {}) {
        write(script_, commands);
        std::vector<std::string> words = {"script", sky_, script_, "-o", out_};
        words.insert(words.end(), more.begin(), more.end());
        return runLodestar(words);
    }

    TemporaryFolder folder_;
    std::string sky_ = folder_.file("sky.lodestar.json");
    std::string script_ = folder_.file("edit.jsonl");
    std::string out_ = folder_.file("out.lodestar.json");
};

TEST_F(Script, EditsADocument) {
    const RunResult done = run(R"(# a stop, and the day
{"do": "AddStop", "key": "/lights/0/keys/0", "at": 30}
{"do": "MoveKey", "key": "/lights/0/keys/0", "hour": 5}
{"do": "SetMaterials", "names": ["gold"], "exponent": 64}
{"do": "Undo"}
)");
    ASSERT_EQ(done.status, 0) << done.err;
    EXPECT_EQ(nlohmann::json::parse(done.out),
              (nlohmann::json{{"commands", 4}, {"steps", 2}, {"changed", true}}));
    const auto document = nlohmann::json::parse(contents(out_));
    const auto& key = document.at("lights").at(0).at("keys").at(0);
    EXPECT_EQ(key.at("hour"), 5);
    ASSERT_EQ(key.at("gradient").at("stops").size(), 3U);
    const auto& stop = key.at("gradient").at("stops").at(1);
    EXPECT_EQ(stop.at("at"), 30);
    EXPECT_NEAR(stop.at("color").at(0).get<double>(), 1.0 / 3.0, 1e-12);
    EXPECT_FALSE(document.contains("materials"));
    EXPECT_EQ(contents(sky_), kSky) << "the document itself is left";
}

TEST_F(Script, BeginsAnew) {
    sky_ = folder_.file("none.lodestar.json");
    EXPECT_EQ(run(R"({"do": "SetEnvironment", "source": "constant:1,1,1", "rotation": 90})").status,
              3);
    const RunResult begun =
        run(R"({"do": "SetEnvironment", "source": "constant:1,1,1", "rotation": 90})", {"--new"});
    ASSERT_EQ(begun.status, 0) << begun.err;
    const auto environment = nlohmann::json::parse(contents(out_)).at("environment");
    EXPECT_EQ(environment.at("rotation"), 90);
}

TEST_F(Script, WhatIsWrongIsSaidInALineAndNothingIsWritten) {
    const RunResult wrong = run("{\"do\": \"AddStop\", \"key\": \"/lights/0/keys/0\", \"at\": 3}\n"
                                "{\"do\": \"DeleteStops\", \"stops\": [\"/lights/0/keys/0/gradient/"
                                "stops/0\", \"/lights/0/keys/0/gradient/stops/1\"]}\n");
    EXPECT_EQ(wrong.status, 3);
    ASSERT_EQ(wrong.errorLines().size(), 1U) << wrong.err;
    EXPECT_NE(wrong.err.find("edit.jsonl: "), std::string::npos) << wrong.err;
    EXPECT_NE(wrong.err.find("(line 2)"), std::string::npos) << wrong.err;
    EXPECT_FALSE(std::filesystem::exists(out_));
    EXPECT_EQ(runLodestar({"script", sky_, folder_.file("none.jsonl"), "-o", out_}).status, 3);
    EXPECT_EQ(runLodestar({"script", sky_}).status, 2);
    out_ = "/nowhere/at/all.lodestar.json";
    EXPECT_EQ(run("").status, 5);
}

TEST_F(Script, HelpTeaches) {
    const RunResult help = runLodestar({"script", "--help"});
    EXPECT_EQ(help.status, 0);
    for (const char* word : {"Example:", "BrushStroke", "ReplaceDocument", "docs/editor.md"}) {
        EXPECT_NE(help.out.find(word), std::string::npos) << word;
    }
}

} // namespace
} // namespace lodestar::testing

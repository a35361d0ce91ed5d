// SPDX-License-Identifier: MIT
//
// `lodestar sample`: words to answers, the white furnace by way of the command, refusals.
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/sample.h"
#include "numerics/oracles.h"

namespace lodestar::testing {

namespace {

using app::SampleQuery;
using app::Sampler;

SampleQuery query(const nlohmann::json& line) {
    auto parsed = app::parseBatchLine(line.dump(), {});
    EXPECT_TRUE(parsed) << line;
    return parsed ? *parsed : SampleQuery{};
}

nlohmann::json answerOf(Sampler& sampler, const nlohmann::json& line) {
    const auto answer = sampler.answer(query(line));
    EXPECT_TRUE(answer) << line;
    return answer ? nlohmann::json::parse(app::answerJson(answer->lookup)) : nlohmann::json{};
}

core::ErrorCode refusalOf(Sampler& sampler, const std::string& line) {
    const auto parsed = app::parseBatchLine(line, {});
    if (!parsed) {
        return parsed.error().code;
    }
    const auto answer = sampler.answer(*parsed);
    EXPECT_FALSE(answer) << line;
    return answer ? core::ErrorCode::Internal : answer.error().code;
}

} // namespace

TEST(Sample, WhiteFurnace) {
    Sampler sampler;
    int answers = 0;
    for (const auto& [lobe, estimators] : std::map<std::string, std::vector<std::string>>{
             {"phong", {"mip", "mip-floor", "bias:3", "bias:3:vertex", "tent", "reference"}},
             {"blinn-phong", {"mip", "mip-floor", "bias:3", "tent", "reference"}},
             {"lambert", {"bias:9", "lowest-mip", "sh9", "irradiance", "reference"}}}) {
        for (const std::string& estimator : estimators) {
            for (const nlohmann::json& exponent :
                 {nlohmann::json(0), nlohmann::json(0.5), nlohmann::json(64), nlohmann::json(1e6),
                  nlohmann::json("inf")}) {
                const auto answer = answerOf(sampler, {{"environment", "constant:1,1,1"},
                                                       {"lobe", lobe},
                                                       {"exponent", exponent},
                                                       {"direction", {0.3, -2, 0.7}},
                                                       {"estimator", estimator}});
                for (const double channel : answer.at("radiance")) {
                    // Bilinear and trilinear weights in float sum to 1 within a few roundings.
                    EXPECT_NEAR(channel, 1.0, 1e-6) << lobe << " " << estimator << " " << exponent;
                }
                ++answers;
            }
        }
    }
    EXPECT_EQ(answers, 16 * 5);
}

TEST(Sample, AnswersTheLinearOracles) {
    Sampler sampler;
    for (const auto& one : oracleCases("linear_env")) {
        const double a = one["in"]["a"];
        const double b = one["in"]["b"];
        const double y = one["in"]["cos"];
        const std::string map = "gradient:" + std::to_string(a - b) + "," + std::to_string(a + b);
        const auto answer = answerOf(sampler, {{"environment", map},
                                               {"lobe", "phong"},
                                               {"exponent", one["in"]["s"]},
                                               {"direction", {std::sqrt(1.0 - y * y), y, 0.0}},
                                               {"estimator", "reference"}});
        // Texel means of a linear map and the midpoint rule at 256: 3e-6.
        EXPECT_NEAR(answer["radiance"][0].get<double>(), one["out"]["value"].get<double>(), 1e-5);
        EXPECT_TRUE(answer["level"].is_null());
        EXPECT_EQ(answer["fetches"], 6 * 256 * 256);
    }
    for (const auto& one : oracleCases("cube_mip_level")) {
        const auto answer = answerOf(sampler, {{"environment", "constant:1,1,1"},
                                               {"exponent", one["in"]["s"]},
                                               {"direction", "0,0,-1"},
                                               {"estimator", "mip"},
                                               {"width", one["in"]["w"]}});
        EXPECT_NEAR(answer["level"].get<double>(), one["out"]["clamped"].get<double>(), 1e-5);
        EXPECT_EQ(answer["fetches"], 1);
    }
}

TEST(Sample, LineOverridesDefaults) {
    SampleQuery defaults;
    defaults.environment = "constant:2,2,2";
    defaults.direction = "1,0,0";
    defaults.exponent = "4";
    Sampler sampler;
    const auto plain = app::parseBatchLine("{}", defaults);
    ASSERT_TRUE(plain);
    ASSERT_TRUE(sampler.answer(*plain));
    EXPECT_NEAR(sampler.answer(*plain)->lookup.radiance.r, 2.0, 2e-6);
    const auto other =
        app::parseBatchLine(R"({"environment":"constant:3,3,3","width":16.0})", defaults);
    ASSERT_TRUE(other);
    EXPECT_NEAR(sampler.answer(*other)->lookup.radiance.r, 3.0, 3e-6);
    // The first environment is still the first one.
    EXPECT_NEAR(sampler.answer(*plain)->lookup.radiance.r, 2.0, 2e-6);
}

TEST(Sample, RepairsAndCounts) {
    Sampler sampler;
    const auto answer = sampler.answer(query({{"environment", "constant:1,1,1"},
                                              {"exponent", 1e12},
                                              {"direction", {1e300, 1e300, 0}},
                                              {"width", 8}}));
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->warnings.counts().size(), 1u);
    EXPECT_NEAR(answer->lookup.radiance.r, 1.0, 1e-6);
}

TEST(Sample, RefusesWithTheRightStatus) {
    Sampler sampler;
    const std::string start = R"({"environment":"constant:1,1,1","exponent":4,"direction":[0,1,0])";
    for (const char* end : {R"(,"lobe":"cone"})",
                            R"(,"estimator":"taps:4"})",
                            R"(,"estimator":"bias:-1"})",
                            R"(,"estimator":"bias:nan"})",
                            R"(,"estimator":"sh9"})",
                            R"(,"lobe":"lambert","estimator":"tent"})",
                            R"(,"exponent":"many"})",
                            R"(,"exponent":-1})",
                            R"(,"exponent":"nan"})",
                            R"(,"direction":[0,0,0]})",
                            R"(,"direction":[1,0]})",
                            R"(,"direction":[1,0,"x"]})",
                            R"(,"direction":{}})",
                            R"(,"width":0})",
                            R"(,"width":2.5})",
                            R"(,"width":1e20})",
                            R"(,"environment":"constant:1,1"})",
                            R"(,"hour":3})",
                            R"(,)",
                            R"(}])"}) {
        EXPECT_EQ(refusalOf(sampler, start + end), core::ErrorCode::Usage) << end;
    }
    EXPECT_EQ(refusalOf(sampler, R"({"environment":"constant:1,1,1","direction":[0,1,0]})"),
              core::ErrorCode::Usage);
    EXPECT_EQ(refusalOf(sampler, R"({"exponent":1,"direction":[0,1,0]})"), core::ErrorCode::Usage);
    EXPECT_EQ(refusalOf(sampler,
                        R"({"environment":"no-such-file.exr","exponent":1,"direction":[0,1,0]})"),
              core::ErrorCode::InputRefused);
}

} // namespace lodestar::testing

// SPDX-License-Identifier: MIT
//
// `lodestar cost`: the figures of small maps, the page and the calls that are refused.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/file.h"
#include "io/image_file.h"
#include "support/run.h"

namespace lodestar::testing {
namespace {

std::string textOf(const std::string& file) {
    const auto bytes = io::readFile(file);
    EXPECT_TRUE(bytes.ok()) << file;
    return bytes ? std::string(bytes->begin(), bytes->end()) : std::string();
}

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, separator);) {
        parts.push_back(part);
    }
    return parts;
}

/// The lines of a CSV file without quotes, by their heads.
std::vector<std::map<std::string, std::string>> rowsOf(const std::string& csv) {
    const std::vector<std::string> lines = split(csv, '\n');
    const std::vector<std::string> heads = split(lines.at(0), ',');
    std::vector<std::map<std::string, std::string>> rows;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        const std::vector<std::string> fields = split(lines[i], ',');
        EXPECT_EQ(fields.size(), heads.size()) << lines[i];
        for (std::size_t k = 0; k < std::min(fields.size(), heads.size()); ++k) {
            rows.resize(i);
            rows[i - 1][heads[k]] = fields[k];
        }
    }
    return rows;
}

std::vector<std::string> call(const std::string& folder, const std::string& environment) {
    return {"cost", environment,   "-o",   folder,      "--width", "32",        "--directions",
            "64",   "--exponents", "4,64", "--repeats", "1",       "--no-plots"};
}

// Direct light by each form: powers differ from themselves by rounding alone; Gaussians by .034 of
// the peak at 4 and .0024 at 64 (docs/derivations/sg.md), which n.l and F, varying, change to no
// more than twice and no less than half that; Fresnel's by up to 6.9 % of F at F0 = .04.
void expectFormsOfDirectLight(const nlohmann::json& rows) {
    EXPECT_EQ(rows.size(), 8u);
    for (const nlohmann::json& row : rows) {
        const double worst = row.at("worst");
        const double lobe = row.at("lobes") == "power"  ? 0.0
                            : row.at("exponent") > 10.0 ? .0024
                                                        : .034;
        const double fresnel = row.at("fresnel") == "sg" ? .069 : 0.0;
        EXPECT_LT(worst, 2.0 * lobe + fresnel + 1e-5) << row;
        EXPECT_GE(worst, fresnel > 0.0 ? 0.5 * fresnel : 0.5 * lobe) << row;
        EXPECT_GT(row.at("shading_ms_per_megapixel").get<double>(), 0.0) << row;
    }
}

// On a constant map every estimator is right: half floats keep a radiance of .25 exactly.
TEST(Cost, NothingIsWrongOnAConstantMap) {
    const TemporaryFolder folder;
    const RunResult run =
        runLodestar(call(folder.file("cost"), "constant:0.25,0.25,0.25"), {}, 300.0);
    ASSERT_EQ(run.status, 0) << run.err;
    const nlohmann::json json = nlohmann::json::parse(textOf(folder.file("cost/cost.json")));
    EXPECT_GT(json.at("rows").size(), 10u);
    for (const nlohmann::json& row : json.at("rows")) {
        EXPECT_LT(row.at("rmse").get<double>(), 5e-3) << row; // eight bits a channel: 1 / 512
        EXPECT_GT(row.at("shading_ms_per_megapixel").get<double>(), 0.0) << row;
    }
    EXPECT_GT(json.at("preparations").size(), 5u);
    expectFormsOfDirectLight(json.at("lobes"));
    EXPECT_EQ(rowsOf(textOf(folder.file("cost/lobes.csv"))).size(), 8u);
    EXPECT_NE(textOf(folder.file("cost/index.html")).find("Forms of direct light"),
              std::string::npos);
}

// A lamp of 10 degrees: `tent` is right where `mip`, whose boxes shift it, is not; a map of the
// mean over azimuth knows nothing of a lamp on the horizon.
TEST(Cost, TellsEstimatorsApart) {
    const TemporaryFolder folder;
    const std::string out = folder.file("cost");
    const RunResult run = runLodestar(call(out, "disc:1,0.2,0.4,10,50,0.1"), {}, 300.0);
    ASSERT_EQ(run.status, 0) << run.err;
    std::map<std::string, double> rmse;
    std::set<std::string> fronts;
    const std::string csv = textOf(out + "/cost.csv");
    // An analytic map's name has commas: it stands in quotes.
    EXPECT_NE(csv.find("\"disc:1,0.2,0.4,10,50,0.1\""), std::string::npos);
    const nlohmann::json json = nlohmann::json::parse(textOf(out + "/cost.json"));
    for (const nlohmann::json& row : json.at("rows")) {
        if (row.at("exponent") == 64.0) {
            rmse[row.at("estimator")] = row.at("rmse");
        }
        if (row.at("front")) {
            fronts.insert(row.at("term").get<std::string>());
        }
    }
    EXPECT_LT(rmse.at("tent"), 0.5 * rmse.at("mip"));
    EXPECT_GT(rmse.at("rsrm"), 0.5);
    EXPECT_EQ(fronts.size(), 2u); // each term has a best
    EXPECT_NE(run.out.find("the fastest glossy estimator"), std::string::npos) << run.out;
    const std::string page = textOf(out + "/index.html");
    EXPECT_EQ(page.find("src=\"http"), std::string::npos);
    EXPECT_EQ(page.find("href="), std::string::npos); // it needs nothing else
    EXPECT_NE(page.find("data:image/png;base64,iVBOR"), std::string::npos);
}

TEST(Cost, ColumnsOfTheTable) {
    const TemporaryFolder folder;
    const std::string map = folder.file("grey.exr");
    core::Image grey(16, 8, 3);
    std::fill(grey.pixels().begin(), grey.pixels().end(), 0.5f);
    ASSERT_TRUE(io::writeImage(map, grey).ok());
    const RunResult run = runLodestar(call(folder.file("cost"), map), {}, 300.0);
    ASSERT_EQ(run.status, 0) << run.err;
    const auto rows = rowsOf(textOf(folder.file("cost/cost.csv")));
    EXPECT_GT(rows.size(), 10u);
    for (const auto& row : rows) {
        EXPECT_EQ(row.at("environment"), "grey");
        for (const char* column :
             {"estimator", "exponent", "fetches", "rmse", "shading_ms_per_megapixel"}) {
            EXPECT_FALSE(row.at(column).empty()) << column;
        }
    }
}

TEST(Cost, PlotsAreDrawnWhereGnuplotIs) {
    if (std::system("gnuplot --version >/dev/null 2>&1") != 0) {
        GTEST_SKIP() << "needs gnuplot, which this machine lacks";
    }
    const TemporaryFolder folder;
    std::vector<std::string> arguments = call(folder.file("cost"), "gradient:0,1");
    arguments.pop_back(); // --no-plots
    const RunResult run = runLodestar(arguments, {}, 300.0);
    ASSERT_EQ(run.status, 0) << run.err;
    const std::string page = textOf(folder.file("cost/index.html"));
    std::size_t plots = 0;
    for (std::size_t at = page.find("<svg"); at != std::string::npos;
         at = page.find("<svg", at + 1)) {
        ++plots;
    }
    EXPECT_EQ(plots, 3u);
}

TEST(Cost, BadCallsAreRefusedInOneLine) {
    const TemporaryFolder folder;
    const std::string out = folder.file("cost");
    const std::vector<std::pair<std::vector<std::string>, int>> calls = {
        {{"cost", "-o", out}, 2},
        {{"cost", "gradient:0,1"}, 2},
        {{"cost", "gradient:0,1", "-o", out, "--no-plots", "--exponents", "4,x"}, 2},
        {{"cost", "gradient:0,1", "-o", out, "--no-plots", "--exponents", "inf"}, 2},
        {{"cost", "gradient:0,1", "-o", out, "--no-plots", "--width", "4"}, 2},
        {{"cost", folder.file("none.exr"), "-o", out, "--no-plots"}, 3},
        {{"cost", "constant:1,1,1", "-o", "/proc/nowhere", "--no-plots"}, 5},
    };
    for (const auto& [arguments, status] : calls) {
        const RunResult run = runLodestar(arguments);
        EXPECT_EQ(run.status, status) << run.err;
        EXPECT_EQ(run.errorLines().size(), 1u) << run.err;
    }
}

} // namespace
} // namespace lodestar::testing

// SPDX-License-Identifier: MIT
//
// `lodestar compare`: figures of pictures whose difference is known, and calls that are refused.
#include <algorithm>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/file.h"
#include "io/image_file.h"
#include "support/run.h"

namespace lodestar::testing {
namespace {

std::string constantPicture(const TemporaryFolder& folder, const std::string& name, int width,
                            float value) {
    core::Image image(width, 4, 4);
    std::fill(image.pixels().begin(), image.pixels().end(), value);
    for (std::size_t i = 3; i < image.pixels().size(); i += 4) {
        image.pixels()[i] = 1.0f;
    }
    std::string path = folder.file(name);
    EXPECT_TRUE(io::writeImage(path, image).ok());
    return path;
}

// Half floats keep .5 and .75 exactly: an error of a half.
TEST(Compare, TellsTheDifference) {
    const TemporaryFolder folder;
    const std::string one = constantPicture(folder, "one.exr", 8, 0.5f);
    const std::string other = constantPicture(folder, "other.exr", 8, 0.75f);
    const std::string errors = folder.file("errors.png");
    const RunResult run = runLodestar({"compare", other, one, "-o", errors});
    ASSERT_EQ(run.status, 0) << run.err;
    const nlohmann::json json = nlohmann::json::parse(run.out);
    for (const char* figure : {"mean", "rms", "worst"}) {
        EXPECT_NEAR(json.at(figure).get<double>(), 0.5, 1e-6) << figure;
    }
    EXPECT_EQ(json.at("pixels"), 32);
    const auto picture = io::readFile(errors);
    ASSERT_TRUE(picture.ok());
    EXPECT_TRUE(io::decodeImage(*picture, 4).ok());
    const RunResult same = runLodestar({"compare", one, one});
    EXPECT_EQ(nlohmann::json::parse(same.out).at("worst"), 0.0);
}

TEST(Compare, BadCallsAreRefusedInOneLine) {
    const TemporaryFolder folder;
    const std::string one = constantPicture(folder, "one.exr", 8, 0.5f);
    const std::string wide = constantPicture(folder, "wide.exr", 9, 0.5f);
    const std::string encoded = constantPicture(folder, "one.png", 8, 0.5f);
    const std::vector<std::pair<std::vector<std::string>, int>> calls = {
        {{"compare", one}, 2},
        {{"compare", one, one, "-o", folder.file("x.exr")}, 2},
        {{"compare", one, wide}, 3},
        {{"compare", one, encoded}, 3},
        {{"compare", one, folder.file("none.exr")}, 3},
    };
    for (const auto& [arguments, status] : calls) {
        const RunResult run = runLodestar(arguments);
        EXPECT_EQ(run.status, status) << run.err;
        EXPECT_EQ(run.errorLines().size(), 1u) << run.err;
    }
}

} // namespace
} // namespace lodestar::testing

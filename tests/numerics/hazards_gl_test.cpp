// SPDX-License-Identifier: MIT
//
// The hazards of docs/numerics.md in GLSL: the rows of hazard_rows.inc by two drivers and by C++,
// beside each other.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>

#include <gtest/gtest.h>

#include "gl/program.h"
#include "numerics/hazard_rows.h"
#include "platform/headless_context.h"

namespace lodestar::testing {
namespace {

const char* hooksOf(std::string_view file) {
    if (file == "lodestar/environment.glsl") {
        return LODESTAR_TEST_DATA "/numerics/hazard_hooks.glsl";
    }
    return file == "lodestar/rsrm.glsl" ? LODESTAR_TEST_DATA "/numerics/hazard_rsrm_hooks.glsl"
                                        : nullptr;
}

/// A row by the current context's driver; NaN, which no bound holds, where it cannot be built.
double onDriver(gl::Device& device, const HazardRow& row) {
    auto text = gl::assembleShader(row.file, 330, {});
    if (!text) {
        ADD_FAILURE() << text.error().message();
        return std::nan("");
    }
    if (const char* hooks = hooksOf(row.file)) {
        std::ostringstream helpers;
        helpers << std::ifstream(hooks).rdbuf();
        *text += helpers.str();
    }
    auto function =
        GlslFunction::make(device, 330, *text, "vec4(" + std::string(row.expression) + ")");
    if (!function) {
        ADD_FAILURE() << function.error().message();
        return std::nan("");
    }
    return static_cast<double>(function->evaluate({row.inputs})[0].x);
}

/// All rows by a driver of Mesa's; nothing where the machine has no such driver.
std::optional<std::vector<double>> onDriver(const char* driver,
                                            const std::vector<HazardRow>& rows) {
    setenv("GALLIUM_DRIVER", driver, 1);
    auto context = platform::HeadlessContext::create();
    unsetenv("GALLIUM_DRIVER");
    if (!context) {
        return {};
    }
    auto device = gl::Device::create();
    if (!device || (*device)->capabilities().renderer.find(driver) == std::string::npos) {
        return {};
    }
    std::vector<double> values;
    for (const HazardRow& row : rows) {
        values.push_back(onDriver(**device, row));
    }
    for (const std::string& message : (*device)->messages()) {
        ADD_FAILURE() << "OpenGL: " << message;
    }
    return values;
}

class HazardsGl : public ::testing::TestWithParam<const char*> {};

TEST_P(HazardsGl, InGlsl) {
    const std::vector<HazardRow> rows = hazardRows();
    const auto values = onDriver(GetParam(), rows);
    if (!values) {
        const char* required = std::getenv("LODESTAR_REQUIRE_GL");
        ASSERT_FALSE(required != nullptr && std::string_view(required) == "1")
            << "no driver " << GetParam();
        GTEST_SKIP() << "no driver " << GetParam();
    }
    std::printf("  #  %16s %16s %16s  bound used\n", "expected", "C++", GetParam());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const HazardRow& row = rows[i];
        const double off = std::abs((*values)[i] - row.expected);
        std::printf("%3d  %16.9g %16.9g %16.9g  %.2f\n", row.number, row.expected, row.inCpp,
                    (*values)[i], off > 0.0 ? off / row.bound : 0.0);
        EXPECT_LE(off, row.bound) << row.number << ": " << row.expression;
    }
}

INSTANTIATE_TEST_SUITE_P(Drivers, HazardsGl, ::testing::Values("llvmpipe", "softpipe"),
                         [](const auto& one) { return std::string(one.param); });

} // namespace
} // namespace lodestar::testing

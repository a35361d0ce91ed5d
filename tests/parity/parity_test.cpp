// SPDX-License-Identifier: MIT
//
// Every function of shaders/lodestar, by the driver, by the float compilation and by the double
// one.
#include <cmath>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "parity/rows.h"
#include "support/gl_fixture.h"

namespace lodestar::testing {
namespace {

std::string readText(const std::string& path) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// How far `value` is from `expected` in units of what is allowed: at most 1 passes. Infinities and
/// NaN must be the same.
double excess(double value, double expected, double allowed) {
    if (!std::isfinite(expected)) {
        const bool same = std::isnan(expected) ? std::isnan(value) : value == expected;
        return same ? 0.0 : 1e30;
    }
    const double difference = std::abs(value - expected);
    return difference <= 0.0 ? 0.0 : (allowed > 0.0 ? difference / allowed : 1e30);
}

std::string describe(const GlslCase& inputs) {
    std::ostringstream text;
    text.precision(9);
    for (std::size_t k = 0; k < 7; ++k) {
        text << " p" << k << "=(" << inputs[k].x << "," << inputs[k].y << "," << inputs[k].z << ","
             << inputs[k].w << ")";
    }
    return text.str();
}

/// Whether a row is worth running: what does not depend on LODESTAR_SPECULAR is run once.
bool isDistinct(const ParityRow& row) {
    return row.specular == 0 || row.function == "lodestar_specular" ||
           row.function == "lodestar_environment" || row.function == "lodestar_specularOfTents";
}

class Parity : public GlTest {
protected:
    /// The row in GLSL of a version.
    std::vector<glm::vec4> onGpu(const ParityRow& row, int version,
                                 const std::vector<GlslCase>& cases) {
        auto text = gl::assembleShader(
            row.file, version,
            {{"LODESTAR_SPECULAR", std::to_string(row.specular)}, {"LODESTAR_RSRM_ROWS", "1"}});
        if (!text) {
            ADD_FAILURE() << text.error().message();
            return {};
        }
        if (row.helpers != nullptr) {
            *text += readText(std::string(LODESTAR_TEST_DATA "/parity/") + row.helpers);
        }
        auto function = GlslFunction::make(device(), version, *text, row.expression);
        if (!function) {
            ADD_FAILURE() << function.error().message();
            return {};
        }
        return function->evaluate(cases);
    }

    void compareRow(std::size_t index, int version) {
        const ParityRow row = parityRows()[index];
        const Evaluation inFloat = floatEvaluations()[index];
        const Evaluation inDouble = doubleEvaluations()[index];
        const std::vector<GlslCase> cases = row.cases();
        const std::vector<glm::vec4> values = onGpu(row, version, cases);
        ASSERT_EQ(values.size(), cases.size()) << row.function;
        double worst = 0.0;
        bool varies = false;
        for (std::size_t i = 0; i < cases.size(); ++i) {
            const glm::dvec4 exactValue = inDouble(cases[i]);
            const glm::dvec4 floatValue = inFloat(cases[i]);
            const Tolerance allowed = row.tolerance(cases[i], exactValue, row.specular);
            for (int k = 0; k < 4; ++k) {
                const double bound = allowed[static_cast<std::size_t>(k)];
                const double value = static_cast<double>(values[i][k]);
                // The float compilation is held to the driver's bound, so the two differ by at most
                // twice that.
                const double off = std::max(excess(value, exactValue[k], bound),
                                            excess(value, floatValue[k], 2.0 * bound));
                worst = std::max(worst, off);
                ASSERT_LE(off, 1.0) << row.function << " channel " << k << ": driver " << value
                                    << ", float " << floatValue[k] << ", double " << exactValue[k]
                                    << ", allowed " << bound << " at" << describe(cases[i]);
            }
            varies = varies || values[i] != values[0];
        }
        EXPECT_TRUE(varies) << row.function << " answered one value only";
        std::printf("%-32s %d  %3zu cases, worst %.2f of the bound\n", row.function.c_str(),
                    version, cases.size(), worst);
    }
};

TEST_F(Parity, EveryFunctionUnderGlsl330) {
    for (std::size_t i = 0; i < parityRows().size(); ++i) {
        if (isDistinct(parityRows()[i])) {
            compareRow(i, 330);
        }
    }
}

TEST_F(Parity, EveryFunctionUnderGlsl450) {
    if (device().capabilities().version < 45) {
        GTEST_SKIP() << "this driver has no OpenGL 4.5";
    }
    for (std::size_t i = 0; i < parityRows().size(); ++i) {
        if (isDistinct(parityRows()[i])) {
            compareRow(i, 450);
        }
    }
}

// A comparison that cannot fail proves nothing: a changed constant is found.
TEST_F(Parity, FindsAChangedConstant) {
    const std::vector<ParityRow> rows = parityRows();
    std::size_t index = 0;
    while (index < rows.size() && rows[index].function != "lodestar_mipLevelUnclamped") {
        ++index;
    }
    ASSERT_LT(index, rows.size());
    const ParityRow row = rows[index];
    const std::vector<GlslCase> cases = row.cases();
    ParityRow changed = row;
    const std::string expression = std::string(row.expression) + " * 1.00001";
    changed.expression = expression.c_str();
    const std::vector<glm::vec4> values = onGpu(changed, 330, cases);
    ASSERT_EQ(values.size(), cases.size());
    std::size_t found = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const glm::dvec4 exactValue = doubleEvaluations()[index](cases[i]);
        const double bound = row.tolerance(cases[i], exactValue, 0)[0];
        found += excess(static_cast<double>(values[i].x), exactValue.x, bound) > 1.0;
    }
    EXPECT_GT(found, cases.size() / 2);
}

} // namespace
} // namespace lodestar::testing

// SPDX-License-Identifier: MIT
//
// The shading text compiled in float against the same text in double: what differs is rounding, and
// it stays within the bounds counted in dual_rows_body.h.
#include <cmath>
#include <cstdio>
#include <random>

#include <gtest/gtest.h>

#include "numerics/dual_rows.h"

namespace lodestar::testing {

namespace {

constexpr int kCases = 20000;

std::vector<double> draw(const std::vector<DualRange>& ranges, std::mt19937& random) {
    std::vector<double> arguments;
    for (const DualRange& range : ranges) {
        const double t = std::uniform_real_distribution<double>(0.0, 1.0)(random);
        const double value = range.logarithmic ? range.low * std::pow(range.high / range.low, t)
                                               : range.low + (range.high - range.low) * t;
        // A float, so that both compilations are given the same number.
        arguments.push_back(static_cast<double>(static_cast<float>(value)));
    }
    return arguments;
}

class DualPrecision : public ::testing::TestWithParam<std::size_t> {};

} // namespace

TEST_P(DualPrecision, DiffersByRoundingOnly) {
    const DualRow inFloat = floatRows()[GetParam()];
    const DualRow inDouble = doubleRows()[GetParam()];
    ASSERT_STREQ(inFloat.name, inDouble.name);
    std::mt19937 random(20130u);
    double worst = 0.0;
    double least = 1e300;
    double most = -1e300;
    for (int i = 0; i < kCases; ++i) {
        const std::vector<double> arguments = draw(inFloat.arguments, random);
        const double f = inFloat.evaluate(arguments.data());
        const double d = inDouble.evaluate(arguments.data());
        ASSERT_TRUE(std::isfinite(f) && std::isfinite(d)) << inFloat.name;
        const double bound = (inFloat.absolute + inFloat.relative * std::abs(d)) * kRounding;
        worst = std::max(worst, std::abs(f - d) / bound);
        least = std::min(least, d);
        most = std::max(most, d);
    }
    std::printf("%-22s worst %.2f of the bound\n", inFloat.name, worst);
    EXPECT_LE(worst, 1.0) << inFloat.name;
    EXPECT_GT(most, least) << inFloat.name << " answered one value only";
}

INSTANTIATE_TEST_SUITE_P(Rows, DualPrecision, ::testing::Range(std::size_t{0}, floatRows().size()),
                         [](const auto& row) { return std::string(floatRows()[row.param].name); });

} // namespace lodestar::testing

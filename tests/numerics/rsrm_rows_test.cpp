// SPDX-License-Identifier: MIT
//
// Maps whose rows are given one by one: against closed forms at their rows and between, and against
// the map whose rows are the default ones.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#define LODESTAR_RSRM_ROWS 1
#include "lodestar/rsrm.glsl"

#include "numerics/rsrm_sources.h"
#include "support/throwing_contract.h"

namespace lodestar::shader {
namespace {

/// The text's rows in float.
struct OwnRowsHost {
    std::array<float, lighting::kMostOwnRows> octaves{};

#define LODESTAR_HOST_CLASS
#include "lodestar/rsrm.glsl"
#undef LODESTAR_HOST_CLASS

    [[nodiscard]] vec4 lodestar_host_rsrmOctaves(int index) const {
        const float* four = octaves.data() + 4 * index;
        return {four[0], four[1], four[2], four[3]};
    }
    [[nodiscard]] vec4 lodestar_host_rsrm(float, float, int) const {
        return vec4(0.0f);
    }
    [[nodiscard]] vec3 lodestar_host_rsrmLambert(float, int) const {
        return vec3(0.0f);
    }
    [[nodiscard]] vec3 lodestar_host_rsrmGradient(float, int) const {
        return vec3(0.0f);
    }
};

} // namespace
} // namespace lodestar::shader

namespace lodestar::testing {
namespace {

using namespace lighting;

RsrmKernels& kernels() {
    static RsrmKernels cache;
    return cache;
}

RsrmBake bakeOf(const RsrmLayout& layout, const RsrmSource& source) {
    const auto kernel = kernels().get(layout, source.kind);
    return kernel->bake(source.zonal(kernel->zones()));
}

const std::vector<glm::vec3> kBlack(2);

/// Uneven rows from the first to the sharpest that there may be.
const std::vector<double> kUneven = {1.0, 1.5, 4.0, 11.0, 40.0, 60.0, 300.0, 2500.0, 16384.0};

/// Row 3.7 of rows that were given is 0.7 of the way from row 3 to row 4 in log2(s + 1).
double placeOf(const std::vector<double>& rows, double exponent) {
    std::size_t k = 0;
    while (k + 2 < rows.size() && rows[k + 1] <= exponent) {
        ++k;
    }
    return static_cast<double>(k) + std::log((exponent + 1.0) / (rows[k] + 1.0)) /
                                        std::log((rows[k + 1] + 1.0) / (rows[k] + 1.0));
}

float textRow(const RsrmLayout& layout, double exponent) {
    const shader::OwnRowsHost host{rowOctaves(layout)};
    shader::LodestarRsrm map{};
    map.rows = static_cast<float>(layout.rows);
    map.leastExponent = static_cast<float>(layout.leastExponent);
    map.greatestExponent = static_cast<float>(layout.greatestExponent);
    return shader::OwnRowsHost(host).lodestar_rsrmOwnRow(map, static_cast<float>(exponent));
}

} // namespace

TEST(RsrmOwnRows, WhatMayBeGiven) {
    EXPECT_TRUE(faultOfRows(kUneven).words.empty());
    EXPECT_TRUE(faultOfRows(std::vector<double>{1.0, 1.01}).words.empty());
    EXPECT_TRUE(faultOfRows(rowExponents(kRsrm)).words.empty());
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::pair<std::vector<double>, std::size_t> refused[] = {
        {{}, 0},           {{5.0}, 1},          {std::vector<double>(25, 3.0), 25},
        {{0.5, 2.0}, 0},   {{1.0, 16385.0}, 1}, {{1.0, 4.0, 4.0}, 2},
        {{1.0, 1.009}, 1}, {{nan, 2.0}, 0},     {{1.0, nan}, 1},
        {{8.0, 2.0}, 1},
    };
    for (const auto& [rows, at] : refused) {
        const RowsFault fault = faultOfRows(rows);
        EXPECT_FALSE(fault.words.empty()) << rows.size();
        EXPECT_EQ(fault.row, at) << fault.words;
    }
    const ThrowingContracts contracts;
    EXPECT_THROW((void)rsrmWithRows(std::vector<double>{2.0, 1.0}), ContractBroken);
    EXPECT_EQ(rsrmWithRows({}), kRsrm);
    EXPECT_FALSE(hasOwnRows(kRsrm));
}

TEST(RsrmOwnRows, LayoutAndTextAgree) {
    // The closest rows that may be given, at either end of their range, too.
    std::vector<double> close = {1.0, 1.01, 1.0202};
    for (double s = 16384.0 / 1.0100001; close.size() < 23; s /= 1.0100001) {
        close.insert(close.begin() + 3, s);
    }
    close.push_back(16384.0);
    for (const std::vector<double>& rows : {kUneven, close, std::vector<double>{3.0, 70.0}}) {
        const RsrmLayout layout = rsrmWithRows(rows);
        EXPECT_EQ(rowExponents(layout), rows);
        EXPECT_EQ(texelBytes(layout), 4u * 170u * rows.size());
        for (double place = 0.0; place <= layout.rows - 1; place += 0.125) {
            const double exponent = rowExponent(layout, place);
            EXPECT_NEAR(placeOf(rows, exponent), place, 1e-9);
            // Octaves of at most 14.0002 as floats, the text's by two roundings (its argument's is
            // one of the octave over ln 2), in steps of .0072 octaves and .0143.
            const double step = std::log2(1.01) * rows.front() / (rows.front() + 1.0);
            EXPECT_NEAR(textRow(layout, exponent), place, 4.0 * 0x1p-20 / step + 2e-6) << exponent;
        }
        EXPECT_EQ(textRow(layout, 0.0), 0.0f);
        EXPECT_EQ(textRow(layout, std::nan("")), 0.0f);
        EXPECT_EQ(textRow(layout, std::numeric_limits<double>::infinity()), layout.rows);
    }
}

// Interpolated weights of low exponents and series for the others, against double precision by
// rings. Five digits of the row's peak are the goal of kernels in float.
TEST(RsrmOwnRows, KernelsKeepFiveDigits) {
    const RsrmLayout layout = rsrmWithRows(kUneven);
    for (const RsrmSource& source : kRsrmSources) {
        const RsrmBake bake = bakeOf(layout, source);
        const ZonalRadiance zonal = source.zonal(zonesFor(source.kind));
        ASSERT_EQ(bake.exponents, bakedExponents(layout));
        EXPECT_LT(worstOfPeak(bake, zonal, 1, 13), 1e-5) << source.name;
    }
}

// A root linear between rows, where it is exact at the rows, is off by E. A fit to two places a row
// is within (1 + P) E, P the greatest sum that fitted rows are of unit samples: the normal matrix
// has 3/2 (5/4 at the ends) beside two of 1/4 (one), its inverse at most 1 / (3/2 - 2/4) = 1, and a
// row's samples weigh 2 together. Nine bits of a root are half a step, 2^-9 of it.
// At a column's angle the text is up to .02 columns beside it, in float, as rsrm_test.cpp has it.
TEST(RsrmOwnRows, AtRowsAndBetweenWithinTheFitsBound) {
    const RsrmLayout layout = rsrmWithRows(kUneven);
    const std::vector<double> thetas = columnAngles(RsrmColumns::Refined, layout.columns);
    int beyondByOtherRows = 0;
    for (const RsrmSource& source : kRsrmSources) {
        const RsrmTexels texels = encode(layout, bakeOf(layout, source));
        // What reads the same texels by evenly spaced rows.
        RsrmTexels misread = texels;
        misread.layout.ownExponents = {};
        double closest = 0.0;
        for (std::size_t i = 1; i + 1 < thetas.size(); i += 8) {
            const auto root = [&](double s) { return std::sqrt(source.exact(thetas[i], s)); };
            double interpolation = 0.0;
            for (double place = 0.0; place <= layout.rows - 1; place += 0.0625) {
                const double before = std::min(std::floor(place), layout.rows - 2.0);
                const double line =
                    std::lerp(root(rowExponent(layout, before)),
                              root(rowExponent(layout, before + 1.0)), place - before);
                interpolation =
                    std::max(interpolation, std::abs(line - root(rowExponent(layout, place))));
            }
            for (double place = 0.0; place <= layout.rows - 1; place += 0.25) {
                const double s = rowExponent(layout, place);
                const double exact = root(s);
                const double beside =
                    0.02 * std::max(std::abs(exact - std::sqrt(source.exact(thetas[i - 1], s))),
                                    std::abs(exact - std::sqrt(source.exact(thetas[i + 1], s))));
                // Of five digits of the peak a root keeps sqrt(v + d) - sqrt(v).
                const double kernel =
                    std::sqrt(exact * exact + 1e-5 * source.exact(0.0, s)) - exact;
                const double fitted = 3.0 * interpolation;
                const double bound = fitted + 0x1p-9 * (exact + fitted) + beside + kernel;
                const auto of = [&](const RsrmTexels& map) {
                    return std::sqrt(
                        static_cast<double>(rsrmRadiance(map, kBlack, thetas[i], s).g));
                };
                ASSERT_NEAR(of(texels), exact, bound)
                    << source.name << " s " << s << " at " << thetas[i] / kDegree;
                closest = std::max(closest, std::abs(of(texels) - exact) / bound);
                beyondByOtherRows += std::abs(of(misread) - exact) > bound ? 1 : 0;
            }
        }
        std::printf("own rows, %s: %.2f of the bound\n", source.name, closest);
    }
    EXPECT_GT(beyondByOtherRows, 100); // the bound sees rows that are read as others
}

// The default rows given one by one: the places between them differ by the roundings of a power,
// and the weights of low exponents by 1e-8 of the peak. A texel at the edge of its nine bits, 2^-8
// of a root at most, may go to the other side.
TEST(RsrmOwnRows, TheDefaultRowsGivenAreTheDefaultWithinRounding) {
    const RsrmLayout given = rsrmWithRows(rowExponents(kRsrm));
    EXPECT_EQ(given.rows, kRsrm.rows);
    for (const RsrmSource& source : kRsrmSources) {
        const RsrmTexels own = encode(given, bakeOf(given, source));
        const RsrmTexels usual = encode(kRsrm, bakeOf(kRsrm, source));
        ASSERT_EQ(own.bytes.size(), usual.bytes.size());
        for (int row = 0; row < kRsrm.rows; ++row) {
            const auto value = [row](const RsrmTexels& map, int column) {
                const auto root = static_cast<double>(storedTexel(map, column, row).g);
                return root * root;
            };
            double peak = 0.0;
            for (int column = 0; column < kRsrm.columns; ++column) {
                peak = std::max(peak, value(usual, column));
            }
            for (int column = 0; column < kRsrm.columns; ++column) {
                const double a = value(own, column);
                const double b = value(usual, column);
                ASSERT_NEAR(a, b, 0x1.02p-7 * std::max(a, b) + 2e-8 * peak) << row << " " << column;
            }
        }
        for (const double s : {1.0, 2.2, 30.0, 700.0, 2048.0}) {
            EXPECT_NEAR(textRow(given, s),
                        23.0 * std::log2((s + 1.0) / 2.0) / std::log2(2049.0 / 2.0), 2e-5);
        }
    }
}

// A row that moves: what others share is the same as what is built anew.
TEST(RsrmOwnRows, AKernelDoesNotDependOnTheOnesBefore) {
    std::vector<double> rows = kUneven;
    RsrmKernels moved;
    for (const double s : {2.0, 5.0, 9.0, 3.0}) { // beyond what is kept
        for (const double t : {100.0, 200.0, 260.0}) {
            rows[2] = s;
            rows[6] = t;
            (void)moved.get(rsrmWithRows(rows), LightKind::Sun);
        }
    }
    RsrmKernels anew;
    const RsrmLayout layout = rsrmWithRows(rows);
    const ZonalRadiance zonal = kRsrmSources[0].zonal(zonesFor(LightKind::Sun));
    const RsrmBake one = moved.get(layout, LightKind::Sun)->bake(zonal);
    const RsrmBake other = anew.get(layout, LightKind::Sun)->bake(zonal);
    EXPECT_EQ(one.exponents, other.exponents);
    EXPECT_EQ(one.planes, other.planes);
    EXPECT_EQ(one.lambert, other.lambert);
}

// Above its own last row a map shows the gradient by the share that belongs to that row.
TEST(RsrmOwnRows, TheMirrorsShareBeginsAtTheLastRow) {
    const RsrmLayout layout = rsrmWithRows(std::vector<double>{1.0, 8.0, 32.0});
    for (const double s : {20.0, 32.0, 100.0, 2048.0, 1e7}) {
        const double share =
            s > 32.0 ? shader::lodestar_rsrmMirrorShare(static_cast<float>(s), 32.0f) : 0.0;
        EXPECT_NEAR(textRow(layout, s), std::min(placeOf({1.0, 8.0, 32.0}, s), 2.0) + share, 1e-5);
    }
    EXPECT_GT(textRow(layout, 1e7), 2.9f);
}

} // namespace lodestar::testing

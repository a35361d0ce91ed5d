// SPDX-License-Identifier: MIT
#define LODESTAR_DOUBLE_PRECISION
#include "lighting/rsrm_layout.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/contract.h"

#include "lodestar/rsrm.glsl"

namespace lodestar::lighting {

namespace {

constexpr int kFitPerRow = 2; ///< places of the fit in a step from row to row

/// What is added to an exponent before its logarithm is taken.
double rowShift(const RsrmLayout& layout) {
    return layout.columnMap == RsrmColumns::UniformHeight ? 0.0 : 1.0;
}

/// The angle of u2 by halving: u2 rises from 0 to 1.
double refinedAngle(double u) {
    double low = 0.0;
    double high = std::numbers::pi;
    for (int step = 0; step < 80; ++step) {
        const double middle = 0.5 * (low + high);
        const double coordinate = shader_double::lodestar_rsrmRefinedColumn(std::sin(0.5 * middle));
        (coordinate < u ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

} // namespace

const RsrmLayout* rsrmLayoutNamed(std::string_view name) {
    return name == "rsrm"                     ? &kRsrm
           : name == "rsrm-published"         ? &kRsrmPublished
           : name == "rsrm-published-columns" ? &kRsrmPublishedColumns
                                              : nullptr;
}

std::vector<double> columnAngles(RsrmColumns map, int columns) {
    LODESTAR_EXPECT(columns >= 2, "a map has two columns at least");
    std::vector<double> angles;
    for (int j = 0; j < columns; ++j) {
        if (map == RsrmColumns::UniformHeight) {
            angles.push_back(2.0 * std::asin(std::sqrt((j + 0.5) / columns)));
        } else if (j == 0 || j == columns - 1) {
            angles.push_back(j == 0 ? 0.0 : std::numbers::pi);
        } else {
            angles.push_back(refinedAngle(static_cast<double>(j) / (columns - 1)));
        }
    }
    return angles;
}

RowsFault faultOfRows(std::span<const double> exponents) {
    if (exponents.size() < 2 || exponents.size() > kMostOwnRows) {
        return {exponents.size(), "2 to 24 are needed"};
    }
    for (std::size_t i = 0; i < exponents.size(); ++i) {
        if (!(exponents[i] >= kLeastOwnExponent && exponents[i] <= kGreatestOwnExponent)) {
            return {i, "each lies in [1, 16384]"};
        }
        if (i > 0 && !(exponents[i] >= kLeastRowRatio * exponents[i - 1])) {
            return {i, "each is at least 1.01 times the one before"};
        }
    }
    return {};
}

RsrmLayout rsrmWithRows(std::span<const double> exponents) {
    RsrmLayout layout = kRsrm;
    if (exponents.empty()) {
        return layout;
    }
    LODESTAR_EXPECT(faultOfRows(exponents).words.empty(),
                    "the rows' exponents rise in their range");
    layout.rows = static_cast<int>(exponents.size());
    layout.leastExponent = exponents.front();
    layout.greatestExponent = exponents.back();
    std::copy(exponents.begin(), exponents.end(), layout.ownExponents.begin());
    return layout;
}

std::vector<double> rowExponents(const RsrmLayout& layout) {
    std::vector<double> exponents;
    for (int row = 0; row < layout.rows; ++row) {
        exponents.push_back(rowExponent(layout, row));
    }
    return exponents;
}

std::array<float, kMostOwnRows> rowOctaves(const RsrmLayout& layout) {
    LODESTAR_EXPECT(layout.rows <= kMostOwnRows && layout.columnMap == RsrmColumns::Refined,
                    "the table holds the layout's rows");
    std::array<float, kMostOwnRows> octaves{};
    for (int row = 0; row < kMostOwnRows; ++row) {
        octaves[static_cast<std::size_t>(row)] = static_cast<float>(
            std::log2(rowExponent(layout, std::min(row, layout.rows - 1)) + 1.0));
    }
    return octaves;
}

double rowExponent(const RsrmLayout& layout, double row) {
    if (hasOwnRows(layout)) {
        const auto before =
            std::min(static_cast<std::size_t>(row), static_cast<std::size_t>(layout.rows) - 2);
        const double share = row - static_cast<double>(before);
        const double below = layout.ownExponents[before];
        const double above = layout.ownExponents[before + 1];
        return share == 0.0 ? below
               : share == 1.0
                   ? above
                   : (below + 1.0) * std::pow((above + 1.0) / (below + 1.0), share) - 1.0;
    }
    const double shift = rowShift(layout);
    const double least = layout.leastExponent + shift;
    const double most = layout.greatestExponent + shift;
    return least * std::pow(most / least, row / (layout.rows - 1)) - shift;
}

double firstOctave(const RsrmLayout& layout) {
    return std::log2(layout.leastExponent + rowShift(layout));
}

double rowsPerOctave(const RsrmLayout& layout) {
    return (layout.rows - 1) /
           (std::log2(layout.greatestExponent + rowShift(layout)) - firstOctave(layout));
}

std::vector<double> lambertAngles() {
    std::vector<double> angles;
    for (int j = 0; j < kLambertColumns; ++j) {
        angles.push_back(2.0 *
                         std::asin(std::sqrt(static_cast<double>(j) / (kLambertColumns - 1))));
    }
    return angles;
}

std::vector<double> fitPlaces(const RsrmLayout& layout) {
    std::vector<double> places;
    const int count = (layout.rows - 1) * kFitPerRow;
    for (int i = 0; i <= count; ++i) {
        places.push_back(static_cast<double>(i) / kFitPerRow);
    }
    return places;
}

std::vector<double> bakedExponents(const RsrmLayout& layout) {
    if (!layout.fitted) {
        return rowExponents(layout);
    }
    std::vector<double> exponents;
    for (const double place : fitPlaces(layout)) {
        exponents.push_back(rowExponent(layout, place));
    }
    return exponents;
}

std::size_t texelBytes(const RsrmLayout& layout) {
    const std::size_t each = layout.encoding == RsrmEncoding::Float  ? 16
                             : layout.encoding == RsrmEncoding::Half ? 8
                                                                     : 4;
    return each * static_cast<std::size_t>(layout.columns) * static_cast<std::size_t>(layout.rows);
}

} // namespace lodestar::lighting

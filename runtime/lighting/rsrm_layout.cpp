// SPDX-License-Identifier: MIT
#define LODESTAR_DOUBLE_PRECISION
#include "lighting/rsrm_layout.h"

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

double rowExponent(const RsrmLayout& layout, double row) {
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
    std::vector<double> exponents;
    if (layout.fitted) {
        for (const double place : fitPlaces(layout)) {
            exponents.push_back(rowExponent(layout, place));
        }
        return exponents;
    }
    for (int row = 0; row < layout.rows; ++row) {
        exponents.push_back(rowExponent(layout, row));
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

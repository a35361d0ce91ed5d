// SPDX-License-Identifier: MIT
//
// How a filtered map is stored: which angle a column has, which exponent a row, and what a texel
// holds (docs/derivations/rsrm.md says what each layout's error is).
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lodestar::lighting {

enum class RsrmColumns {
    UniformHeight, ///< texel centres uniform in z (Stone)
    Refined, ///< u2: fine at the axis and at the horizon, both poles on texel centres (RSRM-6)
};

enum class RsrmEncoding {
    Unorm8,         ///< 4 bytes a texel
    SharedExponent, ///< RGB9_E5, 4 bytes: nine bits a channel of the greatest
    Half,           ///< RGBA16F, 8 bytes
    Float,          ///< RGBA32F, 16 bytes
};

/// Rows that a layout may be given one by one: as many as `rsrm` has, so that no map is larger than
/// that.
inline constexpr int kMostOwnRows = 24;

struct RsrmLayout {
    RsrmColumns columnMap = RsrmColumns::Refined;
    int columns = 0; ///< >= 2
    int rows = 0;    ///< >= 2
    RsrmEncoding encoding = RsrmEncoding::Half;
    /// Rows fitted to sqrt(value) between them, sqrt stored; else values at the rows' exponents
    /// over one scale for the map.
    bool fitted = true;
    bool sampledWeights = false; ///< Stone's eq. 1 instead of exact weights
    double leastExponent = 1.0;  ///< of row 0, > 0
    double greatestExponent = 2048.0;
    /// Where rows are given one by one: their exponents, `rows` of them, the rest 0. All 0: rows
    /// are uniform between the two above. Only of Refined columns.
    std::array<double, kMostOwnRows> ownExponents{};
    bool operator==(const RsrmLayout&) const = default;
};

/// `rsrm`: 170 x 24 RGB9_E5, 16 KB.
inline constexpr RsrmLayout kRsrm{RsrmColumns::Refined, 170, 24, RsrmEncoding::SharedExponent};
/// 128 x 16 RGB9_E5, 8 KB.
inline constexpr RsrmLayout kRsrmSmall{RsrmColumns::Refined, 128, 16, RsrmEncoding::SharedExponent};
/// 512 x 64 RGBA32F, 512 KB: what the others are judged by on a GPU.
inline constexpr RsrmLayout kRsrmReference{RsrmColumns::Refined, 512, 64, RsrmEncoding::Float};
/// `rsrm-published`: Stone's map, 256 uniform columns, 8 rows, one 8-bit scale.
inline constexpr RsrmLayout kRsrmPublished{RsrmColumns::UniformHeight, 256,   8,
                                           RsrmEncoding::Unorm8,       false, true};
/// `rsrm-published-columns`: exact weights in Stone's storage.
inline constexpr RsrmLayout kRsrmPublishedColumns{RsrmColumns::UniformHeight, 256,   8,
                                                  RsrmEncoding::Unorm8,       false, false};

/// What rows that are given one by one may be (RSRM-13).
inline constexpr double kLeastOwnExponent = 1.0;
inline constexpr double kGreatestOwnExponent = 16384.0;
inline constexpr double kLeastRowRatio = 1.01; ///< of a row's exponent over that of the row before

/// What is wrong with exponents of rows, and with which of them.
struct RowsFault {
    std::size_t row = 0; ///< their number where there are too few or too many
    std::string words;   ///< the rule that it breaks; empty: none
};
[[nodiscard]] RowsFault faultOfRows(std::span<const double> exponents);

/// `rsrm` with rows at these exponents; with its own 24 where there are none.
/// @pre none, or faultOfRows finds nothing
[[nodiscard]] RsrmLayout rsrmWithRows(std::span<const double> exponents);

/// Whether a layout's rows were given one by one.
[[nodiscard]] constexpr bool hasOwnRows(const RsrmLayout& layout) {
    return layout.ownExponents[0] > 0.0;
}

/// The exponents of a layout's rows.
[[nodiscard]] std::vector<double> rowExponents(const RsrmLayout& layout);

/// log2(s + 1) of the rows, the last one's again behind it: what lodestar_host_rsrmOctaves answers,
/// four a vector, where the layout has Refined columns and kMostOwnRows rows at most.
[[nodiscard]] std::array<float, kMostOwnRows> rowOctaves(const RsrmLayout& layout);

/// The layout of an estimator's name: rsrm, rsrm-published, rsrm-published-columns; null for
/// others.
[[nodiscard]] const RsrmLayout* rsrmLayoutNamed(std::string_view name);
/// These names, for messages.
inline constexpr const char* kRsrmNames = "rsrm, rsrm-published, rsrm-published-columns";

/// The angle of each column from the axis, radians: where u2 = j / (columns - 1) for Refined, at
/// texel centres for UniformHeight.
[[nodiscard]] std::vector<double> columnAngles(RsrmColumns map, int columns);

/// The exponent of a row or of a place between rows: rows are uniform in log(s + 1), in log s for
/// UniformHeight; between rows that were given one by one log(s + 1) is linear.
/// @param row [0, rows - 1]
[[nodiscard]] double rowExponent(const RsrmLayout& layout, double row);

/// log2 of the first row's exponent, of that + 1 for Refined: LodestarRsrm.firstOctave.
[[nodiscard]] double firstOctave(const RsrmLayout& layout);
/// (rows - 1) over the octaves from the first row to the last: LodestarRsrm.rowsPerOctave.
[[nodiscard]] double rowsPerOctave(const RsrmLayout& layout);

/// Columns of a refined layout's line of means over Lambert's lobe: uniform in z, both poles and
/// the horizon, where a sun's has its bend, on texel centres.
inline constexpr int kLambertColumns = 129;
/// The angle of each of these from the axis, radians.
[[nodiscard]] std::vector<double> lambertAngles();

/// The places between rows (in rows) that a fitted layout is baked at.
[[nodiscard]] std::vector<double> fitPlaces(const RsrmLayout& layout);

/// The exponents that a layout is baked at: its rows', or those of the fit.
[[nodiscard]] std::vector<double> bakedExponents(const RsrmLayout& layout);

/// Bytes of a layout's texels.
[[nodiscard]] std::size_t texelBytes(const RsrmLayout& layout);

} // namespace lodestar::lighting

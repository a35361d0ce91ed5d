// SPDX-License-Identifier: MIT
//
// How a filtered map is stored: which angle a column has, which exponent a row, and what a texel
// holds (docs/derivations/rsrm.md says what each layout's error is).
#pragma once

#include <cstddef>
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

/// The layout of an estimator's name: rsrm, rsrm-published, rsrm-published-columns; null for
/// others.
[[nodiscard]] const RsrmLayout* rsrmLayoutNamed(std::string_view name);
/// These names, for messages.
inline constexpr const char* kRsrmNames = "rsrm, rsrm-published, rsrm-published-columns";

/// The angle of each column from the axis, radians: where u2 = j / (columns - 1) for Refined, at
/// texel centres for UniformHeight.
[[nodiscard]] std::vector<double> columnAngles(RsrmColumns map, int columns);

/// The exponent of a row or of a place between rows: rows are uniform in log(s + 1), in log s for
/// UniformHeight. @param row [0, rows - 1]
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

// SPDX-License-Identifier: MIT
//
// Exact solid angles on a cube's face, and tables of them that the filters share.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

namespace lodestar::lighting {

/// Solid angle of the rectangle from (0, 0) to (x, y) on the plane z = 1: atan(xy /
/// sqrt(1+x^2+y^2)).
[[nodiscard]] inline double cornerSolidAngle(double x, double y) {
    return std::atan(x * y / std::sqrt(1.0 + x * x + y * y));
}

/// Solid angle of the rectangle [x0, x1] x [y0, y1] on the plane z = 1, steradians.
[[nodiscard]] inline double rectangleSolidAngle(double x0, double y0, double x1, double y1) {
    return cornerSolidAngle(x0, y0) - cornerSolidAngle(x1, y0) - cornerSolidAngle(x0, y1) +
           cornerSolidAngle(x1, y1);
}

/// Solid angles of a face's texels in float, with what a tent filter to half the width needs. Only
/// the rows of the upper half are kept: the lower half mirrors them.
class TexelTable {
public:
    explicit TexelTable(int width);

    [[nodiscard]] int width() const { return width_; }
    /// Solid angles of row y. @pre y in [0, width)
    [[nodiscard]] const float* solidAngles(int y) const {
        return solidAngles_.data() + offset(y, width_);
    }
    /// 1 / sum of tent weight times solid angle, for row y of the level below. Widths above 1 only.
    /// @pre y in [0, width / 2)
    [[nodiscard]] const float* tentReciprocals(int y) const {
        return tentReciprocals_.data() + offset(y, width_ / 2);
    }

private:
    static std::size_t offset(int y, int width) {
        const int stored = y < (width + 1) / 2 ? y : width - 1 - y;
        return static_cast<std::size_t>(stored) * static_cast<std::size_t>(width);
    }

    int width_;
    std::vector<float> solidAngles_;
    std::vector<float> tentReciprocals_;
};

/// The table of a width, from a cache that any number of threads may use.
[[nodiscard]] std::shared_ptr<const TexelTable> texelTable(int width);

/// A coarse texel's taps along one axis: weights of fine texels first .. first + count - 1, which
/// may lie one texel outside the face.
struct AxisTaps {
    int first = 0;
    int count = 0;
    float weights[6] = {};
};

/// Overlap of each coarse texel with the fine ones, in fine texels: (1, 1) for even widths, three
/// taps for odd ones. @pre 1 <= coarse <= fine <= 3 coarse
[[nodiscard]] std::vector<AxisTaps> boxTaps(int fine, int coarse);

/// A triangle about each coarse texel's centre, of half width fine / coarse, sampled at the fine
/// centres: (1 3 3 1) / 2 for even widths. @pre as boxTaps
[[nodiscard]] std::vector<AxisTaps> tentTaps(int fine, int coarse);

} // namespace lodestar::lighting

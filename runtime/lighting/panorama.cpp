// SPDX-License-Identifier: MIT
//
// Lat-long panoramas to cubes. The angles of a sample are shared by symmetry: the four side faces
// have the same polar angles, and the lower half of the cube mirrors the upper one, so that of the
// 6 (w k)^2 samples only every sixteenth needs an arc tangent of its own.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/contract.h"
#include "lighting/environment.h"
#include "lighting/float4.h"

namespace lodestar::lighting {

namespace {

constexpr double kPi = std::numbers::pi;

/// A position between texels along one axis: index of the left or upper one and the way to the
/// next.
struct Position {
    int index = 0;
    float fraction = 0.0f;
};

/// @param columns count of the panorama's; the position wraps
Position wrapped(double x, int columns) {
    const double below = std::floor(x);
    int index = static_cast<int>(below);
    index = index < 0 ? index + columns : index;
    index = index >= columns ? index - columns : index;
    return {index, static_cast<float>(x - below)};
}

/// Pixels as four floats with one more column at the right (the first one) and one more row at the
/// top and the bottom (copies), so that a bilinear lookup needs no case.
class PaddedPanorama {
public:
    explicit PaddedPanorama(const core::Image& image)
        : width_(image.width()), height_(image.height()),
          texels_(static_cast<std::size_t>(width_ + 1) * static_cast<std::size_t>(height_ + 2)) {
        for (int y = 0; y < height_ + 2; ++y) {
            const float* source = image.at(0, std::clamp(y - 1, 0, height_ - 1));
            glm::vec4* row = &texels_[static_cast<std::size_t>(y) * stride()];
            for (int x = 0; x < width_; ++x, source += 3) {
                row[x] = {source[0], source[1], source[2], 1.0f};
            }
            row[width_] = row[0];
        }
    }

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    /// @param row in [-1, height - 1]  @param column in [0, width)
    [[nodiscard]] Float4 bilinear(Position row, Position column) const {
        const Float4* p = asFloat4(texels_.data()) +
                          static_cast<std::size_t>(row.index + 1) * stride() +
                          static_cast<std::size_t>(column.index);
        const Float4* q = p + stride();
        const Float4 upper = p[0] + (p[1] - p[0]) * column.fraction;
        const Float4 lower = q[0] + (q[1] - q[0]) * column.fraction;
        return upper + (lower - upper) * row.fraction;
    }

private:
    [[nodiscard]] std::size_t stride() const { return static_cast<std::size_t>(width_ + 1); }

    int width_;
    int height_;
    std::vector<glm::vec4> texels_;
};

/// Mean over pairs of rows and columns, rows weighted by the solid angle of their bands.
core::Image halved(const core::Image& image) {
    const int w = image.width() / 2;
    const int h = image.height() / 2;
    core::Image half(w, h, 3);
    const auto bandEdge = [&](int y) { return std::cos(kPi * y / image.height()); };
    for (int y = 0; y < h; ++y) {
        const double upperBand = bandEdge(2 * y) - bandEdge(2 * y + 1);
        const double lowerBand = bandEdge(2 * y + 1) - bandEdge(2 * y + 2);
        const auto upperWeight = static_cast<float>(0.5 * upperBand / (upperBand + lowerBand));
        const auto lowerWeight = static_cast<float>(0.5 * lowerBand / (upperBand + lowerBand));
        const float* upper = image.at(0, 2 * y);
        const float* lower = image.at(0, 2 * y + 1);
        float* out = half.at(0, y);
        for (int x = 0; x < w; ++x, upper += 6, lower += 6, out += 3) {
            for (int c = 0; c < 3; ++c) {
                out[c] = upperWeight * (upper[c] + upper[c + 3]) +
                         lowerWeight * (lower[c] + lower[c + 3]);
            }
        }
    }
    return half;
}

/// Samples along a texel's side: at least 4, and at least two a panorama pixel where a texel is
/// largest (2 / w radians, at a face's centre), so that no pixel is stepped over.
int samplesPerSide(int panoramaWidth, int width) {
    const double pixels = (2.0 / width) * panoramaWidth / (2.0 * kPi);
    return std::max(4, static_cast<int>(std::ceil(2.0 * pixels)));
}

/// One row of texels of the upper half of the cube, resampled together with its mirror image below.
class RowResampler {
public:
    RowResampler(const PaddedPanorama& panorama, Cubemap& cube, int perSide)
        : panorama_(panorama), cube_(cube), perSide_(perSide), width_(cube.width()),
          across_(width_ * perSide), weights_(sampleCount()), rows_(sampleCount()),
          mirroredRows_(sampleCount()), azimuths_(sampleCount()) {
        makeSideColumns();
    }

    void resample(int texelRow) {
        const bool mirror = width_ - 1 - texelRow != texelRow;
        prepareSides(texelRow);
        for (std::size_t f = 0; f < 4; ++f) {
            resampleSide(f, texelRow, rows_);
            if (mirror) {
                resampleSide(f, width_ - 1 - texelRow, mirroredRows_);
            }
        }
        prepareCaps(texelRow);
        // A row's mirror image has z reversed: the azimuth is measured from the other side.
        resampleCap(2, texelRow, rows_, false);
        resampleCap(3, texelRow, mirroredRows_, true);
        if (mirror) {
            resampleCap(2, width_ - 1 - texelRow, rows_, true);
            resampleCap(3, width_ - 1 - texelRow, mirroredRows_, false);
        }
    }

private:
    static constexpr int kSideFaces[4] = {0, 1, 4, 5};

    [[nodiscard]] std::size_t sampleCount() const {
        return static_cast<std::size_t>(across_) * static_cast<std::size_t>(perSide_);
    }
    [[nodiscard]] double coordinate(int k) const { return (2.0 * k + 1.0) / across_ - 1.0; }
    [[nodiscard]] std::size_t at(int b, int k) const {
        return static_cast<std::size_t>(b) * static_cast<std::size_t>(across_) +
               static_cast<std::size_t>(k);
    }

    /// On the side faces the azimuth depends on the column only: azimuth of the centre - atan u.
    void makeSideColumns() {
        constexpr double kCentre[4] = {0.5 * kPi, -0.5 * kPi, kPi, 0.0}; // +X, -X, +Z, -Z
        for (std::size_t f = 0; f < 4; ++f) {
            sideColumns_[f].resize(static_cast<std::size_t>(across_));
            for (int k = 0; k < across_; ++k) {
                const double azimuth = kCentre[f] - std::atan(coordinate(k));
                sideColumns_[f][static_cast<std::size_t>(k)] = wrapped(
                    (azimuth / (2.0 * kPi) + 0.5) * panorama_.width() - 0.5, panorama_.width());
            }
        }
    }

    /// Stores the panorama's rows of sample (b, k), of the column's mirror image, and of both
    /// below.
    void setRow(int b, int k, double polarAngle, double weight) {
        const int h = panorama_.height();
        const double y = polarAngle / kPi * h - 0.5;
        const double below = std::floor(y);
        const Position row{static_cast<int>(below), static_cast<float>(y - below)};
        const double mirroredY = h - 1.0 - y;
        const double mirroredBelow = std::floor(mirroredY);
        const Position mirrored{static_cast<int>(mirroredBelow),
                                static_cast<float>(mirroredY - mirroredBelow)};
        for (const std::size_t i : {at(b, k), at(b, across_ - 1 - k)}) {
            rows_[i] = row;
            mirroredRows_[i] = mirrored;
            weights_[i] = static_cast<float>(weight);
        }
    }

    void prepareSides(int texelRow) {
        for (int b = 0; b < perSide_; ++b) {
            const double v = coordinate(texelRow * perSide_ + b);
            for (int k = 0; k < (across_ + 1) / 2; ++k) {
                const double u = coordinate(k);
                const double horizontal = std::sqrt(1.0 + u * u);
                const double r = std::sqrt(1.0 + u * u + v * v);
                setRow(b, k, 0.5 * kPi + std::atan(v / horizontal), 1.0 / (r * r * r));
            }
        }
    }

    void prepareCaps(int texelRow) {
        for (int b = 0; b < perSide_; ++b) {
            const double v = coordinate(texelRow * perSide_ + b);
            for (int k = 0; k < (across_ + 1) / 2; ++k) {
                const double u = coordinate(k);
                const double rhoSquared = u * u + v * v;
                const double r = std::sqrt(1.0 + rhoSquared);
                setRow(b, k, std::atan(std::sqrt(rhoSquared)), 1.0 / (r * r * r));
                const double azimuth = std::atan2(u, -v); // of (x, -z) on +Y
                azimuths_[at(b, k)] = azimuth;
                azimuths_[at(b, across_ - 1 - k)] = -azimuth;
            }
        }
    }

    template <class ColumnOf>
    void resampleRow(int face, int texelRow, const std::vector<Position>& rows,
                     const ColumnOf& columnOf) {
        Float4* out = asFloat4(&cube_.texel(face, 0, texelRow));
        for (int i = 0; i < width_; ++i) {
            Float4 sum = {};
            for (int b = 0; b < perSide_; ++b) {
                for (int k = i * perSide_; k < (i + 1) * perSide_; ++k) {
                    const std::size_t s = at(b, k);
                    sum += panorama_.bilinear(rows[s], columnOf(s, k)) * weights_[s];
                }
            }
            // The alpha channel is 1 everywhere: its sum is the weights' sum.
            out[i] = sum / sum[3];
            out[i][3] = 1.0f;
        }
    }

    void resampleSide(std::size_t f, int texelRow, const std::vector<Position>& rows) {
        const std::vector<Position>& columns = sideColumns_[f];
        resampleRow(kSideFaces[f], texelRow, rows,
                    [&](std::size_t, int k) { return columns[static_cast<std::size_t>(k)]; });
    }

    void resampleCap(int face, int texelRow, const std::vector<Position>& rows, bool reversed) {
        const double scale = panorama_.width() / (2.0 * kPi);
        const double centre = 0.5 * panorama_.width() - 0.5;
        resampleRow(face, texelRow, rows, [&](std::size_t s, int) {
            const double azimuth = azimuths_[s];
            const double seen = !reversed ? azimuth : (azimuth < 0.0 ? -kPi : kPi) - azimuth;
            return wrapped(seen * scale + centre, panorama_.width());
        });
    }

    const PaddedPanorama& panorama_;
    Cubemap& cube_;
    int perSide_;
    int width_;
    int across_; ///< samples along a face
    std::vector<Position> sideColumns_[4];
    std::vector<float> weights_;         ///< solid angle of a sample, up to a factor
    std::vector<Position> rows_;         ///< the panorama's row of each sample
    std::vector<Position> mirroredRows_; ///< and of its mirror image below the horizon
    std::vector<double> azimuths_;       ///< caps only, of +Y
};

} // namespace

Cubemap cubeFromLatLong(const core::Image& panorama, int width) {
    LODESTAR_EXPECT(!panorama.empty() && panorama.channels() == 3, "a panorama has three channels");
    LODESTAR_EXPECT(width >= 1 && width <= 4096,
                    "a cube made from a panorama has a width in [1, 4096]");
    // Far finer panoramas are halved first: means over 2x2 pixels that are at most an eighth of a
    // texel wide afterwards blur nothing, and samples stay few.
    core::Image reduced;
    const core::Image* source = &panorama;
    while (source->width() >= 16 * width && source->width() % 2 == 0 && source->height() % 2 == 0) {
        reduced = halved(*source);
        source = &reduced;
    }
    const PaddedPanorama padded(*source);
    Cubemap cube(width);
    RowResampler resampler(padded, cube, samplesPerSide(padded.width(), width));
    for (int row = 0; row < (width + 1) / 2; ++row) {
        resampler.resample(row);
    }
    return cube;
}

} // namespace lodestar::lighting

// SPDX-License-Identifier: MIT
//
// An owning rectangle of float pixels, row 0 at the top, channels interleaved.
#pragma once

#include <cstddef>
#include <vector>

#include "core/contract.h"

namespace lodestar::core {

/// Pixels of an image. What the numbers mean (linear radiance, sRGB-encoded, a normal) is said by
/// whoever made it.
class Image {
public:
    Image() = default;
    /// @pre width, height >= 0, channels in [1, 4]
    Image(int width, int height, int channels)
        : width_(width), height_(height), channels_(channels),
          pixels_(count(width, height, channels)) {}

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] int channels() const { return channels_; }
    [[nodiscard]] bool empty() const { return pixels_.empty(); }
    [[nodiscard]] std::vector<float>& pixels() { return pixels_; }
    [[nodiscard]] const std::vector<float>& pixels() const { return pixels_; }

    /// Pointer to the channels of pixel (x, y). Not checked.
    [[nodiscard]] float* at(int x, int y) { return pixels_.data() + offset(x, y); }
    [[nodiscard]] const float* at(int x, int y) const { return pixels_.data() + offset(x, y); }

private:
    /// Checked before anything is allocated.
    [[nodiscard]] static std::size_t count(int width, int height, int channels) {
        LODESTAR_EXPECT(width >= 0 && height >= 0 && channels >= 1 && channels <= 4,
                        "an image has 1 to 4 channels and no negative size");
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
               static_cast<std::size_t>(channels);
    }
    [[nodiscard]] std::size_t offset(int x, int y) const {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(channels_);
    }

    int width_ = 0;
    int height_ = 0;
    int channels_ = 0;
    std::vector<float> pixels_;
};

} // namespace lodestar::core

// SPDX-License-Identifier: MIT
//
// An owning rectangle of texels as textures keep them: four channels of 8 or 16 bits, row 0 at the
// top.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "core/contract.h"

namespace lodestar::core {

/// Bits of a sample.
enum class SampleDepth { Bits8, Bits16 };

[[nodiscard]] constexpr std::size_t bytesOf(SampleDepth depth) {
    return depth == SampleDepth::Bits8 ? 1 : 2;
}

/// RGBA texels: samples from 0 to 2^bits - 1 in the machine's byte order, which stand for [0, 1].
/// What the numbers mean (sRGB-encoded, a normal) is said by whoever made them.
class Texels {
public:
    Texels() = default;
    /// All zero. @pre width, height >= 0
    Texels(int width, int height, SampleDepth depth = SampleDepth::Bits8)
        : width_(width), height_(height), depth_(depth),
          bytes_(rowBytesOf(width, height, depth) * static_cast<std::size_t>(height)) {}

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] SampleDepth depth() const { return depth_; }
    [[nodiscard]] bool empty() const { return bytes_.empty(); }
    [[nodiscard]] std::size_t rowBytes() const { return rowBytesOf(width_, height_, depth_); }
    [[nodiscard]] std::vector<unsigned char>& bytes() { return bytes_; }
    [[nodiscard]] const std::vector<unsigned char>& bytes() const { return bytes_; }

    /// A sample, [0, 1]. Not checked.
    [[nodiscard]] float value(int x, int y, int channel) const {
        const std::size_t at = offset(x, y, channel);
        if (depth_ == SampleDepth::Bits8) {
            return static_cast<float>(bytes_[at]) / 255.0f;
        }
        std::uint16_t sample = 0;
        std::memcpy(&sample, &bytes_[2 * at], 2);
        return static_cast<float>(sample) / 65535.0f;
    }
    /// Sets a sample to the level nearest to a value of [0, 1]; values outside are clamped, NaN
    /// becomes 0.
    void set(int x, int y, int channel, float value) {
        const float unit = value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f;
        const std::size_t at = offset(x, y, channel);
        if (depth_ == SampleDepth::Bits8) {
            bytes_[at] = static_cast<unsigned char>(std::lround(unit * 255.0f));
            return;
        }
        const auto sample = static_cast<std::uint16_t>(std::lround(unit * 65535.0f));
        std::memcpy(&bytes_[2 * at], &sample, 2);
    }

private:
    /// Checked before anything is allocated.
    [[nodiscard]] static std::size_t rowBytesOf(int width, int height, SampleDepth depth) {
        LODESTAR_EXPECT(width >= 0 && height >= 0, "texels have no negative size");
        return static_cast<std::size_t>(width) * 4 * bytesOf(depth);
    }
    /// In samples.
    [[nodiscard]] std::size_t offset(int x, int y, int channel) const {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                static_cast<std::size_t>(x)) *
                   4 +
               static_cast<std::size_t>(channel);
    }

    int width_ = 0;
    int height_ = 0;
    SampleDepth depth_ = SampleDepth::Bits8;
    std::vector<unsigned char> bytes_;
};

} // namespace lodestar::core

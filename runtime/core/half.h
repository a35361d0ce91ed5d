// SPDX-License-Identifier: MIT
//
// Half floats, rounded to nearest. Drivers that are given floats for a half-float texture may cut
// instead, which loses 0.05 % of a constant.
#pragma once

#include <bit>
#include <cstdint>

namespace lodestar::core {

/// The half nearest to a value, ties to even; finite values beyond 65504 become +-65504.
/// Infinity and NaN stay what they are.
[[nodiscard]] constexpr std::uint16_t halfFromFloat(float value) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t sign = (bits >> 16) & 0x8000u;
    const std::uint32_t magnitude = bits & 0x7fffffffu;
    if (magnitude >= 0x7f800000u) {
        return static_cast<std::uint16_t>(sign | (magnitude > 0x7f800000u ? 0x7e00u : 0x7c00u));
    }
    if (magnitude >= 0x477fe000u) {
        return static_cast<std::uint16_t>(sign | 0x7bffu); // 65504 and above
    }
    if (magnitude < 0x38800000u) {
        // Subnormal: adding 0.5 leaves the rounded count of 2^-24 in the low mantissa bits.
        const float shifted = std::bit_cast<float>(magnitude) + 0.5f;
        return static_cast<std::uint16_t>(sign |
                                          (std::bit_cast<std::uint32_t>(shifted) - 0x3f000000u));
    }
    const std::uint32_t odd = (magnitude >> 13) & 1u;
    return static_cast<std::uint16_t>(sign | ((magnitude - 0x38000000u + 0xfffu + odd) >> 13));
}

/// The value of a half, exactly.
[[nodiscard]] constexpr float floatFromHalf(std::uint16_t half) {
    const std::uint32_t sign = (half & 0x8000u) << 16;
    const std::uint32_t magnitude = half & 0x7fffu;
    if (magnitude >= 0x7c00u) {
        return std::bit_cast<float>(sign | 0x7f800000u | ((magnitude & 0x3ffu) << 13));
    }
    if (magnitude >= 0x400u) {
        return std::bit_cast<float>(sign | ((magnitude << 13) + 0x38000000u));
    }
    const float value = static_cast<float>(magnitude) * 5.9604644775390625e-8f; // 2^-24
    return sign != 0 ? -value : value;
}

} // namespace lodestar::core

// SPDX-License-Identifier: MIT
//
// Value noise from an integer hash: the same on every machine.
#pragma once

#include <cmath>
#include <cstdint>

namespace lodestar::samples {

/// A number in [0, 1) for a lattice point.
[[nodiscard]] inline float latticeValue(int x, int y, int z) {
    std::uint32_t h = static_cast<std::uint32_t>(x) * 0x8da6b343u ^
                      static_cast<std::uint32_t>(y) * 0xd8163841u ^
                      static_cast<std::uint32_t>(z) * 0xcb1ab31fu;
    h ^= h >> 15;
    h *= 0x2c1b3c6du;
    h ^= h >> 12;
    h *= 0x297a2d39u;
    h ^= h >> 15;
    return static_cast<float>(h >> 8) * (1.0f / 16777216.0f);
}

/// Smooth noise in [0, 1); with period > 0 it repeats in x and y after that many cells.
[[nodiscard]] inline float valueNoise(float x, float y, int seed, int period = 0) {
    const auto cell = [&](int i, int j) {
        if (period > 0) {
            i = ((i % period) + period) % period;
            j = ((j % period) + period) % period;
        }
        return latticeValue(i, j, seed);
    };
    const float fx = std::floor(x);
    const float fy = std::floor(y);
    const int ix = static_cast<int>(fx);
    const int iy = static_cast<int>(fy);
    const float u = x - fx;
    const float v = y - fy;
    const float su = u * u * (3.0f - 2.0f * u);
    const float sv = v * v * (3.0f - 2.0f * v);
    const float low = cell(ix, iy) * (1.0f - su) + cell(ix + 1, iy) * su;
    const float high = cell(ix, iy + 1) * (1.0f - su) + cell(ix + 1, iy + 1) * su;
    return low * (1.0f - sv) + high * sv;
}

/// Octaves of value noise, each twice as fine and half as strong, scaled to [0, 1).
[[nodiscard]] inline float fractalNoise(float x, float y, int octaves, int seed, int period = 0) {
    float sum = 0.0f;
    float weight = 0.5f;
    float total = 0.0f;
    for (int i = 0; i < octaves; ++i) {
        sum += weight * valueNoise(x, y, seed + i, period);
        total += weight;
        weight *= 0.5f;
        x *= 2.0f;
        y *= 2.0f;
        period *= 2;
    }
    return sum / total;
}

/// 0 below a, 1 above b, smooth between.
[[nodiscard]] inline float smoothStep(float a, float b, float x) {
    float t = (x - a) / (b - a);
    t = t < 0.0f ? 0.0f : (t > 1.0f ? 1.0f : t);
    return t * t * (3.0f - 2.0f * t);
}

} // namespace lodestar::samples

// SPDX-License-Identifier: MIT
//
// Random valid inputs by docs/conventions.md's ranges: radiance [0, 1e9], exponent [0, 1e7] and
// +infinity, directions unit; and any bits at all for what must be repaired. Shrinks towards the
// low ends.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <rapidcheck.h>

namespace lodestar::testing {

/// Whole ranges from the first try on: rapidcheck starts with small numbers.
template <class T>
rc::Gen<T> whole(rc::Gen<T> generator) {
    return rc::gen::resize(100, std::move(generator));
}

inline rc::Gen<float> uniform(float low, float high) {
    return rc::gen::map(whole(rc::gen::inRange<std::int32_t>(0, (1 << 24) + 1)),
                        [=](std::int32_t k) {
                            const float t = std::ldexp(static_cast<float>(k), -24);
                            return k == 1 << 24 ? high : low + (high - low) * t;
                        });
}

inline rc::Gen<float> logarithmic(float low, float high) {
    return rc::gen::map(uniform(0.0f, 1.0f),
                        [=](float t) { return low * std::pow(high / low, t); });
}

/// The ends, and between them.
inline rc::Gen<float> exponent() {
    return rc::gen::oneOf(
        rc::gen::element(0.0f, 1.0f, 1e7f, std::numeric_limits<float>::infinity()),
        uniform(0.0f, 2.0f), logarithmic(1e-3f, 1e7f));
}

inline rc::Gen<float> radiance() {
    return rc::gen::oneOf(rc::gen::element(0.0f, 1.0f, 1e9f), logarithmic(1e-6f, 1e9f));
}

/// Any 32 bits: subnormal, infinite, not a number.
inline rc::Gen<float> anyFloat() {
    return rc::gen::oneOf(
        rc::gen::element(
            0.0f, -0.0f, std::numeric_limits<float>::infinity(),
            -std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(),
            std::numeric_limits<float>::denorm_min(), std::numeric_limits<float>::max()),
        rc::gen::map(whole(rc::gen::arbitrary<std::uint32_t>()),
                     [](std::uint32_t bits) { return std::bit_cast<float>(bits); }));
}

/// Unit to a rounding; axes, edges and corners of the cube too, where faces meet.
inline rc::Gen<glm::vec3> direction() {
    const auto tie = rc::gen::map(rc::gen::inRange(1, 27), [](int k) {
        k = k < 14 ? k - 1 : k; // all but the middle of 3 x 3 x 3
        return glm::normalize(glm::vec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1));
    });
    const auto any = rc::gen::map(
        rc::gen::pair(uniform(-1.0f, 1.0f), uniform(0.0f, 2.0f * std::numbers::pi_v<float>)),
        [](const std::pair<float, float>& p) {
            const float sine = std::sqrt(1.0f - p.first * p.first);
            return glm::vec3(sine * std::cos(p.second), p.first, sine * std::sin(p.second));
        });
    return rc::gen::oneOf(tie, any, any, any);
}

/// Rotation k of the 24 that take the cube to itself: its entries are -1, 0 and 1, so that turning
/// a direction rounds nothing.
inline glm::mat3 cubeRotation(int k) {
    // The images of x and y: an axis and its sign, then one of the four across it.
    const int a = k / 8;
    const int b = (a + 1 + k / 4 % 2) % 3;
    glm::vec3 x(0.0f), y(0.0f);
    x[a] = k % 2 == 0 ? 1.0f : -1.0f;
    y[b] = k / 2 % 2 == 0 ? 1.0f : -1.0f;
    return glm::mat3(x, y, glm::cross(x, y));
}

} // namespace lodestar::testing

// SPDX-License-Identifier: MIT
//
// Numbers drawn for the cases of parity rows: the same on every machine.
#pragma once

#include <cmath>
#include <random>

#include <glm/vec3.hpp>

namespace lodestar::testing {

class DrawnNumbers {
public:
    explicit DrawnNumbers(unsigned seed) : random_(seed) {}
    float uniform(float low, float high) {
        return low + (high - low) * static_cast<float>(static_cast<double>(random_()) * 0x1p-32);
    }
    float logarithmic(float low, float high) {
        return low * std::pow(high / low, uniform(0.0f, 1.0f));
    }

protected:
    std::mt19937 random_;
};

/// Directions, too, by their height and azimuth.
class DrawnDirections : public DrawnNumbers {
public:
    using DrawnNumbers::DrawnNumbers;
    glm::vec3 unit() {
        const float z = uniform(-1.0f, 1.0f);
        const float azimuth = uniform(0.0f, 6.2831853f);
        const float sine = std::sqrt(1.0f - z * z);
        return {sine * std::cos(azimuth), sine * std::sin(azimuth), z};
    }
};

} // namespace lodestar::testing

// SPDX-License-Identifier: MIT
//
// Cube maps and directions for tests.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include <glm/geometric.hpp>

#include "core/contract.h"
#include "lighting/cubemap.h"
#include "lodestar/cube.glsl"

namespace lodestar::testing {

/// Deterministic directions, even over the sphere.
inline glm::vec3 randomDirection(std::mt19937& random) {
    std::uniform_real_distribution<float> one(-1.0f, 1.0f);
    for (;;) {
        const glm::vec3 d(one(random), one(random), one(random));
        const float squared = glm::dot(d, d);
        if (squared > 0.01f && squared < 1.0f) {
            return d / std::sqrt(squared);
        }
    }
}

/// Independent radiances with a high dynamic range, 10^[-2, 2], alpha 1.
inline lighting::Cubemap randomCube(int width, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> exponent(-2.0f, 2.0f);
    lighting::Cubemap cube(width);
    for (glm::vec4& texel : cube.level(0)) {
        texel = {std::pow(10.0f, exponent(random)), std::pow(10.0f, exponent(random)),
                 std::pow(10.0f, exponent(random)), 1.0f};
    }
    return cube;
}

inline lighting::Cubemap constantCube(int width, const glm::vec4& value) {
    lighting::Cubemap cube(width);
    for (glm::vec4& texel : cube.level(0)) {
        texel = value;
    }
    return cube;
}

/// The unit direction of a texel's centre.
inline glm::dvec3 texelDirection(int face, int x, int y, int width) {
    const float u = static_cast<float>(2 * x + 1) / static_cast<float>(width) - 1.0f;
    const float v = static_cast<float>(2 * y + 1) / static_cast<float>(width) - 1.0f;
    return glm::normalize(glm::dvec3(shader::lodestar_cubeDirection(face, u, v)));
}

/// Makes contract violations throw for as long as it lives.
class ThrowingContracts {
public:
    ThrowingContracts()
        : before_(core::setContractHandler([](const char*, const char* message, const char*, int) {
              throw Violation{message};
          })) {}
    ~ThrowingContracts() { core::setContractHandler(before_); }
    ThrowingContracts(const ThrowingContracts&) = delete;
    ThrowingContracts& operator=(const ThrowingContracts&) = delete;

    struct Violation {
        const char* message;
    };

private:
    core::ContractHandler before_;
};

} // namespace lodestar::testing

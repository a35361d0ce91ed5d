// SPDX-License-Identifier: MIT
//
// Irradiance by the full sum, and how far the product's irradiance cube is from it.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

#include "lighting/environment.h"
#include "support/cubes.h"

namespace lodestar::testing {

/// All texels of a map as lamps: direction times solid angle, and radiance.
class FullSum {
public:
    explicit FullSum(const lighting::Cubemap& map) {
        const int n = map.width();
        const std::vector<double> omega = lighting::texelSolidAngles(n);
        for (int face = 0; face < 6; ++face) {
            for (int i = 0; i < n * n; ++i) {
                lamps_.push_back(
                    {omega[static_cast<std::size_t>(i)] * texelDirection(face, i % n, i / n, n),
                     glm::dvec3(map.texel(face, i % n, i / n))});
            }
        }
    }

    /// Irradiance over pi in double, the cosine's weights divided by their sum.
    [[nodiscard]] glm::dvec3 about(const glm::dvec3& normal) const {
        glm::dvec3 sum(0.0);
        double weights = 0.0;
        for (const Lamp& lamp : lamps_) {
            const double w = std::max(glm::dot(lamp.direction, normal), 0.0);
            sum += w * lamp.radiance;
            weights += w;
        }
        return sum / weights;
    }

private:
    struct Lamp {
        glm::dvec3 direction;
        glm::dvec3 radiance;
    };
    std::vector<Lamp> lamps_;
};

/// RMS over every seventh texel of the irradiance cube (by solid angle) of the error against the
/// full sum, relative to the RMS of the full sum.
inline double relativeIrradianceError(const lighting::Cubemap& base) {
    constexpr int kSide = lighting::kIrradianceWidth;
    const lighting::Cubemap cube = lighting::irradianceCube(base);
    const FullSum full(base);
    const std::vector<double> omega = lighting::texelSolidAngles(kSide);
    double error = 0.0;
    double square = 0.0;
    for (int i = 0; i < 6 * kSide * kSide; i += 7) {
        const int face = i / (kSide * kSide);
        const int k = i % (kSide * kSide);
        const glm::dvec3 truth = full.about(texelDirection(face, k % kSide, k / kSide, kSide));
        const glm::dvec3 d = glm::dvec3(cube.texel(face, k % kSide, k / kSide)) - truth;
        error += omega[static_cast<std::size_t>(k)] * glm::dot(d, d);
        square += omega[static_cast<std::size_t>(k)] * glm::dot(truth, truth);
    }
    return std::sqrt(error / square);
}

} // namespace lodestar::testing

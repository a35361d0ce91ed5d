// SPDX-License-Identifier: MIT
//
// How wrong a lookup is on a map: its answers against the reference's, over directions that find a
// map's small lamps as well as its wide parts.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "lighting/cubemap.h"

namespace lodestar::lighting {

/// A direction that accuracy is measured at.
struct MeasuredDirection {
    glm::dvec3 direction{0.0, 0.0, 1.0}; ///< unit
    double weight = 0.0;                 ///< share of the sphere that it stands for; all sum to 1
};

/// Directions for a map: half of them spread evenly over the sphere, half drawn by radiance^2 x
/// solid angle, each weighted by one over the density of both. The same map gives the same ones.
/// @pre a map with texels; count >= 2
[[nodiscard]] std::vector<MeasuredDirection> measuredDirections(const Cubemap& base, int count);

/// Mean radiance over Phong lobes by referencePhong: wide lobes over coarser means, whose texels
/// add at most a share of a lobe's variance.
class LobeMeans {
public:
    /// @pre a map with texels
    explicit LobeMeans(const Cubemap& base, double addedVariance = 1e-4);
    /// @param direction unit  @param exponent [0, 1e7]
    [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& direction, double exponent) const;

private:
    std::vector<Cubemap> maps_; ///< the finest first
    double addedVariance_;
};

/// The same for many, on all processors. @return [direction][exponent]
/// @param progress told how many directions are done; may be empty
[[nodiscard]] std::vector<glm::dvec3>
lobeMeans(const Cubemap& base, std::span<const glm::dvec3> directions,
          std::span<const double> exponents, const std::function<void(std::size_t)>& progress = {});

/// How far answers are from the truth, relative to the truth's root mean square over the sphere and
/// rgb.
struct Accuracy {
    double rmse = 0.0;  ///< root of the mean square of the difference over the sphere and rgb
    double worst = 0.0; ///< the greatest difference of a direction, root mean square over rgb
};

/// @param truths, answers one a direction  @return zeros where all are 0; infinite where only the
/// truth is
[[nodiscard]] Accuracy accuracyOf(std::span<const MeasuredDirection> directions,
                                  std::span<const glm::dvec3> truths,
                                  std::span<const glm::dvec3> answers);

} // namespace lodestar::lighting

// SPDX-License-Identifier: MIT
//
// The lookups whose cost is told, as the CPU answers them on one map.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "lighting/cubemap.h"
#include "lighting/estimator.h"
#include "lighting/rsrm_layout.h"

namespace lodestar::app {

/// A way to look up a lobe's mean radiance.
struct CostedLookup {
    std::string name;
    lighting::Term term = lighting::Term::Glossy;
    lighting::Estimator estimator;                ///< where it reads the cube
    const lighting::RsrmLayout* layout = nullptr; ///< where it reads a map of the mean over azimuth
};

/// All of them: estimators that need no level chosen by hand, layouts of radially symmetric maps.
[[nodiscard]] std::vector<CostedLookup> costedLookups();

struct CostAnswer {
    glm::dvec3 radiance{0.0};
    int fetches = 0;
};

/// One made ready on a map.
struct ReadyLookup {
    /// @param direction unit  @param exponent Phong, [0, 1e7]
    std::function<CostAnswer(const glm::dvec3& direction, double exponent)> answer;
    double preparationMs = 0.0;
};

/// @param base level 0
[[nodiscard]] ReadyLookup makeReady(const CostedLookup& lookup, const lighting::Cubemap& base);

} // namespace lodestar::app

// SPDX-License-Identifier: MIT
//
// One lookup on the CPU: a lobe's mean radiance about a direction, by any estimator. Runs the dual
// text of shaders/lodestar over CPU images; `reference` is double precision over all texels.
#pragma once

#include <functional>

#include <glm/vec3.hpp>

#include "lighting/environment.h"
#include "lighting/estimator.h"

namespace lodestar::lighting {

enum class Lobe { Phong, BlinnPhong, Lambert };

/// What to look up. For BlinnPhong view = normal = direction.
struct LookupRequest {
    Lobe lobe = Lobe::Phong;
    double exponent = 1.0; ///< [0, 1e7], +infinity is a mirror; ignored by Lambert
    glm::dvec3 direction{0.0, 0.0, 1.0};
    Estimator estimator;
};

struct LookupAnswer {
    glm::dvec3 radiance{0.0};
    double level = -1.0; ///< the mip level fetched; negative where there is none, or several
    int fetches = 0;     ///< texture fetches a shader would make; all texels for `reference`
};

/// The parts that a request needs prepared.
[[nodiscard]] PreparedParts partsFor(const Estimator& estimator);

/// How a sum over all texels is made; the sum is the same to the last bit however it is.
struct ReferenceRun {
    std::size_t threads = 1; ///< 0: as many as there are processors
    std::function<void(double share)> progress =
        {}; ///< on the caller's thread, (0, 1]; may be empty
};

/// @param run of `reference`  @pre the environment holds partsFor(request.estimator); the estimator
/// serves the lobe's term
[[nodiscard]] LookupAnswer lookup(const PreparedEnvironment& environment,
                                  const LookupRequest& request, const ReferenceRun& run = {});

/// Mean radiance over (s+1)/(2 pi) max(r.l, 0)^s, double precision over all texels with exact solid
/// angles, divided by the weights' own sum, so that a constant map is exact.
/// @param direction unit  @param exponent [0, 1e7]; a lobe narrower than a texel reads bilinearly
[[nodiscard]] glm::dvec3 referencePhong(const Cubemap& base, const glm::dvec3& direction,
                                        double exponent, const ReferenceRun& run = {});

/// Mean radiance over the normalised Blinn-Phong lobe (n.h)^s (n.l) about n seen from v, the
/// weights divided by their sum: what the lookup conversion is fitted to.
[[nodiscard]] glm::dvec3 referenceBlinnPhong(const Cubemap& base, const glm::dvec3& normal,
                                             const glm::dvec3& view, double exponent,
                                             const ReferenceRun& run = {});

} // namespace lodestar::lighting

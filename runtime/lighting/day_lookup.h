// SPDX-License-Identifier: MIT
//
// Lookups in the lights of a day on the CPU: by the maps that a GPU reads, or in double precision.
#pragma once

#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "lighting/day.h"
#include "lighting/rsrm.h"

namespace lodestar::lighting {

/// The lights of a day in maps of one layout, made when they are first asked for.
class DayLookup {
public:
    /// @param lights as `repaired` leaves them
    DayLookup(std::vector<DayLight> lights, const RsrmLayout& layout);

    struct Answer {
        glm::dvec3 radiance{0.0};
        int fetches = 0; ///< that a shader would make: one a shining light, two above the last row
    };
    /// Sum over the lights of the mean radiance over the Phong lobe about a direction.
    /// @param hour finite  @param direction unit  @param exponent [0, 1e7], +infinity a mirror
    [[nodiscard]] Answer lookup(double hour, const glm::dvec3& direction, double exponent);
    /// The same over Lambert's lobe about a normal.
    [[nodiscard]] Answer lambert(double hour, const glm::dvec3& normal);

private:
    struct Key {
        RsrmBake bake;
        std::vector<glm::vec3> gradient;
    };
    struct Light {
        DayLight day;
        std::vector<std::optional<Key>> keys;
        std::optional<double> hour; ///< that the texels and the gradient are of
        RsrmTexels texels{};
        std::vector<glm::vec3> gradient{};
    };
    [[nodiscard]] const Key& key(Light& light, std::size_t index);
    void blend(Light& light, const DayMoment& moment, double hour);

    RsrmLayout layout_;
    RsrmKernels kernels_;
    std::vector<Light> lights_;
};

/// The same without maps: exact weights of 4096 zones in double precision, so that what is left is
/// the step of radiance within a zone. @param exponent +infinity: the gradients themselves
[[nodiscard]] glm::dvec3 referenceDay(const std::vector<DayLight>& lights, double hour,
                                      const glm::dvec3& direction, double exponent);

} // namespace lodestar::lighting

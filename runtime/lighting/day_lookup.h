// SPDX-License-Identifier: MIT
//
// Lookups in the lights of a day on the CPU: by the maps that a GPU reads, or in double precision.
#pragma once

#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "lighting/light_map.h"

namespace lodestar::lighting {

/// The lights of a day in maps of one layout, made when they are first asked for.
class DayLookup {
public:
    /// @param lights as `repaired` leaves them  @param kernels to share; null: its own
    DayLookup(std::vector<DayLight> lights, const RsrmLayout& layout,
              std::shared_ptr<RsrmKernels> kernels = nullptr);

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
    struct Light {
        LightMap map;
        std::optional<double> hour{}; ///< that the blend is of
        LightMap::Blend blend{};
    };
    static void prepare(Light& light, const DayMoment& moment, double hour);

    std::vector<Light> lights_;
};

/// referenceDay at one hour, for many directions: what does not depend on them is kept.
class ReferenceDay {
public:
    /// @param lights as `repaired` leaves them; those that do not shine are left out
    ReferenceDay(const std::vector<DayLight>& lights, double hour);

    [[nodiscard]] std::size_t count() const { return lights_.size(); }
    /// The light that one of them gives. @param exponent [0, 1e7], +infinity a mirror
    [[nodiscard]] glm::dvec3 operator()(std::size_t light, const glm::dvec3& direction,
                                        double exponent) const;
    [[nodiscard]] glm::dvec3 operator()(const glm::dvec3& direction, double exponent) const;

private:
    struct Light {
        DayLight day;
        DayMoment moment;
        std::vector<double> edges; ///< all that is black beyond the last zone that shines is one
        std::vector<glm::dvec3> means;
    };
    std::vector<Light> lights_;
};

/// The same without maps: exact weights of 4096 zones in double precision, so that what is left is
/// the step of radiance within a zone. @param exponent +infinity: the gradients themselves
[[nodiscard]] glm::dvec3 referenceDay(const std::vector<DayLight>& lights, double hour,
                                      const glm::dvec3& direction, double exponent);

} // namespace lodestar::lighting

// SPDX-License-Identifier: MIT
//
// Zonal radiance: a gradient as means over zones, rings of directions about the axis. Means keep
// energy whatever the gradient holds between the zones' edges.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "lighting/gradient.h"

namespace lodestar::lighting {

/// Where the zones' edges lie.
enum class ZoneSpacing {
    EqualHeight, ///< equal steps of z = cos(theta), equal areas (Stone)
    EqualAngle,  ///< equal steps of the angle: skies
    Quartic,     ///< equal steps of ((1 - z) / 2)^(1/4), fine about the axis: suns
};

struct Zones {
    ZoneSpacing spacing = ZoneSpacing::EqualHeight;
    int count = 256; ///< [1, 4096]
    bool operator==(const Zones&) const = default;
};

/// The zones of a light's kind.
[[nodiscard]] Zones zonesFor(LightKind kind);

/// The count + 1 edges as angles from the axis, radians, from 0 to pi. @pre count as above
[[nodiscard]] std::vector<double> zoneEdges(const Zones& zones);

/// The share of the sphere that the ring between two angles from the axis covers, (cos a - cos b) /
/// 2 without cancellation. @param a, b radians, 0 <= a <= b <= pi
[[nodiscard]] double ringArea(double a, double b);

/// Mean radiance of the rings between edges (angles from the axis, strictly ascending) by Gauss
/// quadrature in the angle, split at the gradient's stops. Each piece is weighted by its exact
/// area, so that a constant is exact and the rings' energy is the gradient's to 1e-9.
[[nodiscard]] std::vector<glm::dvec3> ringMeans(const RadianceProfile& profile,
                                                const std::vector<double>& edges);

/// Mean radiance of each zone, from the axis outwards.
struct ZonalRadiance {
    Zones zones;
    std::vector<glm::dvec3> means;
};

/// The means over zones, by ringMeans.
[[nodiscard]] ZonalRadiance zonalRadiance(const RadianceProfile& profile, const Zones& zones);

/// Irradiance over pi of a surface that faces the axis: 1 where the radiance is 1.
[[nodiscard]] glm::dvec3 facingIrradiance(const ZonalRadiance& radiance);

/// Mean radiance over the sphere: the zones' energy over 4 pi.
[[nodiscard]] glm::dvec3 sphereMean(const ZonalRadiance& radiance);

} // namespace lodestar::lighting

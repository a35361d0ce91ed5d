// SPDX-License-Identifier: MIT
#include "lighting/drawn_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace lodestar::lighting {
namespace {

/// Rings: the most there may be; 0.09 degrees of a sky, 2e-4 degrees and more of a sun.
constexpr int kRings = 4096;

double sumOf(const glm::dvec3& radiance) {
    return radiance.r + radiance.g + radiance.b;
}

} // namespace

DrawnLight drawnLight(const DayLight& light, const DayMoment& moment, int count) {
    const Zones zones{zonesFor(light.kind).spacing, kRings};
    const ZonalRadiance radiance =
        blended(keyRadiance(light, moment.keys.from, zones),
                keyRadiance(light, moment.keys.to, zones), moment.keys.t, moment.visibility);
    const std::vector<double> edges = zoneEdges(zones);
    DrawnLight drawn;
    std::vector<double> sums; // up to the end of each ring
    for (std::size_t i = 0; i < radiance.means.size(); ++i) {
        drawn.sum += 4.0 * std::numbers::pi * ringArea(edges[i], edges[i + 1]) *
                     std::max(sumOf(radiance.means[i]), 0.0);
        sums.push_back(drawn.sum);
    }
    if (!(drawn.sum > 0.0)) {
        return drawn;
    }
    const glm::dvec3 across =
        std::abs(moment.axis.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 x = glm::normalize(glm::cross(across, moment.axis));
    const glm::dvec3 y = glm::cross(moment.axis, x);
    std::size_t ring = 0;
    for (int k = 0; k < count; ++k) {
        const double place = drawn.sum * (k + 0.5) / count;
        while (ring + 1 < sums.size() && sums[ring] < place) {
            ++ring;
        }
        const double before = ring > 0 ? sums[ring - 1] : 0.0;
        const double t = (place - before) / (sums[ring] - before); // of the ring's area
        // sin^2 of half the angle keeps its digits at the axis.
        const auto half = [&](double angle) {
            const double sine = std::sin(0.5 * angle);
            return sine * sine;
        };
        const double h2 = (1.0 - t) * half(edges[ring]) + t * half(edges[ring + 1]);
        const double sine = 2.0 * std::sqrt(h2 * (1.0 - h2));
        const double azimuth = k * std::numbers::pi * (3.0 - std::sqrt(5.0));
        const glm::dvec3 mean = radiance.means[ring];
        drawn.points.push_back({glm::vec3((1.0 - 2.0 * h2) * moment.axis +
                                          sine * (std::cos(azimuth) * x + std::sin(azimuth) * y)),
                                glm::vec3(mean * (drawn.sum / sumOf(mean)))});
    }
    return drawn;
}

} // namespace lodestar::lighting

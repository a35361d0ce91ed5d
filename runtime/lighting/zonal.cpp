// SPDX-License-Identifier: MIT
#include "lighting/zonal.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/contract.h"
#include "core/quadrature.h"

namespace lodestar::lighting {

namespace {

constexpr int kNodes = 8;
/// Half as many do for rings so much narrower than what the gradient changes over, a piece between
/// stops or a radian: their error falls with the eighth power, 2e-10 of the whole.
constexpr double kNarrow = 1.0 / 16.0;

/// Mean radiance of the ring, smooth within.
glm::dvec3 ringMean(const RadianceProfile& profile, const core::GaussRule& rule, double a,
                    double b) {
    glm::dvec3 sum(0.0);
    double weights = 0.0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double theta = a + (b - a) * rule.nodes[i];
        const double weight = rule.weights[i] * std::sin(theta);
        sum += weight * profile.radiance(theta);
        weights += weight;
    }
    return sum / weights;
}

} // namespace

double ringArea(double a, double b) {
    return std::sin(0.5 * (a + b)) * std::sin(0.5 * (b - a));
}

Zones zonesFor(LightKind kind) {
    return {kind == LightKind::Sky ? ZoneSpacing::EqualAngle : ZoneSpacing::Quartic, 256};
}

std::vector<double> zoneEdges(const Zones& zones) {
    LODESTAR_EXPECT(zones.count >= 1 && zones.count <= 4096, "a map has 1 to 4096 zones");
    std::vector<double> edges;
    for (int j = 0; j <= zones.count; ++j) {
        const double u = static_cast<double>(j) / zones.count;
        if (zones.spacing == ZoneSpacing::EqualAngle) {
            edges.push_back(std::numbers::pi * u);
            continue;
        }
        // sin(theta / 2) = sqrt((1 - z) / 2); from the far end where that is near 1.
        const double h = zones.spacing == ZoneSpacing::EqualHeight ? std::sqrt(u) : u * u;
        const double cosine = std::sqrt(
            zones.spacing == ZoneSpacing::EqualHeight ? 1.0 - u : (1.0 - u * u) * (1.0 + u * u));
        edges.push_back(2.0 * std::atan2(h, cosine));
    }
    edges.back() = std::numbers::pi;
    return edges;
}

std::vector<glm::dvec3> ringMeans(const RadianceProfile& profile,
                                  const std::vector<double>& edges) {
    const core::GaussRule rule = core::gaussLegendre(kNodes);
    const core::GaussRule fewer = core::gaussLegendre(kNodes / 2);
    const std::vector<double>& breaks = profile.breaks();
    std::vector<glm::dvec3> means;
    for (std::size_t j = 0; j + 1 < edges.size(); ++j) {
        glm::dvec3 sum(0.0);
        double areas = 0.0;
        double begin = edges[j];
        auto next = std::upper_bound(breaks.begin(), breaks.end(), begin);
        while (begin < edges[j + 1]) {
            while (next != breaks.end() && *next <= begin) {
                ++next;
            }
            const double end = next == breaks.end() ? edges[j + 1] : std::min(*next, edges[j + 1]);
            const double area = ringArea(begin, end);
            const double from = next == breaks.begin() ? 0.0 : *(next - 1);
            const double to = next == breaks.end() ? std::numbers::pi : *next;
            const bool narrow = end - begin <= kNarrow * std::min(to - from, 1.0);
            sum += area * ringMean(profile, narrow ? fewer : rule, begin, end);
            areas += area;
            begin = end;
        }
        means.push_back(sum / areas);
    }
    return means;
}

ZonalRadiance zonalRadiance(const RadianceProfile& profile, const Zones& zones) {
    return {zones, ringMeans(profile, zoneEdges(zones))};
}

glm::dvec3 facingIrradiance(const ZonalRadiance& radiance) {
    const std::vector<double> edges = zoneEdges(radiance.zones);
    // The cosine's integral over a ring is pi times sin^2 of its edges, to the horizon.
    const auto within = [](double angle) {
        const double sine = std::sin(std::min(angle, std::numbers::pi / 2.0));
        return sine * sine;
    };
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < radiance.means.size(); ++i) {
        sum += radiance.means[i] * (within(edges[i + 1]) - within(edges[i]));
    }
    return sum;
}

glm::dvec3 sphereMean(const ZonalRadiance& radiance) {
    const std::vector<double> edges = zoneEdges(radiance.zones);
    glm::dvec3 sum(0.0);
    for (std::size_t j = 0; j + 1 < edges.size(); ++j) {
        sum += ringArea(edges[j], edges[j + 1]) * radiance.means[j];
    }
    return sum;
}

} // namespace lodestar::lighting

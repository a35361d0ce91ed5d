// SPDX-License-Identifier: MIT
#include "lighting/day_lookup.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "lighting/rsrm_weights.h"

namespace lodestar::lighting {
namespace {

constexpr int kReferenceZones = 4096;

/// The angle between unit vectors, exact at 0 and pi.
double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return 2.0 * std::asin(std::min(0.5 * glm::length(a - b), 1.0));
}

/// A light's zonal radiance at a moment, what is below the horizon left out.
ZonalRadiance zonalAt(const DayLight& light, const DayMoment& moment, const Zones& zones) {
    const ZonalRadiance from = keyRadiance(light, moment.keys.from, zones);
    const ZonalRadiance to = keyRadiance(light, moment.keys.to, zones);
    return blended(from, to, moment.keys.t, moment.visibility);
}

glm::dvec3 gradientAt(const DayLight& light, const DayMoment& moment, double theta) {
    const auto of = [&](std::size_t index) {
        const DayKey& key = light.keys[index];
        return RadianceProfile(key.gradient, light.kind).radiance(theta) * key.tint;
    };
    return ((1.0 - moment.keys.t) * of(moment.keys.from) + moment.keys.t * of(moment.keys.to)) *
           moment.visibility;
}

} // namespace

DayLookup::DayLookup(std::vector<DayLight> lights, const RsrmLayout& layout) {
    const auto kernels = std::make_shared<RsrmKernels>();
    for (DayLight& day : lights) {
        lights_.push_back({LightMap(std::move(day), layout, kernels)});
    }
}

void DayLookup::prepare(Light& light, const DayMoment& moment, double hour) {
    if (light.hour != hour) {
        light.blend = light.map.blend(LightMap::contentOf(moment));
        light.hour = hour;
    }
}

DayLookup::Answer DayLookup::lookup(double hour, const glm::dvec3& direction, double exponent) {
    Answer answer;
    for (Light& light : lights_) {
        const DayMoment moment = momentAt(light.map.day(), hour);
        if (moment.visibility > 0.0) {
            prepare(light, moment, hour);
            const RsrmLayout& layout = light.map.layout();
            const double theta = angleBetween(direction, moment.axis);
            answer.radiance +=
                glm::dvec3(rsrmRadiance(light.blend.texels, light.blend.gradient, theta, exponent));
            const bool past =
                layout.columnMap == RsrmColumns::Refined && exponent > layout.greatestExponent;
            answer.fetches += past ? 2 : 1;
        }
    }
    return answer;
}

DayLookup::Answer DayLookup::lambert(double hour, const glm::dvec3& normal) {
    Answer answer;
    for (Light& light : lights_) {
        const DayMoment moment = momentAt(light.map.day(), hour);
        if (moment.visibility > 0.0) {
            prepare(light, moment, hour);
            answer.radiance +=
                glm::dvec3(rsrmLambert(light.blend.texels, angleBetween(normal, moment.axis)));
            ++answer.fetches;
        }
    }
    return answer;
}

glm::dvec3 referenceDay(const std::vector<DayLight>& lights, double hour,
                        const glm::dvec3& direction, double exponent) {
    glm::dvec3 sum(0.0);
    for (const DayLight& light : lights) {
        const DayMoment moment = momentAt(light, hour);
        if (moment.visibility <= 0.0) {
            continue;
        }
        const double theta = angleBetween(direction, moment.axis);
        if (std::isinf(exponent)) {
            sum += gradientAt(light, moment, theta);
            continue;
        }
        const Zones zones{zonesFor(light.kind).spacing, kReferenceZones};
        const ZonalRadiance radiance = zonalAt(light, moment, zones);
        const std::vector<double> weights = ringWeights(theta, zoneEdges(zones), exponent);
        for (std::size_t j = 0; j < weights.size(); ++j) {
            sum += weights[j] * radiance.means[j];
        }
    }
    return sum;
}

} // namespace lodestar::lighting

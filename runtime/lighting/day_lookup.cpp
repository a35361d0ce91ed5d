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

DayLookup::DayLookup(std::vector<DayLight> lights, const RsrmLayout& layout,
                     std::shared_ptr<RsrmKernels> kernels) {
    kernels = kernels ? std::move(kernels) : std::make_shared<RsrmKernels>();
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

ReferenceDay::ReferenceDay(const std::vector<DayLight>& lights, double hour) {
    for (const DayLight& day : lights) {
        const DayMoment moment = momentAt(day, hour);
        if (moment.visibility <= 0.0) {
            continue;
        }
        const Zones zones{zonesFor(day.kind).spacing, kReferenceZones};
        Light light{day, moment, zoneEdges(zones), zonalAt(day, moment, zones).means};
        while (light.means.size() > 1 && light.means.back() == glm::dvec3(0.0) &&
               light.means[light.means.size() - 2] == glm::dvec3(0.0)) {
            light.means.pop_back();
            light.edges.erase(light.edges.end() - 2);
        }
        lights_.push_back(std::move(light));
    }
}

glm::dvec3 ReferenceDay::operator()(std::size_t index, const glm::dvec3& direction,
                                    double exponent) const {
    const Light& light = lights_[index];
    const double theta = angleBetween(direction, light.moment.axis);
    if (std::isinf(exponent)) {
        return gradientAt(light.day, light.moment, theta);
    }
    const std::vector<double> weights = ringWeights(theta, light.edges, exponent);
    glm::dvec3 sum(0.0);
    for (std::size_t j = 0; j < weights.size(); ++j) {
        sum += weights[j] * light.means[j];
    }
    return sum;
}

glm::dvec3 ReferenceDay::operator()(const glm::dvec3& direction, double exponent) const {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        sum += (*this)(i, direction, exponent);
    }
    return sum;
}

glm::dvec3 referenceDay(const std::vector<DayLight>& lights, double hour,
                        const glm::dvec3& direction, double exponent) {
    return ReferenceDay(lights, hour)(direction, exponent);
}

} // namespace lodestar::lighting

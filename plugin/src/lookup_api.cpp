// SPDX-License-Identifier: MIT
//
// The table's lookups on the CPU: what a shader would get of the environment and the lights.
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "context.h"
#include "lighting/lookup.h"
#include "lighting/rsrm.h"

namespace lodestar::plugin {
namespace {

/// The environment's mean over a lobe; 0 where a sky stands in its place.
glm::dvec3 ofEnvironment(LodestarContext& context, const lighting::LookupRequest& request) {
    PlacedEnvironment* distant = context.environments.find(context.environment);
    if (distant == nullptr || distant->version() == 0) {
        return glm::dvec3(0.0);
    }
    for (const LodestarLight light : context.order) {
        if (lighting::replacesEnvironment(context.lights.find(light)->map.day())) {
            return glm::dvec3(0.0);
        }
    }
    return lighting::lookup(distant->prepared(), request).radiance;
}

/// The sum over the environment and the lights that shine, of which `of` answers for a light and an
/// angle from its axis.
template <class Of>
LodestarStatus sum(LodestarContext* context, const double direction[3],
                   lighting::LookupRequest request, double rgb[3], const Of& of) noexcept {
    return entered(context, [&]() -> LodestarStatus {
        if (direction == nullptr || rgb == nullptr) {
            return context->fail(LODESTAR_E_ARG, "no direction, or no place for the answer");
        }
        const glm::dvec3 given(direction[0], direction[1], direction[2]);
        const double length = glm::length(given);
        if (!(length > 1e-12) || !std::isfinite(length)) {
            return context->fail(LODESTAR_E_ARG, "a direction has a length");
        }
        request.direction = given / length;
        glm::dvec3 result = ofEnvironment(*context, request);
        for (const LodestarLight handle : context->order) {
            PlacedLight& light = *context->lights.find(handle);
            const lighting::DayMoment moment = look(*context, light);
            if (moment.visibility > 0.0) {
                const double halfChord = 0.5 * glm::length(request.direction - moment.axis);
                result +=
                    glm::dvec3(of(*texelsOf(light), 2.0 * std::asin(std::min(halfChord, 1.0))));
            }
        }
        for (int i = 0; i < 3; ++i) {
            rgb[i] = result[i];
        }
        return LODESTAR_OK;
    });
}

LodestarStatus radiance(LodestarContext* context, const double direction[3], double exponent,
                        double rgb[3]) noexcept {
    lighting::LookupRequest request;
    request.exponent = exponent;
    request.estimator = lighting::kDefaultSpecular;
    return sum(context, direction, request, rgb,
               [&](const lighting::LightMap::Blend& blend, double theta) {
                   return lighting::rsrmRadiance(blend.texels, blend.gradient, theta, exponent);
               });
}

LodestarStatus lambert(LodestarContext* context, const double normal[3], double rgb[3]) noexcept {
    lighting::LookupRequest request;
    request.lobe = lighting::Lobe::Lambert;
    request.estimator = lighting::kDefaultDiffuse;
    return sum(context, normal, request, rgb,
               [](const lighting::LightMap::Blend& blend, double theta) {
                   return lighting::rsrmLambert(blend.texels, theta);
               });
}

} // namespace

void addLookupApi(LodestarApi& api) {
    api.radiance = radiance;
    api.lambert = lambert;
}

} // namespace lodestar::plugin

// SPDX-License-Identifier: MIT
#include "app/cost_estimates.h"

#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

#include "lighting/environment.h"
#include "lighting/lookup.h"
#include "lighting/rsrm.h"
#include "lodestar/rsrm.glsl"

namespace lodestar::app {
namespace {

using lighting::Term;
using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Mean radiance over azimuth at an angle from +Y.
glm::dvec3 meanOverAzimuth(const lighting::Cubemap& base, double theta) {
    const int steps = 4 * base.width();
    glm::dvec3 sum(0.0);
    for (int i = 0; i < steps; ++i) {
        const double azimuth = 2.0 * std::numbers::pi * (i + 0.5) / steps;
        const glm::vec3 direction(std::sin(theta) * std::cos(azimuth), std::cos(theta),
                                  std::sin(theta) * std::sin(azimuth));
        sum += glm::dvec3(glm::vec3(base.sampleLevel(direction, 0)));
    }
    return sum / static_cast<double>(steps);
}

/// A map's zones about +Y, each the mean of a few rings.
lighting::ZonalRadiance zonesOf(const lighting::Cubemap& base, const lighting::Zones& zones) {
    constexpr int kRings = 4;
    lighting::ZonalRadiance radiance{zones, {}};
    const std::vector<double> edges = lighting::zoneEdges(zones);
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
        const double top = std::cos(edges[i]);
        const double bottom = std::cos(edges[i + 1]);
        glm::dvec3 sum(0.0);
        for (int k = 0; k < kRings; ++k) { // of equal area
            sum += meanOverAzimuth(base, std::acos(top + (bottom - top) * (k + 0.5) / kRings));
        }
        radiance.means.push_back(sum / static_cast<double>(kRings));
    }
    return radiance;
}

/// What stands beside a map for lobes sharper than its last row: uniform in u2.
std::vector<glm::vec3> gradientOf(const lighting::Cubemap& base) {
    std::vector<glm::vec3> gradient;
    for (const double theta :
         lighting::columnAngles(lighting::RsrmColumns::Refined, lighting::kGradientColumns)) {
        gradient.emplace_back(meanOverAzimuth(base, theta));
    }
    return gradient;
}

ReadyLookup readyMap(const CostedLookup& lookup, const lighting::Cubemap& base) {
    struct Map {
        lighting::RsrmTexels texels;
        std::vector<glm::vec3> gradient;
    };
    static lighting::RsrmKernels kernels; // half a second each to build, for every map the same
    const auto kernel = kernels.get(*lookup.layout, lighting::LightKind::Sky);
    const auto start = Clock::now();
    auto map = std::make_shared<Map>();
    map->texels = lighting::encode(
        *lookup.layout,
        kernel->bake(zonesOf(base, lighting::zonesFor(*lookup.layout, lighting::LightKind::Sky))));
    map->gradient = gradientOf(base);
    const bool diffuse = lookup.term == Term::Diffuse;
    return {[map, diffuse](const glm::dvec3& direction, double exponent) {
                const double theta = std::acos(glm::clamp(direction.y, -1.0, 1.0));
                return CostAnswer{
                    diffuse ? lighting::rsrmLambert(map->texels, theta)
                            : lighting::rsrmRadiance(map->texels, map->gradient, theta, exponent),
                    1};
            },
            millisecondsSince(start)};
}

} // namespace

std::vector<CostedLookup> costedLookups() {
    std::vector<CostedLookup> lookups;
    for (const Term term : {Term::Glossy, Term::Diffuse}) {
        // Without a pixel's footprint `mip-floor` is `mip`; the level of `bias` is chosen by hand.
        const std::vector<const char*> names =
            term == Term::Glossy
                ? std::vector<const char*>{"mip",    "tent",    "ring:3",  "ring:7",
                                           "taps:4", "taps:16", "taps:64", "prefiltered"}
                : std::vector<const char*>{"lowest-mip", "sh9", "irradiance"};
        for (const char* name : names) {
            lookups.push_back({name, term, *lighting::parseEstimator(name, term), nullptr});
        }
        for (const char* name : {"rsrm", "rsrm-published", "rsrm-published-columns"}) {
            lookups.push_back({name, term, {}, lighting::rsrmLayoutNamed(name)});
        }
    }
    return lookups;
}

ReadyLookup makeReady(const CostedLookup& lookup, const lighting::Cubemap& base) {
    if (lookup.layout != nullptr) {
        return readyMap(lookup, base);
    }
    const auto start = Clock::now();
    auto prepared = std::make_shared<const lighting::PreparedEnvironment>(
        lighting::prepare(base, lighting::partsFor(lookup.estimator)));
    const double ms = millisecondsSince(start);
    const auto lobe =
        lookup.term == Term::Diffuse ? lighting::Lobe::Lambert : lighting::Lobe::Phong;
    return {[prepared, lobe, estimator = lookup.estimator](const glm::dvec3& direction,
                                                           double exponent) {
                const lighting::LookupAnswer answer =
                    lighting::lookup(*prepared, {lobe, exponent, direction, estimator});
                return CostAnswer{answer.radiance, answer.fetches};
            },
            ms};
}

} // namespace lodestar::app

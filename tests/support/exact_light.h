// SPDX-License-Identifier: MIT
//
// A sky or sun in double precision: what its filtered maps are held to.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>

#include "lighting/day.h"
#include "lighting/rsrm_weights.h"

namespace lodestar::testing {

/// A light's gradient at an hour as means of zones that end at its stops, 96 between two.
struct ExactLight {
    glm::dvec3 axis;
    std::vector<double> edges;
    std::vector<glm::dvec3> means;

    ExactLight(const lighting::DayLight& light, double hour) {
        const lighting::DayMoment moment = lighting::momentAt(light, hour);
        axis = moment.axis;
        std::vector<double> breaks = {0.0, std::numbers::pi};
        std::vector<lighting::RadianceProfile> profiles;
        for (const std::size_t key : {moment.keys.from, moment.keys.to}) {
            profiles.emplace_back(light.keys[key].gradient, light.kind);
            breaks.insert(breaks.end(), profiles.back().breaks().begin(),
                          profiles.back().breaks().end());
        }
        std::sort(breaks.begin(), breaks.end());
        edges.push_back(0.0);
        for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
            for (int k = 1; k <= 96 && breaks[i + 1] - breaks[i] > 1e-9; ++k) {
                edges.push_back(breaks[i] + (breaks[i + 1] - breaks[i]) * k / 96.0);
            }
        }
        const auto from = lighting::ringMeans(profiles[0], edges);
        const auto to = lighting::ringMeans(profiles[1], edges);
        for (std::size_t j = 0; j < from.size(); ++j) {
            means.push_back(((1.0 - moment.keys.t) * from[j] * light.keys[moment.keys.from].tint +
                             moment.keys.t * to[j] * light.keys[moment.keys.to].tint) *
                            moment.visibility);
        }
    }

    /// Mean radiance under the Phong lobe; the zone's own where the exponent is infinite.
    [[nodiscard]] glm::dvec3 filtered(const glm::dvec3& direction, double s) const {
        return filteredAt(2.0 * std::asin(std::min(0.5 * glm::length(direction - axis), 1.0)), s);
    }
    [[nodiscard]] glm::dvec3 filteredAt(double theta, double s) const {
        if (std::isinf(s)) {
            const auto at = std::upper_bound(edges.begin() + 1, edges.end() - 1, theta);
            return means[static_cast<std::size_t>(at - edges.begin()) - 1];
        }
        const std::vector<double> weights = lighting::ringWeights(theta, edges, s);
        glm::dvec3 sum(0.0);
        for (std::size_t j = 0; j < weights.size(); ++j) {
            sum += weights[j] * means[j];
        }
        return sum;
    }
    /// The mean of |l - axis|^2 over squared radiance.
    [[nodiscard]] double spread() const {
        double power = 0.0, moment = 0.0;
        for (std::size_t j = 0; j < means.size(); ++j) {
            const double shines = means[j].r + means[j].g + means[j].b;
            const double near = std::cos(edges[j]), far = std::cos(edges[j + 1]);
            power += shines * shines * (near - far);
            moment += shines * shines * (near - far) * (2.0 - near - far);
        }
        return moment / power;
    }
    /// How near the direction lies to a step of the gradient, radians.
    [[nodiscard]] double toStep(const glm::dvec3& direction, double step) const {
        return std::abs(2.0 * std::asin(0.5 * glm::length(direction - axis)) - step);
    }
};

} // namespace lodestar::testing

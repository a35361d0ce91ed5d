// SPDX-License-Identifier: MIT
#include "app/accuracy_truth.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "lighting/drawn_light.h"

namespace lodestar::app {
namespace {

glm::dvec3 evenDirection(int i, int count) {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double r = std::sqrt(std::max(1.0 - z * z, 0.0));
    return {r * std::cos(angle), z, r * std::sin(angle)};
}

/// A direction in the Phong lobe about another, by two numbers of [0, 1).
glm::dvec3 inLobe(const glm::dvec3& about, double exponent, double u, double turn) {
    const double cosine = std::pow(1.0 - u, 1.0 / (exponent + 1.0));
    const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
    const glm::dvec3 x = glm::normalize(glm::cross(
        std::abs(about.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0), about));
    const double azimuth = 2.0 * std::numbers::pi * turn;
    return glm::normalize(
        cosine * about + sine * (std::cos(azimuth) * x + std::sin(azimuth) * glm::cross(about, x)));
}

double sumOf(const glm::dvec3& radiance) {
    return radiance.r + radiance.g + radiance.b;
}

} // namespace

std::vector<Drawn> drawnLights(const std::vector<lighting::DayLight>& lights, double hour,
                               int count) {
    std::vector<Drawn> all;
    for (const lighting::DayLight& light : lights) {
        const lighting::DayMoment moment = lighting::momentAt(light, hour);
        if (moment.visibility <= 0.0) {
            continue; // as ReferenceDay
        }
        const lighting::DrawnLight drawn = lighting::drawnLight(light, moment, count);
        all.push_back({{}, drawn.sum});
        for (const lighting::DrawnTexel& point : drawn.points) {
            all.back().points.emplace_back(point.direction);
        }
    }
    return all;
}

Truth truthOf(const lighting::ReferenceDay& reference, const std::vector<Drawn>& drawn, int even,
              double exponent, const std::function<bool()>& advance) {
    Truth truth;
    std::vector<glm::dvec3> directions;
    for (int i = 0; i < even; ++i) {
        directions.push_back(evenDirection(i, even));
    }
    for (const Drawn& light : drawn) {
        for (std::size_t i = 0; i < light.points.size(); ++i) {
            const double u = (static_cast<double>(i * 7 % light.points.size()) + 0.5) /
                             static_cast<double>(light.points.size());
            const double turn = 0.7548776662466927 * static_cast<double>(i + 1);
            directions.push_back(
                inLobe(glm::normalize(light.points[i]), exponent, u, turn - std::floor(turn)));
        }
    }
    double weights = 0.0;
    for (const glm::dvec3& direction : directions) {
        if (!advance()) {
            return {};
        }
        double density = even / (4.0 * std::numbers::pi);
        glm::dvec3 sum(0.0);
        for (std::size_t light = 0; light < reference.count(); ++light) {
            const glm::dvec3 part = reference(light, direction, exponent);
            sum += part;
            density += drawn[light].sum > 0.0 ? static_cast<double>(drawn[light].points.size()) *
                                                    sumOf(part) / drawn[light].sum
                                              : 0.0;
        }
        truth.directions.push_back({direction, 1.0 / density});
        truth.radiance.push_back(sum);
        weights += 1.0 / density;
    }
    for (lighting::MeasuredDirection& direction : truth.directions) {
        direction.weight /= weights;
    }
    return truth;
}

} // namespace lodestar::app

// SPDX-License-Identifier: MIT
#include "app/cost_lobes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "lodestar/lobes.glsl"

namespace lodestar::app {
namespace {

constexpr double kF0 = 0.04;
constexpr double kViews[] = {1.0, 0.7, 0.3};
constexpr int kRings = 400, kTurns = 32;

/// (n.h)^s (n.l) with its normaliser and Schlick's form, of a surface facing +Z.
double reference(const glm::dvec3& h, const glm::dvec3& v, const glm::dvec3& l, double s) {
    const double normaliser =
        (s + 2.0) * (s + 4.0) / (8.0 * std::numbers::pi * (std::exp2(-0.5 * s) + s));
    const double fresnel = kF0 + (1.0 - kF0) * std::pow(1.0 - glm::dot(v, h), 5.0);
    return fresnel * normaliser * std::pow(h.z, s) * l.z;
}

} // namespace

LobeErrors lobeErrors(lighting::LobeForm lobes, lighting::FresnelForm fresnel, double exponent) {
    const int lobe =
        lobes == lighting::LobeForm::Sg ? shader::LODESTAR_LOBES_SG : shader::LODESTAR_LOBES_POWER;
    const int rise = fresnel == lighting::FresnelForm::Sg ? shader::LODESTAR_FRESNEL_SG
                                                          : shader::LODESTAR_FRESNEL_SCHLICK;
    LobeErrors errors;
    double off = 0.0;
    double norm = 0.0;
    for (const double cosine : kViews) {
        const glm::dvec3 v(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
        double most = 0.0;
        double peak = 0.0;
        for (int i = 0; i < kRings * kTurns; ++i) {
            // Half vectors, at angles that rise with the cube, so that sharp lobes have many.
            const double t = (i / kTurns + 0.5) / kRings;
            const double theta = 0.5 * std::numbers::pi * t * t * t;
            const double azimuth = 2.0 * std::numbers::pi * (i % kTurns + 0.5) / kTurns;
            const glm::dvec3 h(std::sin(theta) * std::cos(azimuth),
                               std::sin(theta) * std::sin(azimuth), std::cos(theta));
            const double hDotV = glm::dot(h, v);
            const glm::dvec3 l = 2.0 * hDotV * h - v;
            if (hDotV <= 0.0 || l.z <= 0.0) {
                continue;
            }
            const double exact = reference(h, v, l, exponent);
            const auto ours = static_cast<double>(
                shader::lodestar_directReflectanceBy(
                    glm::vec3(0.0f, 0.0f, 1.0f), glm::vec3(v), glm::vec3(l), glm::vec3(0.0f),
                    glm::vec3(static_cast<float>(kF0)), static_cast<float>(exponent), lobe, rise)
                    .x);
            const double angle = std::sin(theta) * t * t * hDotV; // solid angle of lights, scaled
            off += angle * (ours - exact) * (ours - exact);
            norm += angle * exact * exact;
            most = std::max(most, std::abs(ours - exact));
            peak = std::max(peak, exact);
        }
        errors.worst = std::max(errors.worst, most / peak);
    }
    errors.rmse = std::sqrt(off / norm);
    return errors;
}

} // namespace lodestar::app

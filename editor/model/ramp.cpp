// SPDX-License-Identifier: MIT
#include "model/ramp.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lodestar::model {

using lighting::LightKind;

AngleRange anglesOf(LightKind kind) {
    return kind == LightKind::Sky ? AngleRange{-90.0, 90.0} : AngleRange{0.0, 180.0};
}

double fromAxis(double at, LightKind kind) {
    return kind == LightKind::Sky ? 90.0 - at : at;
}

double atFromAxis(double degrees, LightKind kind) {
    return kind == LightKind::Sky ? 90.0 - degrees : degrees;
}

core::Result<lighting::RadianceProfile> profileOf(const document::Gradient& gradient,
                                                  LightKind kind) {
    lighting::Gradient values{{}, gradient.interpolation, gradient.space};
    values.stops.reserve(gradient.stops.size());
    for (const document::Stop& stop : gradient.stops) {
        values.stops.push_back(stop.stop);
    }
    core::Tally warnings; // the reader's to tell
    const auto ordered = lighting::repaired(std::move(values), kind, warnings);
    if (!ordered) {
        return ordered.error();
    }
    return lighting::RadianceProfile(*ordered, kind);
}

std::vector<glm::dvec3> radianceAt(const document::Gradient& gradient, LightKind kind,
                                   std::span<const double> at) {
    std::vector<glm::dvec3> radiances(at.size(), glm::dvec3(0.0));
    const auto profile = profileOf(gradient, kind);
    for (std::size_t i = 0; profile && i < at.size(); ++i) {
        radiances[i] = profile->radiance(fromAxis(at[i], kind) * (std::numbers::pi / 180.0));
    }
    return radiances;
}

lighting::GradientStop stopOf(double at, const glm::dvec3& radiance, double ev) {
    // A colour space and back may have made a rounding more of the most.
    const glm::dvec3 held = glm::min(radiance, glm::dvec3(lighting::kMaxRadiance));
    const double brightest = std::max({held.r, held.g, held.b});
    const double color = brightest * std::exp2(-ev);
    if (!(color <= 1.0 && color * std::exp2(ev) <= lighting::kMaxRadiance)) {
        ev = std::max(0.0, std::ceil(std::log2(brightest))); // whole: nothing is rounded
    }
    return {at, held * std::exp2(-ev), ev};
}

double snapped(double at, const Snap& snap, std::span<const double> others) {
    double best = at;
    double nearest = std::numeric_limits<double>::infinity();
    const auto offer = [&](double place) {
        const double distance = std::abs(place - at);
        if (distance <= snap.reach && distance < nearest) {
            nearest = distance;
            best = place;
        }
    };
    if (snap.horizon) {
        offer(0.0);
    }
    if (snap.stops) {
        std::for_each(others.begin(), others.end(), offer);
    }
    if (snap.grid > 0.0) {
        offer(snap.grid * std::round(at / snap.grid));
    }
    return best;
}

} // namespace lodestar::model

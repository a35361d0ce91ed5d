// SPDX-License-Identifier: MIT
#include "model/key_blend.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <glm/common.hpp>

#include "model/ramp.h"
#include "model/rules.h"

namespace lodestar::model {
namespace {

using lighting::GradientInterpolation;
using lighting::LightKind;

constexpr double kRadians = std::numbers::pi / 180.0;
constexpr std::size_t kMostBlended = 256;
/// Half a step of an 8-bit picture's brightest values; darker than kDark of the peak none sees.
constexpr double kTolerance = 1.0 / 256.0;
constexpr double kDark = 1e-5;

/// Two keys' radiance, mixed, as a function of degrees from the axis.
struct Mixed {
    lighting::RadianceProfile a, b;
    glm::dvec3 shareA, shareB;

    [[nodiscard]] glm::dvec3 radians(double theta) const {
        return shareA * a.radiance(theta) + shareB * b.radiance(theta);
    }
    [[nodiscard]] glm::dvec3 at(double degrees) const { return radians(degrees * kRadians); }
    [[nodiscard]] glm::dvec3 justBefore(double degrees) const {
        return radians(std::nextafter(degrees * kRadians, -1.0));
    }
    [[nodiscard]] glm::dvec3 justAfter(double degrees) const {
        return radians(std::nextafter(degrees * kRadians, 4.0));
    }
};

double largest(const glm::dvec3& v) {
    return std::max({std::abs(v.r), std::abs(v.g), std::abs(v.b)});
}

/// A gradient through the mixture at places, degrees from the axis; `breaks` may be steps.
document::Gradient through(const Mixed& mixed, const std::set<double>& places,
                           const std::set<double>& breaks, document::Gradient gradient,
                           LightKind kind) {
    gradient.stops.clear();
    const auto add = [&](double place, const glm::dvec3& radiance) {
        gradient.stops.push_back({stopOf(plain(atFromAxis(place, kind)), plain(radiance)), {}});
    };
    const bool constant = gradient.interpolation == GradientInterpolation::Constant;
    for (const double place : places) {
        const bool last = place == *places.rbegin();
        const glm::dvec3 after =
            last && kind == LightKind::Sun ? mixed.at(place) : mixed.justAfter(place);
        if (breaks.contains(place) && place > *places.begin() && !constant) {
            // Rounding alone makes less of a step than this.
            const glm::dvec3 before = mixed.justBefore(place);
            if (largest(after - before) > 1e-9 * std::max(largest(after), largest(before))) {
                add(place, before);
            }
        }
        add(place, after);
    }
    return gradient;
}

/// Places halfway between neighbours where a gradient strays from the mixture.
std::set<double> strays(const Mixed& mixed, const document::Gradient& gradient, LightKind kind,
                        const std::set<double>& places, double peak) {
    std::set<double> found;
    const auto profile = profileOf(gradient, kind);
    for (auto a = places.begin(), b = std::next(a); profile && b != places.end(); ++a, ++b) {
        for (const double t : {0.25, 0.5, 0.75}) {
            const double place = (1.0 - t) * *a + t * *b;
            const glm::dvec3 wanted = mixed.at(place);
            const double error = largest(profile->radiance(place * kRadians) - wanted);
            if (error > kTolerance * std::max(largest(wanted), kDark * peak)) {
                found.insert(0.5 * (*a + *b));
            }
        }
    }
    return found;
}

document::Gradient mixedGradient(const Mixed& mixed, const document::Gradient& a,
                                 const document::Gradient& b, LightKind kind) {
    document::Gradient gradient;
    if (a.interpolation == b.interpolation && a.space == b.space) {
        gradient.interpolation = a.interpolation;
        gradient.space = a.space;
    }
    std::set<double> places;
    double peak = 0.0;
    for (const document::Gradient* each : {&a, &b}) {
        for (const document::Stop& stop : each->stops) {
            places.insert(fromAxis(stop.stop.at, kind));
        }
    }
    const std::set<double> breaks = places;
    for (const double place : places) {
        peak = std::max(peak, largest(mixed.at(place)));
    }
    gradient = through(mixed, places, breaks, std::move(gradient), kind);
    while (true) {
        const std::set<double> more = strays(mixed, gradient, kind, places, peak);
        const std::size_t before = places.size();
        if (more.empty() || before + more.size() > kMostBlended) {
            return gradient;
        }
        places.insert(more.begin(), more.end());
        if (places.size() == before) {
            return gradient; // a step between two neighbouring doubles
        }
        gradient = through(mixed, places, breaks, std::move(gradient), kind);
    }
}

/// Back to the document's form.
document::Gradient asWritten(const lighting::Gradient& gradient) {
    document::Gradient made{{}, gradient.interpolation, gradient.space, {}};
    for (const lighting::GradientStop& stop : gradient.stops) {
        made.stops.push_back({stop, {}});
    }
    return made;
}

} // namespace

core::Result<document::Key> keyAt(const document::Light& light, double hour) {
    document::Document alone;
    alone.lights.push_back(light);
    core::Tally warnings; // the reader's to tell
    const auto day = document::dayLights(alone, warnings);
    if (!day) {
        return core::refused(day.error().what);
    }
    const lighting::DayLight& read = day->front();
    const lighting::DayMoment moment = lighting::momentAt(read, hour);
    const lighting::DayKey& from = read.keys[moment.keys.from];
    const lighting::DayKey& to = read.keys[moment.keys.to];
    document::Key key;
    key.hour = hour;
    if (!light.path && (from.axis || to.axis)) {
        key.axis = moment.axis;
    }
    const double t = moment.keys.t;
    if (moment.keys.from == moment.keys.to) {
        key.gradient = asWritten(from.gradient);
        key.tint = from.tint;
        return key;
    }
    const bool shared = from.tint == to.tint;
    key.tint = shared ? from.tint : glm::dvec3(1.0);
    const Mixed mixed{lighting::RadianceProfile(from.gradient, read.kind),
                      lighting::RadianceProfile(to.gradient, read.kind),
                      (1.0 - t) * (shared ? glm::dvec3(1.0) : from.tint),
                      t * (shared ? glm::dvec3(1.0) : to.tint)};
    key.gradient =
        mixedGradient(mixed, asWritten(from.gradient), asWritten(to.gradient), read.kind);
    return key;
}

} // namespace lodestar::model

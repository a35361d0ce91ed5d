// SPDX-License-Identifier: MIT
#include "lighting/day.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/contract.h"
#include "lighting/rsrm.h"

namespace lodestar::lighting {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kHours = 24.0;
/// Axes nearer than this to equal or to opposite are blended another way, radians.
constexpr double kNarrow = 1e-4;
constexpr glm::dvec3 kUp(0.0, 1.0, 0.0);

bool finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// A unit vector across a: from the coordinate axis that a has least of.
glm::dvec3 perpendicular(const glm::dvec3& a) {
    const glm::dvec3 size = glm::abs(a);
    const glm::dvec3 least = size.x <= size.y && size.x <= size.z ? glm::dvec3(1.0, 0.0, 0.0)
                             : size.y <= size.z                   ? glm::dvec3(0.0, 1.0, 0.0)
                                                                  : glm::dvec3(0.0, 0.0, 1.0);
    return glm::normalize(glm::cross(a, least));
}

void repairAxis(glm::dvec3& axis, core::Tally& warnings) {
    const double length = glm::length(axis);
    if (!finite(axis) || !(length > 1e-12) || !std::isfinite(length)) {
        axis = kUp;
        warnings.add("axis without a direction, set to +Y");
        return;
    }
    axis /= length;
}

void repairTint(glm::dvec3& tint, core::Tally& warnings) {
    for (int c = 0; c < 3; ++c) {
        if (!(tint[c] >= 0.0 && tint[c] <= kMaxRadiance)) {
            tint[c] = tint[c] > 0.0 ? kMaxRadiance : 0.0;
            warnings.add("tint outside [0, 1e9], clamped");
        }
    }
}

/// Stops whose radiance times the tint lies above the range are lowered. @pre both are repaired
void repairTinted(DayKey& key, core::Tally& warnings) {
    std::uint64_t tooLarge = 0;
    for (GradientStop& stop : key.gradient.stops) {
        const glm::dvec3 radiance = radianceOf(stop);
        // Divided, so that what is repaired is in range when it is read again.
        const glm::dvec3 most = glm::dvec3(kMaxRadiance) / key.tint;
        const glm::dvec3 lowered = glm::min(radiance, most);
        if (lowered != radiance) {
            for (int c = 0; c < 3; ++c) {
                tooLarge += radiance[c] > most[c] ? 1U : 0U;
            }
            stop.color = lowered;
            stop.ev = 0.0;
        }
    }
    warnings.add("radiance times tint above 1e9, set to 1e9", tooLarge);
}

core::Result<void> repairPath(SunPath& path) {
    if (!(std::abs(path.latitude) <= 0.5 * kPi + 1e-9)) {
        return core::refused("a latitude lies from -90 to 90 degrees", "/path/latitude");
    }
    if (path.dayOfYear < 1 || path.dayOfYear > 366) {
        return core::refused("a day of the year lies from 1 to 366", "/path/dayOfYear");
    }
    path.north.y = 0.0;
    const double length = glm::length(path.north);
    if (!(length > 1e-12) || !std::isfinite(length)) {
        return core::refused("north needs a part across +Y", "/path/north");
    }
    path.north /= length;
    return {};
}

/// Of keys at one hour the last listed holds.
void dropDuplicates(std::vector<DayKey>& keys, core::Tally& warnings) {
    std::stable_sort(keys.begin(), keys.end(),
                     [](const DayKey& a, const DayKey& b) { return a.hour < b.hour; });
    std::vector<DayKey> kept;
    for (DayKey& key : keys) {
        if (!kept.empty() && kept.back().hour == key.hour) {
            kept.back() = std::move(key);
            warnings.add("two keys at one hour, the last listed kept");
        } else {
            kept.push_back(std::move(key));
        }
    }
    keys = std::move(kept);
}

} // namespace

double wrappedHour(double hour) {
    if (!std::isfinite(hour)) {
        return 0.0;
    }
    const double wrapped = hour - kHours * std::floor(hour / kHours);
    return wrapped >= 0.0 && wrapped < kHours ? wrapped : 0.0; // rounding may reach 24
}

double blendedHour(double a, double b, double t) {
    const double from = wrappedHour(a);
    const double ahead = wrappedHour(wrappedHour(b) - from);
    return wrappedHour(from + t * (ahead <= 0.5 * kHours ? ahead : ahead - kHours));
}

KeyBlend keysAt(std::span<const double> hours, double hour) {
    LODESTAR_EXPECT(!hours.empty(), "a day has a key");
    const double now = wrappedHour(hour);
    const auto next =
        static_cast<std::size_t>(std::upper_bound(hours.begin(), hours.end(), now) - hours.begin());
    const std::size_t from = next == 0 ? hours.size() - 1 : next - 1;
    const std::size_t to = next == hours.size() ? 0 : next;
    if (from == to) {
        return {from, to, 0.0};
    }
    const double length = wrappedHour(hours[to] - hours[from]);
    return {from, to, std::min(wrappedHour(now - hours[from]) / length, std::nextafter(1.0, 0.0))};
}

glm::dvec3 slerpAxis(const glm::dvec3& a, const glm::dvec3& b, double t) {
    const double angle = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
    if (angle < kNarrow) {
        return glm::normalize((1.0 - t) * a + t * b);
    }
    if (angle > kPi - kNarrow) {
        // Half a turn through the perpendicular, ending at b itself.
        const glm::dvec3 across = perpendicular(a);
        return t <= 0.5 ? slerpAxis(a, across, 2.0 * t) : slerpAxis(across, b, 2.0 * t - 1.0);
    }
    return glm::normalize((std::sin((1.0 - t) * angle) * a + std::sin(t * angle) * b) /
                          std::sin(angle));
}

double sunDeclination(int dayOfYear) {
    return 23.45 * kPi / 180.0 * std::sin(2.0 * kPi * (284 + dayOfYear) / 365.0);
}

glm::dvec3 sunDirection(const SunPath& path, double hour) {
    const double declination = sunDeclination(path.dayOfYear);
    const double angle = (wrappedHour(hour) - 12.0) * kPi / 12.0; // westwards of the meridian
    const double toPole = std::sin(declination);
    const double around = std::cos(declination);
    const double up =
        std::sin(path.latitude) * toPole + std::cos(path.latitude) * around * std::cos(angle);
    const double north =
        std::cos(path.latitude) * toPole - std::sin(path.latitude) * around * std::cos(angle);
    const double east = -around * std::sin(angle);
    return glm::normalize(up * kUp + north * path.north + east * glm::cross(path.north, kUp));
}

double sunVisibility(double elevation, double radius) {
    if (elevation >= 0.0) {
        return 1.0;
    }
    if (!(radius > 0.0) || elevation <= -2.0 * radius) {
        return 0.0;
    }
    const double t = 1.0 + elevation / (2.0 * radius);
    return t * t * (3.0 - 2.0 * t);
}

core::Result<DayLight> repaired(DayLight light, core::Tally& warnings) {
    if (light.keys.empty()) {
        return core::refused("a light needs at least one key", "/keys");
    }
    if (light.path) {
        if (auto path = repairPath(*light.path); !path) {
            return path.error();
        }
    }
    repairAxis(light.axis, warnings);
    for (std::size_t i = 0; i < light.keys.size(); ++i) {
        DayKey& key = light.keys[i];
        const std::string pointer = "/keys/" + std::to_string(i);
        if (!std::isfinite(key.hour)) {
            return core::refused("an hour is a finite number", pointer + "/hour");
        }
        if (key.hour < 0.0 || key.hour >= kHours) {
            key.hour = wrappedHour(key.hour);
            warnings.add("hour outside [0, 24), wrapped");
        }
        auto gradient = repaired(std::move(key.gradient), light.kind, warnings);
        if (!gradient) {
            return core::refused(gradient.error().what,
                                 pointer + "/gradient" + gradient.error().where);
        }
        key.gradient = std::move(*gradient);
        repairTint(key.tint, warnings);
        repairTinted(key, warnings);
        if (key.axis) {
            repairAxis(*key.axis, warnings);
        }
    }
    dropDuplicates(light.keys, warnings);
    return light;
}

double sunRadius(const Gradient& gradient) {
    const std::vector<GradientStop>& stops = gradient.stops;
    LODESTAR_EXPECT(!stops.empty(), "a gradient has stops");
    const auto edge =
        std::adjacent_find(stops.begin(), stops.end(),
                           [](const auto& a, const auto& b) { return a.at > 0.0 && a.at == b.at; });
    return (edge == stops.end() ? stops.back() : *edge).at * kPi / 180.0;
}

DayMoment momentAt(const DayLight& light, double hour) {
    std::vector<double> hours;
    for (const DayKey& key : light.keys) {
        hours.push_back(key.hour);
    }
    DayMoment moment{keysAt(hours, hour), light.axis, 1.0};
    const DayKey& from = light.keys[moment.keys.from];
    const DayKey& to = light.keys[moment.keys.to];
    moment.axis = light.path ? sunDirection(*light.path, hour)
                             : slerpAxis(from.axis.value_or(light.axis),
                                         to.axis.value_or(light.axis), moment.keys.t);
    if (light.kind == LightKind::Sun) {
        const double radius = (1.0 - moment.keys.t) * sunRadius(from.gradient) +
                              moment.keys.t * sunRadius(to.gradient);
        moment.visibility = sunVisibility(std::asin(std::clamp(moment.axis.y, -1.0, 1.0)), radius);
    }
    return moment;
}

ZonalRadiance keyRadiance(const DayLight& light, std::size_t key, const Zones& zones) {
    LODESTAR_EXPECT(key < light.keys.size(), "the light has the key");
    ZonalRadiance radiance =
        zonalRadiance(RadianceProfile(light.keys[key].gradient, light.kind), zones);
    for (glm::dvec3& mean : radiance.means) {
        mean *= light.keys[key].tint;
    }
    return radiance;
}

std::vector<glm::vec3> keyGradient(const DayLight& light, std::size_t key) {
    LODESTAR_EXPECT(key < light.keys.size(), "the light has the key");
    std::vector<glm::vec3> gradient =
        unfiltered(RadianceProfile(light.keys[key].gradient, light.kind));
    for (glm::vec3& mean : gradient) {
        mean *= glm::vec3(light.keys[key].tint);
    }
    return gradient;
}

RsrmBake blended(const RsrmBake& a, const RsrmBake& b, double t, double factor) {
    LODESTAR_EXPECT(a.exponents == b.exponents && a.columns == b.columns,
                    "bakes of one kernel are blended");
    RsrmBake result = a;
    const auto first = static_cast<float>((1.0 - t) * factor);
    const auto second = static_cast<float>(t * factor);
    for (std::size_t i = 0; i < result.planes.size(); ++i) {
        result.planes[i] = first * a.planes[i] + second * b.planes[i];
    }
    result.lambert = blended(a.lambert, b.lambert, t, factor);
    return result;
}

std::vector<glm::vec3> blended(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b,
                               double t, double factor) {
    LODESTAR_EXPECT(a.size() == b.size(), "gradients of one layout are blended");
    std::vector<glm::vec3> result = a;
    const auto first = static_cast<float>((1.0 - t) * factor);
    const auto second = static_cast<float>(t * factor);
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] = first * a[i] + second * b[i];
    }
    return result;
}

ZonalRadiance blended(const ZonalRadiance& a, const ZonalRadiance& b, double t, double factor) {
    LODESTAR_EXPECT(a.zones == b.zones, "radiances of the same zones are blended");
    ZonalRadiance result = a;
    for (std::size_t j = 0; j < result.means.size(); ++j) {
        result.means[j] = factor * ((1.0 - t) * a.means[j] + t * b.means[j]);
    }
    return result;
}

} // namespace lodestar::lighting

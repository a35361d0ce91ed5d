// SPDX-License-Identifier: MIT
#include "model/rules.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "model/ramp.h"
#include "model/stop_commands.h"

namespace lodestar::model {
namespace {

constexpr double kMaxEv = 64.0;
constexpr const char* kNoNumber = "a number is needed, not NaN or infinity";

} // namespace

double plain(double value) {
    return std::abs(value) < std::numeric_limits<double>::min() ? 0.0 : value;
}

glm::dvec3 plain(const glm::dvec3& value) {
    return {plain(value.x), plain(value.y), plain(value.z)};
}

bool finite(double value) {
    return std::isfinite(value);
}

bool finite(const glm::dvec3& value) {
    return finite(value.x) && finite(value.y) && finite(value.z);
}

core::Result<double> checkedAngle(double at, lighting::LightKind kind) {
    if (!finite(at)) {
        return core::refused(kNoNumber);
    }
    const AngleRange range = anglesOf(kind);
    return plain(std::clamp(at, range.least, range.most));
}

core::Result<double> checkedHour(double hour) {
    if (!finite(hour)) {
        return core::refused(kNoNumber);
    }
    return plain(lighting::wrappedHour(hour));
}

core::Result<document::Stop> checkedStop(document::Stop stop, lighting::LightKind kind) {
    lighting::GradientStop& values = stop.stop;
    const auto at = checkedAngle(values.at, kind);
    if (!at) {
        return at.error();
    }
    if (!finite(values.color) || !finite(values.ev)) {
        return core::refused(kNoNumber);
    }
    values = {*at, plain(values.color), plain(values.ev)};
    if (std::abs(values.ev) > kMaxEv) {
        return core::refused("an ev lies from -64 to 64 stops");
    }
    for (int c = 0; c < 3; ++c) {
        if (values.color[c] < 0.0) {
            return core::refused("a colour is not negative");
        }
        if (values.color[c] * std::exp2(values.ev) > lighting::kMaxRadiance) {
            return core::refused("a radiance lies from 0 to 1e9");
        }
    }
    return stop;
}

namespace {

/// A key as it is read again, where it has members that no version knows: they are text, which
/// might be none or too deep. @pre its numbers are checked
core::Result<document::Key> asReadUnknown(document::Key key, lighting::LightKind kind) {
    const std::vector<document::Stop>& stops = key.gradient.stops;
    if (key.unknown.empty() && key.gradient.unknown.empty() &&
        std::all_of(stops.begin(), stops.end(),
                    [](const document::Stop& stop) { return stop.unknown.empty(); })) {
        return key;
    }
    document::Document document;
    document.lights.emplace_back();
    document.lights.front().kind = kind;
    document.lights.front().keys.push_back(std::move(key));
    auto read = asRead(document);
    if (!read) {
        return core::refused(read.error().what);
    }
    return std::move(read->lights.front().keys.front());
}

} // namespace

core::Result<document::Gradient> checkedGradient(document::Gradient gradient,
                                                 lighting::LightKind kind) {
    if (gradient.stops.empty()) {
        return core::refused("a gradient needs at least one stop");
    }
    if (gradient.stops.size() > kMostStops) {
        return core::refused("a gradient has at most 65536 stops");
    }
    for (document::Stop& stop : gradient.stops) {
        auto checked = checkedStop(std::move(stop), kind);
        if (!checked) {
            return checked.error();
        }
        stop = std::move(*checked);
    }
    document::Key key;
    key.gradient = std::move(gradient);
    auto read = asReadUnknown(std::move(key), kind);
    if (!read) {
        return read.error();
    }
    return std::move(read->gradient);
}

core::Result<glm::dvec3> checkedTint(const glm::dvec3& tint) {
    if (!finite(tint)) {
        return core::refused(kNoNumber);
    }
    for (int c = 0; c < 3; ++c) {
        if (!(tint[c] >= 0.0 && tint[c] <= lighting::kMaxRadiance)) {
            return core::refused("a tint's factors lie from 0 to 1e9");
        }
    }
    return plain(tint);
}

core::Result<glm::dvec3> checkedAxis(const glm::dvec3& axis) {
    if (!finite(axis)) {
        return core::refused(kNoNumber);
    }
    // Shorter ones, and ones whose square is beyond a double, lighting takes for +Y.
    const double length = glm::length(axis);
    if (!(length > 1e-12) || !finite(length)) {
        return core::refused("an axis needs a direction");
    }
    return plain(axis);
}

core::Result<document::Key> checkedKey(document::Key key, lighting::LightKind kind) {
    const auto hour = checkedHour(key.hour);
    const auto tint = checkedTint(key.tint);
    auto gradient = checkedGradient(std::move(key.gradient), kind);
    if (!hour || !tint || !gradient) {
        return !hour ? hour.error() : !tint ? tint.error() : gradient.error();
    }
    key.hour = *hour;
    key.tint = *tint;
    key.gradient = std::move(*gradient);
    if (key.axis) {
        const auto axis = checkedAxis(*key.axis);
        if (!axis) {
            return axis.error();
        }
        key.axis = *axis;
    }
    return asReadUnknown(std::move(key), kind);
}

core::Result<document::Light> checkedValues(document::Light light) {
    if (light.axis) {
        const auto axis = checkedAxis(*light.axis);
        if (!axis) {
            return axis.error();
        }
        light.axis = *axis;
    }
    if (light.path) {
        if (!finite(light.path->latitude) || !finite(light.path->north)) {
            return core::refused(kNoNumber);
        }
        light.path->latitude = plain(light.path->latitude);
        light.path->north = plain(light.path->north);
    }
    auto keys = std::move(light.keys);
    document::Key dark; // a light without a key is refused
    dark.gradient.stops.resize(1);
    light.keys = {dark};
    document::Document document;
    document.lights.push_back(std::move(light));
    auto read = asRead(document);
    if (!read) {
        return core::refused(read.error().what);
    }
    light = std::move(read->lights.front());
    light.keys = std::move(keys);
    return light;
}

core::Result<document::Light> checkedLight(document::Light light) {
    if (light.keys.empty()) {
        return core::refused("a light needs at least one key");
    }
    for (document::Key& key : light.keys) {
        auto checked = checkedKey(std::move(key), light.kind);
        if (!checked) {
            return checked.error();
        }
        key = std::move(*checked);
    }
    return checkedValues(std::move(light));
}

core::Result<document::Document> asRead(const document::Document& document) {
    core::Tally warnings; // what is mended when lighting reads it stays as written
    return document::parseDocument(document::writeDocument(document), warnings);
}

bool tooBright(const document::Document& document) {
    for (const document::Light& light : document.lights) {
        for (const document::Key& key : light.keys) {
            const glm::dvec3 most = glm::dvec3(lighting::kMaxRadiance) / key.tint; // as lighting's
            for (const document::Stop& stop : key.gradient.stops) {
                if (glm::any(glm::greaterThan(lighting::radianceOf(stop.stop), most))) {
                    return true;
                }
            }
        }
    }
    return false;
}

core::Result<void> checkedSize(const document::Document& document) {
    // A stop's text is at most 5 numbers of 25 characters and 11 lines of indentation; a member
    // that no version knows grows by indentation, 2 blanks a level and a line break, each byte.
    constexpr std::size_t kStop = 512;
    constexpr std::size_t kPart = 4096;
    constexpr std::size_t kUnknownByte = 2 * document::kMaxDepth + 2;
    std::size_t most = kPart + document.unknown.size() * kUnknownByte;
    for (const document::Light& light : document.lights) {
        most += kPart + 6 * light.name.size() +
                kUnknownByte * (light.unknown.size() + light.pathUnknown.size());
        for (const document::Key& key : light.keys) {
            most += kPart + kUnknownByte * (key.unknown.size() + key.gradient.unknown.size()) +
                    kStop * key.gradient.stops.size();
            for (const document::Stop& stop : key.gradient.stops) {
                most += kUnknownByte * stop.unknown.size();
            }
        }
    }
    for (const document::Probe& probe : document.probes) {
        most += kPart +
                6 * (probe.probe.name.size() + probe.probe.node.size() + probe.probe.source.size());
        for (const auto* unknown : {&probe.unknown, &probe.captureUnknown, &probe.updateUnknown,
                                    &probe.influenceUnknown, &probe.proxyUnknown}) {
            most += kUnknownByte * unknown->size();
        }
    }
    for (const auto& [name, material] : document.materials) {
        most += kPart + 6 * name.size() + kUnknownByte * material.unknown.size();
    }
    if (most > document::kMaxTextBytes &&
        document::writeDocument(document).size() > document::kMaxTextBytes) {
        return core::refused("a lighting document has at most 64 MiB");
    }
    return {};
}

} // namespace lodestar::model

// SPDX-License-Identifier: MIT
//
// Values to text.
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include <glm/trigonometric.hpp>

#include "document/document.h"
#include "document/probe_text.h"
#include "document/reader.h"

namespace lodestar::document {
namespace {

constexpr std::array<const char*, 4> kInterpolations = {"linear", "constant", "smooth", "cubic"};
constexpr std::array<const char*, 3> kSpaces = {"linear", "oklab", "srgb"};

/// JSON has no NaN and no infinity.
double finite(double value) {
    return std::isfinite(value) ? value : 0.0;
}

/// The degrees of an angle: the shortest decimal that is read as the same radians, so that what was
/// read is written again.
double degrees(double radians) {
    const double value = finite(glm::degrees(radians));
    constexpr int kEnough = std::numeric_limits<double>::max_digits10;
    for (int digits = 1; digits <= kEnough; ++digits) {
        std::array<char, 40> text{};
        const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                       std::chars_format::general, digits);
        double shorter = 0.0;
        std::from_chars(text.data(), end.ptr, shorter);
        if (glm::radians(shorter) == radians) {
            return shorter;
        }
    }
    // Rounding has moved it by a few units in the last place.
    for (double near = value, far = value, i = 0; i < 4; ++i) {
        near = std::nextafter(near, 0.0);
        far = std::nextafter(far, 2.0 * value);
        for (const double each : {near, far}) {
            if (glm::radians(each) == radians) {
                return each;
            }
        }
    }
    return value;
}

Json toJson(const glm::dvec3& v) {
    return Json::array({finite(v.x), finite(v.y), finite(v.z)});
}

Json toJson(const Gradient& gradient) {
    Json object;
    object["interpolation"] = kInterpolations[static_cast<std::size_t>(gradient.interpolation)];
    object["space"] = kSpaces[static_cast<std::size_t>(gradient.space)];
    object["stops"] = Json::array();
    for (const Stop& stop : gradient.stops) {
        Json each;
        each["at"] = finite(stop.stop.at);
        each["color"] = toJson(stop.stop.color);
        each["ev"] = finite(stop.stop.ev);
        addUnknown(each, stop.unknown);
        object["stops"].push_back(std::move(each));
    }
    addUnknown(object, gradient.unknown);
    return object;
}

Json toJson(const Key& key) {
    Json object;
    object["hour"] = finite(key.hour);
    object["tint"] = toJson(key.tint);
    if (key.axis) {
        object["axis"] = toJson(*key.axis);
    }
    object["gradient"] = toJson(key.gradient);
    addUnknown(object, key.unknown);
    return object;
}

Json toJson(const Light& light) {
    Json object;
    if (!light.name.empty()) {
        object["name"] = light.name;
    }
    object["kind"] = light.kind == lighting::LightKind::Sky ? "sky" : "sun";
    if (light.axis) {
        object["axis"] = toJson(*light.axis);
    }
    if (light.path) {
        Json path;
        path["latitude"] = degrees(light.path->latitude);
        path["dayOfYear"] = light.path->dayOfYear;
        path["north"] = toJson(light.path->north);
        addUnknown(path, light.pathUnknown);
        object["path"] = std::move(path);
    }
    if (!light.visibility) {
        object["visibility"] = false;
    }
    if (light.add) {
        object["add"] = true;
    }
    object["keys"] = Json::array();
    for (const Key& key : light.keys) {
        object["keys"].push_back(toJson(key));
    }
    addUnknown(object, light.unknown);
    return object;
}

Json toJson(const Environment& environment) {
    Json object;
    object["source"] = environment.source;
    object["rotation"] = degrees(environment.rotation);
    object["ev"] = finite(environment.ev);
    addUnknown(object, environment.unknown);
    return object;
}

Json toJson(const Rsrm& rsrm) {
    Json object = Json::object();
    if (!rsrm.exponents.empty()) {
        object["exponents"] = Json::array();
        for (const double exponent : rsrm.exponents) {
            object["exponents"].push_back(finite(exponent));
        }
    }
    addUnknown(object, rsrm.unknown);
    return object;
}

Json toJson(const Material& material) {
    Json object = Json::object();
    if (material.exponent) {
        object["exponent"] =
            std::isinf(*material.exponent) ? Json("mirror") : Json(finite(*material.exponent));
    }
    if (material.diffuse) {
        object["diffuse"] = toJson(*material.diffuse);
    }
    if (material.f0) {
        object["f0"] = toJson(*material.f0);
    }
    if (material.specular) {
        object["specular"] = *material.specular;
    }
    if (material.tolerance) {
        object["tolerance"] = finite(*material.tolerance);
    }
    addUnknown(object, material.unknown);
    return object;
}

} // namespace

void addUnknown(Json& object, const Unknown& unknown) {
    if (unknown.empty()) {
        return;
    }
    const Json rest = Json::parse(unknown, nullptr, false);
    if (rest.is_object()) {
        for (const auto& [name, value] : rest.items()) {
            if (!object.contains(name)) {
                object[name] = value;
            }
        }
    }
}

std::string writeDocument(const Document& document) {
    Json object;
    object["lodestar"] = kVersion;
    if (document.environment) {
        object["environment"] = toJson(*document.environment);
    }
    object["lights"] = Json::array();
    for (const Light& light : document.lights) {
        object["lights"].push_back(toJson(light));
    }
    if (document.rsrm) {
        object["rsrm"] = toJson(*document.rsrm);
    }
    if (!document.probes.empty()) {
        object["probes"] = Json::array();
        for (const Probe& probe : document.probes) {
            object["probes"].push_back(toJson(probe));
        }
    }
    if (!document.materials.empty()) {
        object["materials"] = Json::object();
        for (const auto& [name, material] : document.materials) {
            object["materials"][name] = toJson(material);
        }
    }
    addUnknown(object, document.unknown);
    // Texts that are no UTF-8 are replaced, not thrown over.
    return object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace lodestar::document

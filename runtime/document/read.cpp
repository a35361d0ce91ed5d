// SPDX-License-Identifier: MIT
//
// Text to values.
#include <cmath>
#include <limits>

#include <glm/trigonometric.hpp>

#include "document/document.h"
#include "document/probe_text.h"
#include "document/reader.h"
#include "lighting/estimator.h"

namespace lodestar::document {
namespace {

using lighting::GradientInterpolation;
using lighting::GradientSpace;
using lighting::LightKind;

constexpr double kMaxExponent = 1e7;
constexpr double kMaxEv = 64.0;

Stop readStop(const Reader& reader) {
    Stop stop;
    if (!reader.isObject()) {
        return stop;
    }
    if (const auto at = reader.needed("at")) {
        stop.stop.at = at->number();
    }
    if (const auto color = reader.needed("color")) {
        stop.stop.color = color->vector();
    }
    if (const auto ev = reader.member("ev")) {
        stop.stop.ev = ev->number();
    }
    stop.unknown = reader.unknown({"at", "color", "ev"});
    return stop;
}

Gradient readGradient(const Reader& reader) {
    Gradient gradient;
    if (!reader.isObject()) {
        return gradient;
    }
    if (const auto stops = reader.needed("stops")) {
        stops->forEach([&](const Reader& stop) { gradient.stops.push_back(readStop(stop)); });
    }
    if (const auto interpolation = reader.member("interpolation")) {
        gradient.interpolation = static_cast<GradientInterpolation>(
            interpolation->word({"linear", "constant", "smooth", "cubic"}));
    }
    if (const auto space = reader.member("space")) {
        gradient.space = static_cast<GradientSpace>(space->word({"linear", "oklab", "srgb"}));
    }
    gradient.unknown = reader.unknown({"stops", "interpolation", "space"});
    return gradient;
}

Key readKey(const Reader& reader) {
    Key key;
    if (!reader.isObject()) {
        return key;
    }
    if (const auto hour = reader.needed("hour")) {
        key.hour = hour->number();
    }
    if (const auto gradient = reader.needed("gradient")) {
        key.gradient = readGradient(*gradient);
    }
    if (const auto tint = reader.member("tint")) {
        key.tint = tint->vector();
    }
    if (const auto axis = reader.member("axis")) {
        key.axis = axis->vector();
    }
    key.unknown = reader.unknown({"hour", "gradient", "tint", "axis"});
    return key;
}

lighting::SunPath readPath(const Reader& reader, Unknown& unknown) {
    lighting::SunPath path;
    if (!reader.isObject()) {
        return path;
    }
    if (const auto latitude = reader.needed("latitude")) {
        path.latitude =
            glm::radians(latitude->numberIn(-90.0, 90.0, "a latitude lies from -90 to 90 degrees"));
    }
    if (const auto day = reader.member("dayOfYear")) {
        const double value = day->numberIn(1.0, 366.0, "a day of the year lies from 1 to 366");
        if (value != std::floor(value)) {
            day->refuse("a day of the year is a whole number");
        }
        path.dayOfYear = static_cast<int>(value);
    }
    if (const auto north = reader.member("north")) {
        path.north = north->vector();
    }
    unknown = reader.unknown({"latitude", "dayOfYear", "north"});
    return path;
}

Light readLight(const Reader& reader) {
    Light light;
    if (!reader.isObject()) {
        return light;
    }
    if (const auto name = reader.member("name")) {
        light.name = name->text();
    }
    if (const auto kind = reader.needed("kind")) {
        light.kind = static_cast<LightKind>(kind->word({"sky", "sun"}));
    }
    if (const auto axis = reader.member("axis")) {
        light.axis = axis->vector();
    }
    if (const auto path = reader.member("path")) {
        light.path = readPath(*path, light.pathUnknown);
        if (light.kind == LightKind::Sky) {
            path->refuse("a sky has no path; a sun has");
        }
    }
    if (const auto keys = reader.needed("keys")) {
        keys->forEach([&](const Reader& key) { light.keys.push_back(readKey(key)); });
    }
    if (const auto visibility = reader.member("visibility")) {
        light.visibility = visibility->boolean();
    }
    if (const auto add = reader.member("add")) {
        light.add = add->boolean();
    }
    light.unknown = reader.unknown({"name", "kind", "axis", "path", "keys", "visibility", "add"});
    return light;
}

Environment readEnvironment(const Reader& reader) {
    Environment environment;
    if (!reader.isObject()) {
        return environment;
    }
    if (const auto source = reader.needed("source")) {
        environment.source = source->text();
        if (environment.source.empty()) {
            source->refuse("a source is a file or an analytic map");
        }
    }
    if (const auto rotation = reader.member("rotation")) {
        environment.rotation =
            glm::radians(rotation->numberIn(-1e6, 1e6, "a rotation lies within a million degrees"));
    }
    if (const auto ev = reader.member("ev")) {
        environment.ev = ev->numberIn(-kMaxEv, kMaxEv, "an ev lies from -64 to 64 stops");
    }
    environment.unknown = reader.unknown({"source", "rotation", "ev"});
    return environment;
}

Rsrm readRsrm(const Reader& reader) {
    Rsrm rsrm;
    if (!reader.isObject()) {
        return rsrm;
    }
    if (const auto exponents = reader.member("exponents")) {
        std::vector<Reader> places;
        exponents->forEach([&](const Reader& exponent) {
            rsrm.exponents.push_back(exponent.number());
            places.push_back(exponent);
        });
        const lighting::RowsFault fault = lighting::faultOfRows(rsrm.exponents);
        if (!fault.words.empty()) {
            (fault.row < places.size() ? places[fault.row] : *exponents)
                .refuse("exponents of rows: " + fault.words);
        }
    }
    rsrm.unknown = reader.unknown({"exponents"});
    return rsrm;
}

glm::dvec3 readReflectance(const Reader& reader) {
    const glm::dvec3 value = reader.vector();
    for (int c = 0; c < 3; ++c) {
        if (!(value[c] >= 0.0 && value[c] <= 1.0)) {
            reader.refuse("a reflectance lies in [0, 1]");
        }
    }
    return value;
}

Material readMaterial(const Reader& reader) {
    Material material;
    if (!reader.isObject()) {
        return material;
    }
    if (const auto exponent = reader.member("exponent")) {
        const bool mirror = exponent->json().is_string() && exponent->text() == "mirror";
        material.exponent =
            mirror ? std::numeric_limits<double>::infinity()
                   : exponent->numberIn(0.0, kMaxExponent,
                                        "an exponent lies from 0 to 1e7, or is \"mirror\"");
    }
    if (const auto diffuse = reader.member("diffuse")) {
        material.diffuse = readReflectance(*diffuse);
    }
    if (const auto f0 = reader.member("f0")) {
        material.f0 = readReflectance(*f0);
    }
    if (const auto specular = reader.member("specular")) {
        material.specular = specular->text();
        const auto estimator = lighting::parseEstimator(*material.specular, lighting::Term::Glossy);
        if (!estimator) {
            specular->refuse(estimator.error().what);
        }
    }
    if (const auto tolerance = reader.member("tolerance")) {
        material.tolerance = tolerance->numberIn(std::numeric_limits<double>::min(), 1e9,
                                                 "a tolerance is a relative error above 0");
    }
    material.unknown = reader.unknown({"exponent", "diffuse", "f0", "specular", "tolerance"});
    return material;
}

void readVersion(const Reader& reader) {
    if (const auto version = reader.needed("lodestar")) {
        if (version->json() != kVersion) {
            version->refuse("the version is not 1, the one that is read");
        }
    }
}

Document readDocument(const Reader& reader) {
    Document document;
    if (const auto environment = reader.member("environment")) {
        document.environment = readEnvironment(*environment);
    }
    if (const auto lights = reader.member("lights")) {
        lights->forEach([&](const Reader& light) { document.lights.push_back(readLight(light)); });
    }
    if (const auto rsrm = reader.member("rsrm")) {
        document.rsrm = readRsrm(*rsrm);
    }
    if (const auto probes = reader.member("probes")) {
        probes->forEach([&](const Reader& probe) { document.probes.push_back(readProbe(probe)); });
    }
    if (const auto materials = reader.member("materials"); materials && materials->isObject()) {
        for (const auto& [name, value] : materials->json().items()) {
            document.materials[name] = readMaterial(*materials->member(name));
        }
    }
    document.unknown =
        reader.unknown({"lodestar", "environment", "lights", "rsrm", "probes", "materials"});
    return document;
}

} // namespace

core::Result<Document> parseDocument(std::string_view text, core::Tally& warnings) {
    const auto tree = parseTree(text);
    if (!tree) {
        return tree.error();
    }
    Refusal refusal;
    const Reader root(tree->json(), {}, refusal);
    Document document;
    if (root.isObject()) {
        readVersion(root);
        if (!refusal) {
            document = readDocument(root);
        }
    }
    if (refusal) {
        return *refusal;
    }
    // Judged, and counted, by the rules of lighting; the values stay as written.
    if (const auto lights = dayLights(document, warnings); !lights) {
        return lights.error();
    }
    for (const Probe& probe : document.probes) {
        const glm::dvec3& size = probe.probe.influence.size;
        warnings.add("light probe without an inside, lights nothing",
                     size.x > 0.0 && size.y > 0.0 && size.z > 0.0 ? 0 : 1);
    }
    return document;
}

} // namespace lodestar::document

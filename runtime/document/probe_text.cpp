// SPDX-License-Identifier: MIT
#include "document/probe_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace lodestar::document {
namespace {

using lighting::ProbeRelight;
using lighting::ProbeUpdate;
using lighting::ProbeVolume;
using lighting::VolumeShape;

constexpr double kGreatestLength = 1e9; ///< metres
constexpr int kWidestCapture = 16384;   ///< texels

int wholeIn(const Reader& reader, double least, double greatest, const char* rule) {
    const double value = reader.numberIn(least, greatest, rule);
    if (value != std::floor(value)) {
        reader.refuse(rule);
    }
    return static_cast<int>(value);
}

glm::dvec3 vectorAtLeastZero(const Reader& reader, const char* rule) {
    const glm::dvec3 value = reader.vector();
    for (int c = 0; c < 3; ++c) {
        if (!(value[c] >= 0.0 && value[c] <= kGreatestLength)) {
            reader.refuse(rule);
        }
    }
    return value;
}

std::array<double, 6> readBlend(const Reader& reader) {
    constexpr const char* kRule = "a blend is one number of metres or six, at least 0";
    std::array<double, 6> blend{};
    if (!reader.json().is_array()) {
        blend.fill(reader.numberIn(0.0, kGreatestLength, kRule));
        return blend;
    }
    std::size_t count = 0;
    reader.forEach([&](const Reader& element) {
        if (count < blend.size()) {
            blend[count] = element.numberIn(0.0, kGreatestLength, kRule);
        }
        ++count;
    });
    if (count != blend.size()) {
        reader.refuse(kRule);
    }
    return blend;
}

ProbeVolume readVolume(const Reader& reader, Unknown& unknown) {
    constexpr const char* kSizeRule = "a size has three extents in metres, at least 0";
    ProbeVolume volume;
    if (!reader.isObject()) {
        return volume;
    }
    if (const auto shape = reader.member("shape")) {
        volume.shape = static_cast<VolumeShape>(shape->word({"box", "sphere"}));
    }
    if (const auto center = reader.member("center")) {
        volume.center = center->vector();
    }
    const auto size = reader.member("size");
    const auto radius = reader.member("radius");
    if (volume.shape == VolumeShape::Sphere) {
        if (const auto needed = reader.needed("radius")) {
            volume.size = glm::dvec3(
                2.0 * needed->numberIn(0.0, kGreatestLength, "a radius is at least 0 metres"));
        }
        if (size) {
            size->refuse("a sphere has a radius; a box has a size");
        }
    } else {
        if (const auto needed = reader.needed("size")) {
            volume.size = vectorAtLeastZero(*needed, kSizeRule);
        }
        if (radius) {
            radius->refuse("a box has a size; a sphere has a radius");
        }
    }
    if (const auto blend = reader.member("blend")) {
        volume.blend = readBlend(*blend);
    }
    unknown = reader.unknown({"shape", "center", "size", "radius", "blend"});
    return volume;
}

lighting::ProbeCapture readCapture(const Reader& reader, Unknown& unknown) {
    lighting::ProbeCapture capture;
    if (!reader.isObject()) {
        return capture;
    }
    if (const auto resolution = reader.member("resolution")) {
        capture.resolution = wholeIn(*resolution, 1.0, kWidestCapture,
                                     "a resolution is a whole number of texels from 1 to 16384");
    }
    constexpr double kLeastPlane = 1e-6;
    if (const auto nearPlane = reader.member("near")) {
        capture.nearPlane = nearPlane->numberIn(kLeastPlane, kGreatestLength,
                                                "a near plane lies before the probe, above 0");
    }
    if (const auto farPlane = reader.member("far")) {
        capture.farPlane =
            farPlane->numberIn(kLeastPlane, kGreatestLength, "a far plane lies above 0");
    }
    if (!(capture.farPlane > capture.nearPlane)) {
        reader.refuse("the far plane lies beyond the near one");
    }
    if (const auto layers = reader.member("layers")) {
        const double mask =
            layers->numberIn(0.0, 4294967295.0, "layers are a mask of 32 bits, 0 to 4294967295");
        if (mask != std::floor(mask)) {
            layers->refuse("layers are a mask of 32 bits, 0 to 4294967295");
        }
        capture.layers = static_cast<std::uint32_t>(mask);
    }
    unknown = reader.unknown({"resolution", "near", "far", "layers"});
    return capture;
}

void readUpdate(const Reader& reader, Probe& probe) {
    if (reader.json().is_object()) {
        probe.probe.update = ProbeUpdate::Every;
        if (const auto every = reader.needed("every")) {
            probe.probe.every =
                wholeIn(*every, 1.0, 1e9, "every is a whole number of frames, at least 1");
        }
        probe.updateUnknown = reader.unknown({"every"});
        return;
    }
    constexpr std::array<ProbeUpdate, 4> kUpdates = {ProbeUpdate::Once, ProbeUpdate::OnChange,
                                                     ProbeUpdate::Always, ProbeUpdate::OnDemand};
    probe.probe.update = kUpdates[reader.word({"once", "on-change", "always", "on-demand"})];
}

void readLight(const Reader& reader, lighting::Probe& probe) {
    if (const auto priority = reader.member("priority")) {
        probe.priority =
            wholeIn(*priority, -1e6, 1e6, "a priority is a whole number within a million");
    }
    if (const auto exterior = reader.member("exterior")) {
        probe.exterior = exterior->boolean();
    }
    if (const auto tint = reader.member("tint")) {
        probe.tint = vectorAtLeastZero(*tint, "a tint has three factors, at least 0");
    }
    if (const auto intensity = reader.member("intensity")) {
        probe.intensity = intensity->numberIn(0.0, 1e6, "an intensity is a factor from 0 to 1e6");
    }
}

double finite(double value) {
    return std::isfinite(value) ? value : 0.0;
}

Json toJson(const glm::dvec3& v) {
    return Json::array({finite(v.x), finite(v.y), finite(v.z)});
}

Json toJson(const ProbeVolume& volume, const Unknown& unknown) {
    Json object;
    const bool sphere = volume.shape == VolumeShape::Sphere;
    object["shape"] = sphere ? "sphere" : "box";
    object["center"] = toJson(volume.center);
    if (sphere) {
        object["radius"] = finite(0.5 * volume.size.x);
    } else {
        object["size"] = toJson(volume.size);
    }
    const bool even = std::all_of(volume.blend.begin(), volume.blend.end(),
                                  [&](double each) { return each == volume.blend[0]; });
    object["blend"] = even ? Json(finite(volume.blend[0])) : Json(volume.blend);
    addUnknown(object, unknown);
    return object;
}

} // namespace

Probe readProbe(const Reader& reader) {
    Probe probe;
    if (!reader.isObject()) {
        return probe;
    }
    lighting::Probe& values = probe.probe;
    if (const auto name = reader.member("name")) {
        values.name = name->text();
    }
    if (const auto node = reader.member("node")) {
        values.node = node->text();
        if (values.node.empty()) {
            node->refuse("a node has a name");
        }
    }
    if (const auto position = reader.member("position")) {
        values.position = position->vector();
    }
    if (const auto source = reader.member("source")) {
        values.source = source->text();
        if (values.source.empty()) {
            source->refuse("a source is a file or an analytic map");
        }
    }
    if (const auto capture = reader.member("capture")) {
        values.capture = readCapture(*capture, probe.captureUnknown);
    }
    if (const auto update = reader.member("update")) {
        readUpdate(*update, probe);
    }
    if (const auto relight = reader.member("relight")) {
        constexpr std::array<ProbeRelight, 2> kRelights = {ProbeRelight::Compose,
                                                           ProbeRelight::Ratio};
        values.relight = kRelights[relight->word({"compose", "ratio"})];
    }
    if (const auto influence = reader.member("influence")) {
        values.influence = readVolume(*influence, probe.influenceUnknown);
    }
    if (const auto proxy = reader.member("proxy")) {
        values.proxy = readVolume(*proxy, probe.proxyUnknown);
    }
    readLight(reader, values);
    probe.unknown =
        reader.unknown({"name", "node", "position", "source", "capture", "update", "relight",
                        "influence", "proxy", "priority", "exterior", "tint", "intensity"});
    return probe;
}

Json toJson(const Probe& probe) {
    const lighting::Probe& values = probe.probe;
    Json object;
    if (!values.name.empty()) {
        object["name"] = values.name;
    }
    if (!values.node.empty()) {
        object["node"] = values.node;
    }
    object["position"] = toJson(values.position);
    if (!values.source.empty()) {
        object["source"] = values.source;
    }
    Json capture;
    capture["resolution"] = values.capture.resolution;
    capture["near"] = finite(values.capture.nearPlane);
    capture["far"] = finite(values.capture.farPlane);
    if (values.capture.layers != std::numeric_limits<std::uint32_t>::max()) {
        capture["layers"] = values.capture.layers;
    }
    addUnknown(capture, probe.captureUnknown);
    object["capture"] = std::move(capture);
    if (values.update == ProbeUpdate::Every) {
        Json every;
        every["every"] = values.every;
        addUnknown(every, probe.updateUnknown);
        object["update"] = std::move(every);
    } else {
        object["update"] = values.update == ProbeUpdate::Once       ? "once"
                           : values.update == ProbeUpdate::OnChange ? "on-change"
                           : values.update == ProbeUpdate::Always   ? "always"
                                                                    : "on-demand";
    }
    if (values.relight == ProbeRelight::Ratio) {
        object["relight"] = "ratio";
    }
    object["influence"] = toJson(values.influence, probe.influenceUnknown);
    if (values.proxy) {
        object["proxy"] = toJson(*values.proxy, probe.proxyUnknown);
    }
    object["priority"] = values.priority;
    object["exterior"] = values.exterior;
    object["tint"] = toJson(values.tint);
    object["intensity"] = finite(values.intensity);
    addUnknown(object, probe.unknown);
    return object;
}

} // namespace lodestar::document

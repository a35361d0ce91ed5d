// SPDX-License-Identifier: MIT
//
// Documents to edit, and what tests ask of a model.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "document/document.h"
#include "model/model.h"
#include "model/ramp.h"

namespace lodestar::model {

/// A sky of two keys, a sun of two, a probe, two materials, an environment, and members that no
/// version knows wherever they may be.
inline constexpr const char* kDocument = R"({
  "lodestar": 1, "future": {"a": [1, 2.5, "three"]},
  "environment": {"source": "constant:0.1,0.2,0.3", "rotation": 30.7, "ev": 0.25, "note": "x"},
  "lights": [
    {"name": "sky", "kind": "sky", "axis": [0, 1, 0], "mood": true, "keys": [
      {"hour": 6, "tint": [1, 0.9, 0.8], "who": "a", "gradient": {"interpolation": "linear",
        "space": "linear", "made": 1, "stops": [
          {"at": 90, "color": [0.1, 0.2, 0.4], "ev": 0.5, "pin": 7},
          {"at": 20, "color": [0.5, 0.5, 0.5]},
          {"at": 0, "color": [1, 0.7, 0.3]},
          {"at": 0, "color": [0.1, 0.1, 0.1]},
          {"at": -90, "color": [0.05, 0.05, 0.05]}]}},
      {"hour": 18, "gradient": {"interpolation": "smooth", "space": "oklab", "stops": [
          {"at": 90, "color": [0.2, 0.1, 0.1]},
          {"at": 10, "color": [0.9, 0.3, 0.1], "ev": 1},
          {"at": -90, "color": [0.02, 0.02, 0.03]}]}}]},
    {"name": "sun", "kind": "sun", "visibility": false,
      "path": {"latitude": 51.477, "dayOfYear": 172, "north": [0, 0, -1], "city": "Greenwich"},
      "keys": [
        {"hour": 5, "tint": [0.1, 0.05, 0.02], "gradient": {"stops": [
          {"at": 0, "color": [1, 0.9, 0.8], "ev": 14}, {"at": 0.27, "color": [1, 0.9, 0.8], "ev": 14},
          {"at": 0.27, "color": [1, 1, 1], "ev": 4}, {"at": 20, "color": [0, 0, 0]}]}},
        {"hour": 12, "tint": [1, 1, 1], "gradient": {"stops": [
          {"at": 0, "color": [1, 1, 1], "ev": 15}, {"at": 0.27, "color": [1, 1, 1], "ev": 15}]}}]}],
  "probes": [{"name": "hall", "position": [1, 2, 3], "secret": {"deep": [[[]]]},
    "capture": {"resolution": 64, "near": 0.1, "far": 50, "lens": 2},
    "influence": {"shape": "sphere", "radius": 4, "blend": 1, "kind": "soft"}}],
  "materials": {"gold": {"exponent": 64, "f0": [1, 0.8, 0.3], "vendor": 3}, "#2": {"exponent": "mirror"}}
})";

inline document::Document documentOf(const std::string& text) {
    core::Tally warnings;
    auto document = document::parseDocument(text, warnings);
    EXPECT_TRUE(document) << (document ? "" : document.error().message());
    return document ? std::move(*document) : document::Document{};
}

inline Model sampleModel() {
    return Model(documentOf(kDocument));
}

inline std::string textOf(const Model& model) {
    return document::writeDocument(model.document());
}

/// A document of one light with one key, linear in linear radiance.
inline Model modelOf(lighting::LightKind kind, const std::vector<lighting::GradientStop>& stops) {
    document::Document document;
    document.lights.emplace_back();
    document.lights[0].kind = kind;
    document.lights[0].keys.emplace_back();
    document.lights[0].keys[0].hour = 12.0;
    for (const lighting::GradientStop& stop : stops) {
        document.lights[0].keys[0].gradient.stops.push_back({stop, {}});
    }
    return Model(std::move(document));
}

inline Id keyId(const Model& model, std::size_t light = 0, std::size_t key = 0) {
    return model.ids().lights.at(light).keys.at(key).id;
}

inline Id stopId(const Model& model, std::size_t stop, std::size_t light = 0, std::size_t key = 0) {
    return model.ids().lights.at(light).keys.at(key).stops.at(stop);
}

/// The gradient's stops.
inline const std::vector<document::Stop>& stopsOf(const Model& model, std::size_t light = 0,
                                                  std::size_t key = 0) {
    return model.document().lights.at(light).keys.at(key).gradient.stops;
}

inline std::vector<double> placesOf(const Model& model, std::size_t light = 0,
                                    std::size_t key = 0) {
    std::vector<double> places;
    for (const document::Stop& stop : stopsOf(model, light, key)) {
        places.push_back(stop.stop.at);
    }
    return places;
}

/// Red radiance of a gradient at a place.
inline double redAt(const Model& model, double at, std::size_t light = 0, std::size_t key = 0) {
    const document::Light& from = model.document().lights.at(light);
    return radianceAt(from.keys.at(key).gradient, from.kind, {&at, 1}).front().r;
}

/// Carries a command out that must do something.
inline Outcome did(Model& model, const Command& command, MergeToken token = 0) {
    const auto outcome = model.execute(command, token);
    EXPECT_TRUE(outcome) << nameOf(command) << ": " << (outcome ? "" : outcome.error().message());
    EXPECT_TRUE(outcome && outcome->changed) << nameOf(command);
    return outcome ? *outcome : Outcome{};
}

/// Why a command is refused; the document must stay as it was.
inline std::string refusal(Model& model, const Command& command) {
    const std::string before = textOf(model);
    const std::size_t steps = model.undoCount();
    const auto outcome = model.execute(command);
    EXPECT_FALSE(outcome) << nameOf(command);
    EXPECT_EQ(textOf(model), before) << nameOf(command);
    EXPECT_EQ(model.undoCount(), steps) << nameOf(command);
    return outcome ? std::string() : outcome.error().what;
}

} // namespace lodestar::model

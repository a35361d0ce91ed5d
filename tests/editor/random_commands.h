// SPDX-License-Identifier: MIT
//
// Commands of every kind on whatever a model holds, wild values among them.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "model_support.h"

namespace lodestar::model {

using lighting::GradientInterpolation;
using lighting::GradientSpace;
using lighting::LightKind;

/// Values and names at random, most of them sensible.
class Chance {
public:
    explicit Chance(std::uint64_t seed) : engine_(seed) {}

    std::size_t below(std::size_t n) {
        return n == 0 ? 0 : std::uniform_int_distribution<std::size_t>(0, n - 1)(engine_);
    }
    bool one(std::size_t in) { return below(in) == 0; }
    double between(double a, double b) {
        return std::uniform_real_distribution<double>(a, b)(engine_);
    }
    /// Within a range, one in 40 anything that a double can be.
    double number(double a, double b) {
        if (!one(40)) {
            return one(5) ? std::round(between(a, b)) : between(a, b);
        }
        constexpr double kWild[] = {std::numeric_limits<double>::quiet_NaN(),
                                    std::numeric_limits<double>::infinity(),
                                    -std::numeric_limits<double>::infinity(),
                                    std::numeric_limits<double>::denorm_min(),
                                    std::numeric_limits<double>::max(),
                                    -0.0,
                                    -1.0,
                                    1e300,
                                    1e-300,
                                    0.1 + 0.2};
        return kWild[below(std::size(kWild))];
    }
    glm::dvec3 vector(double a, double b) { return {number(a, b), number(a, b), number(a, b)}; }
    template <class T>
    std::optional<T> maybe(T value) {
        return one(2) ? std::optional<T>(std::move(value)) : std::nullopt;
    }
    std::string name() {
        constexpr const char* kNames[] = {"gold", "#2",    "a \"quoted\" one", "wand\xc3\xa4",
                                          "",     "x/y~z", "\xff broken"};
        return kNames[below(std::size(kNames))];
    }

private:
    std::mt19937_64 engine_;
};

class Generator {
public:
    Generator(std::uint64_t seed, const Model& model) : chance_(seed), model_(model) {}

    Command next() {
        std::size_t stops = 0;
        for (const LightIds& light : ids().lights) {
            for (const KeyIds& key : light.keys) {
                stops += key.stops.size();
                if (key.stops.size() > 120) {
                    return SimplifyStops{key.id, 3 + chance_.below(6)};
                }
            }
        }
        if (ids().lights.size() > 5 || stops > 1500) {
            return RemoveLight{ids().lights.front().id};
        }
        return make(chance_.below(std::variant_size_v<Command>));
    }

    Chance& chance() { return chance_; }

private:
    [[nodiscard]] const Identities& ids() const { return model_.ids(); }

    Id light() {
        return ids().lights.empty() || chance_.one(50)
                   ? static_cast<Id>(chance_.below(1000))
                   : ids().lights[chance_.below(ids().lights.size())].id;
    }
    const KeyIds* keyNames() {
        if (ids().lights.empty()) {
            return nullptr;
        }
        const auto& keys = ids().lights[chance_.below(ids().lights.size())].keys;
        return &keys[chance_.below(keys.size())];
    }
    Id key() {
        const KeyIds* const names = keyNames();
        return names == nullptr || chance_.one(50) ? Id::None : names->id;
    }
    std::vector<Id> stops() {
        std::vector<Id> list;
        const KeyIds* names = keyNames();
        for (std::size_t i = 0; names != nullptr && i < 1 + chance_.below(3); ++i) {
            list.push_back(names->stops[chance_.below(names->stops.size())]);
            names = chance_.one(5) ? keyNames() : names;
        }
        return list;
    }
    std::vector<Id> probes() {
        return ids().probes.empty()
                   ? std::vector<Id>{Id::None}
                   : std::vector<Id>{ids().probes[chance_.below(ids().probes.size())]};
    }
    double at() { return chance_.number(-95.0, 185.0); }
    double hour() { return chance_.number(-2.0, 26.0); }
    document::Stop stop() {
        return {{at(), chance_.vector(0.0, 2.0), chance_.number(-3.0, 12.0)},
                chance_.one(10) ? R"({"tag":[1,{"b":null}]})" : ""};
    }
    document::Gradient gradient() {
        document::Gradient made;
        for (std::size_t i = 0; i < chance_.below(8); ++i) {
            made.stops.push_back(stop());
        }
        made.interpolation = static_cast<GradientInterpolation>(chance_.below(4));
        made.space = static_cast<GradientSpace>(chance_.below(3));
        return made;
    }
    document::Key documentKey() {
        document::Key made;
        made.hour = hour();
        made.gradient = gradient();
        made.tint = chance_.vector(0.0, 2.0);
        made.axis = chance_.maybe(chance_.vector(-1.0, 1.0));
        return made;
    }
    lighting::SunPath path() {
        return {chance_.number(-1.6, 1.6), static_cast<int>(chance_.below(368)),
                chance_.vector(-1.0, 1.0)};
    }
    document::Light documentLight() {
        document::Light made;
        made.name = chance_.name();
        made.kind = chance_.one(2) ? LightKind::Sky : LightKind::Sun;
        made.axis = chance_.maybe(chance_.vector(-1.0, 1.0));
        made.path = chance_.one(3) ? std::optional(path()) : std::nullopt;
        for (std::size_t i = 0; i < chance_.below(4); ++i) {
            made.keys.push_back(documentKey());
        }
        return made;
    }
    lighting::Probe probe() {
        lighting::Probe made;
        made.name = chance_.name();
        made.position = chance_.vector(-9.0, 9.0);
        made.capture.resolution = static_cast<int>(chance_.below(300));
        made.capture.nearPlane = chance_.number(0.0, 1.0);
        made.influence.shape = static_cast<lighting::VolumeShape>(chance_.below(2));
        made.influence.size = chance_.vector(0.0, 9.0);
        made.influence.blend[chance_.below(6)] = chance_.number(0.0, 2.0);
        made.proxy = chance_.maybe(made.influence);
        made.update = static_cast<lighting::ProbeUpdate>(chance_.below(5));
        made.every = static_cast<int>(chance_.below(5));
        made.tint = chance_.vector(0.0, 2.0);
        made.intensity = chance_.number(0.0, 4.0);
        return made;
    }
    /// Most of them in order, a step too near now and then.
    std::vector<double> rows() {
        std::vector<double> made;
        double exponent = chance_.number(0.9, 4.0);
        for (std::size_t i = 0; i < chance_.below(26); ++i) {
            made.push_back(exponent);
            exponent *= chance_.number(1.009, 2.0);
        }
        return made;
    }
    BrushStroke stroke() {
        BrushStroke made{key(),
                         {static_cast<BrushMode>(chance_.below(2)), chance_.number(0.01, 60.0),
                          chance_.one(4) ? 0.0 : chance_.number(0.0, 1.0), chance_.number(0.0, 1.0),
                          chance_.vector(0.0, 3.0)},
                         {}};
        for (std::size_t i = 0; i < chance_.below(5); ++i) {
            made.path.push_back(at());
        }
        return made;
    }
    SetMaterials materials() {
        constexpr const char* kEstimators[] = {"tent", "ring:3", "auto:0.05", "nonsense",
                                               "taps:32"};
        return {{chance_.name(), chance_.name()},
                chance_.maybe(chance_.number(0.0, 500.0)),
                chance_.maybe(chance_.vector(0.0, 1.0)),
                chance_.maybe(chance_.vector(0.0, 1.0)),
                chance_.maybe(std::string(kEstimators[chance_.below(5)])),
                chance_.maybe(chance_.number(0.0, 1.0))};
    }

    /// A command of one type of the variant.
    Command make(std::size_t type) {
        switch (type) {
        case 0:
            return AddStop{key(), at()};
        case 1:
            return InsertStops{key(), gradient().stops};
        case 2: {
            MoveStops moves;
            for (const Id id : stops()) {
                moves.moves.push_back({id, at()});
            }
            return moves;
        }
        case 3:
            return SetStops{stops(), chance_.maybe(at()), chance_.maybe(chance_.vector(0.0, 2.0)),
                            chance_.maybe(chance_.number(-2.0, 4.0))};
        case 4:
            return DeleteStops{stops()};
        case 5:
            return ReverseStops{key()};
        case 6:
            return MirrorStops{key()};
        case 7:
            return DistributeStops{key(), chance_.one(2)};
        case 8:
            return SimplifyStops{key(), 1 + chance_.below(20)};
        case 9:
            return SetGradient{key(), gradient()};
        case 10:
            return SetInterpolation{key(), static_cast<GradientInterpolation>(chance_.below(4))};
        case 11:
            return SetSpace{key(), static_cast<GradientSpace>(chance_.below(3))};
        case 12:
            return stroke();
        default:
            return makeLight(type);
        }
    }
    Command makeLight(std::size_t type) {
        switch (type) {
        case 13:
            return AddKey{light(), hour()};
        case 14:
            return InsertKey{light(), documentKey()};
        case 15:
            return MoveKey{key(), hour()};
        case 16:
            return CopyKey{key(), hour()};
        case 17:
            return DeleteKey{key()};
        case 18: {
            SetKey set{key(), chance_.maybe(chance_.vector(0.0, 2.0)), std::nullopt};
            if (chance_.one(2)) {
                set.axis = chance_.maybe(chance_.vector(-1.0, 1.0));
            }
            return set;
        }
        case 19:
            return AddLight{documentLight()};
        case 20:
            return RemoveLight{light()};
        case 21: {
            SetLight set{light(), chance_.maybe(chance_.name()), {},
                         {},      chance_.maybe(chance_.one(2)), chance_.maybe(chance_.one(2))};
            if (chance_.one(2)) {
                set.axis = chance_.maybe(chance_.vector(-1.0, 1.0));
            }
            if (chance_.one(2)) {
                set.path = chance_.maybe(path());
            }
            return set;
        }
        case 22:
            return SetLights{{documentLight(), documentLight()}};
        default:
            return makeScene(type);
        }
    }
    Command makeScene(std::size_t type) {
        switch (type) {
        case 23:
            return SetEnvironment{
                chance_.maybe(chance_.one(2) ? std::string("sky.hdr") : "../" + chance_.name()),
                chance_.maybe(chance_.number(-10.0, 10.0)),
                chance_.maybe(chance_.number(-5.0, 5.0))};
        case 24:
            return RemoveEnvironment{};
        case 25:
            return materials();
        case 26:
            return ResetMaterials{{chance_.name()}, static_cast<MaterialField>(chance_.below(32))};
        case 27:
            return AddProbe{probe()};
        case 28:
            return SetProbe{probes().front(), probe()};
        case 29:
            return RemoveProbes{probes()};
        case 30:
            return SetMapRow{chance_.below(26), chance_.number(0.5, 3000.0)};
        case 31:
            return SetMapRows{rows()};
        default:
            return ReplaceDocument{documentOf(kDocument)};
        }
    }

    Chance chance_;
    const Model& model_;
};

} // namespace lodestar::model

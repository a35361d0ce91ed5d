// SPDX-License-Identifier: MIT
#include "model/clipboard.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

#include <nlohmann/json.hpp>

#include "model/ramp.h"

namespace lodestar::model {
namespace {

using lighting::LightKind;
using Json = nlohmann::json;

constexpr const char* kMember = "clipboard";
constexpr const char* kNoStop = "there is no such stop";
constexpr const char* kForeign = "the text is no stops, gradient, key or material of Lodestar's";

/// A document that is marked as a part of one.
std::string textOf(const std::string& what, document::Document document) {
    document.unknown = Json{{kMember, what}}.dump();
    return document::writeDocument(document);
}

std::string textOf(const std::string& what, LightKind kind, document::Key key) {
    document::Document document;
    document.lights.emplace_back();
    document.lights.front().kind = kind;
    document.lights.front().keys.push_back(std::move(key));
    return textOf(what, std::move(document));
}

/// What a document says it is a part of; empty if it does not.
std::string meaning(const document::Document& document) {
    const Json unknown = Json::parse(document.unknown, nullptr, false);
    const bool known = unknown.is_object() && unknown.contains(kMember) &&
                       unknown[kMember].is_string() && unknown.size() == 1;
    return known ? unknown[kMember].get<std::string>() : std::string();
}

/// Stops keep their angle from the axis.
void convert(document::Gradient& gradient, LightKind from, LightKind to) {
    for (document::Stop& stop : gradient.stops) {
        stop.stop.at = atFromAxis(fromAxis(stop.stop.at, from), to);
    }
}

core::Result<Command> pasteKey(const Model& model, document::Light light, const std::string& what,
                               const PasteTarget& target) {
    document::Key& key = light.keys.front();
    if (what == "key") {
        const document::Light* const place = model.light(target.light);
        if (place == nullptr) {
            return core::refused("a key is pasted into a light; none is selected");
        }
        convert(key.gradient, light.kind, place->kind);
        key.hour = target.hour;
        return Command(InsertKey{target.light, std::move(key)});
    }
    const document::Light* const place = model.light(model.lightOf(target.key));
    if (place == nullptr) {
        return core::refused("stops are pasted into a key's gradient; no key is selected");
    }
    convert(key.gradient, light.kind, place->kind);
    if (what == "gradient") {
        return Command(SetGradient{target.key, std::move(key.gradient)});
    }
    return Command(InsertStops{target.key, std::move(key.gradient.stops)});
}

Command pasteMaterial(const document::Material& material, const PasteTarget& target) {
    return SetMaterials{target.materials, material.exponent, material.diffuse,
                        material.f0,      material.specular, material.tolerance};
}

} // namespace

core::Result<std::string> copyStops(const Model& model, const std::vector<Id>& stops) {
    if (stops.empty()) {
        return core::refused("no stop is named");
    }
    const Id from = model.keyOf(stops.front());
    const auto place = findKey(model.ids(), from);
    if (!place) {
        return core::refused(kNoStop);
    }
    // In the gradient's order, not that of selecting.
    const std::unordered_set<Id> wanted(stops.begin(), stops.end());
    const document::Light& light = model.document().lights[place->light];
    const std::vector<Id>& names = model.ids().lights[place->light].keys[place->key].stops;
    document::Key key;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (wanted.contains(names[i])) {
            key.gradient.stops.push_back(light.keys[place->key].gradient.stops[i]);
        }
    }
    if (key.gradient.stops.size() != wanted.size()) {
        const bool known = std::all_of(wanted.begin(), wanted.end(),
                                       [&](Id id) { return model.keyOf(id) != Id::None; });
        return core::refused(known ? "stops of one gradient are copied at a time" : kNoStop);
    }
    return textOf("stops", light.kind, std::move(key));
}

core::Result<std::string> copyGradient(const Model& model, Id key) {
    const document::Key* const found = model.key(key);
    if (found == nullptr) {
        return core::refused("there is no such key");
    }
    document::Key copy;
    copy.gradient = found->gradient;
    return textOf("gradient", model.light(model.lightOf(key))->kind, std::move(copy));
}

core::Result<std::string> copyKey(const Model& model, Id key) {
    const document::Key* const found = model.key(key);
    if (found == nullptr) {
        return core::refused("there is no such key");
    }
    return textOf("key", model.light(model.lightOf(key))->kind, *found);
}

core::Result<std::string> copyMaterial(const Model& model, const std::string& name) {
    const auto found = model.document().materials.find(name);
    if (found == model.document().materials.end()) {
        return core::refused("the document gives that material no values");
    }
    document::Document document;
    document.materials.insert(*found);
    return textOf("material", std::move(document));
}

core::Result<Command> pasteCommand(const Model& model, std::string_view text,
                                   const PasteTarget& target) {
    core::Tally warnings; // what is mended when lighting reads it stays as written
    auto document = document::parseDocument(text, warnings);
    if (!document) {
        return core::refused(kForeign);
    }
    const std::string what = meaning(*document);
    if (what == "material" && document->materials.size() == 1) {
        if (target.materials.empty()) {
            return core::refused("a material is pasted onto others; none is selected");
        }
        return pasteMaterial(document->materials.begin()->second, target);
    }
    const bool ofLight = what == "stops" || what == "gradient" || what == "key";
    if (!ofLight || document->lights.size() != 1 || document->lights.front().keys.size() != 1) {
        return core::refused(kForeign);
    }
    return pasteKey(model, std::move(document->lights.front()), what, target);
}

} // namespace lodestar::model

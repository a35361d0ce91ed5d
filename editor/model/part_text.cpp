// SPDX-License-Identifier: MIT
#include "model/part_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>

namespace lodestar::model {
namespace {

constexpr std::array<const char*, 4> kInterpolations = {"linear", "constant", "smooth", "cubic"};
constexpr std::array<const char*, 3> kSpaces = {"linear", "oklab", "srgb"};
constexpr std::array<const char*, 2> kModes = {"paint", "smooth"};
constexpr std::array<const char*, 5> kFields = {"exponent", "diffuse", "f0", "specular",
                                                "tolerance"};

core::Result<std::size_t> choice(const Json& json, std::span<const char* const> names) {
    std::string known;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (json.is_string() && json.get<std::string>() == names[i]) {
            return i;
        }
        known += (i > 0 ? ", " : "") + std::string(names[i]);
    }
    return core::refused("must be one of " + known);
}

template <class T>
core::Result<void> readChoice(const Json& json, std::span<const char* const> names, T& value) {
    const auto chosen = choice(json, names);
    if (!chosen) {
        return chosen.error();
    }
    value = static_cast<T>(*chosen);
    return {};
}

/// A document around one part, as JSON, and the part's place in it.
Json around(const char* pointer, const Json& part) {
    Json whole = {{"lodestar", 1}};
    if (std::string_view(pointer).starts_with("/lights/0")) {
        whole["lights"] = Json::array(
            {{{"kind", "sun"},
              {"keys",
               Json::array({{{"hour", 0},
                             {"gradient",
                              {{"stops", Json::array({{{"at", 0}, {"color", {0, 0, 0}}}})}}}}})}}});
    }
    if (std::string_view(pointer).starts_with("/environment")) {
        whole["environment"] = {{"source", "constant:0"}};
    }
    whole[Json::json_pointer(pointer)] = part;
    return whole;
}

/// A part by the document's reader. @return the document around it
core::Result<document::Document> readAround(const char* pointer, const Json& part) {
    core::Tally mended; // by the command, or told when it is read again
    const Json whole = *pointer == '\0' ? part : around(pointer, part);
    auto read =
        document::parseDocument(whole.dump(-1, ' ', false, Json::error_handler_t::replace), mended);
    if (!read) {
        core::Error error = read.error();
        error.where.erase(0, std::string_view(pointer).size());
        return error;
    }
    return read;
}

Json partOf(const char* pointer, const document::Document& document) {
    return Json::parse(document::writeDocument(document)).at(Json::json_pointer(pointer));
}

document::Document holding(document::Light light) {
    document::Document document;
    document.lights.push_back(std::move(light));
    return document;
}
document::Document holding(document::Key key) {
    document::Light light;
    light.keys.push_back(std::move(key));
    return holding(std::move(light));
}
document::Document holding(document::Gradient gradient) {
    document::Key key;
    key.gradient = std::move(gradient);
    return holding(std::move(key));
}

/// A number in a pointer. @return none where there is no such
std::optional<std::size_t> takeNumber(std::string_view& text, std::string_view before) {
    if (!text.starts_with(before)) {
        return std::nullopt;
    }
    std::size_t number = 0;
    const char* const first = text.data() + before.size();
    const auto [end, error] = std::from_chars(first, text.data() + text.size(), number);
    if (error != std::errc() || (*first == '0' && end != first + 1)) {
        return std::nullopt;
    }
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return number;
}

constexpr const char* kGradient = "/lights/0/keys/0/gradient";
constexpr const char* kStops = "/lights/0/keys/0/gradient/stops";
constexpr const char* kKey = "/lights/0/keys/0";
constexpr const char* kLight = "/lights/0";
constexpr const char* kPath = "/lights/0/path";
constexpr const char* kRotation = "/environment/rotation";
constexpr const char* kProbe = "/probes/0";

} // namespace

std::string pointerOf(const Identities& ids, Id id) {
    const auto light = [](std::size_t i) { return "/lights/" + std::to_string(i); };
    const auto key = [&](std::size_t i, std::size_t k) {
        return light(i) + "/keys/" + std::to_string(k);
    };
    if (const auto place = findLight(ids, id)) {
        return light(*place);
    }
    if (const auto place = findKey(ids, id)) {
        return key(place->light, place->key);
    }
    if (const auto place = findStop(ids, id)) {
        return key(place->light, place->key) + "/gradient/stops/" + std::to_string(place->stop);
    }
    if (const auto place = findProbe(ids, id)) {
        return "/probes/" + std::to_string(*place);
    }
    return {};
}

Id partAt(const Identities& ids, std::string_view pointer) {
    if (const auto probe = takeNumber(pointer, "/probes/")) {
        return pointer.empty() && *probe < ids.probes.size() ? ids.probes[*probe] : Id::None;
    }
    const auto light = takeNumber(pointer, "/lights/");
    if (!light || *light >= ids.lights.size()) {
        return Id::None;
    }
    if (pointer.empty()) {
        return ids.lights[*light].id;
    }
    const std::vector<KeyIds>& keys = ids.lights[*light].keys;
    const auto key = takeNumber(pointer, "/keys/");
    if (!key || *key >= keys.size()) {
        return Id::None;
    }
    if (pointer.empty()) {
        return keys[*key].id;
    }
    const std::vector<Id>& stops = keys[*key].stops;
    const auto stop = takeNumber(pointer, "/gradient/stops/");
    return stop && pointer.empty() && *stop < stops.size() ? stops[*stop] : Id::None;
}

Json jsonOfAngle(double radians) {
    document::Document document;
    document.environment = document::Environment{"constant:0", radians, 0.0, {}};
    return partOf(kRotation, document);
}

core::Result<void> readAngle(const Json& json, double& radians) {
    const auto read = readAround(kRotation, json);
    if (!read) {
        return read.error();
    }
    radians = read->environment->rotation;
    return {};
}

Json jsonOf(double value) {
    return value;
}
Json jsonOf(bool value) {
    return value;
}
Json jsonOf(std::size_t value) {
    return value;
}
Json jsonOf(const std::string& value) {
    return value;
}
Json jsonOf(const glm::dvec3& value) {
    return Json::array({value.x, value.y, value.z});
}
Json jsonOf(lighting::GradientInterpolation value) {
    return kInterpolations[static_cast<std::size_t>(value)];
}
Json jsonOf(lighting::GradientSpace value) {
    return kSpaces[static_cast<std::size_t>(value)];
}
Json jsonOf(BrushMode value) {
    return kModes[static_cast<std::size_t>(value)];
}
Json jsonOf(MaterialField value) {
    Json names = Json::array();
    for (std::size_t i = 0; i < kFields.size(); ++i) {
        if ((static_cast<unsigned>(value) >> i & 1u) != 0) {
            names.push_back(kFields[i]);
        }
    }
    return names;
}
Json jsonOf(const lighting::SunPath& value) {
    document::Light light;
    light.kind = lighting::LightKind::Sun;
    light.path = value;
    return partOf(kPath, holding(std::move(light)));
}
Json jsonOf(const std::vector<document::Stop>& value) {
    document::Gradient gradient;
    gradient.stops = value;
    return partOf(kStops, holding(std::move(gradient)));
}
Json jsonOf(const document::Gradient& value) {
    return partOf(kGradient, holding(value));
}
Json jsonOf(const document::Key& value) {
    return partOf(kKey, holding(value));
}
Json jsonOf(const document::Light& value) {
    return partOf(kLight, holding(value));
}
Json jsonOf(const std::vector<document::Light>& value) {
    document::Document document;
    document.lights = value;
    return partOf("/lights", document);
}
Json jsonOf(const lighting::Probe& value) {
    document::Document document;
    document.probes.emplace_back();
    document.probes.back().probe = value;
    return partOf(kProbe, document);
}
Json jsonOf(const document::Document& value) {
    return partOf("", value);
}

core::Result<void> readPart(const Json& json, double& value) {
    if (!json.is_number()) {
        return core::refused("must be a number");
    }
    value = json.get<double>();
    return {};
}
core::Result<void> readPart(const Json& json, bool& value) {
    if (!json.is_boolean()) {
        return core::refused("must be true or false");
    }
    value = json.get<bool>();
    return {};
}
core::Result<void> readPart(const Json& json, std::size_t& value) {
    if (!json.is_number_unsigned()) {
        return core::refused("must be a whole number, at least 0");
    }
    value = json.get<std::size_t>();
    return {};
}
core::Result<void> readPart(const Json& json, std::string& value) {
    if (!json.is_string()) {
        return core::refused("must be a string");
    }
    value = json.get<std::string>();
    return {};
}
core::Result<void> readPart(const Json& json, glm::dvec3& value) {
    if (!json.is_array() || json.size() != 3) {
        return core::refused("must be three numbers");
    }
    for (int c = 0; c < 3; ++c) {
        const Json& each = json[static_cast<std::size_t>(c)];
        if (!each.is_number()) {
            return core::refused("must be three numbers");
        }
        value[c] = each.get<double>();
    }
    return {};
}
core::Result<void> readPart(const Json& json, lighting::GradientInterpolation& value) {
    return readChoice(json, kInterpolations, value);
}
core::Result<void> readPart(const Json& json, lighting::GradientSpace& value) {
    return readChoice(json, kSpaces, value);
}
core::Result<void> readPart(const Json& json, BrushMode& value) {
    return readChoice(json, kModes, value);
}
core::Result<void> readPart(const Json& json, MaterialField& value) {
    if (!json.is_array()) {
        return core::refused("must be a list of names of values");
    }
    unsigned bits = 0;
    for (const Json& each : json) {
        const auto field = choice(each, kFields);
        if (!field) {
            return field.error();
        }
        bits |= 1u << *field;
    }
    value = static_cast<MaterialField>(bits);
    return {};
}
core::Result<void> readPart(const Json& json, lighting::SunPath& value) {
    auto read = readAround(kPath, json);
    if (!read) {
        return read.error();
    }
    value = *read->lights.front().path;
    return {};
}
core::Result<void> readPart(const Json& json, std::vector<document::Stop>& value) {
    auto read = readAround(kStops, json);
    if (!read) {
        return read.error();
    }
    value = std::move(read->lights.front().keys.front().gradient.stops);
    return {};
}
core::Result<void> readPart(const Json& json, document::Gradient& value) {
    auto read = readAround(kGradient, json);
    if (!read) {
        return read.error();
    }
    value = std::move(read->lights.front().keys.front().gradient);
    return {};
}
core::Result<void> readPart(const Json& json, document::Key& value) {
    auto read = readAround(kKey, json);
    if (!read) {
        return read.error();
    }
    value = std::move(read->lights.front().keys.front());
    return {};
}
core::Result<void> readPart(const Json& json, document::Light& value) {
    auto read = readAround(kLight, json);
    if (!read) {
        return read.error();
    }
    value = std::move(read->lights.front());
    return {};
}
core::Result<void> readPart(const Json& json, std::vector<document::Light>& value) {
    auto read = readAround("/lights", json);
    if (!read) {
        return read.error();
    }
    value = std::move(read->lights);
    return {};
}
core::Result<void> readPart(const Json& json, lighting::Probe& value) {
    auto read = readAround(kProbe, json);
    if (!read) {
        return read.error();
    }
    value = std::move(read->probes.front().probe);
    return {};
}
core::Result<void> readPart(const Json& json, document::Document& value) {
    auto read = readAround("", json);
    if (!read) {
        return read.error();
    }
    value = std::move(*read);
    return {};
}

} // namespace lodestar::model

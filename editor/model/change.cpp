// SPDX-License-Identifier: MIT
#include "model/change.h"

#include <algorithm>
#include <iterator>

#include "core/contract.h"

namespace lodestar::model {
namespace {

/// The range in which two lists differ, names and values together.
template <class Value, class Names>
Splice<Value, Names>
spliceOf(const std::vector<Value>& before, const std::vector<Names>& namesBefore,
         const std::vector<Value>& after, const std::vector<Names>& namesAfter) {
    const auto same = [&](std::size_t i, std::size_t j) {
        return namesBefore[i] == namesAfter[j] && before[i] == after[j];
    };
    std::size_t first = 0;
    while (first < before.size() && first < after.size() && same(first, first)) {
        ++first;
    }
    std::size_t endBefore = before.size();
    std::size_t endAfter = after.size();
    while (endBefore > first && endAfter > first && same(endBefore - 1, endAfter - 1)) {
        --endBefore;
        --endAfter;
    }
    const auto range = [](const auto& list, std::size_t from, std::size_t to) {
        return std::decay_t<decltype(list)>(list.begin() + static_cast<std::ptrdiff_t>(from),
                                            list.begin() + static_cast<std::ptrdiff_t>(to));
    };
    return {first, range(before, first, endBefore), range(after, first, endAfter),
            range(namesBefore, first, endBefore), range(namesAfter, first, endAfter)};
}

template <class Value>
void replaceRange(std::vector<Value>& list, std::size_t at, std::size_t count,
                  const std::vector<Value>& by) {
    LODESTAR_EXPECT(at + count <= list.size(), "a change starts from the document it was made on");
    const auto start = list.begin() + static_cast<std::ptrdiff_t>(at);
    const std::size_t over = std::min(count, by.size());
    std::copy_n(by.begin(), over, start);
    const auto rest = start + static_cast<std::ptrdiff_t>(over);
    if (count > over) {
        list.erase(rest, start + static_cast<std::ptrdiff_t>(count));
    } else {
        list.insert(rest, by.begin() + static_cast<std::ptrdiff_t>(over), by.end());
    }
}

template <class Value, class Names>
void applySplice(const Splice<Value, Names>& splice, Direction direction,
                 std::vector<Value>& values, std::vector<Names>& names) {
    const bool forth = direction == Direction::Forth;
    const std::size_t count = forth ? splice.valuesBefore.size() : splice.valuesAfter.size();
    replaceRange(values, splice.at, count, forth ? splice.valuesAfter : splice.valuesBefore);
    replaceRange(names, splice.at, count, forth ? splice.namesAfter : splice.namesBefore);
}

template <class Value>
const Value& sideOf(const Swap<Value>& swap, Direction direction) {
    return direction == Direction::Forth ? swap.after : swap.before;
}

/// A key without its stops, a light without its keys.
document::Key valuesOf(const document::Key& key) {
    document::Key values{key.hour, {}, key.tint, key.axis, key.unknown};
    values.gradient.interpolation = key.gradient.interpolation;
    values.gradient.space = key.gradient.space;
    values.gradient.unknown = key.gradient.unknown;
    return values;
}
document::Light valuesOf(const document::Light& light) {
    return {light.name,       light.kind, light.axis,    light.path,       {},
            light.visibility, light.add,  light.unknown, light.pathUnknown};
}

void giveValues(document::Key& key, const document::Key& values) {
    auto stops = std::move(key.gradient.stops);
    key = values;
    key.gradient.stops = std::move(stops);
}
void giveValues(document::Light& light, const document::Light& values) {
    auto keys = std::move(light.keys);
    light = values;
    light.keys = std::move(keys);
}

template <class Value>
Rarely<Value> swapOf(Value before, Value after) {
    if (before == after) {
        return nullptr;
    }
    return std::make_unique<const Swap<Value>>(Swap<Value>{std::move(before), std::move(after)});
}

/// The names of the parts of a list alone, without those of what is below.
template <class Names>
bool sameParts(const std::vector<Names>& a, const std::vector<Names>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Names& x, const Names& y) { return x.id == y.id; });
}

/// Two states of one light.
void addLightChange(const State& before, const State& after, std::size_t light, Change& change) {
    const document::Light& was = before.document.lights[light];
    const document::Light& is = after.document.lights[light];
    const auto& wasNames = before.ids.lights[light].keys;
    const auto& isNames = after.ids.lights[light].keys;
    LightChange made;
    made.light = light;
    made.values = swapOf(valuesOf(was), valuesOf(is));
    const bool parts = sameParts(wasNames, isNames);
    if (!parts) {
        made.keys = spliceOf(was.keys, wasNames, is.keys, isNames);
    }
    if (made.values || !made.keys.empty()) {
        change.inLights.push_back(std::move(made));
    }
    for (std::size_t k = 0; parts && k < was.keys.size(); ++k) {
        KeyChange key;
        key.light = light;
        key.key = k;
        key.values = swapOf(valuesOf(was.keys[k]), valuesOf(is.keys[k]));
        key.stops = spliceOf(was.keys[k].gradient.stops, wasNames[k].stops,
                             is.keys[k].gradient.stops, isNames[k].stops);
        if (key.values || !key.stops.empty()) {
            change.inKeys.push_back(std::move(key));
        }
    }
}

void addMaterialChanges(const document::Document& before, const document::Document& after,
                        Change& change) {
    for (const auto& [name, material] : before.materials) {
        const auto found = after.materials.find(name);
        if (found == after.materials.end()) {
            change.materials.push_back({name, material, std::nullopt});
        } else if (found->second != material) {
            change.materials.push_back({name, material, found->second});
        }
    }
    for (const auto& [name, material] : after.materials) {
        if (!before.materials.contains(name)) {
            change.materials.push_back({name, std::nullopt, material});
        }
    }
}

std::size_t bytesOf(const document::Stop& stop) {
    return sizeof stop + stop.unknown.size();
}
std::size_t bytesOf(const document::Key& key) {
    std::size_t sum = sizeof key + key.unknown.size() + key.gradient.unknown.size();
    for (const document::Stop& stop : key.gradient.stops) {
        sum += bytesOf(stop);
    }
    return sum;
}
std::size_t bytesOf(const document::Light& light) {
    std::size_t sum = sizeof light + light.name.size() + light.unknown.size();
    for (const document::Key& key : light.keys) {
        sum += bytesOf(key);
    }
    return sum;
}
std::size_t bytesOf(const document::Probe& probe) {
    return sizeof probe + probe.probe.name.size() + probe.unknown.size();
}
std::size_t bytesOf(Id id) {
    return sizeof id;
}
std::size_t bytesOf(const KeyIds& names) {
    return sizeof names + names.stops.size() * sizeof(Id);
}
std::size_t bytesOf(const LightIds& names) {
    std::size_t sum = sizeof names;
    for (const KeyIds& key : names.keys) {
        sum += bytesOf(key);
    }
    return sum;
}
template <class Value, class Names>
std::size_t bytesOf(const Splice<Value, Names>& splice) {
    std::size_t sum = 0;
    for (const auto* values : {&splice.valuesBefore, &splice.valuesAfter}) {
        for (const Value& value : *values) {
            sum += bytesOf(value);
        }
    }
    for (const auto* names : {&splice.namesBefore, &splice.namesAfter}) {
        for (const Names& name : *names) {
            sum += bytesOf(name);
        }
    }
    return sum;
}

} // namespace

bool Change::empty() const {
    return !environment && materials.empty() && probes.empty() && lights.empty() &&
           inLights.empty() && inKeys.empty() && !rsrm && !unknown;
}

std::size_t Change::bytes() const {
    const auto swapped = [](const auto& swap) { return swap ? sizeof *swap : std::size_t{0}; };
    std::size_t sum = swapped(environment) + swapped(rsrm) + swapped(unknown);
    sum += bytesOf(probes) + bytesOf(lights) + materials.size() * sizeof(MaterialChange);
    for (const auto* side : {rsrm ? &rsrm->before : nullptr, rsrm ? &rsrm->after : nullptr}) {
        if (side != nullptr && *side) {
            sum += (*side)->exponents.size() * sizeof(double) + (*side)->unknown.size();
        }
    }
    for (const LightChange& each : inLights) {
        sum += sizeof each + swapped(each.values) + bytesOf(each.keys);
    }
    for (const KeyChange& each : inKeys) {
        sum += sizeof each + swapped(each.values) + bytesOf(each.stops);
    }
    return sum;
}

Change difference(const State& before, const State& after) {
    Change change;
    const document::Document& was = before.document;
    const document::Document& is = after.document;
    change.environment = swapOf(was.environment, is.environment);
    change.rsrm = swapOf(was.rsrm, is.rsrm);
    change.unknown = swapOf(was.unknown, is.unknown);
    change.next = {before.ids.next, after.ids.next};
    change.probes = spliceOf(was.probes, before.ids.probes, is.probes, after.ids.probes);
    addMaterialChanges(was, is, change);
    if (!sameParts(before.ids.lights, after.ids.lights)) {
        change.lights = spliceOf(was.lights, before.ids.lights, is.lights, after.ids.lights);
        return change;
    }
    for (std::size_t i = 0; i < was.lights.size(); ++i) {
        addLightChange(before, after, i, change);
    }
    return change;
}

void apply(const Change& change, Direction direction, State& state) {
    document::Document& document = state.document;
    if (change.environment) {
        document.environment = sideOf(*change.environment, direction);
    }
    if (change.rsrm) {
        document.rsrm = sideOf(*change.rsrm, direction);
    }
    if (change.unknown) {
        document.unknown = sideOf(*change.unknown, direction);
    }
    state.ids.next = sideOf(change.next, direction);
    for (const MaterialChange& each : change.materials) {
        const auto& side = direction == Direction::Forth ? each.after : each.before;
        if (side) {
            document.materials[each.name] = *side;
        } else {
            document.materials.erase(each.name);
        }
    }
    applySplice(change.probes, direction, document.probes, state.ids.probes);
    applySplice(change.lights, direction, document.lights, state.ids.lights);
    for (const LightChange& each : change.inLights) {
        document::Light& light = document.lights[each.light];
        if (each.values) {
            giveValues(light, sideOf(*each.values, direction));
        }
        applySplice(each.keys, direction, light.keys, state.ids.lights[each.light].keys);
    }
    for (const KeyChange& each : change.inKeys) {
        document::Key& key = document.lights[each.light].keys[each.key];
        if (each.values) {
            giveValues(key, sideOf(*each.values, direction));
        }
        applySplice(each.stops, direction, key.gradient.stops,
                    state.ids.lights[each.light].keys[each.key].stops);
    }
}

} // namespace lodestar::model

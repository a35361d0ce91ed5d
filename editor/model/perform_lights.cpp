// SPDX-License-Identifier: MIT
//
// Commands on lights and on the keys of their day.
#include <algorithm>
#include <utility>

#include "model/key_blend.h"
#include "model/perform.h"
#include "model/rules.h"

namespace lodestar::model {
namespace {

constexpr const char* kNoLight = "there is no such light";
constexpr const char* kNoKey = "there is no such key";

/// An hour that no other key of the light has.
core::Result<double> freeHour(const document::Light& light, double hour, std::size_t but) {
    auto checked = checkedHour(hour);
    for (std::size_t k = 0; checked && k < light.keys.size(); ++k) {
        if (k != but && lighting::wrappedHour(light.keys[k].hour) == *checked) {
            return core::refused("there is a key at that hour already");
        }
    }
    return checked;
}
constexpr std::size_t kNoneBut = ~std::size_t{0};

/// Keys in the order of their hours; those at one hour keep theirs.
void sortKeys(State& state, std::size_t light) {
    std::vector<document::Key>& keys = state.document.lights[light].keys;
    std::vector<KeyIds>& names = state.ids.lights[light].keys;
    std::vector<std::pair<document::Key, KeyIds>> both;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        both.emplace_back(std::move(keys[i]), std::move(names[i]));
    }
    std::stable_sort(both.begin(), both.end(), [](const auto& a, const auto& b) {
        return lighting::wrappedHour(a.first.hour) < lighting::wrappedHour(b.first.hour);
    });
    for (std::size_t i = 0; i < keys.size(); ++i) {
        keys[i] = std::move(both[i].first);
        names[i] = std::move(both[i].second);
    }
}

Performed insertKey(State& state, std::size_t light, document::Key key) {
    KeyIds names = namesOf(key, state.ids);
    const Id id = names.id;
    state.document.lights[light].keys.push_back(std::move(key));
    state.ids.lights[light].keys.push_back(std::move(names));
    sortKeys(state, light);
    return std::vector<Id>{id};
}

} // namespace

Performed performOn(State& state, const AddKey& command) {
    const auto place = findLight(state.ids, command.light);
    if (!place) {
        return core::refused(kNoLight);
    }
    const auto hour = freeHour(state.document.lights[*place], command.hour, kNoneBut);
    if (!hour) {
        return hour.error();
    }
    auto key = keyAt(state.document.lights[*place], *hour);
    if (!key) {
        return key.error();
    }
    return insertKey(state, *place, std::move(*key));
}

Performed performOn(State& state, const InsertKey& command) {
    const auto place = findLight(state.ids, command.light);
    if (!place) {
        return core::refused(kNoLight);
    }
    const document::Light& light = state.document.lights[*place];
    auto key = checkedKey(command.key, light.kind);
    if (!key) {
        return key.error();
    }
    if (const auto hour = freeHour(light, key->hour, kNoneBut); !hour) {
        return hour.error();
    }
    return insertKey(state, *place, std::move(*key));
}

Performed performOn(State& state, const MoveKey& command) {
    const auto place = findKey(state.ids, command.key);
    if (!place) {
        return core::refused(kNoKey);
    }
    document::Light& light = state.document.lights[place->light];
    const auto hour = freeHour(light, command.hour, place->key);
    if (!hour) {
        return hour.error();
    }
    light.keys[place->key].hour = *hour;
    sortKeys(state, place->light);
    return std::vector<Id>();
}

Performed performOn(State& state, const CopyKey& command) {
    const auto place = findKey(state.ids, command.key);
    if (!place) {
        return core::refused(kNoKey);
    }
    const document::Light& light = state.document.lights[place->light];
    const auto hour = freeHour(light, command.hour, kNoneBut);
    if (!hour) {
        return hour.error();
    }
    document::Key copy = light.keys[place->key];
    copy.hour = *hour;
    return insertKey(state, place->light, std::move(copy));
}

Performed performOn(State& state, const DeleteKey& command) {
    const auto place = findKey(state.ids, command.key);
    if (!place) {
        return core::refused(kNoKey);
    }
    document::Light& light = state.document.lights[place->light];
    if (light.keys.size() < 2) {
        return core::refused("a light keeps its last key");
    }
    std::vector<KeyIds>& names = state.ids.lights[place->light].keys;
    light.keys.erase(light.keys.begin() + static_cast<std::ptrdiff_t>(place->key));
    names.erase(names.begin() + static_cast<std::ptrdiff_t>(place->key));
    return std::vector<Id>();
}

Performed performOn(State& state, const SetKey& command) {
    const auto place = findKey(state.ids, command.key);
    if (!place) {
        return core::refused(kNoKey);
    }
    document::Key& key = state.document.lights[place->light].keys[place->key];
    if (command.tint) {
        const auto tint = checkedTint(*command.tint);
        if (!tint) {
            return tint.error();
        }
        key.tint = *tint;
    }
    if (command.axis && *command.axis) {
        const auto axis = checkedAxis(**command.axis);
        if (!axis) {
            return axis.error();
        }
        key.axis = *axis;
    } else if (command.axis) {
        key.axis.reset();
    }
    return std::vector<Id>();
}

Performed performOn(State& state, const AddLight& command) {
    auto light = checkedLight(command.light);
    if (!light) {
        return light.error();
    }
    LightIds names = namesOf(*light, state.ids);
    const Id id = names.id;
    state.document.lights.push_back(std::move(*light));
    state.ids.lights.push_back(std::move(names));
    return std::vector<Id>{id};
}

Performed performOn(State& state, const RemoveLight& command) {
    const auto place = findLight(state.ids, command.light);
    if (!place) {
        return core::refused(kNoLight);
    }
    const auto offset = static_cast<std::ptrdiff_t>(*place);
    state.document.lights.erase(state.document.lights.begin() + offset);
    state.ids.lights.erase(state.ids.lights.begin() + offset);
    return std::vector<Id>();
}

Performed performOn(State& state, const SetLight& command) {
    const auto place = findLight(state.ids, command.light);
    if (!place) {
        return core::refused(kNoLight);
    }
    document::Light light = state.document.lights[*place];
    light.name = command.name.value_or(light.name);
    light.axis = command.axis.value_or(light.axis);
    light.path = command.path.value_or(light.path);
    light.visibility = command.visibility.value_or(light.visibility);
    light.add = command.add.value_or(light.add);
    if (!light.path) {
        light.pathUnknown.clear();
    }
    auto checked = checkedValues(std::move(light));
    if (!checked) {
        return checked.error();
    }
    state.document.lights[*place] = std::move(*checked);
    return std::vector<Id>();
}

Performed performOn(State& state, const SetLights& command) {
    std::vector<document::Light> lights;
    std::vector<LightIds> names;
    for (const document::Light& light : command.lights) {
        auto checked = checkedLight(light);
        if (!checked) {
            return checked.error();
        }
        lights.push_back(std::move(*checked));
        names.push_back(namesOf(lights.back(), state.ids));
    }
    if (lights == state.document.lights) {
        return std::vector<Id>();
    }
    state.document.lights = std::move(lights);
    state.ids.lights = std::move(names);
    return std::vector<Id>();
}

} // namespace lodestar::model

// SPDX-License-Identifier: MIT
#include "model/state.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

#include "model/selection.h"

namespace lodestar::model {
namespace {

/// Each once, in the order of their first coming, where `has` says yes.
template <class T, class Has>
void keepValid(std::vector<T>& list, Has&& has) {
    std::vector<T> kept;
    for (T& each : list) {
        if (has(each) && std::find(kept.begin(), kept.end(), each) == kept.end()) {
            kept.push_back(std::move(each));
        }
    }
    list = std::move(kept);
}

/// The keys that selected stops are of. One pass over the document, however many they are.
std::unordered_map<Id, const KeyIds*> keysOf(const std::vector<Id>& stops, const Identities& ids) {
    const std::unordered_set<Id> wanted(stops.begin(), stops.end());
    std::unordered_map<Id, const KeyIds*> found;
    for (const LightIds& light : ids.lights) {
        for (const KeyIds& key : light.keys) {
            for (const Id stop : key.stops) {
                if (wanted.contains(stop)) {
                    found.emplace(stop, &key);
                }
            }
        }
    }
    return found;
}

/// Leaves of selected stops each once, in the order of their first coming, and those of one key:
/// that of the first that there is.
void keepStops(Selection& selection, const Identities& ids) {
    if (selection.stops.empty()) {
        return;
    }
    auto keys = keysOf(selection.stops, ids);
    const KeyIds* key = nullptr;
    std::erase_if(selection.stops, [&](Id stop) {
        const auto found = keys.extract(stop);
        key = key == nullptr && found ? found.mapped() : key;
        return !found || found.mapped() != key;
    });
    selection.key = key != nullptr ? key->id : selection.key;
}

} // namespace

KeyIds namesOf(const document::Key& key, Identities& ids) {
    KeyIds names{ids.make(), {}};
    for (std::size_t i = 0; i < key.gradient.stops.size(); ++i) {
        names.stops.push_back(ids.make());
    }
    return names;
}

LightIds namesOf(const document::Light& light, Identities& ids) {
    LightIds names{ids.make(), {}};
    for (const document::Key& key : light.keys) {
        names.keys.push_back(namesOf(key, ids));
    }
    return names;
}

State named(document::Document document, std::uint64_t first) {
    State state{std::move(document), {}};
    state.ids.next = first;
    for (const document::Light& light : state.document.lights) {
        state.ids.lights.push_back(namesOf(light, state.ids));
    }
    for (std::size_t i = 0; i < state.document.probes.size(); ++i) {
        state.ids.probes.push_back(state.ids.make());
    }
    return state;
}

std::optional<std::size_t> findLight(const Identities& ids, Id light) {
    for (std::size_t i = 0; i < ids.lights.size(); ++i) {
        if (ids.lights[i].id == light) {
            return i;
        }
    }
    return std::nullopt;
}

std::optional<KeyPlace> findKey(const Identities& ids, Id key) {
    for (std::size_t i = 0; i < ids.lights.size(); ++i) {
        for (std::size_t k = 0; k < ids.lights[i].keys.size(); ++k) {
            if (ids.lights[i].keys[k].id == key) {
                return KeyPlace{i, k};
            }
        }
    }
    return std::nullopt;
}

std::optional<StopPlace> findStop(const Identities& ids, Id stop) {
    for (std::size_t i = 0; i < ids.lights.size(); ++i) {
        for (std::size_t k = 0; k < ids.lights[i].keys.size(); ++k) {
            const std::vector<Id>& stops = ids.lights[i].keys[k].stops;
            const auto found = std::find(stops.begin(), stops.end(), stop);
            if (found != stops.end()) {
                return StopPlace{i, k, static_cast<std::size_t>(found - stops.begin())};
            }
        }
    }
    return std::nullopt;
}

std::optional<std::size_t> findProbe(const Identities& ids, Id probe) {
    const auto found = std::find(ids.probes.begin(), ids.probes.end(), probe);
    if (found == ids.probes.end()) {
        return std::nullopt;
    }
    return static_cast<std::size_t>(found - ids.probes.begin());
}

Selection valid(Selection selection, const Identities& ids) {
    keepStops(selection, ids);
    if (const auto key = findKey(ids, selection.key)) {
        selection.light = ids.lights[key->light].id;
    } else {
        selection.key = Id::None;
    }
    if (!findLight(ids, selection.light)) {
        selection.light = Id::None;
    }
    keepValid(selection.probes, [&](Id id) { return findProbe(ids, id).has_value(); });
    keepValid(selection.materials, [](const std::string& name) { return !name.empty(); });
    return selection;
}

} // namespace lodestar::model

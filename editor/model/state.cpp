// SPDX-License-Identifier: MIT
#include "model/state.h"

#include <algorithm>

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
    keepValid(selection.stops, [&](Id id) { return findStop(ids, id).has_value(); });
    if (!selection.stops.empty()) {
        const auto place = *findStop(ids, selection.stops.front());
        const KeyIds& key = ids.lights[place.light].keys[place.key];
        selection.key = key.id;
        keepValid(selection.stops, [&](Id id) {
            return std::find(key.stops.begin(), key.stops.end(), id) != key.stops.end();
        });
    }
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

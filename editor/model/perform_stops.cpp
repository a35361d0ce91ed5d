// SPDX-License-Identifier: MIT
//
// Commands on single stops, and on a gradient as a whole.
#include <algorithm>
#include <set>
#include <utility>

#include "model/perform.h"
#include "model/ramp.h"
#include "model/rules.h"

namespace lodestar::model {
namespace {

constexpr const char* kNoStop = "there is no such stop";

core::Result<void> checkedRoom(const GradientEdit& edit, std::size_t more) {
    if (more > kMostStops || edit.gradient.stops.size() + more > kMostStops) {
        return core::refused("a gradient has at most 65536 stops");
    }
    return {};
}

/// Where stops are, by key. @errors InputRefused: one is none, or there are none
core::Result<std::vector<StopPlace>> placesOf(const State& state, const std::vector<Id>& stops) {
    if (stops.empty()) {
        return core::refused("no stop is named");
    }
    // One pass over the document, so that ten thousand stops are found in reasonable time.
    const std::set<Id> wanted(stops.begin(), stops.end());
    std::vector<StopPlace> places;
    for (std::size_t i = 0; i < state.ids.lights.size(); ++i) {
        for (std::size_t k = 0; k < state.ids.lights[i].keys.size(); ++k) {
            const std::vector<Id>& names = state.ids.lights[i].keys[k].stops;
            for (std::size_t s = 0; s < names.size(); ++s) {
                if (wanted.contains(names[s])) {
                    places.push_back({i, k, s});
                }
            }
        }
    }
    if (places.size() != wanted.size()) {
        return core::refused(kNoStop);
    }
    return places;
}

/// Puts every gradient that stops are named of in order. @errors as `placesOf`
core::Result<std::vector<Id>> orderGradients(State& state, const std::vector<Id>& stops) {
    const auto places = placesOf(state, stops);
    if (!places) {
        return places.error();
    }
    std::vector<Id> keys;
    for (const StopPlace& place : *places) {
        const Id key = state.ids.lights[place.light].keys[place.key].id;
        if (keys.empty() || keys.back() != key) {
            keys.push_back(key);
            if (const auto edit = editGradient(state, key); !edit) {
                return edit.error();
            }
        }
    }
    return keys;
}

/// Changes stops in place, then puts their gradients in order again.
template <class Edit>
Performed editStops(State& state, const std::vector<Id>& stops, Edit&& edit) {
    const auto keys = orderGradients(state, stops);
    if (!keys) {
        return keys.error();
    }
    const auto places = placesOf(state, stops);
    if (!places) {
        return places.error();
    }
    for (const StopPlace& place : *places) {
        document::Light& light = state.document.lights[place.light];
        document::Stop& stop = light.keys[place.key].gradient.stops[place.stop];
        edit(state.ids.lights[place.light].keys[place.key].stops[place.stop], stop);
        auto checked = checkedStop(std::move(stop), light.kind);
        if (!checked) {
            return checked.error();
        }
        stop = std::move(*checked);
    }
    for (const Id key : *keys) {
        gradientAt(state, *findKey(state.ids, key)).sort();
    }
    return std::vector<Id>();
}

} // namespace

Performed performOn(State& state, const AddStop& command) {
    auto edit = editGradient(state, command.key);
    if (!edit) {
        return edit.error();
    }
    const auto at = checkedAngle(command.at, edit->kind);
    const auto room = checkedRoom(*edit, 2);
    if (!at || !room) {
        return at ? room.error() : at.error();
    }
    const glm::dvec3 radiance = radianceAt(edit->gradient, edit->kind, {&*at, 1}).front();
    edit->closeBefore(*at);
    const std::size_t place = edit->after(*at);
    const double ev = edit->gradient.stops[place > 0 ? place - 1 : 0].stop.ev;
    return std::vector<Id>{edit->insert(place, {stopOf(*at, radiance, ev), {}})};
}

Performed performOn(State& state, const InsertStops& command) {
    auto edit = editGradient(state, command.key);
    if (!edit) {
        return edit.error();
    }
    if (command.stops.empty()) {
        return core::refused("no stop is given");
    }
    if (const auto room = checkedRoom(*edit, command.stops.size()); !room) {
        return room.error();
    }
    document::Gradient given;
    given.stops = command.stops;
    auto checked = checkedGradient(std::move(given), edit->kind);
    if (!checked) {
        return checked.error();
    }
    std::vector<Id> created;
    for (document::Stop& stop : checked->stops) {
        created.push_back(edit->insert(edit->gradient.stops.size(), std::move(stop)));
    }
    edit->sort();
    return created;
}

Performed performOn(State& state, const MoveStops& command) {
    std::map<Id, double> places;
    std::vector<Id> stops;
    for (const StopMove& move : command.moves) {
        places[move.stop] = move.at;
        stops.push_back(move.stop);
    }
    return editStops(state, stops,
                     [&](Id id, document::Stop& stop) { stop.stop.at = places.at(id); });
}

Performed performOn(State& state, const SetStops& command) {
    return editStops(state, command.stops, [&](Id, document::Stop& stop) {
        stop.stop.at = command.at.value_or(stop.stop.at);
        stop.stop.color = command.color.value_or(stop.stop.color);
        stop.stop.ev = command.ev.value_or(stop.stop.ev);
    });
}

Performed performOn(State& state, const DeleteStops& command) {
    const auto keys = orderGradients(state, command.stops);
    if (!keys) {
        return keys.error();
    }
    const std::set<Id> gone(command.stops.begin(), command.stops.end());
    for (const Id key : *keys) {
        GradientEdit edit = gradientAt(state, *findKey(state.ids, key));
        std::size_t kept = 0;
        for (std::size_t i = 0; i < edit.names.size(); ++i) {
            if (!gone.contains(edit.names[i])) {
                std::swap(edit.gradient.stops[kept], edit.gradient.stops[i]);
                std::swap(edit.names[kept++], edit.names[i]);
            }
        }
        if (kept < 2) {
            return core::refused("a gradient keeps its last two stops");
        }
        edit.gradient.stops.resize(kept);
        edit.names.resize(kept);
    }
    return std::vector<Id>();
}

Performed performOn(State& state, const ReverseStops& command) {
    auto edit = editGradient(state, command.key);
    if (!edit) {
        return edit.error();
    }
    std::vector<document::Stop>& stops = edit->gradient.stops;
    const double least = std::min(stops.front().stop.at, stops.back().stop.at);
    const double most = std::max(stops.front().stop.at, stops.back().stop.at);
    for (document::Stop& stop : stops) {
        stop.stop.at = plain(std::clamp(least + most - stop.stop.at, least, most));
    }
    std::reverse(stops.begin(), stops.end());
    std::reverse(edit->names.begin(), edit->names.end());
    edit->sort(); // rounding may have crossed neighbours
    return std::vector<Id>();
}

Performed performOn(State& state, const DistributeStops& command) {
    auto edit = editGradient(state, command.key);
    if (!edit) {
        return edit.error();
    }
    std::vector<document::Stop>& stops = edit->gradient.stops;
    const double first = stops.front().stop.at;
    const double last = stops.back().stop.at;
    const std::size_t parts = command.fromLeft ? stops.size() : stops.size() - 1;
    for (std::size_t i = 1; i < parts; ++i) {
        const double t = static_cast<double>(i) / static_cast<double>(parts);
        // This way rounding keeps their order, and lets stops of one place lie.
        stops[i].stop.at = plain(
            std::clamp(first + t * (last - first), std::min(first, last), std::max(first, last)));
    }
    return std::vector<Id>();
}

Performed performOn(State& state, const SetGradient& command) {
    const auto place = findKey(state.ids, command.key);
    if (!place) {
        return core::refused("there is no such key");
    }
    GradientEdit edit = gradientAt(state, *place);
    auto checked = checkedGradient(command.gradient, edit.kind);
    if (!checked) {
        return checked.error();
    }
    edit.gradient = std::move(*checked);
    edit.names.resize(std::min(edit.names.size(), edit.gradient.stops.size()));
    while (edit.names.size() < edit.gradient.stops.size()) {
        edit.names.push_back(state.ids.make());
    }
    return std::vector<Id>();
}

Performed performOn(State& state, const SetInterpolation& command) {
    auto edit = editGradient(state, command.key);
    if (!edit) {
        return edit.error();
    }
    edit->gradient.interpolation = command.interpolation;
    return std::vector<Id>();
}

Performed performOn(State& state, const SetSpace& command) {
    auto edit = editGradient(state, command.key);
    if (!edit) {
        return edit.error();
    }
    edit->gradient.space = command.space;
    return std::vector<Id>();
}

} // namespace lodestar::model

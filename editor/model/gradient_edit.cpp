// SPDX-License-Identifier: MIT
//
// What commands on stops have in common.
#include <algorithm>
#include <utility>

#include "model/perform.h"
#include "model/ramp.h"
#include "model/rules.h"

namespace lodestar::model {
namespace {

bool inOrder(const std::vector<document::Stop>& stops, lighting::LightKind kind) {
    return std::is_sorted(stops.begin(), stops.end(), [kind](const auto& a, const auto& b) {
        return fromAxis(a.stop.at, kind) < fromAxis(b.stop.at, kind);
    });
}

/// A list that runs towards the axis is read backwards, as lighting::repaired does.
void turnAround(GradientEdit& edit) {
    std::vector<document::Stop>& stops = edit.gradient.stops;
    std::reverse(stops.begin(), stops.end());
    std::reverse(edit.names.begin(), edit.names.end());
    if (edit.gradient.interpolation == lighting::GradientInterpolation::Constant) {
        edit.insert(0, stops.front());
        for (std::size_t i = 1; i + 1 < stops.size(); ++i) {
            stops[i].stop.color = stops[i + 1].stop.color;
            stops[i].stop.ev = stops[i + 1].stop.ev;
        }
    }
}

} // namespace

void GradientEdit::sort() {
    if (inOrder(gradient.stops, kind)) {
        return;
    }
    std::vector<std::pair<document::Stop, Id>> both;
    for (std::size_t i = 0; i < names.size(); ++i) {
        both.emplace_back(std::move(gradient.stops[i]), names[i]);
    }
    std::stable_sort(both.begin(), both.end(), [this](const auto& a, const auto& b) {
        return fromAxis(a.first.stop.at, kind) < fromAxis(b.first.stop.at, kind);
    });
    for (std::size_t i = 0; i < names.size(); ++i) {
        gradient.stops[i] = std::move(both[i].first);
        names[i] = both[i].second;
    }
}

Id GradientEdit::insert(std::size_t i, document::Stop stop) {
    const Id id = ids.make();
    gradient.stops.insert(gradient.stops.begin() + static_cast<std::ptrdiff_t>(i), std::move(stop));
    names.insert(names.begin() + static_cast<std::ptrdiff_t>(i), id);
    return id;
}

std::size_t GradientEdit::after(double at) const {
    const auto found =
        std::upper_bound(gradient.stops.begin(), gradient.stops.end(), at,
                         [this](double place, const document::Stop& stop) {
                             return fromAxis(place, kind) < fromAxis(stop.stop.at, kind);
                         });
    return static_cast<std::size_t>(found - gradient.stops.begin());
}

std::size_t GradientEdit::before(double at) const {
    const auto found =
        std::lower_bound(gradient.stops.begin(), gradient.stops.end(), at,
                         [this](const document::Stop& stop, double place) {
                             return fromAxis(stop.stop.at, kind) < fromAxis(place, kind);
                         });
    return static_cast<std::size_t>(found - gradient.stops.begin());
}

void GradientEdit::closeBefore(double at) {
    const lighting::GradientStop& last = gradient.stops.back().stop;
    if (kind == lighting::LightKind::Sun && at > last.at &&
        lighting::radianceOf(last) != glm::dvec3(0.0)) {
        insert(gradient.stops.size(), {{last.at, glm::dvec3(0.0), 0.0}, {}});
    }
}

GradientEdit gradientAt(State& state, const KeyPlace& place) {
    document::Light& light = state.document.lights[place.light];
    return {light.kind, light.keys[place.key].gradient,
            state.ids.lights[place.light].keys[place.key].stops, state.ids};
}

core::Result<GradientEdit> editGradient(State& state, Id key) {
    const auto place = findKey(state.ids, key);
    if (!place) {
        return core::refused("there is no such key");
    }
    GradientEdit edit = gradientAt(state, *place);
    if (edit.gradient.stops.empty()) {
        return core::refused("a gradient needs at least one stop");
    }
    const std::vector<document::Stop>& stops = edit.gradient.stops;
    const bool backwards = std::is_sorted(stops.rbegin(), stops.rend(), [&](auto& a, auto& b) {
        return fromAxis(a.stop.at, edit.kind) < fromAxis(b.stop.at, edit.kind);
    });
    if (!inOrder(stops, edit.kind) && backwards) {
        turnAround(edit);
    }
    edit.sort();
    for (document::Stop& stop : edit.gradient.stops) {
        // As lighting reads it: what is out of range was mended there all along.
        if (!checkedStop(stop, edit.kind)) {
            stop.stop = {stop.stop.at, lighting::radianceOf(stop.stop), 0.0};
        }
    }
    return edit;
}

} // namespace lodestar::model

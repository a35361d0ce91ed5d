// SPDX-License-Identifier: MIT
//
// Commands that make a gradient's shape anew: mirror, simplify.
#include <cmath>
#include <utility>

#include <glm/common.hpp>

#include "lighting/gradient_simplify.h"
#include "model/perform.h"
#include "model/ramp.h"
#include "model/rules.h"

namespace lodestar::model {
namespace {

using lighting::GradientInterpolation;
using lighting::LightKind;

/// Just on the axis' side of an angle, so that a step there counts with its first stop.
double justBefore(double at, LightKind kind) {
    const double toAxis = kind == LightKind::Sky ? 90.0 : 0.0;
    return std::nextafter(at, toAxis);
}

} // namespace

Performed performOn(State& state, const SimplifyStops& command) {
    auto edit = editGradient(state, command.key);
    if (!edit) {
        return edit.error();
    }
    if (command.count < 2) {
        return core::refused("a gradient keeps its last two stops");
    }
    std::vector<document::Stop>& stops = edit->gradient.stops;
    std::vector<lighting::GradientStop> plain;
    plain.reserve(stops.size());
    for (const document::Stop& stop : stops) {
        plain.push_back(stop.stop);
    }
    const std::vector<bool> kept = lighting::keptStops(plain, command.count);
    std::size_t next = 0;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        if (kept[i]) {
            std::swap(stops[next], stops[i]);
            std::swap(edit->names[next++], edit->names[i]);
        }
    }
    stops.resize(next);
    edit->names.resize(next);
    return std::vector<Id>();
}

Performed performOn(State& state, const MirrorStops& command) {
    auto edit = editGradient(state, command.key);
    if (!edit) {
        return edit.error();
    }
    std::vector<document::Stop>& stops = edit->gradient.stops;
    const double middle =
        edit->kind == LightKind::Sky ? 0.0 : 0.5 * (stops.front().stop.at + stops.back().stop.at);
    const std::size_t inner = edit->before(middle);
    if (inner == 0) {
        return core::refused("there is no stop on the side that is mirrored");
    }
    if (2 * inner + 1 > kMostStops) {
        return core::refused("a gradient has at most 65536 stops");
    }
    const double place = justBefore(middle, edit->kind);
    const glm::dvec3 radiance = radianceAt(edit->gradient, edit->kind, {&place, 1}).front();
    if (inner == stops.size() || stops[inner].stop.at != middle) {
        edit->insert(inner, {});
    }
    stops.resize(inner + 1);
    edit->names.resize(inner + 1);
    stops[inner].stop = stopOf(middle, radiance, stops[inner - 1].stop.ev);
    // A constant stop's radiance reaches outwards: there its copy's comes from the one before.
    const bool constant = edit->gradient.interpolation == GradientInterpolation::Constant;
    const AngleRange range = anglesOf(edit->kind);
    std::vector<Id> created;
    for (std::size_t i = inner; i-- > 0;) {
        document::Stop copy = stops[i];
        if (constant && i > 0) {
            copy.stop.color = stops[i - 1].stop.color;
            copy.stop.ev = stops[i - 1].stop.ev;
        }
        copy.stop.at = plain(glm::clamp(2.0 * middle - stops[i].stop.at, range.least, range.most));
        created.push_back(edit->insert(stops.size(), std::move(copy)));
    }
    edit->sort();
    return created;
}

} // namespace lodestar::model

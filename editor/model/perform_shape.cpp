// SPDX-License-Identifier: MIT
//
// Commands that make a gradient's shape anew: mirror, simplify.
#include <cmath>
#include <queue>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

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

/// Three stops' triangle of angle and radiance, all channels.
struct Triangles {
    std::vector<double> angles;
    std::vector<glm::dvec3> radiances;

    [[nodiscard]] double area(std::size_t a, std::size_t b, std::size_t c) const {
        const glm::dvec3 twice = (angles[b] - angles[a]) * (radiances[c] - radiances[a]) -
                                 (angles[c] - angles[a]) * (radiances[b] - radiances[a]);
        return 0.5 * (std::abs(twice.x) + std::abs(twice.y) + std::abs(twice.z));
    }
};

/// Which stops stay when all but `count` have gone. @pre count >= 2
std::vector<bool> keptStops(const Triangles& triangles, std::size_t count) {
    const std::size_t n = triangles.angles.size();
    std::vector<std::size_t> before(n), after(n);
    std::vector<double> areas(n, 0.0);
    std::vector<bool> kept(n, true);
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> least;
    const auto offer = [&](std::size_t i) {
        areas[i] = triangles.area(before[i], i, after[i]);
        least.emplace(areas[i], i);
    };
    for (std::size_t i = 0; i < n; ++i) {
        before[i] = i == 0 ? 0 : i - 1;
        after[i] = i + 1;
    }
    for (std::size_t i = 1; i + 1 < n; ++i) {
        offer(i);
    }
    std::size_t left = n;
    while (left > count) {
        const auto [area, i] = least.top();
        least.pop();
        if (!kept[i] || area != areas[i]) {
            continue; // an entry from before a neighbour went
        }
        kept[i] = false;
        --left;
        after[before[i]] = after[i];
        before[after[i]] = before[i];
        for (const std::size_t neighbour : {before[i], after[i]}) {
            if (neighbour > 0 && neighbour + 1 < n) {
                offer(neighbour);
            }
        }
    }
    return kept;
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
    if (stops.size() <= command.count) {
        return std::vector<Id>();
    }
    Triangles triangles;
    for (const document::Stop& stop : stops) {
        triangles.angles.push_back(stop.stop.at);
        triangles.radiances.push_back(lighting::radianceOf(stop.stop));
    }
    const std::vector<bool> kept = keptStops(triangles, command.count);
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

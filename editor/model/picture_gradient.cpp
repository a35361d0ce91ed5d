// SPDX-License-Identifier: MIT
#include "model/picture_gradient.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lighting/gradient_simplify.h"
#include "lighting/zonal_picture.h"
#include "model/ramp.h"
#include "model/rules.h"
#include "model/stop_commands.h"

namespace lodestar::model {
namespace {

using lighting::LightKind;

/// Places that a line is read at before it is simplified.
constexpr int kLinePlaces = 1024;

core::Result<void> checkedCount(std::size_t stops) {
    if (stops < 2 || stops > kMostStops) {
        return core::refused("a gradient has from 2 to 65536 stops");
    }
    return {};
}

/// The stops that matter most, linear in linear radiance as the samples are.
document::Gradient ofStops(const std::vector<lighting::GradientStop>& stops, std::size_t count) {
    document::Gradient gradient;
    const std::vector<bool> kept = lighting::keptStops(stops, count);
    for (std::size_t i = 0; i < stops.size(); ++i) {
        if (kept[i]) {
            gradient.stops.push_back({stops[i], {}});
        }
    }
    return gradient;
}

/// A picture between its pixels, its edges beyond.
glm::dvec3 read(const core::Image& picture, const glm::dvec2& place) {
    const glm::dvec2 last(picture.width() - 1, picture.height() - 1);
    const glm::dvec2 at = glm::clamp(place - 0.5, glm::dvec2(0.0), last);
    const glm::dvec2 low = glm::min(glm::floor(at), glm::max(last - 1.0, glm::dvec2(0.0)));
    const glm::dvec2 t = at - low;
    const auto pixel = [&](double x, double y) {
        const float* const p = picture.at(static_cast<int>(std::min(x, last.x)),
                                          static_cast<int>(std::min(y, last.y)));
        return glm::dvec3(p[0], p[1], p[2]);
    };
    return glm::mix(glm::mix(pixel(low.x, low.y), pixel(low.x + 1.0, low.y), t.x),
                    glm::mix(pixel(low.x, low.y + 1.0), pixel(low.x + 1.0, low.y + 1.0), t.x), t.y);
}

} // namespace

core::Result<document::Gradient> gradientOfPanorama(const core::Image& panorama,
                                                    const glm::dvec3& axis, LightKind kind,
                                                    std::size_t stops) {
    if (panorama.empty() || panorama.width() != 2 * panorama.height() || panorama.channels() != 3) {
        return core::refused("a panorama is twice as wide as high, of three channels");
    }
    const auto checked = checkedAxis(axis);
    const auto count = checkedCount(stops);
    if (!checked || !count) {
        return checked ? count.error() : checked.error();
    }
    const lighting::ZonalRadiance zonal =
        lighting::zonalFromPanorama(panorama, glm::normalize(*checked), lighting::zonesFor(kind))
            .radiance;
    const std::vector<double> edges = lighting::zoneEdges(zonal.zones);
    std::vector<lighting::GradientStop> made;
    const auto add = [&](double theta, const glm::dvec3& radiance) {
        const double at = atFromAxis(std::min(theta * (180.0 / std::numbers::pi), 180.0), kind);
        made.push_back(stopOf(plain(at), plain(radiance)));
    };
    add(0.0, zonal.means.front());
    for (std::size_t i = 0; i < zonal.means.size(); ++i) {
        add(0.5 * (edges[i] + edges[i + 1]), zonal.means[i]);
    }
    add(edges.back(), zonal.means.back());
    return ofStops(made, stops);
}

core::Result<document::Gradient> gradientAlongLine(const core::Image& picture,
                                                   const PictureLine& line, LightKind kind,
                                                   std::size_t stops) {
    if (picture.empty() || picture.channels() != 3) {
        return core::refused("a picture has pixels, of three channels");
    }
    const auto from = checkedAngle(line.fromAt, kind);
    const auto to = checkedAngle(line.toAt, kind);
    const auto count = checkedCount(stops);
    if (!from || !to || !count) {
        return !from ? from.error() : !to ? to.error() : count.error();
    }
    const glm::dvec2 span = line.to - line.from;
    if (!std::isfinite(span.x) || !std::isfinite(span.y) || !std::isfinite(line.from.x) ||
        !std::isfinite(line.from.y)) {
        return core::refused("a number is needed, not NaN or infinity");
    }
    if (*from == *to) {
        return core::refused("the ends of a line stand for different angles");
    }
    std::vector<lighting::GradientStop> made;
    for (int i = 0; i < kLinePlaces; ++i) {
        const double t = i / (kLinePlaces - 1.0);
        const double at = plain((1.0 - t) * *from + t * *to);
        made.push_back(stopOf(at, plain(read(picture, line.from + t * span))));
    }
    if (fromAxis(*from, kind) > fromAxis(*to, kind)) {
        std::reverse(made.begin(), made.end());
    }
    return ofStops(made, stops);
}

} // namespace lodestar::model

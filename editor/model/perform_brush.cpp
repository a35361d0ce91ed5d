// SPDX-License-Identifier: MIT
//
// The freehand brush. Along one angle a stroke through its places covers the interval that holds
// them all; the brush's middle is drawn over that interval, its soft rim lies around it. Degrees
// here count from the axis.
#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

#include "model/perform.h"
#include "model/ramp.h"
#include "model/rules.h"

namespace lodestar::model {
namespace {

using lighting::LightKind;

/// Stops across each soft rim, ends included, besides those that are there.
constexpr int kRimStops = 5;
/// Places over which Smooth takes its mean.
constexpr int kMeanPlaces = 9;

struct Stroke {
    double first = 0.0, last = 0.0; ///< the interval
    double core = 0.0, radius = 0.0;
    bool hard = false; ///< no rim: its edges are steps

    /// How much the brush covers an angle, [0, 1].
    [[nodiscard]] double coverage(double angle) const {
        const double distance = std::max({first - angle, angle - last, 0.0});
        if (distance >= radius) {
            return 0.0;
        }
        const double t = hard ? 0.0 : std::clamp((distance - core) / (radius - core), 0.0, 1.0);
        return 1.0 - t * t * (3.0 - 2.0 * t);
    }
    /// Where stops are wanted, ascending.
    [[nodiscard]] std::vector<double> places() const {
        std::vector<double> made;
        for (int i = 0; i < kRimStops && !hard; ++i) {
            const double t = i / (kRimStops - 1.0);
            made.push_back(first - radius + t * (radius - core));
            made.push_back(last + radius - t * (radius - core));
        }
        std::sort(made.begin(), made.end());
        return made;
    }
};

core::Result<Stroke> strokeOf(const BrushStroke& command, LightKind kind) {
    const Brush& brush = command.brush;
    if (command.path.empty()) {
        return core::refused("a stroke has at least one place");
    }
    if (!(brush.size >= 1e-6 && brush.size <= 180.0)) {
        return core::refused("a brush is from 0.000001 to 180 degrees across");
    }
    if (!(brush.softness >= 0.0 && brush.softness <= 1.0) ||
        !(brush.strength >= 0.0 && brush.strength <= 1.0)) {
        return core::refused("a brush's softness and strength lie from 0 to 1");
    }
    for (int c = 0; c < 3; ++c) {
        if (!(brush.color[c] >= 0.0 && brush.color[c] <= lighting::kMaxRadiance)) {
            return core::refused("a radiance lies from 0 to 1e9");
        }
    }
    Stroke stroke{180.0, 0.0, 0.5 * brush.size * (1.0 - brush.softness), 0.5 * brush.size, false};
    stroke.hard = stroke.radius - stroke.core < 1e-9;
    for (const double place : command.path) {
        const auto at = checkedAngle(place, kind);
        if (!at) {
            return at.error();
        }
        stroke.first = std::min(stroke.first, fromAxis(*at, kind));
        stroke.last = std::max(stroke.last, fromAxis(*at, kind));
    }
    return stroke;
}

/// Adds stops where the stroke bends the gradient; what shines stays as it is.
class Bend {
public:
    Bend(GradientEdit& edit, const Stroke& stroke, BrushMode mode) : edit_(edit) {
        near_ = (stroke.radius - stroke.core) / (4.0 * kRimStops);
        const double least = std::max(0.0, stroke.first - stroke.radius);
        const double most = std::min(180.0, stroke.last + stroke.radius);
        edit_.closeBefore(atFromAxis(most, edit_.kind));
        const document::Gradient was = edit_.gradient;
        std::vector<double> wanted = stroke.places();
        if (mode == BrushMode::Smooth) {
            addCorners(stroke, wanted);
        }
        for (double& angle : wanted) {
            angle = std::clamp(angle, least, most);
        }
        add(was, wanted);
        if (stroke.hard) {
            // The outer stop of each step keeps the light there, the inner one is painted.
            addEdge(was, stroke.first - stroke.radius, true);
            addEdge(was, stroke.last + stroke.radius, false);
        }
    }
    /// The stops that are painted though they lie at the edge.
    [[nodiscard]] const std::vector<Id>& inner() const { return inner_; }

private:
    void add(const document::Gradient& was, const std::vector<double>& angles) {
        std::vector<double> places;
        places.reserve(angles.size());
        for (const double angle : angles) {
            places.push_back(plain(atFromAxis(angle, edit_.kind)));
        }
        const std::vector<glm::dvec3> radiances = radianceAt(was, edit_.kind, places);
        for (std::size_t i = 0; i < places.size(); ++i) {
            const std::size_t at = edit_.after(places[i]);
            if (!taken(places[i], at)) {
                edit_.insert(at, {stopOf(places[i], radiances[i], evBefore(at)), {}});
            }
        }
    }
    /// Smooth bends the gradient about each stop of its own.
    void addCorners(const Stroke& stroke, std::vector<double>& wanted) const {
        const double reach = 0.5 * stroke.radius;
        for (const document::Stop& stop : edit_.gradient.stops) {
            const double angle = fromAxis(stop.stop.at, edit_.kind);
            for (const double offset : {-reach, -0.5 * reach, 0.5 * reach, reach}) {
                if (stroke.coverage(angle + offset) > 0.0) {
                    wanted.push_back(angle + offset);
                }
            }
        }
        std::sort(wanted.begin(), wanted.end());
    }
    void addEdge(const document::Gradient& was, double angle, bool first) {
        if (angle < 0.0 || angle > 180.0) {
            return;
        }
        const double place = plain(atFromAxis(angle, edit_.kind));
        // The light on the outer side: beyond a step, its last stop's; before one, its first's.
        const double toAxis = edit_.kind == LightKind::Sky ? 90.0 : 0.0;
        const double side = first ? place : std::nextafter(place, toAxis);
        const glm::dvec3 radiance = radianceAt(was, edit_.kind, {&side, 1}).front();
        const std::size_t at = first ? edit_.after(place) : edit_.before(place);
        const document::Stop stop{stopOf(place, radiance, evBefore(at)), {}};
        const Id one = edit_.insert(at, stop);
        const Id two = edit_.insert(at + 1, stop);
        inner_.push_back(first ? two : one);
    }
    [[nodiscard]] double evBefore(std::size_t i) const {
        return edit_.gradient.stops[i > 0 ? i - 1 : 0].stop.ev;
    }
    /// Whether a neighbour is so near that another stop would show nothing.
    [[nodiscard]] bool taken(double at, std::size_t i) const {
        const std::vector<document::Stop>& stops = edit_.gradient.stops;
        return (i > 0 && std::abs(stops[i - 1].stop.at - at) <= near_) ||
               (i < stops.size() && std::abs(stops[i].stop.at - at) <= near_);
    }

    GradientEdit& edit_;
    double near_ = 0.0;
    std::vector<Id> inner_;
};

/// The mean radiance over a width about an angle.
glm::dvec3 meanAbout(const lighting::RadianceProfile& profile, double angle, double width) {
    glm::dvec3 sum(0.0);
    for (int i = 0; i < kMeanPlaces; ++i) {
        const double place = angle + width * ((i + 0.5) / kMeanPlaces - 0.5);
        sum += profile.radiance(glm::radians(std::clamp(place, 0.0, 180.0)));
    }
    return sum / static_cast<double>(kMeanPlaces);
}

} // namespace

Performed performOn(State& state, const BrushStroke& command) {
    auto edit = editGradient(state, command.key);
    if (!edit) {
        return edit.error();
    }
    const auto stroke = strokeOf(command, edit->kind);
    if (!stroke) {
        return stroke.error();
    }
    if (command.brush.strength == 0.0) {
        return std::vector<Id>();
    }
    const auto profile = profileOf(edit->gradient, edit->kind);
    if (!profile) {
        return profile.error();
    }
    const Bend bend(*edit, *stroke, command.brush.mode);
    if (edit->gradient.stops.size() > kMostStops) {
        return core::refused("a gradient has at most 65536 stops");
    }
    for (std::size_t i = 0; i < edit->gradient.stops.size(); ++i) {
        lighting::GradientStop& stop = edit->gradient.stops[i].stop;
        const double angle = fromAxis(stop.at, edit->kind);
        const bool inner = std::find(bend.inner().begin(), bend.inner().end(), edit->names[i]) !=
                           bend.inner().end();
        const double share = command.brush.strength * (inner ? 1.0 : stroke->coverage(angle));
        if (share > 0.0) {
            const glm::dvec3 target = command.brush.mode == BrushMode::Paint
                                          ? command.brush.color
                                          : meanAbout(*profile, angle, stroke->radius);
            stop = stopOf(stop.at, plain(glm::mix(lighting::radianceOf(stop), target, share)),
                          stop.ev);
        }
    }
    return std::vector<Id>();
}

} // namespace lodestar::model

// SPDX-License-Identifier: MIT
#include "plan/probe_history.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plan/effect_plan.h"

namespace lodestar::plan {
namespace {

bool any(const std::array<bool, 6>& faces) {
    return std::find(faces.begin(), faces.end(), true) != faces.end();
}

void mark(ProbeHistory& history, std::size_t face) {
    (history.drawn[face] ? history.again : history.stale)[face] = true;
}

void markAll(ProbeHistory& history, std::string because) {
    history.because = std::move(because);
    for (std::size_t face = 0; face < 6; ++face) {
        mark(history, face);
    }
}

double lengthOf(const std::array<glm::dvec3, 3>& rows) {
    return std::sqrt(glm::dot(rows[0], rows[0]) + glm::dot(rows[1], rows[1]) +
                     glm::dot(rows[2], rows[2]));
}

std::string changeText(double share) {
    return std::isfinite(share)
               ? "its light has changed by " + std::to_string(std::lround(100.0 * share)) + " %"
               : std::string("there is light where there was none");
}

/// Marks the faces that see what has moved.
void markMoved(ProbeHistory& history, const ProbeView& view, const MovedIndex& moved) {
    const MovedIndex::Seen seen =
        moved.from(view.position, view.capture.nearPlane, view.capture.farPlane);
    if (seen.faces == 0) {
        return;
    }
    if (!any(history.stale)) {
        history.because = seen.first->subject + (seen.more ? " and others moved" : " moved");
    }
    history.speed = std::max(history.speed, seen.first->speed);
    for (std::size_t face = 0; face < 6; ++face) {
        if ((seen.faces >> face & 1u) != 0) {
            mark(history, face);
        }
    }
}

/// The faces of the round show from here on.
void publish(ProbeHistory& history) {
    const bool whole =
        std::find(history.drawn.begin(), history.drawn.end(), false) == history.drawn.end();
    if (whole) { // of a part, the others still show the light before
        history.capturedUnder = history.drawingUnder;
    }
    history.stale = history.again;
    history.again.fill(false);
    history.drawn.fill(false);
    history.drawnFor = 0;
    history.asked = false;
    history.sinceCapture = 0;
    history.speed = 0.0;
    if (any(history.stale)) {
        history.because = "what it sees went on moving";
    }
}

void markChanges(ProbeHistory& history, const ProbeView& view, const MovedIndex& moved,
                 double lightThreshold) {
    using lighting::ProbeUpdate;
    const bool begins = !any(history.drawn); // a round, if there is one
    const bool rests = view.update == ProbeUpdate::Once || view.update == ProbeUpdate::OnDemand;
    if (history.ready && rests && begins && !history.asked) {
        history.stale.fill(false); // what moved during the first round is not asked for
    }
    const bool resting = begins && !any(history.stale);
    if (history.requested) {
        markAll(history, "it is asked for");
        history.requested = false;
        history.asked = true;
    } else if (!history.ready || view.update == ProbeUpdate::OnChange) {
        if (history.position && history.position != view.position) {
            markAll(history, "it moved itself");
        } else if (begins && view.lightChange > lightThreshold) {
            markAll(history, changeText(view.lightChange));
        }
        markMoved(history, view, moved);
    } else if (resting && view.update == ProbeUpdate::Always) {
        markAll(history, "it is captured always");
    } else if (resting && view.update == ProbeUpdate::Every && history.sinceCapture >= view.every) {
        markAll(history, "it is captured every " + std::to_string(view.every) + " frames");
    }
}

} // namespace

MovedIndex::MovedIndex(std::vector<Moved> moved) : moved_(std::move(moved)) {
    std::vector<BoxTree::Box> boxes;
    boxes.reserve(moved_.size());
    for (const Moved& thing : moved_) {
        boxes.push_back({thing.low, thing.high});
    }
    tree_ = BoxTree(std::move(boxes));
}

MovedIndex::Seen MovedIndex::from(const glm::vec3& position, double nearPlane,
                                  double farPlane) const {
    Seen seen;
    const auto faces = [&](const BoxTree::Box& box) {
        return lighting::facesSeeing(position, nearPlane, farPlane, box.low, box.high);
    };
    // Only what may tell of a face more is looked at; of one thing alone, whether there is another.
    tree_.visit(
        [&](const BoxTree::Box& box) {
            const unsigned in = faces(box);
            return (in & ~seen.faces) != 0 || (in != 0 && !seen.more);
        },
        [&](std::size_t index) {
            const Moved& thing = moved_[index];
            seen.more = seen.more || seen.first != nullptr;
            if (seen.first == nullptr || thing.speed > seen.first->speed) {
                seen.first = &thing;
            }
            seen.faces |= faces({thing.low, thing.high});
        });
    return seen;
}

double lightChange(const LightState& then, const LightState& now) {
    double change = 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < std::max(then.sources.size(), now.sources.size()); ++i) {
        const std::array<glm::dvec3, 3> none{};
        const auto& a = i < then.sources.size() ? then.sources[i] : none;
        const auto& b = i < now.sources.size() ? now.sources[i] : none;
        change += lengthOf({a[0] - b[0], a[1] - b[1], a[2] - b[2]});
        sum += lengthOf(a);
    }
    if (then == now || change == 0.0) {
        return 0.0;
    }
    return sum > 0.0 && std::isfinite(change) ? change / sum
                                              : std::numeric_limits<double>::infinity();
}

double progressOf(const ProbeHistory& history) {
    const auto count = [](const std::array<bool, 6>& faces) {
        return static_cast<double>(std::count(faces.begin(), faces.end(), true));
    };
    const double drawn = count(history.drawn);
    const double all = drawn + count(history.stale);
    return all > 0.0 ? drawn / all : 1.0;
}

void observe(ProbeHistory& history, ProbeView& view, const MovedIndex& moved,
             const LightState& light, double lightThreshold) {
    using lighting::ProbeUpdate;
    ++history.sinceCapture;
    view.lightChange = history.ready ? lightChange(history.capturedUnder, light) : 0.0;
    if (!view.fromFile && view.influence) {
        markChanges(history, view, moved, lightThreshold);
    } else { // a round that was begun is begun anew: others may draw where its faces wait
        for (std::size_t face = 0; face < 6; ++face) {
            history.stale[face] = history.stale[face] || history.drawn[face];
        }
        history.drawn.fill(false);
        history.again.fill(false);
        history.drawnFor = 0;
    }
    history.position = view.position;
    view.skyChanged = !history.ready || history.composedUnder != light.sky;
    if (view.ratio && history.ready) {
        const bool known = view.skyChanged && history.composedRadiance && light.radiance;
        const std::optional<glm::vec3> factor =
            !view.skyChanged ? glm::vec3(1.0f)
            : known          ? skyFactor(*history.composedRadiance, *light.radiance)
                             : std::nullopt;
        view.skyChanged = !factor;
        history.skyFactor = factor.value_or(history.skyFactor);
    }
    view.skyFactor = history.skyFactor;
    view.ready = history.ready;
    view.stale = view.fromFile ? std::array<bool, 6>{} : history.stale;
    view.drawn = history.drawn;
    view.because = history.because;
    view.waiting = any(view.stale) ? history.waiting : 0;
    view.speed = history.speed;
    view.madeLevel = history.madeLevel;
    view.madeIrradiance = history.madeIrradiance;
    view.fadeLeft = history.fadeLeft;
    view.drawnFor = history.drawnFor;
}

std::vector<ProbeDone> doneFor(const EffectPlan& plan, std::size_t probes) {
    std::vector<ProbeDone> done(probes);
    for (const ProbeFace& face : plan.probeFaces) {
        done[face.probe].faces[static_cast<std::size_t>(face.face)] = true;
    }
    for (const ProbeWork& work : plan.probeWork) {
        done[work.probe].work = &work;
    }
    return done;
}

void executed(ProbeHistory& history, const ProbeDone& done, const LightState& light) {
    const bool faces = any(done.faces);
    if (faces && !any(history.drawn)) {
        history.drawingUnder = light;
    }
    for (std::size_t face = 0; face < 6; ++face) {
        history.stale[face] = history.stale[face] && !done.faces[face];
        history.drawn[face] = history.drawn[face] || done.faces[face];
    }
    history.drawnFor = any(history.drawn) ? history.drawnFor + 1 : 0;
    history.waiting = any(history.stale) && !faces ? history.waiting + 1 : 0;
    if (done.work == nullptr) {
        return;
    }
    if (done.work->publish) {
        publish(history);
    }
    if (done.work->compose) {
        history.ready = true;
        history.madeLevel = done.work->lastLevel;
        history.madeIrradiance = done.work->irradiance;
        history.composedUnder = light.sky;
        history.composedRadiance = light.radiance;
        history.skyFactor = glm::vec3(1.0f);
        history.fadeLeft = done.work->fadeLeft - 1;
    }
}

} // namespace lodestar::plan

// SPDX-License-Identifier: MIT
#include "plan/draw_plan.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>
#include <utility>

namespace lodestar::plan {
namespace {

/// The probes of a draw, and which of them give no light.
using Pair = std::pair<std::array<int, 2>, std::array<bool, 2>>;

constexpr Pair kNoProbes{{ProbeChoice::kNone, ProbeChoice::kNone}, {}};

Pair pairOf(const std::vector<ProbeChoice>& choices, std::size_t draw) {
    return choices.empty() ? kNoProbes : Pair{choices[draw].probe, choices[draw].dark};
}

auto sharing(const DrawView& draw, const Pair& probes) {
    return std::tuple(draw.features, probes, draw.material, draw.geometry, draw.mirrored);
}

/// What every lit draw's shader reads.
Features lightFeatures(const PlanInput& input, const EffectPlan& result) {
    Features features = input.environment.present ? bit(Feature::Environment) : 0u;
    features |= result.rsrmLights.empty() ? 0u : bit(Feature::RsrmLights);
    features |= !result.rsrmLights.empty() && input.rsrmRows ? bit(Feature::RsrmRows) : 0u;
    features |= result.shadowedLights() > 0 ? bit(Feature::Shadows) : 0u;
    features |= input.fresnel == lighting::FresnelForm::Sg ? bit(Feature::SgFresnel) : 0u;
    if (input.lightCount > 0) {
        features |= bit(Feature::PunctualLights);
        features |= input.lobes == lighting::LobeForm::Sg ? bit(Feature::SgLobes) : 0u;
    }
    return features;
}

Features probeFeatures(const PlanInput& input, const ProbeChoice& choice) {
    const bool skies = std::any_of(choice.probe.begin(), choice.probe.end(), [&](int probe) {
        return probe != ProbeChoice::kNone && input.probes[static_cast<std::size_t>(probe)].ratio;
    });
    const bool any = choice.probe[0] != ProbeChoice::kNone || choice.open < 1.0f;
    return (any ? bit(Feature::Probe) : 0u) |
           (choice.probe[1] != ProbeChoice::kNone ? bit(Feature::SecondProbe) : 0u) |
           (skies ? bit(Feature::ProbeSkies) : 0u);
}

/// The Phong exponent of the sharpest lookup that a draw makes in a sun's map (SUN-6).
/// @param sharpest of its other lookups, seen along the surface: 1.294 s - 1.6 at least (LOOK-8)
double sharpestInSuns(double sharpest) {
    const double root = std::sqrt((sharpest + 1.6) / 1.294 + 1.0);
    return std::max(sharpest, 0.315 * root * root * root + 1.7 * root);
}

Features featuresOf(const PlanInput& input, const DrawView& draw, Features lights,
                    const ProbeChoice& choice) {
    if (!draw.lit) {
        return draw.features;
    }
    Features features = draw.features | lights | probeFeatures(input, choice);
    const bool suns =
        std::any_of(input.rsrmLights.begin(), input.rsrmLights.end(),
                    [](const RsrmLightView& light) { return light.shines && !light.sky; });
    if (has(features, Feature::RsrmLights) && !input.rsrmPublished &&
        (suns ? sharpestInSuns(draw.sharpest) : draw.sharpest) > input.rsrmGreatestExponent) {
        features |= bit(Feature::RsrmMirror);
    }
    if (draw.glossy && draw.specular != input.specular) {
        const std::optional<Feature> own = estimatorFeature(draw.specular);
        features |= own ? bit(*own) : 0u;
    }
    return features;
}

/// Opaque draws by what they share, then blended ones, the farthest first.
/// @param distance of a draw
template <class Distance>
void sortForDrawing(const PlanInput& input, const std::vector<ProbeChoice>& choices,
                    const Distance& distance, std::vector<std::size_t>& order) {
    const auto blended = std::stable_partition(
        order.begin(), order.end(), [&](std::size_t i) { return !input.draws[i].blended; });
    std::vector<std::size_t> opaque(order.begin(), blended);
    sortByShared(input, choices, opaque);
    std::copy(opaque.begin(), opaque.end(), order.begin());
    std::stable_sort(blended, order.end(), [&](std::size_t a, std::size_t b) {
        return distance(input.draws[a]) > distance(input.draws[b]);
    });
}

std::string percent(double share) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2g %%", 100.0 * share);
    return text;
}

/// What `auto` chose and why.
std::string choiceText(const DrawView& draw) {
    if (draw.specular.kind == lighting::EstimatorKind::Auto) {
        return "glossy light by tent until errors are foreseen";
    }
    const bool met = draw.foreseenError <= draw.toleratedError;
    return "glossy light by " + lighting::estimatorName(draw.specular) + ", " +
           (met ? "the cheapest within " : "the best, though not within ") +
           percent(draw.toleratedError) + ": " + percent(draw.foreseenError) + " foreseen";
}

/// An effect for each draw; the call to the driver is the first's of its batch.
void describeDraws(const PlanInput& input, EffectPlan& result) {
    std::vector<std::size_t> leader(input.draws.size());
    for (const Batch& batch : result.batches) {
        for (std::size_t i = 0; i < batch.count; ++i) {
            leader[result.drawOrder[batch.first + i]] = result.drawOrder[batch.first];
        }
    }
    result.effects.reserve(result.effects.size() + input.draws.size() + 2);
    for (std::size_t i = 0; i < input.draws.size(); ++i) {
        const DrawView& draw = input.draws[i];
        Effect effect{"draw", draw.subject, Decision::Skip, "outside the view", {}};
        if (draw.visible) {
            effect.decision = Decision::Run;
            effect.reason = leader[i] == i ? "inside the view"
                                           : "inside the view, in one call with '" +
                                                 input.draws[leader[i]].subject + "'";
            if (draw.toleratedError > 0.0 && draw.glossy && draw.lit && input.environment.present) {
                effect.reason += "; " + choiceText(draw);
            }
            effect.cost.draws = leader[i] == i ? 1 : 0;
        }
        result.effects.push_back(std::move(effect));
    }
}

float farness(const DrawView& draw, const glm::vec3& from) {
    return glm::length(0.5f * (draw.low + draw.high) - from);
}

} // namespace

void sortByShared(const PlanInput& input, const std::vector<ProbeChoice>& choices,
                  std::vector<std::size_t>& order) {
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return sharing(input.draws[a], pairOf(choices, a)) <
               sharing(input.draws[b], pairOf(choices, b));
    });
}

std::vector<Batch> batchesOf(const PlanInput& input, const std::vector<ProbeChoice>& choices,
                             const std::vector<std::size_t>& order, std::size_t before) {
    std::vector<Batch> batches;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool newPage = (before + i) % input.instancesPerPage == 0;
        if (i > 0 && !newPage &&
            sharing(input.draws[order[i]], pairOf(choices, order[i])) ==
                sharing(input.draws[order[i - 1]], pairOf(choices, order[i - 1]))) {
            ++batches.back().count;
        } else {
            batches.push_back({i, 1, input.draws[order[i]].mirrored});
        }
    }
    return batches;
}

void planDraws(const PlanInput& input, const std::vector<ProbeChoice>& choices,
               EffectPlan& result) {
    for (std::size_t i = 0; i < input.draws.size(); ++i) {
        if (input.draws[i].visible) {
            result.drawOrder.push_back(i);
        }
    }
    sortForDrawing(
        input, choices, [](const DrawView& draw) { return draw.distance; }, result.drawOrder);
    result.batches = batchesOf(input, choices, result.drawOrder, 0);
    const Features lights = lightFeatures(input, result);
    for (const std::size_t index : result.drawOrder) {
        const ProbeChoice choice = choices.empty() ? ProbeChoice{} : choices[index];
        result.drawFeatures.push_back(featuresOf(input, input.draws[index], lights, choice));
        if (!choices.empty()) {
            result.drawChoices.push_back(choice);
        }
    }
    describeDraws(input, result);
}

namespace {

/// The calls that the faces of each probe take, to its capture's cost.
void addFaceDraws(const PlanInput& input, EffectPlan& result) {
    std::vector<std::uint64_t> draws(input.probes.size());
    for (const ProbeFace& face : result.probeFaces) {
        draws[face.probe] += face.batches.size();
    }
    std::size_t capture = 0; // hosts' own come first
    for (Effect& effect : result.effects) {
        if (effect.effect == "probe-capture") {
            if (capture >= input.captures.size()) {
                effect.cost.draws = draws[capture - input.captures.size()];
            }
            ++capture;
        }
    }
}

} // namespace

void planFaces(const PlanInput& input, const ProbeIndex& index, EffectPlan& result) {
    const Features lights = lightFeatures(input, result);
    std::size_t before = result.drawOrder.size() + result.casters.size();
    const std::vector<bool> ready =
        readyProbes(input); // what this frame makes comes after its faces
    std::vector<ProbeChoice> choices(result.probeFaces.empty() ? 0 : input.draws.size());
    for (ProbeFace& face : result.probeFaces) {
        for (const std::size_t draw : face.drawOrder) {
            const DrawView& view = input.draws[draw];
            choices[draw] =
                view.lit ? index.choose(view.low, view.high, ready, static_cast<int>(face.probe))
                         : ProbeChoice{};
        }
        const glm::vec3 from = input.probes[face.probe].position;
        sortForDrawing(
            input, choices, [&](const DrawView& draw) { return farness(draw, from); },
            face.drawOrder);
        face.batches = batchesOf(input, choices, face.drawOrder, before);
        before += face.drawOrder.size();
        for (const std::size_t draw : face.drawOrder) {
            face.choices.push_back(choices[draw]);
            face.drawFeatures.push_back(
                featuresOf(input, input.draws[draw], lights, choices[draw]));
        }
    }
    if (!result.probeFaces.empty()) {
        addFaceDraws(input, result);
    }
}

} // namespace lodestar::plan

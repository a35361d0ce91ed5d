// SPDX-License-Identifier: MIT
#include "plan/probe_plan.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "lodestar/cube.glsl"
#include "plan/effect_plan.h"

namespace lodestar::plan {
namespace {

/// What is lit by a probe in the picture.
struct Receivers {
    int count = 0;
    bool diffuse = false;
    bool glossy = false;
    double share = 0.0;                                        ///< of the picture, at most 1
    double bluntest = std::numeric_limits<double>::infinity(); ///< Phong exponents of lookups
    double sharpest = 0.0;
};

/// A cross-fade lasts as long as its faces took to be drawn, at most that many frames.
constexpr int kLongestFade = 16;

int countOf(const std::array<bool, 6>& faces) {
    return static_cast<int>(std::count(faces.begin(), faces.end(), true));
}

/// Of the draws that are visible and lit.
std::vector<ProbeChoice> choicesOf(const PlanInput& input, const ProbeIndex& index,
                                   const std::vector<bool>& lights) {
    std::vector<ProbeChoice> choices(input.draws.size());
    for (std::size_t i = 0; i < input.draws.size(); ++i) {
        const DrawView& draw = input.draws[i];
        if (draw.visible && draw.lit) {
            choices[i] = index.choose(draw.low, draw.high, lights);
        }
    }
    return choices;
}

std::vector<Receivers> receiversOf(const PlanInput& input,
                                   const std::vector<ProbeChoice>& choices) {
    std::vector<Receivers> receivers(input.probes.size());
    for (std::size_t i = 0; i < input.draws.size(); ++i) {
        const DrawView& draw = input.draws[i];
        for (const int probe : draw.visible&& draw.lit ? choices[i].probe : ProbeChoice{}.probe) {
            if (probe == ProbeChoice::kNone) {
                continue;
            }
            Receivers& lit = receivers[static_cast<std::size_t>(probe)];
            ++lit.count;
            lit.diffuse = lit.diffuse || draw.diffuse;
            lit.share = std::min(lit.share + static_cast<double>(draw.screenShare), 1.0);
            if (draw.glossy) {
                lit.glossy = true;
                lit.bluntest = std::min(lit.bluntest, draw.bluntest);
                lit.sharpest = std::max(lit.sharpest, draw.sharpest);
            }
        }
    }
    return receivers;
}

int widthOf(const ProbeView& probe, int level) {
    return std::max(probe.capture.resolution >> level, 1);
}

/// The deepest level that a probe's receivers read: of the bluntest lookup where texels are the
/// smallest, and the coarsest of more than 16 texels, of which irradiance is made.
int lastLevel(const ProbeView& probe, const Receivers& receivers) {
    const double width = static_cast<double>(std::max(probe.capture.resolution, 1));
    const int last = static_cast<int>(std::floor(std::log2(width)));
    int level = 0;
    if (receivers.diffuse) {
        while (widthOf(probe, level + 1) > 16) {
            ++level;
        }
    }
    if (receivers.glossy) {
        const auto exponent = static_cast<float>(std::min(receivers.bluntest, 1e7));
        const float deepest = shader::lodestar_tentLevel(
            glm::vec3(0.57735f), exponent, static_cast<float>(width), static_cast<float>(last));
        level = std::max(level, static_cast<int>(std::ceil(deepest)));
    }
    return level;
}

std::uint64_t faceTexels(const ProbeView& probe) {
    const auto width = static_cast<std::uint64_t>(probe.capture.resolution);
    return width * width;
}

/// What gl/probe_filter.h writes for irradiance: 16 parts of seven colours, then a tile.
constexpr std::uint64_t kPartTexels = 16 * 7;
constexpr std::uint64_t kTileTexels = 25 * 25;
/// The rows of a tile that tell of suns.
constexpr std::uint64_t kSunTexels = 25 * 2;

/// What gl/probe_filter.h does for levels 1 to a last one: a pass each.
Cost mipCost(const ProbeView& probe, int last) {
    Cost cost;
    for (int level = 1; level <= last; ++level) {
        const auto width = static_cast<std::uint64_t>(widthOf(probe, level));
        cost.texelsWritten += 6 * width * width;
        ++cost.passes;
    }
    cost.draws = cost.passes;
    return cost;
}

std::string exponentText(double exponent) {
    return exponent < 1e7 ? std::to_string(std::llround(exponent)) : std::string("a mirror");
}

/// "0.8", or "0.8, 0.7, 0.6" where the channels differ.
std::string factorText(const glm::vec3& factor) {
    const bool grey = factor.r == factor.g && factor.g == factor.b;
    std::string text;
    for (int c = 0; c < (grey ? 1 : 3); ++c) {
        std::array<char, 16> digits{};
        std::snprintf(digits.data(), digits.size(), "%.3g", static_cast<double>(factor[c]));
        text += (c > 0 ? ", " : "") + std::string(digits.data());
    }
    return text;
}

/// Decides for all probes in one frame.
class ProbePlanner {
public:
    ProbePlanner(const PlanInput& input, const std::vector<Receivers>& receivers,
                 EffectPlan& result)
        : input_(input), receivers_(receivers), result_(result),
          left_(std::max(input.faceBudget - static_cast<int>(result.captureFaces.size()), 0)),
          leftMs_(input.probeBudgetMs), drawnNow_(input.probes.size()) {}

    void plan() {
        for (std::size_t i = 0; i < input_.probes.size(); ++i) {
            leftMs_ -= workOf(i, false).compose ? input_.probes[i].lightMs : 0.0;
        }
        for (const std::size_t probe : inTurn()) {
            drawFaces(probe);
        }
        for (std::size_t i = 0; i < input_.probes.size(); ++i) {
            result_.effects.push_back(captureEffect(i));
            makeLight(i);
        }
    }

private:
    [[nodiscard]] bool inProgress(std::size_t i) const {
        return countOf(input_.probes[i].drawn) > 0;
    }
    [[nodiscard]] bool captures(std::size_t i) const {
        const ProbeView& probe = input_.probes[i];
        return probe.influence && !probe.fromFile && countOf(probe.stale) > 0 &&
               (receivers_[i].count > 0 || inProgress(i));
    }
    /// The picture's share of what it lights, the speed of what moved before it, and its patience:
    /// waiting grows without bound, so that none is passed over for ever. One that shows nothing
    /// yet comes before all that do.
    [[nodiscard]] double urgency(std::size_t i) const {
        const ProbeView& probe = input_.probes[i];
        const double waited = 1.0 + static_cast<double>(probe.waiting);
        return (probe.ready ? 1.0 : 1e6) * (0.01 + receivers_[i].share) *
               (1.0 + std::min(probe.speed, 10.0)) * waited * waited;
    }
    /// Probes that want faces: one that has been begun is finished before another is.
    [[nodiscard]] std::vector<std::size_t> inTurn() const {
        std::vector<std::size_t> turn;
        for (std::size_t i = 0; i < input_.probes.size(); ++i) {
            if (captures(i)) {
                turn.push_back(i);
            }
        }
        std::stable_sort(turn.begin(), turn.end(), [&](std::size_t a, std::size_t b) {
            return inProgress(a) != inProgress(b) ? inProgress(a) : urgency(a) > urgency(b);
        });
        return turn;
    }

    void drawFaces(std::size_t i) {
        const ProbeView& probe = input_.probes[i];
        for (int face = 0; face < 6 && left_ > 0; ++face) {
            if (probe.stale[static_cast<std::size_t>(face)]) {
                if (!affords(i, face)) {
                    left_ = 0;
                    return;
                }
                ProbeFace drawn;
                drawn.probe = i;
                drawn.face = face;
                result_.probeFaces.push_back(std::move(drawn));
                drawnNow_[i].push_back(face);
                --left_;
            }
        }
    }

    /// Whether the frame has the milliseconds for the next of its faces, and takes them. A frame's
    /// first face is free: a budget that is always spent on light would starve all that wait.
    [[nodiscard]] bool affords(std::size_t i, int face) {
        const ProbeView& probe = input_.probes[i];
        const bool last = static_cast<int>(drawnNow_[i].size()) + 1 == countOf(probe.stale);
        const double known = probe.faceMs[static_cast<std::size_t>(face)];
        const double takes = known > 0.0 ? known : std::numeric_limits<double>::infinity();
        const double light = last && !workOf(i, false).compose ? probe.lightMs : 0.0;
        spentMs_ = !result_.probeFaces.empty() && takes + light > leftMs_;
        leftMs_ -= std::isinf(leftMs_) ? 0.0 : takes + light;
        return !spentMs_;
    }

    [[nodiscard]] bool publishes(std::size_t i) const {
        const ProbeView& probe = input_.probes[i];
        if (input_.facesComeLater) {
            return inProgress(i) && countOf(probe.stale) == 0 && countOf(probe.awaited) == 0;
        }
        return static_cast<int>(drawnNow_[i].size()) == countOf(probe.stale) &&
               (inProgress(i) || !drawnNow_[i].empty());
    }

    [[nodiscard]] Effect captureEffect(std::size_t i) const {
        const ProbeView& probe = input_.probes[i];
        Effect effect{"probe-capture", probe.subject, Decision::Skip, {}, {}, drawnNow_[i]};
        const int stale = countOf(probe.stale);
        if (!probe.influence) {
            effect.reason = "it has no inside";
        } else if (!drawnNow_[i].empty()) {
            effect.decision = Decision::Run;
            effect.reason = std::to_string(drawnNow_[i].size()) + " of 6 faces: " + probe.because;
            effect.cost.passes = drawnNow_[i].size();
            effect.cost.texelsWritten = drawnNow_[i].size() * faceTexels(probe);
        } else if (receivers_[i].count == 0 && !inProgress(i)) {
            effect.reason = "nobody sees it";
        } else if (probe.fromFile) {
            effect.reason = "it holds a file's light";
        } else if (countOf(probe.awaited) > 0) {
            effect.reason = "waits for faces that were asked for: " + probe.because;
        } else if (stale > 0) {
            effect.reason = std::string("waits, the frame's ") +
                            (spentMs_ ? "milliseconds" : "faces") +
                            " are spent: " + std::to_string(stale) +
                            (stale == 1 ? " face, " : " faces, ") + probe.because;
        } else {
            effect.reason = "nothing that it sees has changed";
        }
        return effect;
    }

    /// What is made of a probe whose faces are published now or are not.
    [[nodiscard]] ProbeWork workOf(std::size_t i, bool publish) const {
        const ProbeView& probe = input_.probes[i];
        const Receivers& lit = receivers_[i];
        ProbeWork work;
        work.probe = i;
        work.publish = publish;
        const bool first = probe.fromFile && !probe.ready;
        const bool needed = probe.influence && (lit.count > 0 || publish);
        const bool shows = probe.ready || publish || first;
        // A new receiver may read what none did before.
        work.lastLevel = lastLevel(probe, lit);
        work.irradiance = lit.diffuse || lit.count == 0;
        const bool more =
            work.lastLevel > probe.madeLevel || (lit.diffuse && !probe.madeIrradiance);
        work.compose =
            needed && shows && (publish || probe.fadeLeft > 0 || probe.skyChanged || first || more);
        const int took = probe.drawnFor + (drawnNow_[i].empty() ? 0 : 1);
        work.fadeLeft = !publish      ? std::max(probe.fadeLeft, 1)
                        : probe.ready ? std::clamp(took, 1, kLongestFade)
                                      : 1;
        return work;
    }

    void makeLight(std::size_t i) {
        const ProbeWork work = workOf(i, publishes(i));
        if (work.compose) {
            result_.probeWork.push_back(work);
            describe(work);
            return;
        }
        const ProbeView& probe = input_.probes[i];
        if (probe.ratio && receivers_[i].count > 0 && probe.skyFactor != glm::vec3(1.0f)) {
            result_.effects.push_back(
                {"probe-ratio",
                 probe.subject,
                 Decision::Run,
                 "sky " + factorText(probe.skyFactor) + " times as bright: a factor, no pass",
                 {}});
        }
    }

    void describe(const ProbeWork& work) {
        const ProbeView& probe = input_.probes[work.probe];
        const Receivers& lit = receivers_[work.probe];
        Effect compose{"probe-compose", probe.subject, Decision::Run, {}, {}};
        compose.reason = work.publish         ? "composed: its faces are published"
                         : probe.fadeLeft > 0 ? "composed: what was published fades in"
                         : !probe.ready       ? "composed: a file's light is shown"
                         : probe.skyChanged
                             ? probe.ratio ? "composed again: the sky has changed, not by a factor"
                                           : "composed again: the sky has changed"
                             : "composed again: what it lights now reads more of it";
        // And one for what it sees of suns.
        const std::uint64_t suns = input_.rsrmLights.empty() ? 0 : 1;
        const std::uint64_t parts = probe.ratio ? 2 : 1; // the sky's apart
        compose.cost = {6 * parts + suns, 6 * parts + suns,
                        6 * parts * faceTexels(probe) + suns * kSunTexels, 0};
        result_.effects.push_back(std::move(compose));
        if (work.lastLevel > 0) {
            Effect mips{"probe-mips", probe.subject, Decision::Run, {}, {}};
            mips.reason = "levels 1 to " + std::to_string(work.lastLevel);
            if (lit.glossy) {
                mips.reason += ", for exponents " + exponentText(lit.bluntest) + " to " +
                               exponentText(lit.sharpest);
            }
            mips.cost = mipCost(probe, work.lastLevel);
            mips.cost.draws *= parts;
            mips.cost.passes *= parts;
            mips.cost.texelsWritten *= parts;
            result_.effects.push_back(std::move(mips));
        }
        if (work.irradiance) {
            result_.effects.push_back(
                {"probe-irradiance",
                 probe.subject,
                 Decision::Run,
                 "visible diffuse surfaces are lit by it",
                 {2 * parts, 2 * parts, parts * (kPartTexels + kTileTexels), 0}});
        }
    }

    const PlanInput& input_;
    const std::vector<Receivers>& receivers_;
    EffectPlan& result_;
    int left_;             ///< faces
    double leftMs_;        ///< milliseconds
    bool spentMs_ = false; ///< and not faces
    std::vector<std::vector<int>> drawnNow_;
};

/// The draws that each face sees, in the input's order.
void cullFaces(const PlanInput& input, EffectPlan& result) {
    for (std::size_t first = 0; first < result.probeFaces.size();) {
        std::size_t end = first;
        const std::size_t index = result.probeFaces[first].probe;
        while (end < result.probeFaces.size() && result.probeFaces[end].probe == index) {
            ++end;
        }
        const ProbeView& probe = input.probes[index];
        for (std::size_t i = 0; i < input.draws.size(); ++i) {
            const DrawView& draw = input.draws[i];
            if ((draw.layers & probe.capture.layers) == 0) {
                continue;
            }
            const unsigned faces =
                lighting::facesSeeing(probe.position, probe.capture.nearPlane,
                                      probe.capture.farPlane, draw.low, draw.high);
            for (std::size_t f = first; faces != 0 && f < end; ++f) {
                if ((faces >> static_cast<unsigned>(result.probeFaces[f].face) & 1u) != 0) {
                    result.probeFaces[f].drawOrder.push_back(i);
                }
            }
        }
        first = end;
    }
}

} // namespace

std::vector<bool> readyProbes(const PlanInput& input) {
    std::vector<bool> ready;
    for (const ProbeView& probe : input.probes) {
        ready.push_back(probe.ready);
    }
    return ready;
}

std::vector<ProbeChoice> planProbes(const PlanInput& input, const ProbeIndex& index,
                                    EffectPlan& result) {
    if (input.probes.empty()) {
        return {};
    }
    // What is asked for is what would light, were all probes ready.
    const std::vector<bool> all(input.probes.size(), true);
    std::vector<ProbeChoice> choices = choicesOf(input, index, all);
    const std::vector<Receivers> receivers = receiversOf(input, choices);
    ProbePlanner(input, receivers, result).plan();
    cullFaces(input, result);
    std::vector<bool> lights = readyProbes(input);
    for (const ProbeWork& work : result.probeWork) {
        lights[work.probe] = true;
    }
    return lights == all ? choices : choicesOf(input, index, lights);
}

} // namespace lodestar::plan

// SPDX-License-Identifier: MIT
#include "probe_plans.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "context.h"
#include "lighting/zonal.h"
#include "plan/state_hash.h"

namespace lodestar::plugin {
namespace {

/// Irradiance over pi of a surface that faces the light at the hour last looked at.
glm::dvec3 facingIrradiance(PlacedLight& light) {
    const lighting::DayLight& day = light.map.day();
    for (std::size_t key = light.facing.size(); key < day.keys.size(); ++key) {
        light.facing.push_back(lighting::facingIrradiance(
            lighting::keyRadiance(day, key, lighting::zonesFor(day.kind))));
    }
    const lighting::LightMap::Content& content = light.content;
    return content.factor *
           ((1.0 - content.t) * light.facing[content.from] + content.t * light.facing[content.to]);
}

bool isSky(const PlacedLight& light) {
    return light.map.day().kind == lighting::LightKind::Sky;
}

/// The distant environment where it is seen; null: there is none, or a sky stands in its place.
PlacedEnvironment* seenEnvironment(LodestarContext& context) {
    PlacedEnvironment* distant = context.environments.find(context.environment);
    const bool replaced =
        std::any_of(context.order.begin(), context.order.end(), [&](const LodestarLight light) {
            return lighting::replacesEnvironment(context.lights.find(light)->map.day());
        });
    return distant != nullptr && distant->version() != 0 && !replaced ? distant : nullptr;
}

plan::LightState lightState(LodestarContext& context,
                            const std::vector<lighting::DayMoment>& moments) {
    plan::LightState state;
    plan::StateHash sky;
    PlacedEnvironment* distant = seenEnvironment(context);
    const glm::dvec3 up = context.hostFromDocument * glm::dvec3(0.0, 1.0, 0.0);
    state.sources.push_back(
        plan::along(distant != nullptr ? distant->mean() : glm::dvec3(0.0), up));
    sky.fold(distant != nullptr ? context.environment : 0);
    sky.fold(distant != nullptr ? distant->version() : 0);
    for (std::size_t i = 0; i < moments.size(); ++i) {
        PlacedLight& light = *context.lights.find(context.order[i]);
        const glm::dvec3 facing =
            moments[i].visibility > 0.0 ? facingIrradiance(light) : glm::dvec3(0.0);
        state.sources.push_back(plan::along(facing, moments[i].axis));
        if (isSky(light)) {
            sky.fold(context.order[i]);
            sky.fold(light.version);
            for (int c = 0; c < 3; ++c) {
                sky.fold(moments[i].axis[c]);
            }
        }
    }
    state.sky = sky.value();
    return state;
}

LodestarDrawProbes drawProbesOf(const plan::ProbeChoice& choice, plan::Features features,
                                std::size_t draw, const std::vector<LodestarProbe>& order) {
    LodestarDrawProbes result{};
    result.struct_size = sizeof result;
    result.draw = static_cast<std::uint32_t>(draw);
    for (std::size_t k = 0; k < 2; ++k) {
        if (choice.probe[k] != plan::ProbeChoice::kNone) {
            result.probe[k] = order[static_cast<std::size_t>(choice.probe[k])];
            result.dark[k] = choice.dark[k] ? 1 : 0;
            result.factor[k] = choice.factor[k];
        }
    }
    result.open = choice.open;
    result.features = featureBits(features);
    return result;
}

/// As `volumeOf` of shaders/plugin/probes.glsl reads them.
std::array<glm::vec4, LODESTAR_PROBE_VECTORS>
vectorsOf(const plan::ProbeView& view, const PlacedProbe& placed, const ProbeState& state) {
    std::array<glm::vec4, LODESTAR_PROBE_VECTORS> v{};
    const lighting::PlacedVolume& influence = *view.influence;
    std::copy(influence.rows.begin(), influence.rows.end(), v.begin());
    v[3] = glm::vec4(influence.halfExtents, influence.sphere ? 1.0f : 0.0f);
    v[4] = glm::vec4(influence.blendHigh, influence.outward ? 1.0f : 0.0f);
    v[5] = glm::vec4(influence.blendLow, 0.0f);
    v[9].w = -1.0f;
    if (const auto proxy = placed.proxy()) {
        std::copy(proxy->rows.begin(), proxy->rows.end(), v.begin() + 6);
        v[9] = glm::vec4(proxy->halfExtents, proxy->sphere ? 1.0f : 0.0f);
    }
    v[10] = glm::vec4(view.position, 0.0f);
    v[11] = glm::vec4(glm::vec3(placed.probe().tint * placed.probe().intensity), 0.0f);
    if (state.texels[0]) {
        v[10].w = static_cast<float>(state.texels[0]->width);
        v[11].w = static_cast<float>(state.lastLevel);
        v[12] = {state.texels[0]->scale, state.texels[1]->scale, 0.0f, 0.0f};
    }
    return v;
}

} // namespace

const ProbePacket::Light* ProbePacket::find(LodestarProbe probe) const {
    const auto found = std::find_if(lights.begin(), lights.end(),
                                    [&](const Light& light) { return light.of == probe; });
    return found != lights.end() ? &*found : nullptr;
}

ProbePlanning::ProbePlanning(LodestarContext& context,
                             const std::vector<lighting::DayMoment>& moments,
                             plan::PlanInput& input)
    : context_(context), moments_(moments) {
    if (!context.boxes || context.probeOrder.empty()) {
        return;
    }
    active_ = true;
    number_ = context.plans.next();
    markMoved(input);
    const plan::MovedIndex moved(std::move(moved_));
    light_ = lightState(context, moments);
    input.facesComeLater = true;
    for (const LodestarProbe handle : context.probeOrder) {
        const PlacedProbe& placed = *context.probes.find(handle);
        ProbeState& state = states_.emplace_back(placed.state);
        PlacedProbe::giveUp(state, number_);
        plan::ProbeView view = placed.view();
        plan::observe(state.history, view, moved, light_, context.boxes->lightThreshold);
        for (std::size_t face = 0; face < 6; ++face) {
            view.awaited[face] = state.askedBy[face] != 0;
        }
        input.probes.push_back(std::move(view));
    }
    published_.resize(states_.size());
}

/// Compares where things are with where they were.
void ProbePlanning::markMoved(const plan::PlanInput& input) {
    const std::vector<DrawBox>& boxes = context_.boxes->draws;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        seen_.push_back(
            {boxes[i].id, boxes[i].low, boxes[i].high, boxes[i].changed, input.draws[i].subject});
    }
    std::sort(seen_.begin(), seen_.end(),
              [](const SeenBox& a, const SeenBox& b) { return a.id < b.id; });
    if (!context_.seen) {
        return; // the first frame: nothing has been captured
    }
    const std::vector<SeenBox>& before = *context_.seen;
    auto was = before.begin();
    auto is = seen_.cbegin();
    while (was != before.end() || is != seen_.cend()) {
        if (is == seen_.cend() || (was != before.end() && was->id < is->id)) {
            moved_.push_back({was->subject, was->low, was->high, 0.0});
            ++was;
        } else if (was == before.end() || is->id < was->id) {
            moved_.push_back({is->subject, is->low, is->high, 0.0});
            ++is;
        } else {
            if (is->changed || was->low != is->low || was->high != is->high) {
                const double way = static_cast<double>(
                    std::max(glm::length(is->low - was->low), glm::length(is->high - was->high)));
                moved_.push_back(
                    {is->subject, glm::min(was->low, is->low), glm::max(was->high, is->high), way});
            }
            ++was;
            ++is;
        }
    }
}

void ProbePlanning::prepareSky() {
    PlacedEnvironment* distant = seenEnvironment(context_);
    distant_ = distant != nullptr ? &distant->tentMips() : nullptr;
    for (std::size_t i = 0; i < moments_.size(); ++i) {
        PlacedLight& light = *context_.lights.find(context_.order[i]);
        if (isSky(light) && moments_[i].visibility > 0.0) {
            skies_.push_back({moments_[i].axis, texelsOf(light)});
        }
    }
}

glm::vec3 ProbePlanning::sky(const glm::vec3& direction, int width) const {
    glm::vec3 sum(0.0f);
    if (distant_ != nullptr) {
        const float finer =
            std::log2(static_cast<float>(distant_->width()) / static_cast<float>(width));
        sum += glm::vec3(distant_->sample(direction, std::max(finer, 0.0f)));
    }
    for (const Sky& one : skies_) {
        const double halfChord = 0.5 * glm::length(glm::dvec3(direction) - one.axis);
        sum += lighting::rsrmRadiance(one.blend->texels, one.blend->gradient,
                                      2.0 * std::asin(std::min(halfChord, 1.0)),
                                      std::numeric_limits<double>::infinity());
    }
    return sum;
}

void ProbePlanning::make(const plan::EffectPlan& plan) {
    if (!plan.probeWork.empty()) {
        prepareSky();
    }
    for (const plan::ProbeWork& work : plan.probeWork) {
        ProbeState& state = states_[work.probe];
        if (work.publish) {
            state.captured =
                context_.probes.find(context_.probeOrder[work.probe])->published(state);
            published_[work.probe] = true;
        }
        if (work.compose && state.captured) {
            const int width = state.captured->width();
            compose(
                state, [&](const glm::vec3& d) { return sky(d, width); }, work.fadeLeft,
                work.lastLevel);
        }
    }
}

void ProbePlanning::askFaces(const plan::EffectPlan& plan, ProbePacket& packet) {
    for (const plan::ProbeFace& face : plan.probeFaces) {
        const LodestarProbe handle = context_.probeOrder[face.probe];
        const PlacedProbe& placed = *context_.probes.find(handle);
        const lighting::ProbeCapture& capture = placed.probe().capture;
        const glm::dvec3 position = placed.position();
        const FaceCamera camera =
            faceCamera(face.face, position, capture.nearPlane, capture.farPlane);
        LodestarProbeJob job{};
        job.struct_size = sizeof job;
        job.face = face.face;
        job.probe = handle;
        for (int i = 0; i < 3; ++i) {
            job.position[i] = position[i];
        }
        std::copy_n(camera.view, 16, job.view);
        std::copy_n(camera.projection, 16, job.projection);
        job.width = static_cast<std::uint32_t>(capture.resolution);
        job.draw_count = static_cast<std::uint32_t>(face.drawOrder.size());
        packet.jobs.push_back(job);
        std::vector<LodestarDrawProbes>& draws = packet.jobDraws.emplace_back();
        for (std::size_t i = 0; i < face.drawOrder.size(); ++i) {
            draws.push_back(drawProbesOf(face.choices[i], face.drawFeatures[i], face.drawOrder[i],
                                         context_.probeOrder));
        }
        states_[face.probe].askedBy[static_cast<std::size_t>(face.face)] = number_;
    }
}

void ProbePlanning::describe(const plan::PlanInput& input, ProbePacket& packet) const {
    for (std::size_t i = 0; i < states_.size(); ++i) {
        ProbePacket::Light light;
        light.of = context_.probeOrder[i];
        if (input.probes[i].influence) {
            light.version = states_[i].version;
            light.texels[0] = states_[i].texels[0];
            light.texels[1] = states_[i].texels[1];
            light.vectors = vectorsOf(input.probes[i], *context_.probes.find(light.of), states_[i]);
        }
        packet.lights.push_back(std::move(light));
    }
}

/// Whose light is read, and what of it is new.
void ProbePlanning::foresee(ProbePacket& packet, LodestarWork& work) {
    const auto note = [&](const std::vector<LodestarDrawProbes>& draws) {
        for (const LodestarDrawProbes& draw : draws) {
            for (std::size_t k = 0; k < 2; ++k) {
                for (ProbePacket::Light& light : packet.lights) {
                    light.shines = light.shines || (light.of == draw.probe[k] && draw.dark[k] == 0);
                }
            }
        }
    };
    note(packet.drawProbes);
    std::for_each(packet.jobDraws.begin(), packet.jobDraws.end(), note);
    for (std::size_t i = 0; i < packet.lights.size(); ++i) {
        const ProbePacket::Light& light = packet.lights[i];
        if (!light.shines || !light.texels[0] || light.version == states_[i].shown) {
            continue;
        }
        states_[i].shown = light.version;
        for (const auto& texels : light.texels) {
            work.uploads += 6 * texels->levels.size();
            work.upload_bytes += texels->bytes();
            work.texels_written += texels->texels();
        }
    }
}

void ProbePlanning::execute(const plan::EffectPlan& plan, const plan::PlanInput& input,
                            ProbePacket& packet, LodestarWork& work) {
    packet.all = context_.probeOrder;
    if (!active_) {
        return;
    }
    make(plan);
    askFaces(plan, packet);
    describe(input, packet);
    const std::vector<plan::ProbeDone> done = plan::doneFor(plan, states_.size());
    for (std::size_t i = 0; i < states_.size(); ++i) {
        plan::executed(states_[i].history, done[i], light_);
    }
    for (std::size_t i = 0; i < input.draws.size(); ++i) {
        packet.drawProbes.push_back(drawProbesOf({}, 0, i, context_.probeOrder));
    }
    for (std::size_t i = 0; i < plan.drawOrder.size(); ++i) {
        const std::size_t draw = plan.drawOrder[i];
        packet.drawProbes[draw] =
            drawProbesOf(plan.drawChoices.empty() ? plan::ProbeChoice{} : plan.drawChoices[i],
                         plan.drawFeatures[i], draw, context_.probeOrder);
    }
    foresee(packet, work);
}

void ProbePlanning::keep() noexcept {
    for (std::size_t i = 0; i < states_.size(); ++i) {
        PlacedProbe& placed = *context_.probes.find(context_.probeOrder[i]);
        placed.state = std::move(states_[i]);
        if (published_[i]) {
            placed.clearStaged();
        }
    }
    if (context_.boxes) {
        if (active_) {
            context_.seen.emplace(std::move(seen_));
        }
        context_.boxes.reset();
    }
}

} // namespace lodestar::plugin

// SPDX-License-Identifier: MIT
#include "plans.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "context.h"
#include "lodestar/lobes.glsl"

namespace lodestar::plugin {
namespace {

bool isBlack(const float* rgb) {
    return std::all_of(rgb, rgb + 3, [](float value) { return value == 0.0f; });
}

/// A draw's terms as the built-in renderer finds them. @return false if a value is out of range
bool setTerms(const LodestarMaterial& material, plan::DrawView& draw) {
    float packed[8];
    if (!packMaterial(material, packed)) {
        return false;
    }
    const float exponent = packed[3];
    // Of metallic and roughness Fresnel's rise at grazing angles is there whatever F0 is.
    draw.glossy = material.given == 0 || !isBlack(packed + 4) || exponent > 0.0f;
    draw.diffuse = !isBlack(packed) || (draw.glossy && exponent < 1.0f);
    draw.sharpest = static_cast<double>(shader::lodestar_lookupExponent(exponent, 0.0f));
    draw.bluntest = static_cast<double>(shader::lodestar_lookupExponent(exponent, 1.0f));
    return true;
}

/// Draws of which the host says no more than where they are.
std::vector<plan::DrawView> drawsOf(const BoxedFrame& boxes) {
    std::vector<plan::DrawView> draws(boxes.draws.size());
    for (std::size_t i = 0; i < draws.size(); ++i) {
        draws[i].subject = "draw " + std::to_string(i);
        draws[i].casts = false;
        draws[i].geometry = i;
        draws[i].material = static_cast<std::uint32_t>(i);
    }
    return draws;
}

/// Tells the planner where the draws are.
core::Result<void> place(const BoxedFrame& boxes, std::vector<plan::DrawView>& draws) {
    if (boxes.draws.size() != draws.size()) {
        return core::refused("there are as many boxes as draws", "/draws");
    }
    for (std::size_t i = 0; i < draws.size(); ++i) {
        draws[i].low = boxes.draws[i].low;
        draws[i].high = boxes.draws[i].high;
        draws[i].layers = boxes.draws[i].layers;
        draws[i].screenShare = boxes.draws[i].share;
    }
    return {};
}

core::Result<std::vector<plan::DrawView>> drawsOf(const LodestarFrame& frame) {
    std::vector<plan::DrawView> draws;
    if (frame.draws == nullptr) {
        plan::DrawView all;
        all.subject = "all that the host draws";
        draws.push_back(std::move(all));
        return draws;
    }
    const auto* bytes = reinterpret_cast<const unsigned char*>(frame.draws);
    for (std::uint32_t i = 0; i < frame.draw_count; ++i) {
        const std::string at = "/draws/" + std::to_string(i);
        const auto* given =
            reinterpret_cast<const LodestarDraw*>(bytes + std::size_t{i} * frame.draw_stride);
        LodestarDraw draw{};
        if (frame.draw_stride < 2 * sizeof(std::uint32_t) ||
            given->struct_size > frame.draw_stride || !readStruct(given, draw)) {
            return core::refused("the draw's struct_size or the stride is none", at);
        }
        plan::DrawView view;
        view.subject = draw.name != nullptr ? draw.name : "draw " + std::to_string(i);
        view.visible = draw.visible != 0;
        view.casts = false; // shadows are the host's own
        view.geometry = view.material = i;
        LodestarMaterial material{};
        view.lit = draw.material != nullptr;
        if (view.lit && (!readStruct(draw.material, material) || !setTerms(material, view))) {
            return core::refused("a value of the material is out of range", at + "/material");
        }
        draws.push_back(std::move(view));
    }
    return draws;
}

/// What the planner is told of the lights at the context's hour.
std::vector<lighting::DayMoment> describeLights(LodestarContext& context, plan::PlanInput& input) {
    std::vector<lighting::DayMoment> moments;
    for (std::size_t i = 0; i < context.order.size() && i < LODESTAR_MAX_LIGHTS_SHOWN; ++i) {
        PlacedLight& light = *context.lights.find(context.order[i]);
        const lighting::DayMoment moment = look(context, light);
        plan::RsrmLightView view;
        view.subject =
            light.map.day().name.empty() ? "light " + std::to_string(i) : light.map.day().name;
        view.shines = moment.visibility > 0.0;
        view.sky = light.map.day().kind == lighting::LightKind::Sky;
        view.changed = light.planned != light.version;
        view.texels = light.map.uploadTexels();
        view.uploadBytes = light.map.uploadBytes();
        if (input.environment.replacedBy.empty() &&
            lighting::replacesEnvironment(light.map.day())) {
            input.environment.replacedBy = view.subject;
        }
        input.rsrmLights.push_back(std::move(view));
        moments.push_back(moment);
    }
    input.rsrmGreatestExponent = context.maps.greatestExponent;
    input.rsrmRows = lighting::hasOwnRows(context.maps);
    return moments;
}

void describeEnvironment(LodestarContext& context, plan::PlanInput& input) {
    PlacedEnvironment* distant = context.environments.find(context.environment);
    const bool shows = distant != nullptr && distant->version() != 0;
    PlannedEnvironment& planned = context.planned;
    plan::EnvironmentView& view = input.environment;
    view.source = distant != nullptr ? distant->name() : "environment";
    view.width = shows ? distant->width() : 0;
    view.present = shows && view.replacedBy.empty();
    view.changed = planned.environment != context.environment ||
                   (shows && planned.version != distant->version());
    if (view.changed) {
        planned = {context.environment, shows ? distant->version() : 0, {}};
    }
    input.alreadyPrepared = planned.parts;
}

/// The captures that the planner is told of, as handles.
std::vector<LodestarEnvironment> describeCaptures(LodestarContext& context,
                                                  plan::PlanInput& input) {
    std::vector<LodestarEnvironment> captured;
    context.environments.each([&](LodestarEnvironment handle, const PlacedEnvironment& one) {
        if (one.isCaptured()) {
            input.captures.push_back(one.view());
            captured.push_back(handle);
        }
    });
    return captured;
}

void keepLights(LodestarContext& context, const std::vector<lighting::DayMoment>& moments,
                Packet& packet) {
    packet.layers = context.order;
    packet.layers.resize(std::min<std::size_t>(packet.layers.size(), LODESTAR_MAX_LIGHTS_SHOWN));
    for (const plan::LitLight& lit : packet.plan.rsrmLights) {
        PlacedLight& light = *context.lights.find(context.order[lit.light]);
        Packet::Light kept;
        kept.blend = texelsOf(light);
        kept.shown.struct_size = sizeof kept.shown;
        kept.shown.layer = static_cast<std::uint32_t>(lit.light);
        kept.shown.light = context.order[lit.light];
        for (int i = 0; i < 3; ++i) {
            kept.shown.axis[i] = moments[lit.light].axis[i];
        }
        kept.shown.version = light.version;
        kept.shown.blend = lit.blend ? 1 : 0;
        if (lit.blend) {
            packet.work.uploads += 3;
            packet.work.upload_bytes += light.map.uploadBytes();
            packet.work.texels_written += light.map.uploadTexels();
        }
        packet.lights.push_back(std::move(kept));
    }
}

void keepEnvironment(LodestarContext& context, bool present, Packet& packet) {
    const lighting::PreparedParts& made = packet.plan.prepare;
    lighting::PreparedParts& parts = context.planned.parts;
    parts.tentMips = parts.tentMips || made.tentMips;
    parts.irradiance = parts.irradiance || made.irradiance;
    if (!present) {
        return;
    }
    PlacedEnvironment& distant = *context.environments.find(context.environment);
    const auto keep = [&](bool wanted, bool isNew, int which, Packet::Cube& cube) {
        if (!wanted) {
            return;
        }
        cube.texels = distant.texels(which);
        cube.of = context.environment;
        cube.version = distant.version();
        if (isNew) {
            packet.work.uploads += 6 * cube.texels->levels.size();
            packet.work.upload_bytes += cube.texels->bytes();
            packet.work.texels_written += cube.texels->texels();
        }
    };
    keep(parts.tentMips, made.tentMips, LODESTAR_TEXELS_ENVIRONMENT, packet.environment);
    keep(parts.irradiance, made.irradiance, LODESTAR_TEXELS_IRRADIANCE, packet.irradiance);
}

std::vector<std::uint32_t> featuresOf(const plan::EffectPlan& plan, std::size_t draws) {
    std::vector<std::uint32_t> features(draws, 0);
    for (std::size_t i = 0; i < plan.drawOrder.size(); ++i) {
        features[plan.drawOrder[i]] = featureBits(plan.drawFeatures[i]);
    }
    return features;
}

blocks::LodestarLighting uniformsOf(const Packet& packet) {
    blocks::LodestarLighting uniforms{};
    const auto cube = [](const Packet::Cube& from) {
        return from.texels ? glm::vec4(from.texels->width, from.texels->levels.size() - 1, 0.0f,
                                       from.texels->scale)
                           : glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
    };
    const lighting::RsrmLayout& map = packet.maps;
    const bool environment = packet.environment.texels || packet.irradiance.texels;
    uniforms.lodestar_counts =
        glm::vec4(packet.lights.size(), environment ? 1.0f : 0.0f, packet.plan.suns(), 0.0f);
    uniforms.lodestar_environmentCube = cube(packet.environment);
    uniforms.lodestar_irradianceCube = cube(packet.irradiance);
    uniforms.lodestar_mapSize = {map.columns, map.rows, map.leastExponent, map.greatestExponent};
    uniforms.lodestar_mapRows = {lighting::firstOctave(map), lighting::rowsPerOctave(map),
                                 lighting::kLambertColumns, lighting::kGradientColumns};
    const auto octaves = lighting::rowOctaves(map);
    static_assert(sizeof octaves == sizeof uniforms.lodestar_mapOctaves);
    std::memcpy(uniforms.lodestar_mapOctaves, octaves.data(), sizeof octaves);
    for (std::size_t i = 0; i < packet.lights.size(); ++i) {
        const LodestarPlannedLight& light = packet.lights[i].shown;
        uniforms.lodestar_axes[i] = {light.axis[0], light.axis[1], light.axis[2], light.layer};
        uniforms.lodestar_spreads[i / 4][static_cast<int>(i % 4)] =
            static_cast<float>(packet.lights[i].blend->spread);
    }
    return uniforms;
}

} // namespace

std::uint32_t featureBits(plan::Features features) {
    const auto flag = [&](plan::Feature feature, std::uint32_t bit) {
        return plan::has(features, feature) ? bit : 0u;
    };
    return flag(plan::Feature::Environment, LODESTAR_FEATURE_ENVIRONMENT) |
           flag(plan::Feature::RsrmLights, LODESTAR_FEATURE_LIGHTS) |
           flag(plan::Feature::RsrmMirror, LODESTAR_FEATURE_MIRROR) |
           flag(plan::Feature::Probe, LODESTAR_FEATURE_PROBE) |
           flag(plan::Feature::SecondProbe, LODESTAR_FEATURE_SECOND_PROBE) |
           flag(plan::Feature::RsrmRows, LODESTAR_FEATURE_ROWS);
}

core::Result<std::shared_ptr<const Packet>> makePacket(LodestarContext& context,
                                                       const LodestarFrame& frame) {
    plan::PlanInput input;
    if (frame.draws == nullptr && context.boxes) {
        input.draws = drawsOf(*context.boxes);
    } else {
        auto draws = drawsOf(frame);
        if (!draws) {
            return draws.error();
        }
        input.draws = std::move(*draws);
    }
    if (context.boxes) {
        if (auto placed = place(*context.boxes, input.draws); !placed) {
            return placed.error();
        }
    }
    input.backdrop = frame.backdrop != 0;
    input.faceBudget = static_cast<int>(std::min<std::uint32_t>(frame.max_faces, 1u << 20));
    const std::vector<lighting::DayMoment> moments = describeLights(context, input);
    describeEnvironment(context, input);
    const std::vector<LodestarEnvironment> captures = describeCaptures(context, input);
    ProbePlanning probes(context, moments, input);
    auto made = std::make_shared<Packet>();
    Packet& packet = *made;
    packet.plan = plan::plan(input);
    packet.maps = context.maps;
    packet.work.struct_size = sizeof packet.work;
    keepLights(context, moments, packet);
    keepEnvironment(context, input.environment.present, packet);
    for (const plan::CaptureFace& face : packet.plan.captureFaces) {
        const LodestarEnvironment handle = captures[face.capture];
        packet.jobs.push_back(context.environments.find(handle)->job(face.face));
        packet.jobs.back().environment = handle;
    }
    probes.execute(packet.plan, input, packet.probes, packet.work);
    packet.work.face_jobs =
        static_cast<std::uint32_t>(packet.jobs.size() + packet.probes.jobs.size());
    if (frame.draws != nullptr) {
        packet.features = featuresOf(packet.plan, input.draws.size());
    }
    packet.uniforms = uniformsOf(packet);
    // What was asked for is not asked for again: noted last, for memory may run out before.
    for (const Packet::Light& light : packet.lights) {
        context.lights.find(light.shown.light)->planned = light.shown.version;
    }
    probes.keep();
    return std::shared_ptr<const Packet>(std::move(made));
}

} // namespace lodestar::plugin

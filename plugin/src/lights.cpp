// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "context.h"

namespace lodestar::plugin {
namespace {

glm::dvec3 vectorOf(const double v[3]) {
    return {v[0], v[1], v[2]};
}

core::Error refusal(std::string what, std::string where) {
    return core::refused(std::move(what), std::move(where));
}

core::Result<lighting::DayKey> keyOf(const LodestarKey& key, const glm::dmat3& documentFromHost,
                                     const std::string& at) {
    if (key.interpolation < 0 || key.interpolation > LODESTAR_INTERPOLATION_CUBIC) {
        return refusal("no such interpolation", at + "/gradient/interpolation");
    }
    if (key.space < 0 || key.space > LODESTAR_SPACE_SRGB) {
        return refusal("no such space", at + "/gradient/space");
    }
    if (key.stops == nullptr && key.stop_count > 0) {
        return refusal("the stops are null", at + "/gradient/stops");
    }
    lighting::DayKey result;
    result.hour = key.hour;
    result.tint = vectorOf(key.tint);
    result.gradient.interpolation = static_cast<lighting::GradientInterpolation>(key.interpolation);
    result.gradient.space = static_cast<lighting::GradientSpace>(key.space);
    for (std::uint32_t i = 0; i < key.stop_count; ++i) {
        const LodestarStop& stop = key.stops[i];
        result.gradient.stops.push_back({stop.at, vectorOf(stop.color), stop.ev});
    }
    if (key.has_axis != 0) {
        result.axis = documentFromHost * vectorOf(key.axis);
    }
    return result;
}

} // namespace

std::optional<glm::dmat3> frameOf(const LodestarHost& host) {
    glm::dvec3 up = vectorOf(host.up), north = vectorOf(host.north);
    if (up == glm::dvec3(0.0) && north == glm::dvec3(0.0)) {
        return glm::dmat3(1.0);
    }
    const double upLength = glm::length(up);
    up /= upLength;
    north -= glm::dot(north, up) * up;
    const double northLength = glm::length(north);
    north /= northLength;
    // Not so where one is zero, not finite, or along the other.
    if (!(upLength > 0.0 && northLength > 1e-6 * glm::length(vectorOf(host.north))) ||
        !std::isfinite(upLength) || !std::isfinite(northLength)) {
        return {};
    }
    return glm::dmat3(glm::cross(north, up), up, -north);
}

core::Result<lighting::DayLight>
lightOf(const LodestarLightDesc& desc, const glm::dmat3& hostFromDocument, core::Tally& warnings) {
    if (desc.kind != LODESTAR_SKY && desc.kind != LODESTAR_SUN) {
        return refusal("a light is a sky or a sun", "/kind");
    }
    if (desc.key_count == 0 || desc.keys == nullptr) {
        return refusal("a light has at least one key", "/keys");
    }
    const glm::dmat3 documentFromHost = glm::transpose(hostFromDocument);
    lighting::DayLight light;
    light.kind = desc.kind == LODESTAR_SKY ? lighting::LightKind::Sky : lighting::LightKind::Sun;
    light.name = desc.name != nullptr ? desc.name : "";
    light.axis = documentFromHost * vectorOf(desc.axis);
    light.add = desc.add != 0;
    if (desc.has_path != 0) {
        light.path = lighting::SunPath{glm::radians(desc.latitude), desc.day_of_year,
                                       documentFromHost * vectorOf(desc.north)};
    }
    const auto* bytes = reinterpret_cast<const unsigned char*>(desc.keys);
    for (std::uint32_t i = 0; i < desc.key_count; ++i) {
        const std::string at = "/keys/" + std::to_string(i);
        LodestarKey key{};
        const auto* given =
            reinterpret_cast<const LodestarKey*>(bytes + std::size_t{i} * desc.key_stride);
        if (desc.key_stride < 2 * sizeof(std::uint32_t) || given->struct_size > desc.key_stride ||
            !readStruct(given, key)) {
            return refusal("the key's struct_size or the stride is none", at);
        }
        auto read = keyOf(key, documentFromHost, at);
        if (!read) {
            return read.error();
        }
        light.keys.push_back(std::move(*read));
    }
    return lighting::repaired(std::move(light), warnings);
}

lighting::DayMoment look(const LodestarContext& context, PlacedLight& light) {
    lighting::DayMoment moment = lighting::momentAt(light.map.day(), context.hour);
    moment.axis = context.hostFromDocument * moment.axis;
    const auto content = lighting::LightMap::contentOf(moment);
    // A sun that has set is not asked for: it rises with the texels that it had.
    if (moment.visibility > 0.0 && !(content == light.content)) {
        light.content = content;
        ++light.version;
    }
    return moment;
}

const std::shared_ptr<const lighting::LightMap::Blend>& texelsOf(PlacedLight& light) {
    if (light.blended != light.version) {
        light.blend =
            std::make_shared<const lighting::LightMap::Blend>(light.map.blend(light.content));
        light.blended = light.version;
    }
    return light.blend;
}

} // namespace lodestar::plugin

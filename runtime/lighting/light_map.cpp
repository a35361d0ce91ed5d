// SPDX-License-Identifier: MIT
#include "lighting/light_map.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include <glm/vec4.hpp>

#include "core/half.h"

namespace lodestar::lighting {

int lambertColumns(const RsrmLayout& layout) {
    return layout.fitted ? kLambertColumns : layout.columns;
}

LightMap::LightMap(DayLight day, const RsrmLayout& layout, std::shared_ptr<RsrmKernels> kernels)
    : day_(std::move(day)), layout_(layout), kernels_(std::move(kernels)), keys_(day_.keys.size()) {
}

bool LightMap::keep(const LightMap& before) {
    if (day_.kind != before.day_.kind) {
        return false;
    }
    const auto same = [](const DayKey& a, const DayKey& b) {
        return a.gradient == b.gradient && a.tint == b.tint;
    };
    const std::vector<DayKey>& were = before.day_.keys;
    const bool all = day_.keys.size() == were.size() &&
                     std::equal(day_.keys.begin(), day_.keys.end(), were.begin(), same);
    for (std::size_t i = 0; i < day_.keys.size(); ++i) {
        for (std::size_t j = 0; j < were.size() && !keys_[i]; ++j) {
            if (before.keys_[j] && same(day_.keys[i], were[j])) {
                keys_[i] = before.keys_[j];
            }
        }
    }
    return all;
}

std::uint64_t LightMap::uploadTexels() const {
    return static_cast<std::uint64_t>(layout_.columns) * static_cast<std::uint64_t>(layout_.rows) +
           static_cast<std::uint64_t>(lambertColumns(layout_)) + kGradientColumns;
}

std::uint64_t LightMap::uploadBytes() const {
    return texelBytes(layout_) +
           sizeof(glm::vec4) * static_cast<std::uint64_t>(lambertColumns(layout_)) +
           std::uint64_t{8} * kGradientColumns;
}

LightMap::Content LightMap::contentOf(const DayMoment& moment) {
    return {moment.keys.from, moment.keys.to, moment.keys.t, moment.visibility};
}

const LightMap::Key& LightMap::key(std::size_t index) {
    std::optional<Key>& key = keys_[index];
    if (!key) {
        const auto kernel = kernels_->get(layout_, day_.kind);
        key =
            Key{kernel->bake(keyRadiance(day_, index, kernel->zones())), keyGradient(day_, index)};
    }
    return *key;
}

LightMap::Blend LightMap::blend(const Content& content) {
    const Key& from = key(content.from);
    const Key& to = key(content.to);
    Blend blend{encode(layout_, blended(from.bake, to.bake, content.t, content.factor)),
                blended(from.gradient, to.gradient, content.t, content.factor)};
    blend.spread = spread(blend.gradient);
    return blend;
}

std::vector<std::uint8_t> LightMap::lambertTexels(const Blend& blend) {
    const std::vector<glm::vec3>& line = blend.texels.lambert;
    std::vector<std::uint8_t> bytes(line.size() * sizeof(glm::vec4));
    for (std::size_t i = 0; i < line.size(); ++i) {
        const glm::vec4 texel(line[i], 1.0f);
        std::memcpy(bytes.data() + i * sizeof texel, &texel, sizeof texel);
    }
    return bytes;
}

std::vector<std::uint8_t> LightMap::gradientTexels(const Blend& blend) {
    std::vector<std::uint8_t> bytes(blend.gradient.size() * 4 * sizeof(std::uint16_t));
    std::size_t at = 0;
    for (const glm::vec3& radiance : blend.gradient) {
        const float values[] = {radiance.r, radiance.g, radiance.b, 1.0f};
        for (const float value : values) {
            const std::uint16_t half = core::halfFromFloat(std::sqrt(value));
            std::memcpy(bytes.data() + at, &half, sizeof half);
            at += sizeof half;
        }
    }
    return bytes;
}

} // namespace lodestar::lighting

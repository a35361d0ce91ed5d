// SPDX-License-Identifier: MIT
#include "lighting/cube_texels.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/half.h"

namespace lodestar::lighting {
namespace {

constexpr float kLargestHalf = 65504.0f;
/// Beyond this scale dark texels lose digits in a half float; such maps are stored as floats.
constexpr float kLargestHalfScale = 64.0f;

std::vector<std::uint8_t> halvesOf(const std::vector<glm::vec4>& texels, float factor) {
    std::vector<std::uint16_t> halves;
    halves.reserve(texels.size() * 4);
    for (const glm::vec4& texel : texels) {
        for (const float value : {texel.r * factor, texel.g * factor, texel.b * factor, texel.a}) {
            halves.push_back(core::halfFromFloat(value));
        }
    }
    std::vector<std::uint8_t> bytes(halves.size() * sizeof(std::uint16_t));
    std::memcpy(bytes.data(), halves.data(), bytes.size());
    return bytes;
}

std::vector<std::uint8_t> floatsOf(const std::vector<glm::vec4>& texels) {
    std::vector<std::uint8_t> bytes(texels.size() * sizeof(glm::vec4));
    std::memcpy(bytes.data(), texels.data(), bytes.size());
    return bytes;
}

} // namespace

std::size_t CubeTexels::bytes() const {
    std::size_t sum = 0;
    for (const std::vector<std::uint8_t>& level : levels) {
        sum += level.size();
    }
    return sum;
}

std::uint64_t CubeTexels::texels() const {
    return bytes() / (half ? 8u : 16u);
}

CubeTexels cubeTexels(const Cubemap& map) {
    float largest = 0.0f;
    for (int level = 0; level < map.levelCount(); ++level) {
        for (const glm::vec4& texel : map.level(level)) {
            largest = std::max({largest, texel.r, texel.g, texel.b});
        }
    }
    const float scale =
        largest > kLargestHalf ? std::exp2(std::ceil(std::log2(largest / kLargestHalf))) : 1.0f;
    CubeTexels result;
    result.width = map.width();
    result.half = scale <= kLargestHalfScale;
    result.scale = result.half ? scale : 1.0f;
    for (int level = 0; level < map.levelCount(); ++level) {
        result.levels.push_back(result.half ? halvesOf(map.level(level), 1.0f / scale)
                                            : floatsOf(map.level(level)));
    }
    return result;
}

} // namespace lodestar::lighting

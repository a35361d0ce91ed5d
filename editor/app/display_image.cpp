// SPDX-License-Identifier: MIT
#include "app/display_image.h"

#include <cmath>

#include "lodestar/display.glsl"

namespace lodestar::app {

core::Image toDisplay(const core::Image& radiance, double exposure) {
    core::Image display = radiance;
    const auto factor = static_cast<float>(std::exp2(exposure));
    for (std::size_t i = 0; i < display.pixels().size(); i += 4) {
        float* pixel = &display.pixels()[i];
        const float alpha = pixel[3];
        for (int c = 0; c < 3; ++c) {
            const float value = alpha > 0.0f ? pixel[c] / alpha * factor : 0.0f;
            pixel[c] = shader::lodestar_srgbFromLinear(shader::lodestar_filmic(value));
        }
    }
    return display;
}

} // namespace lodestar::app

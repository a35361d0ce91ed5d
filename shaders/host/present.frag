// SPDX-License-Identifier: MIT
//
// A tile of linear radiance on a display: the mean of a pixel's samples, exposure, filmic, sRGB.
#include "lodestar/display.glsl"

uniform sampler2D uRadiance;
uniform ivec2 uOrigin;      // the tile's lower left pixel in the window
uniform int uSamplesPerSide;
uniform float uExposure;    // a factor

layout(location = 0) out vec4 oColor;

void main() {
    ivec2 corner = (ivec2(gl_FragCoord.xy) - uOrigin) * uSamplesPerSide;
    vec4 sum = vec4(0.0);
    for (int y = 0; y < uSamplesPerSide; ++y) {
        for (int x = 0; x < uSamplesPerSide; ++x) {
            sum += texelFetch(uRadiance, corner + ivec2(x, y), 0);
        }
    }
    vec4 mean = sum / float(uSamplesPerSide * uSamplesPerSide);
    if (any(isnan(mean)) || any(isinf(mean))) {
        mean = vec4(0.0);
    }
    vec3 color = vec3(0.0);
    for (int c = 0; c < 3; ++c) {
        float radiance = mean.a > 0.0 ? mean[c] / mean.a * uExposure : 0.0;
        color[c] = lodestar_srgbFromLinear(lodestar_filmic(radiance));
    }
    // What is not covered is black, as a picture with alpha is shown on black.
    oColor = vec4(color * clamp(mean.a, 0.0, 1.0), 1.0);
}

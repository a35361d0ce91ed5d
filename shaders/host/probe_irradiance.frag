// SPDX-License-Identifier: MIT
//
// A tile of irradiance over pi from nine coefficients.
#include "host/probe_half.glsl"
#include "lodestar/cube.glsl"
#include "lodestar/sh9.glsl"

uniform ivec2 uTile; // its first texel

flat in vec3 vCoefficients[9];

layout(location = 0) out vec4 oIrradiance;

void main() {
    vec2 at = (gl_FragCoord.xy - vec2(uTile) - 0.5) * (2.0 / (LODESTAR_TILE_TEXELS - 1.0)) - 1.0;
    vec3 n = normalize(lodestar_octahedralDirection(at));
    vec3 irradiance = lodestar_sh9(vCoefficients[0], vCoefficients[1], vCoefficients[2], vCoefficients[3], vCoefficients[4],
                                   vCoefficients[5], vCoefficients[6], vCoefficients[7], vCoefficients[8], n);
    oIrradiance = nearestHalf(vec4(irradiance, 1.0));
}

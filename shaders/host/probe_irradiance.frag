// SPDX-License-Identifier: MIT
//
// A tile of irradiance over pi from nine coefficients; its border is what lies across its sides.
#include "host/probe_half.glsl"
#include "lodestar/cube.glsl"
#include "lodestar/sh9.glsl"

uniform sampler2D uCoefficients;
uniform ivec2 uTile; // its first texel

layout(location = 0) out vec4 oIrradiance;

vec3 coefficient(int k) { return texelFetch(uCoefficients, ivec2(k, 0), 0).rgb; }

void main() {
    vec2 at = (gl_FragCoord.xy - vec2(uTile) - 1.0) * (2.0 / LODESTAR_TILE_TEXELS) - 1.0;
    vec3 n = normalize(lodestar_octahedralDirection(at));
    vec3 irradiance = lodestar_sh9(coefficient(0), coefficient(1), coefficient(2), coefficient(3), coefficient(4),
                                   coefficient(5), coefficient(6), coefficient(7), coefficient(8), n);
    oIrradiance = nearestHalf(vec4(irradiance, 1.0));
}

// SPDX-License-Identifier: MIT
//
// A level of tent mips from the next finer one: the (1 3 3 1) x (1 3 3 1) mean as four bilinear
// fetches, across faces, each weighted by the solid angle there.
#include "host/probe_half.glsl"
#include "lodestar/cube.glsl"

uniform samplerCube uFirstProbe; // its base level is the finer one
uniform vec2 uWidths;            // of a face: the level that is made, the finer one

flat in int vFace;

layout(location = 0) out vec4 oRadiance;

vec4 texelAt(float x, float y) {
    return textureLod(uFirstProbe, lodestar_cubeDirection(vFace, x, y), 0.0);
}

void main() {
    vec2 center = gl_FragCoord.xy * (2.0 / uWidths.x) - 1.0;
    float reach = 1.5 / uWidths.y; // three quarters of the finer level's pitch
    vec2 low = center - reach;
    vec2 high = center + reach;
    vec4 weights = vec4(lodestar_texelDensity(low.x, low.y), lodestar_texelDensity(high.x, low.y),
                        lodestar_texelDensity(low.x, high.y), lodestar_texelDensity(high.x, high.y));
    vec4 sum = weights.x * texelAt(low.x, low.y) + weights.y * texelAt(high.x, low.y) +
               weights.z * texelAt(low.x, high.y) + weights.w * texelAt(high.x, high.y);
    oRadiance = nearestHalf(sum / (weights.x + weights.y + weights.z + weights.w));
}

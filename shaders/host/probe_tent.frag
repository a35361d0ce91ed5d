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

void main() {
    vec2 center = gl_FragCoord.xy * (2.0 / uWidths.x) - 1.0;
    float step = 1.5 / uWidths.y; // three quarters of the finer level's pitch
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        vec2 at = center + step * vec2((i & 1) == 0 ? -1.0 : 1.0, (i & 2) == 0 ? -1.0 : 1.0);
        float weight = lodestar_texelDensity(at.x, at.y);
        sum += weight * textureLod(uFirstProbe, lodestar_cubeDirection(vFace, at.x, at.y), 0.0);
        weights += weight;
    }
    oRadiance = nearestHalf(sum / weights);
}

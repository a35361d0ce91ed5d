// SPDX-License-Identifier: MIT
//
// A level of tent mips from the next finer one, all six faces at once: the (1 3 3 1) x (1 3 3 1) mean as
// four bilinear fetches, across faces, each weighted by the solid angle there.
#include "host/probe_half.glsl"
#include "host/probe_faces.glsl"
#include "lodestar/cube.glsl"

uniform samplerCube uFirstProbe; // its base level is the finer one
uniform vec2 uWidths;            // of a face: the level that is made, the finer one

vec4 texelAt(int face, vec2 at) {
    return textureLod(uFirstProbe, turned(face, vec3(at, 1.0)), 0.0);
}

void main() {
    vec2 center = gl_FragCoord.xy * (2.0 / uWidths.x) - 1.0;
    float reach = 1.5 / uWidths.y; // three quarters of the finer level's pitch
    vec2 low = center - reach;
    vec2 high = center + reach;
    vec4 weights = vec4(lodestar_texelDensity(low.x, low.y), lodestar_texelDensity(high.x, low.y),
                        lodestar_texelDensity(low.x, high.y), lodestar_texelDensity(high.x, high.y));
    weights /= weights.x + weights.y + weights.z + weights.w;
    vec4 means[6];
    for (int face = 0; face < 6; ++face) {
        means[face] = weights.x * texelAt(face, low) + weights.y * texelAt(face, vec2(high.x, low.y)) +
                      weights.z * texelAt(face, vec2(low.x, high.y)) + weights.w * texelAt(face, high);
    }
    writeFaces(nearestHalf(means[0]), nearestHalf(means[1]), nearestHalf(means[2]), nearestHalf(means[3]),
               nearestHalf(means[4]), nearestHalf(means[5]));
}

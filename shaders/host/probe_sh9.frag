// SPDX-License-Identifier: MIT
//
// Nine coefficients of irradiance over pi, as lodestar/sh9.glsl reads them, in 16 parts: each fragment
// sums a part of all six faces of a level, weighted by solid angle. A fetch reads four texels where it
// weighs each by its own.
#include "host/probe_turned.glsl"
#include "lodestar/cube.glsl"

uniform samplerCube uFirstProbe; // its base level is the one that is read
uniform vec2 uCells;             // fetches along a face's side; half of the pitch of the texels that one reads, 0 for one alone

/// The coefficients' colours one after another, then the sum of the weights.
layout(location = 0) out vec4 oSums[7];

/// Between four texels about a point, where a fetch weighs them by their solid angles.
vec2 between(vec2 center) {
    float left = lodestar_texelDensity(center.x - uCells.y, center.y);
    float right = lodestar_texelDensity(center.x + uCells.y, center.y);
    float below = lodestar_texelDensity(center.x, center.y - uCells.y);
    float above = lodestar_texelDensity(center.x, center.y + uCells.y);
    return center + uCells.y * vec2((right - left) / (right + left), (above - below) / (above + below));
}

void main() {
    int cells = int(uCells.x);
    int part = int(gl_FragCoord.x) + 4 * int(gl_FragCoord.y);
    int end = (part + 1) * cells * cells / 16;
    vec3 c0 = vec3(0.0), c1 = c0, c2 = c0, c3 = c0, c4 = c0, c5 = c0, c6 = c0, c7 = c0, c8 = c0;
    float weights = 0.0;
    for (int i = part * cells * cells / 16; i < end; ++i) {
        vec2 center = (vec2(float(i % cells), float(i / cells)) + 0.5) * (2.0 / uCells.x) - 1.0;
        vec3 at = vec3(between(center), 1.0);
        float weight = lodestar_meanTexelDensity(center.x, center.y, uCells.x);
        weights += 6.0 * weight;
        float norm = inversesqrt(dot(at, at));
        for (int face = 0; face < 6; ++face) {
            vec3 direction = turned(face, at);
            vec3 light = weight * textureLod(uFirstProbe, direction, 0.0).rgb;
            vec3 d = direction * norm;
            // The basis over the constants that sh9.glsl has folded in.
            c0 += light;
            c1 += light * (2.0 * d.y);
            c2 += light * (2.0 * d.z);
            c3 += light * (2.0 * d.x);
            c4 += light * (3.75 * d.x * d.y);
            c5 += light * (3.75 * d.y * d.z);
            c6 += light * (0.3125 * (3.0 * d.z * d.z - 1.0));
            c7 += light * (3.75 * d.x * d.z);
            c8 += light * (0.9375 * (d.x * d.x - d.y * d.y));
        }
    }
    oSums[0] = vec4(c0, c1.x);
    oSums[1] = vec4(c1.yz, c2.xy);
    oSums[2] = vec4(c2.z, c3);
    oSums[3] = vec4(c4, c5.x);
    oSums[4] = vec4(c5.yz, c6.xy);
    oSums[5] = vec4(c6.z, c7);
    oSums[6] = vec4(c8, weights);
}

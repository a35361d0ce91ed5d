// SPDX-License-Identifier: MIT
//
// A level of tent mips from the next finer one, all six faces at once: the mean under a triangle of
// twice a texel's width along columns and rows, across faces, by bilinear fetches, each weighted by the
// solid angle there. An even finer level takes 2 along an axis, (1 3 3 1); an odd one, LODESTAR_ODD, 3.
#include "host/probe_half.glsl"
#include "host/probe_faces.glsl"
#include "lodestar/cube.glsl"

uniform samplerCube uFirstProbe; // its base level is the finer one
uniform vec2 uWidths;            // of a face: the level that is made, the finer one

vec4 texelAt(int face, vec2 at) {
    return textureLod(uFirstProbe, turned(face, vec3(at, 1.0)), 0.0);
}

#if LODESTAR_ODD
/// The i-th pair of finer texels along an axis, all in these: where a fetch weighs it, its weight.
vec2 pairAt(float center, float reach, int i) {
    float first = floor(center - reach - 0.5) + 1.5 + 2.0 * float(i); // the centre of its first
    vec2 weights = max(reach - abs(vec2(first, first + 1.0) - center), vec2(0.0));
    float sum = weights.x + weights.y;
    return vec2(first + weights.y / max(sum, 1e-6), sum);
}
#endif

void main() {
    vec4 means[6] = vec4[6](vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));
#if LODESTAR_ODD
    float reach = uWidths.y / uWidths.x;
    vec2 center = gl_FragCoord.xy * reach;
    float total = 0.0;
    for (int i = 0; i < 9; ++i) {
        vec2 x = pairAt(center.x, reach, i % 3);
        vec2 y = pairAt(center.y, reach, i / 3);
        vec2 at = vec2(x.x, y.x) * (2.0 / uWidths.y) - 1.0;
        float weight = x.y * y.y * lodestar_texelDensity(at.x, at.y);
        total += weight;
        for (int face = 0; face < 6; ++face) {
            means[face] += weight * texelAt(face, at);
        }
    }
    for (int face = 0; face < 6; ++face) {
        means[face] /= total;
    }
#else
    vec2 center = gl_FragCoord.xy * (2.0 / uWidths.x) - 1.0;
    float reach = 1.5 / uWidths.y; // three quarters of the finer level's pitch
    vec2 low = center - reach;
    vec2 high = center + reach;
    vec4 weights = vec4(lodestar_texelDensity(low.x, low.y), lodestar_texelDensity(high.x, low.y),
                        lodestar_texelDensity(low.x, high.y), lodestar_texelDensity(high.x, high.y));
    weights /= weights.x + weights.y + weights.z + weights.w;
    for (int face = 0; face < 6; ++face) {
        means[face] = weights.x * texelAt(face, low) + weights.y * texelAt(face, vec2(high.x, low.y)) +
                      weights.z * texelAt(face, vec2(low.x, high.y)) + weights.w * texelAt(face, high);
    }
#endif
    writeFaces(nearestHalf(means[0]), nearestHalf(means[1]), nearestHalf(means[2]), nearestHalf(means[3]),
               nearestHalf(means[4]), nearestHalf(means[5]));
}

// SPDX-License-Identifier: MIT
//
// A round level of all six faces at once: weighted sums of bilinear fetches from a finer level, the
// same for each face but for its turn.
#include "host/probe_half.glsl"
#include "host/probe_faces.glsl"

uniform samplerCube uFirstProbe; // its base level is the one that is read
uniform sampler2D uFetches;      // fetch y of texel x of a face: where, and its share
uniform ivec3 uRows;             // width of a face, the first row of uFetches, the end

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    int texel = at.y * uRows.x + at.x;
    vec4 sums[6] = vec4[6](vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));
    for (int row = uRows.y; row < uRows.z; ++row) {
        vec4 fetch = texelFetch(uFetches, ivec2(texel, row), 0);
        if (fetch.w == 0.0) {
            break;
        }
        for (int face = 0; face < 6; ++face) {
            sums[face] += fetch.w * textureLod(uFirstProbe, turned(face, fetch.xyz), 0.0);
        }
    }
    writeFaces(nearestHalf(sums[0]), nearestHalf(sums[1]), nearestHalf(sums[2]), nearestHalf(sums[3]), nearestHalf(sums[4]),
               nearestHalf(sums[5]));
}

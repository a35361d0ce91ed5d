// SPDX-License-Identifier: MIT
//
// Means of a level, in parts: fragment x sums the rows of one of 16 parts of face x / 16. The first
// output is weighted by solid angle; the second by what the level's tents took of the finer one, so
// that it is the finer level's own mean. The parts add up to the means.
#include "lodestar/cube.glsl"

uniform samplerCube uFirstProbe; // its base level is the one that is read
uniform vec2 uWidths;            // of a face: this level, the finer one
uniform vec2 uNorms;             // over the sums of the two weights

layout(location = 0) out vec4 oMean;
layout(location = 1) out vec4 oFinerMean;

void main() {
    int part = int(gl_FragCoord.x);
    int face = part / 16;
    int width = int(uWidths.x);
    int first = (part % 16) * width / 16;
    int end = (part % 16 + 1) * width / 16;
    vec4 sum = vec4(0.0);
    vec4 finer = vec4(0.0);
    for (int y = first; y < end; ++y) {
        for (int x = 0; x < width; ++x) {
            vec2 center = (vec2(float(x), float(y)) + 0.5) * (2.0 / uWidths.x) - 1.0;
            vec4 texel = textureLod(uFirstProbe, lodestar_cubeDirection(face, center.x, center.y), 0.0);
            sum += texel * lodestar_meanTexelDensity(center.x, center.y, uWidths.x);
            finer += texel * lodestar_tentDensity(center.x, center.y, uWidths.y);
        }
    }
    oMean = sum * uNorms.x;
    oFinerMean = finer * uNorms.y;
}

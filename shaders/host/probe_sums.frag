// SPDX-License-Identifier: MIT
//
// Means of levels, weighted by solid angle, in parts: row y is of level uRange.x + y, and its
// fragment x sums one of 16 parts of face x / 16. The parts add up to the mean. The first level, the
// finest, is read four texels at a time, where a bilinear fetch weighs each by its solid angle.
#include "lodestar/cube.glsl"

uniform samplerCube uFirstProbe;
uniform ivec2 uRange;     // first level, face width of level 0
uniform float uNorms[8];  // over the sums of weights, by row

layout(location = 0) out vec4 oMean;

/// The place between four texels about a point at which the fetch weighs them so. @param reach half of their pitch
vec2 between(vec2 center, float reach) {
    float left = lodestar_texelDensity(center.x - reach, center.y);
    float right = lodestar_texelDensity(center.x + reach, center.y);
    float below = lodestar_texelDensity(center.x, center.y - reach);
    float above = lodestar_texelDensity(center.x, center.y + reach);
    return center + reach * vec2((right - left) / (right + left), (above - below) / (above + below));
}

void main() {
    int part = int(gl_FragCoord.x);
    int row = int(gl_FragCoord.y);
    int level = uRange.x + row;
    int face = part / 16;
    int width = max(uRange.y >> (row == 0 ? level + 1 : level), 1);
    int first = (part % 16) * width * width / 16;
    int end = (part % 16 + 1) * width * width / 16;
    vec4 sum = vec4(0.0);
    for (int i = first; i < end; ++i) {
        vec2 center = (vec2(float(i % width), float(i / width)) + 0.5) * (2.0 / float(width)) - 1.0;
        vec2 at = row == 0 ? between(center, 0.5 / float(width)) : center;
        sum += textureLod(uFirstProbe, lodestar_cubeDirection(face, at.x, at.y), float(level)) *
               lodestar_meanTexelDensity(center.x, center.y, float(width));
    }
    oMean = sum * uNorms[row];
}

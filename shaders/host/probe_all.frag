// SPDX-License-Identifier: MIT
//
// A level of one or two texels a face: means over cosine lobes as sums over all texels of a level.
#include "host/probe_half.glsl"
#include "lodestar/cube.glsl"

uniform samplerCube uFirstProbe; // its base level is the one that is read
uniform vec4 uLobe;              // face width of the level that is made, its exponent, spread that a texel adds, face width of what is read

flat in int vFace;

layout(location = 0) out vec4 oRadiance;

void main() {
    vec2 center = gl_FragCoord.xy * (2.0 / uLobe.x) - 1.0;
    vec3 r = normalize(lodestar_cubeDirection(vFace, center.x, center.y));
    float exponent = uLobe.y > 0.0 ? lodestar_roundExponent(uLobe.y, uLobe.z * lodestar_texelSolidAngle(uLobe.x, gl_FragCoord.x - 0.5, gl_FragCoord.y - 0.5)) : 0.0;
    int width = int(uLobe.w);
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < width * width; ++i) {
            vec2 at = (vec2(float(i % width), float(i / width)) + 0.5) * (2.0 / uLobe.w) - 1.0;
            vec3 d = lodestar_cubeDirection(face, at.x, at.y);
            float weight = lodestar_meanTexelDensity(at.x, at.y, uLobe.w) * lodestar_cosinePower(dot(r, normalize(d)), exponent);
            sum += weight * textureLod(uFirstProbe, d, 0.0);
            weights += weight;
        }
    }
    oRadiance = nearestHalf(sum / max(weights, 1e-30));
}

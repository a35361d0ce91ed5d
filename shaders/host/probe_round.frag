// SPDX-License-Identifier: MIT
//
// A coarse level of tent mips: means over round lobes, as a spiral of fetches of equal weight.
#include "host/probe_half.glsl"
#include "lodestar/cube.glsl"

uniform samplerCube uFirstProbe; // its base level is the one that is read
uniform vec4 uLobe;              // face width of the level that is made, its exponent, spread that a texel adds, fetches

flat in int vFace;

layout(location = 0) out vec4 oRadiance;

void main() {
    vec2 center = gl_FragCoord.xy * (2.0 / uLobe.x) - 1.0;
    vec3 r = normalize(lodestar_cubeDirection(vFace, center.x, center.y));
    float exponent = lodestar_roundExponent(uLobe.y, uLobe.z * lodestar_texelSolidAngle(uLobe.x, gl_FragCoord.x - 0.5, gl_FragCoord.y - 0.5));
    vec3 u = normalize(abs(r.y) < 0.7 ? vec3(r.z, 0.0, -r.x) : vec3(0.0, -r.z, r.y));
    vec3 v = cross(r, u);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < int(uLobe.w); ++i) {
        float t = (float(i) + 0.5) / uLobe.w;
        // Of a cosine lobe the share t lies within the angle whose cosine to s + 1 is 1 - t.
        float cosine = exp2(log2(1.0 - t) / (exponent + 1.0));
        float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
        float angle = 2.39996323 * float(i);
        sum += textureLod(uFirstProbe, cosine * r + sine * (cos(angle) * u + sin(angle) * v), 0.0);
    }
    oRadiance = nearestHalf(sum / uLobe.w);
}

// SPDX-License-Identifier: MIT
//
// A coarse level of tent mips: means over round lobes, as a spiral of fetches of equal weight. The
// spiral is that of the level's mean texel, drawn together or apart for each texel's own lobe.
#include "host/probe_half.glsl"
#include "lodestar/cube.glsl"

uniform samplerCube uFirstProbe; // its base level is the one that is read
uniform vec4 uLobe;              // face width of the level that is made, its exponent, spread that a texel adds, fetches
uniform vec2 uSpiral[64];        // sines, for the mean exponent uMeanExponent
uniform float uMeanExponent;

flat in int vFace;

layout(location = 0) out vec4 oRadiance;

void main() {
    vec2 center = gl_FragCoord.xy * (2.0 / uLobe.x) - 1.0;
    vec3 r = normalize(lodestar_cubeDirection(vFace, center.x, center.y));
    float exponent = lodestar_roundExponent(uLobe.y, uLobe.z * lodestar_texelSolidAngle(uLobe.x, gl_FragCoord.x - 0.5, gl_FragCoord.y - 0.5));
    // Half the mean square of a cosine lobe's angle is 1 / (s + 2).
    float narrower = sqrt((uMeanExponent + 2.0) / (exponent + 2.0));
    vec3 u = normalize(abs(r.y) < 0.7 ? vec3(r.z, 0.0, -r.x) : vec3(0.0, -r.z, r.y));
    vec3 v = cross(r, u);
    u *= narrower;
    v *= narrower;
    vec4 sum = vec4(0.0);
    int count = int(uLobe.w);
    for (int i = 0; i < count; ++i) {
        vec3 across = uSpiral[i].x * u + uSpiral[i].y * v;
        sum += textureLod(uFirstProbe, sqrt(max(1.0 - dot(across, across), 0.0)) * r + across, 0.0);
    }
    oRadiance = nearestHalf(sum / uLobe.w);
}

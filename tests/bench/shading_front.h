// SPDX-License-Identifier: MIT
//
// What the shading benchmarks share: the ball grid that is shaded, its directional light, CPU time.
#pragma once

#include <algorithm>
#include <ctime>
#include <vector>

namespace lodestar::testing {

inline constexpr int kSide = 1024;

/// Of the process: a software rasteriser's threads are in it.
inline double cpuMilliseconds() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

inline double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t n = values.size();
    return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

inline const char* kVertex = R"(#version 330 core
void main() {
    vec2 p = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));
    gl_Position = vec4(p * 2.0 - 1.0, 0.0, 1.0);
})";

/// A grid of 4x4 balls with exact normals; uniforms so that nothing folds to a constant. Stands
/// after lodestar/environment.glsl.
inline const char* kSurface = R"(
uniform vec4 uLight;      // direction
uniform vec4 uLightColor; // irradiance
uniform vec4 uDiffuse;    // k_L, exponent
uniform vec4 uF0;         // F0, occlusion

LodestarSurface here() {
    LodestarSurface s;
    vec2 q = fract(gl_FragCoord.xy * (4.0 / 1024.0)) * 2.0 - 1.0;
    vec2 b = 0.9 * q * inversesqrt(max(dot(q, q), 1.0));
    s.normal = vec3(b, sqrt(1.0 - dot(b, b)));
    s.view = normalize(vec3(-0.4 * (gl_FragCoord.xy / 1024.0 - 0.5), 1.0));
    s.diffuse = uDiffuse.rgb;
    s.f0 = uF0.rgb;
    s.exponent = uDiffuse.w;
    s.occlusion = uF0.w;
    return s;
}

vec3 direct(LodestarSurface s) {
    return uLightColor.rgb *
           lodestar_directReflectance(s.normal, s.view, uLight.xyz, s.diffuse, s.f0, s.exponent);
}
)";

} // namespace lodestar::testing

// SPDX-License-Identifier: MIT
//
// What a level is multiplied by to keep the mean, channel by channel. With uFirst the level is the
// first that is made, and its parts tell the mean that all are to have; else a texel does.
#include "host/probe_half.glsl"

uniform sampler2D uMeans;
uniform sampler2D uFinerMeans;
uniform sampler2D uKept;
uniform int uFirst;

layout(location = 0) out vec4 oScale;
layout(location = 1) out vec4 oKept;

void main() {
    vec4 mean = vec4(0.0);
    vec4 finer = vec4(0.0);
    for (int i = 0; i < 96; ++i) {
        mean += texelFetch(uMeans, ivec2(i, 0), 0);
        finer += uFirst != 0 ? texelFetch(uFinerMeans, ivec2(i, 0), 0) : vec4(0.0);
    }
    vec4 kept = uFirst != 0 ? finer : texelFetch(uKept, ivec2(0), 0);
    oScale = mix(vec4(1.0), kept / max(mean, vec4(1e-30)), vec4(greaterThan(mean, vec4(0.0))));
    // What is multiplied is stored by the blend, which rounds as the driver does.
    oScale *= uHalfStep > 0u ? 1.0 + 1.0 / 4096.0 : 1.0;
    oKept = kept;
}

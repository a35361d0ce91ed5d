// SPDX-License-Identifier: MIT
//
// What each level is multiplied by to have the mean of the first, channel by channel: texel x is of row
// x of the parts.
#include "host/probe_half.glsl"

uniform sampler2D uMeans;

layout(location = 0) out vec4 oScale;

vec4 meanOf(int row) {
    vec4 mean = vec4(0.0);
    for (int i = 0; i < 96; ++i) {
        mean += texelFetch(uMeans, ivec2(i, row), 0);
    }
    return mean;
}

void main() {
    vec4 wanted = meanOf(0);
    vec4 mean = meanOf(int(gl_FragCoord.x));
    oScale = mix(vec4(1.0), wanted / max(mean, vec4(1e-30)), vec4(greaterThan(mean, vec4(0.0))));
    // What is multiplied is stored by the blend, which rounds as the driver does.
    oScale *= uHalfStep > 0u ? 1.0 + 1.0 / 4096.0 : 1.0;
}

// SPDX-License-Identifier: MIT
//
// Nine coefficients from their parts: fragment k adds up row k.
uniform sampler2D uMeans;

layout(location = 0) out vec4 oCoefficient;

void main() {
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 96; ++i) {
        sum += texelFetch(uMeans, ivec2(i, int(gl_FragCoord.x)), 0);
    }
    oCoefficient = sum;
}

// SPDX-License-Identifier: MIT
//
// Multiplies what is there, by blending.
uniform sampler2D uMeans;

layout(location = 0) out vec4 oScale;

void main() {
    oScale = texelFetch(uMeans, ivec2(0), 0);
}

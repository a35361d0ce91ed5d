// SPDX-License-Identifier: MIT
//
// Multiplies what is there, by blending.
uniform sampler2D uMeans;
uniform int uRow;

layout(location = 0) out vec4 oScale;

void main() {
    oScale = texelFetch(uMeans, ivec2(uRow, 0), 0);
}

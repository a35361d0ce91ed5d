// SPDX-License-Identifier: MIT
//
// A triangle over a tile of irradiance, and the nine coefficients that probe_sh9.frag left in parts.
uniform sampler2DArray uParts;

flat out vec3 vCoefficients[9];

void main() {
    vec4 sums[7];
    for (int k = 0; k < 7; ++k) {
        sums[k] = vec4(0.0);
        for (int i = 0; i < 16; ++i) {
            sums[k] += texelFetch(uParts, ivec3(i % 4, i / 4, k), 0);
        }
    }
    float scale = 1.0 / sums[6].w;
    vCoefficients[0] = scale * sums[0].xyz;
    vCoefficients[1] = scale * vec3(sums[0].w, sums[1].xy);
    vCoefficients[2] = scale * vec3(sums[1].zw, sums[2].x);
    vCoefficients[3] = scale * sums[2].yzw;
    vCoefficients[4] = scale * sums[3].xyz;
    vCoefficients[5] = scale * vec3(sums[3].w, sums[4].xy);
    vCoefficients[6] = scale * vec3(sums[4].zw, sums[5].x);
    vCoefficients[7] = scale * sums[5].yzw;
    vCoefficients[8] = scale * sums[6].xyz;
    vec2 p = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2)) * 2.0 - 1.0;
    gl_Position = vec4(p, 0.0, 1.0);
}

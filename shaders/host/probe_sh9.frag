// SPDX-License-Identifier: MIT
//
// Nine coefficients of irradiance over pi, as lodestar/sh9.glsl reads them, in parts: fragment (x, k)
// sums coefficient k over one of 16 parts of face x / 16 of a level, weighted by solid angle.
#include "lodestar/cube.glsl"

uniform samplerCube uFirstProbe; // its base level is the one that is read
uniform vec2 uWidths;            // x: of its faces; y: over the sum of weights

layout(location = 0) out vec4 oCoefficient;

/// The basis function over the constants that sh9.glsl has folded in: a coefficient is the mean of
/// radiance times this.
float basis(int k, vec3 d) {
    float linear = k == 1 ? d.y : k == 2 ? d.z : d.x;
    float product = k == 4 ? d.x * d.y : k == 5 ? d.y * d.z : d.x * d.z;
    float value = k < 4 ? 2.0 * linear : 3.75 * product;
    value = k == 0 ? 1.0 : value;
    value = k == 6 ? 0.3125 * (3.0 * d.z * d.z - 1.0) : value;
    return k == 8 ? 0.9375 * (d.x * d.x - d.y * d.y) : value;
}

void main() {
    int part = int(gl_FragCoord.x);
    int k = int(gl_FragCoord.y);
    int face = part / 16;
    int width = int(uWidths.x);
    int first = (part % 16) * width * width / 16;
    int end = (part % 16 + 1) * width * width / 16;
    vec3 sum = vec3(0.0);
    for (int i = first; i < end; ++i) {
        vec2 at = (vec2(float(i % width), float(i / width)) + 0.5) * (2.0 / uWidths.x) - 1.0;
        vec3 d = lodestar_cubeDirection(face, at.x, at.y);
        float weight = lodestar_meanTexelDensity(at.x, at.y, uWidths.x);
        sum += textureLod(uFirstProbe, d, 0.0).rgb * (weight * basis(k, normalize(d)));
    }
    oCoefficient = vec4(sum * uWidths.y, 1.0);
}

// SPDX-License-Identifier: MIT
//
// Nine coefficients of irradiance over pi, as lodestar/sh9.glsl reads them: fragment k sums the texels
// of a level, weighted by solid angle.
#include "lodestar/cube.glsl"

uniform samplerCube uFirstProbe; // its base level is the one that is read
uniform vec2 uWidths;            // x: of its faces

layout(location = 0) out vec4 oCoefficient;

/// The basis function over the constants that sh9.glsl has folded in: a coefficient is the mean of
/// radiance times this, times a factor.
float basis(int k, vec3 d) {
    if (k == 0) return 1.0;
    if (k == 1) return d.y * 2.0;
    if (k == 2) return d.z * 2.0;
    if (k == 3) return d.x * 2.0;
    if (k == 4) return d.x * d.y * 3.75;
    if (k == 5) return d.y * d.z * 3.75;
    if (k == 6) return (3.0 * d.z * d.z - 1.0) * 0.3125;
    if (k == 7) return d.x * d.z * 3.75;
    return (d.x * d.x - d.y * d.y) * 0.9375;
}

void main() {
    int k = int(gl_FragCoord.x);
    int width = int(uWidths.x);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int face = 0; face < 6; ++face) {
        for (int y = 0; y < width; ++y) {
            for (int x = 0; x < width; ++x) {
                vec2 at = (vec2(float(x), float(y)) + 0.5) * (2.0 / uWidths.x) - 1.0;
                vec3 d = lodestar_cubeDirection(face, at.x, at.y);
                float weight = lodestar_meanTexelDensity(at.x, at.y, uWidths.x);
                sum += textureLod(uFirstProbe, d, 0.0).rgb * (weight * basis(k, normalize(d)));
                weights += weight;
            }
        }
    }
    oCoefficient = vec4(sum / weights, 1.0);
}

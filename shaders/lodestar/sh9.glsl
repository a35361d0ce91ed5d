// SPDX-License-Identifier: MIT
//
// Nine spherical-harmonic coefficients of irradiance over pi (order 2), in the order
// 1, y, z, x, xy, yz, 3z^2-1, xz, x^2-y^2, with the basis constants and the cosine lobe's eigenvalues
// (1, 2/3, 1/4) folded in: the CPU makes them (lighting/sh9.h), a shader needs one dot product.
// Source: Ramamoorthi and Hanrahan 2001.
#ifndef LODESTAR_SH9_GLSL
#define LODESTAR_SH9_GLSL
#include "dual.glsl"

LODESTAR_BEGIN

/// Irradiance over pi about a unit normal; clamped at 0, because nine coefficients ring.
LODESTAR_FN vec3 lodestar_sh9(vec3 c0, vec3 c1, vec3 c2, vec3 c3, vec3 c4, vec3 c5, vec3 c6, vec3 c7,
                              vec3 c8, vec3 n) {
    vec3 linear = c0 + c1 * n.y + c2 * n.z + c3 * n.x;
    vec3 quadratic = c4 * (n.x * n.y) + c5 * (n.y * n.z) + c6 * (3.0f * n.z * n.z - 1.0f) +
                     c7 * (n.x * n.z) + c8 * (n.x * n.x - n.y * n.y);
    return max(linear + quadratic, vec3(0.0f));
}

LODESTAR_END

#endif

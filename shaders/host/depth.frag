// SPDX-License-Identifier: MIT
//
// Depth alone, for shadow maps: what an alpha mask cuts out casts nothing.
#include "host/blocks.glsl"
#include "lodestar/sh9.glsl"
#include "lodestar/environment.glsl"
#include "host/hooks.glsl"

in vec3 vPosition;
in vec3 vNormal;
in vec4 vTangent;
in vec2 vUv0;
in vec2 vUv1;
in vec4 vColor;

#include "host/material.glsl"

void main() {
#if LODESTAR_ALPHA_MASK
    if (baseColorHere().a < surface.w) {
        discard;
    }
#endif
}

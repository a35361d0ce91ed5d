// SPDX-License-Identifier: MIT
//
// The hook lodestar_host_visibility over shadow maps: one layer of depths a sun that casts.
// LODESTAR_SHADOWS says how many lights have one; they are the first of the block.
#if LODESTAR_RSRM_LIGHTS

#if LODESTAR_SHADOWS
uniform sampler2DArrayShadow uShadows;

/// The share of two by two bilinear comparisons around a point that are lit: an edge two texels
/// soft. A facet turned away asks nothing: what it gets of a wide light by its smooth normal would
/// else end at the facet's edge. The others are moved along their normal, by more the more they
/// lean away, so that a texel's own slope does not shadow them.
float shadowAt(int layer, vec3 toLight) {
    vec3 facet = lodestar_safeNormalize(cross(dFdx(vPosition), dFdy(vPosition)), toLight); // to the viewer
    float towards = dot(facet, toLight);
    if (towards <= 0.0) {
        return 1.0;
    }
    float slope = sqrt(max(1.0 - towards * towards, 0.0));
    vec3 moved = vPosition + facet * (shadowTexel[layer].x * (0.5 + 2.0 * slope));
    vec4 at = shadowFromWorld[layer] * vec4(moved, 1.0);
    if (any(lessThan(at.xyz, vec3(0.0))) || any(greaterThan(at.xyz, vec3(1.0)))) {
        return 1.0;
    }
    float texel = 1.0 / float(textureSize(uShadows, 0).x);
    float lit = 0.0;
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 2; ++x) {
            vec2 offset = (vec2(float(x), float(y)) - 0.5) * texel;
            lit += texture(uShadows, vec4(at.xy + offset, float(layer), at.z));
        }
    }
    return 0.25 * lit;
}
#endif

float lodestar_host_visibility(int light) {
#if LODESTAR_SHADOWS
    if (light < LODESTAR_SHADOWS) {
        return shadowAt(int(rsrmShadow[light].x), rsrmAxis[light].xyz);
    }
#endif
    return 1.0;
}

#endif

// SPDX-License-Identifier: MIT
//
// The built-in renderer's radially symmetric lights: their maps, and its answers to the hooks of
// lodestar/rsrm.glsl, which name a light by its place in the block: a constant once loops unroll.
// Variants say how many lights there are:
//   LODESTAR_RSRM_LIGHTS     how many light the frame
//   LODESTAR_SUNS            how many of them are suns: the first
//   LODESTAR_RSRM_LAYOUT     LodestarRsrm.layoutName of their maps
//   LODESTAR_RSRM_ROWS       1: their rows were given one by one
#if LODESTAR_RSRM_LIGHTS

uniform sampler2DArray uRsrmMaps;
uniform sampler1DArray uRsrmLamberts;
uniform sampler2DArray uRsrmGradients; // one row: square roots of the gradients over u2

vec4 lodestar_host_rsrm(float column, float row, int light) {
    vec2 at = (vec2(column, row) + 0.5) * rsrmTexel.xy;
    vec3 stored = textureLod(uRsrmMaps, vec3(at, rsrmAxis[light].w), 0.0).rgb;
    return vec4(stored, LODESTAR_RSRM_LAYOUT == LODESTAR_RSRM_PUBLISHED ? rsrmScale[light].x : 1.0);
}

vec3 lodestar_host_rsrmLambert(float u, int light) {
    return textureLod(uRsrmLamberts, vec2(u * rsrmRows.z + rsrmRows.w, rsrmAxis[light].w), 0.0).rgb;
}

vec3 lodestar_host_rsrmGradient(float u2, int light) {
    float texels = float(textureSize(uRsrmGradients, 0).x);
    float s = (u2 * (texels - 1.0) + 0.5) / texels;
    vec3 root = textureLod(uRsrmGradients, vec3(s, 0.5, rsrmAxis[light].w), 0.0).rgb;
    return root * root;
}

#if LODESTAR_RSRM_ROWS
vec4 lodestar_host_rsrmOctaves(int index) { return rsrmOctaves[index]; }
#endif

LodestarRsrm rsrmLight(int light) {
    LodestarRsrm map;
    map.layer = light;
    map.layoutName = LODESTAR_RSRM_LAYOUT;
    map.axis = rsrmAxis[light].xyz;
    map.columns = rsrmMap.x;
    map.rows = rsrmMap.y;
    map.leastExponent = rsrmMap.z;
    map.greatestExponent = rsrmMap.w;
    map.firstOctave = rsrmRows.x;
    map.rowsPerOctave = rsrmRows.y;
    return map;
}

/// The row of an exponent, in every map the same.
float rsrmRow(float exponent) {
#if LODESTAR_RSRM_ROWS
    return lodestar_rsrmOwnRow(rsrmLight(0), exponent);
#else
    return lodestar_rsrmRow(rsrmLight(0), exponent);
#endif
}

/// What all lights paint in a direction.
vec3 rsrmBackdrop(vec3 direction) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < LODESTAR_RSRM_LIGHTS; ++i) {
        sum += lodestar_rsrmGradient(rsrmLight(i), direction);
    }
    return sum;
}

#endif

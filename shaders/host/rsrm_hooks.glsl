// SPDX-License-Identifier: MIT
//
// The built-in renderer's radially symmetric lights: their maps, and its answers to the hooks of
// lodestar/rsrm.glsl. Lights of the block name their layer of both.
#if LODESTAR_RSRM_LIGHTS

uniform sampler2DArray uRsrmMaps;
uniform sampler2DArray uRsrmGradients; // one row: square roots of the gradients over u2

/// log2 of a row's scale.
float rsrmLogScale(int layer, int row) {
    vec4 four = rsrmLogScales[layer * (LODESTAR_MAX_RSRM_ROWS / 4) + row / 4];
    int k = row - 4 * (row / 4);
    return k < 2 ? (k == 0 ? four.x : four.y) : (k == 2 ? four.z : four.w);
}

vec4 lodestar_host_rsrm(float column, float row, int layer) {
    float last = rsrmMap.y - 1.0;
    if (row > last + 0.5) {
        float texels = float(textureSize(uRsrmGradients, 0).x);
        float s = (column / (rsrmMap.x - 1.0) * (texels - 1.0) + 0.5) / texels;
        return vec4(textureLod(uRsrmGradients, vec3(s, 0.5, float(layer)), 0.0).rgb, 1.0);
    }
    vec2 at = (vec2(column, row) + 0.5) / rsrmMap.xy;
    vec3 stored = textureLod(uRsrmMaps, vec3(at, float(layer)), 0.0).rgb;
    float lower = floor(min(row, last - 1.0));
    return vec4(stored, lodestar_rsrmRowScale(rsrmLogScale(layer, int(lower)),
                                              rsrmLogScale(layer, int(lower) + 1), row - lower));
}

LodestarRsrm rsrmLight(int light) {
    LodestarRsrm map;
    map.layer = int(rsrmAxis[light].w);
    map.layoutName = int(rsrmLightCount.y);
    map.axis = rsrmAxis[light].xyz;
    map.columns = rsrmMap.x;
    map.rows = rsrmMap.y;
    map.leastExponent = rsrmMap.z;
    map.greatestExponent = rsrmMap.w;
    return map;
}

/// What all lights paint in a direction.
vec3 rsrmBackdrop(vec3 direction) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < int(rsrmLightCount.x); ++i) {
        sum += lodestar_rsrmGradient(rsrmLight(i), direction);
    }
    return sum;
}

#endif

// SPDX-License-Identifier: MIT
//
// Skies and suns by many taps a pixel, in place of their maps, for comparison: as host/reference.glsl
// of the distant environment, but for taps that read the unfiltered gradient.

/// A layer a light. Row 0: directions drawn by its own light; w: its sum of r + g + b over the sphere.
/// Row 1: the radiance there over the density by which it was drawn.
uniform sampler2DArray uDrawnLights;

vec3 referenceLambert(int light, vec3 normal) {
    int layer = int(rsrmAxis[light].w);
    vec3 sum = vec3(0.0);
    for (float i = 0.0; i < referenceTaps.z; i += 1.0) {
        int k = int(referenceTaps.x + referenceTaps.y * i);
        vec3 direction = texelFetch(uDrawnLights, ivec3(k, 0, layer), 0).xyz;
        sum += texelFetch(uDrawnLights, ivec3(k, 1, layer), 0).rgb * max(dot(normal, direction), 0.0);
    }
    return sum / (LODESTAR_PI * referenceTaps.z);
}

/// Radiance over the Blinn-Phong lobe before Fresnel, by as many taps drawn by the lobe as by the light.
vec3 referenceGlossy(int light, LodestarSurface surface) {
    int layer = int(rsrmAxis[light].w);
    float s = lodestar_repairExponent(surface.exponent);
    float each = 1.0 / texelFetch(uDrawnLights, ivec3(0, 0, layer), 0).w;
    vec3 sum = vec3(0.0);
    float weight = 0.0;
    for (float i = 0.0; i < referenceTaps.z; i += 1.0) {
        float k = referenceTaps.x + referenceTaps.y * i;
        LodestarTap tap = lodestar_drawnTap(lodestar_spiralPoint(k, referenceTaps.w), surface.normal, surface.view, s);
        vec3 radiance = lodestar_rsrmGradient(rsrmLight(light), tap.direction);
        sum += tap.weight * radiance * (tap.density / (tap.density + each * sumOf(radiance)));
        weight += tap.weight;
        vec3 direction = texelFetch(uDrawnLights, ivec3(int(k), 0, layer), 0).xyz;
        tap = lodestar_tapOfDirection(direction, surface.normal, surface.view, s);
        float density = each * sumOf(lodestar_rsrmGradient(rsrmLight(light), direction));
        if (tap.weight * tap.density > 0.0 && density > 0.0) {
            sum += tap.weight * texelFetch(uDrawnLights, ivec3(int(k), 1, layer), 0).rgb *
                   (density * tap.density / (tap.density + density));
        }
    }
    vec3 reflection = 2.0 * dot(surface.normal, surface.view) * surface.normal - surface.view;
    return weight > 0.0 ? sum / weight : lodestar_rsrmGradient(rsrmLight(light), reflection);
}

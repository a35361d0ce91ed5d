// SPDX-License-Identifier: MIT
//
// The distant environment by many taps a pixel, in place of the estimators, for comparison. A pass
// takes its share of them, LodestarFrame.referenceTaps, and irradiance from the hook, whose cube is
// fine here.

/// Row 0: directions drawn by the map's own light; w: its sum of r + g + b over the sphere. Row 1: the
/// radiance there over the density by which it was drawn.
uniform sampler2DArray uReferenceLights;

float sumOf(vec3 radiance) {
    return radiance.r + radiance.g + radiance.b;
}

float referenceLevel(LodestarTap tap, LodestarCube cube, float footprint) {
    float coarsest = max(log2(cube.width) - 5.0, 0.0);
    float level = clamp(lodestar_tapLevel(tap, referenceTaps.w, cube.width) - 2.0, 0.0, coarsest);
    return lodestar_raiseLevel(level, footprint, cube.maxLevel);
}

/// The glossy term's radiance before Fresnel: as many taps drawn by the lobe as by the light, each
/// weighed by the share of its density in both (the balance heuristic of [VeachGuibas95]).
/// A tap reads a sixteenth of the solid angle that it stands for, which blurs the lobe little and still
/// joins what lies between taps; no finer than the pixel's footprint, as `tent` does, and no coarser
/// than 32 texels a face, beyond which levels are no tents. A lobe of fewer than 64 texels is drawn by
/// itself alone: what is drawn by the light are points. Where a normal is turned away from the viewer
/// and no tap meets the lobe, it is read along the reflection, as the CPU's reference does.
vec3 referenceSpecular(LodestarCube cube, LodestarSurface surface, vec3 reflection, float footprint) {
    float s = lodestar_repairExponent(surface.exponent);
    float nDotV = clamp(dot(surface.normal, surface.view), 0.0, 1.0);
    bool points = 12.0 * nDotV * cube.width * cube.width >= 64.0 * (s + 1.0);
    float light = points ? 1.0 / texelFetch(uReferenceLights, ivec3(0), 0).w : 0.0;
    vec3 sum = vec3(0.0);
    float weight = 0.0;
    for (float i = 0.0; i < referenceTaps.z; i += 1.0) {
        float k = referenceTaps.x + referenceTaps.y * i;
        LodestarTap tap = lodestar_drawnTap(lodestar_spiralPoint(k, referenceTaps.w), surface.normal, surface.view, s);
        float level = referenceLevel(tap, cube, footprint);
        vec3 radiance = lodestar_host_cube(cube.slot, tap.direction, level).rgb;
        sum += tap.weight * radiance * (tap.density / (tap.density + light * sumOf(radiance)));
        weight += tap.weight;
        if (points) {
            vec3 direction = texelFetch(uReferenceLights, ivec3(int(k), 0, 0), 0).xyz;
            tap = lodestar_tapOfDirection(direction, surface.normal, surface.view, s);
            if (tap.weight * tap.density > 0.0) {
                level = referenceLevel(tap, cube, footprint);
                float density = light * sumOf(lodestar_host_cube(cube.slot, direction, level).rgb);
                sum += tap.weight * texelFetch(uReferenceLights, ivec3(int(k), 1, 0), 0).rgb *
                       (density * tap.density / (tap.density + density));
            }
        }
    }
    float sharp = lodestar_raiseLevel(0.0, footprint, cube.maxLevel);
    return weight > 0.0 ? sum / weight : lodestar_host_cube(cube.slot, reflection, sharp).rgb;
}

vec3 referenceEnvironment(LodestarCube cube, LodestarSurface surface, vec3 reflection, vec3 reflectionDx,
                          vec3 reflectionDy) {
    float footprint = lodestar_footprintLevel(reflection, reflectionDx, reflectionDy, cube.width);
    return lodestar_reflected(surface, lodestar_host_irradiance(cube.slot, surface.normal),
                              referenceSpecular(cube, surface, reflection, footprint));
}

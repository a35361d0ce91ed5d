// SPDX-License-Identifier: MIT
//
// Two light probes for a host's shader, as plan_probe_uniforms and plan_probe_texels of
// lodestar/lodestar_probes.h have them: LODESTAR_WITH_PROBES of them hold a draw, 1 or 2.
#ifndef LODESTAR_PLUGIN_PROBES_GLSL
#define LODESTAR_PLUGIN_PROBES_GLSL
#include "lodestar/probes.glsl"
#include "lodestar/environment.glsl"

#define LODESTAR_PROBE_VECTORS 13

/// Of each: influence rows (3) and extents (w 1: a sphere), blends at + (w 1: outside the faces) and at -, metres;
/// proxy rows (3) and extents (w 1: a sphere, 0: a box, -1: there is none); xyz where it captured, w face width; rgb
/// factor on its light, w last level; x, y what stored radiance and irradiance are multiplied by.
uniform vec4 lodestar_probes[LODESTAR_WITH_PROBES * LODESTAR_PROBE_VECTORS];
uniform vec4 lodestar_probeFactors; ///< what the draw lets the two have, and the sky of what they leave
uniform samplerCube lodestar_probeTexels0;
uniform samplerCube lodestar_probeIrradiance0;
#if LODESTAR_WITH_PROBES > 1
uniform samplerCube lodestar_probeTexels1;
uniform samplerCube lodestar_probeIrradiance1;
#endif

vec4 lodestar_probeVector(int k, int i) { return lodestar_probes[k * LODESTAR_PROBE_VECTORS + i]; }

/// @param first 0: where it lights; 6: what its reflections are corrected to
LodestarVolume lodestar_probeVolume(int k, int first) {
    LodestarVolume volume;
    volume.rowX = lodestar_probeVector(k, first);
    volume.rowY = lodestar_probeVector(k, first + 1);
    volume.rowZ = lodestar_probeVector(k, first + 2);
    volume.halfExtents = lodestar_probeVector(k, first + 3).xyz;
    volume.sphere = lodestar_probeVector(k, first + 3).w;
    volume.blendHigh = lodestar_probeVector(k, 4).xyz;
    volume.blendLow = lodestar_probeVector(k, 5).xyz;
    volume.outward = lodestar_probeVector(k, 4).w;
    return volume;
}

LodestarShares lodestar_sharesAt(vec3 world) {
    float first = 0.0;
    float second = 0.0;
    if (lodestar_probeVector(0, 3).x > 0.0) {
        first = lodestar_volumeWeight(lodestar_probeVolume(0, 0), world);
    }
#if LODESTAR_WITH_PROBES > 1
    if (lodestar_probeVector(1, 3).x > 0.0) {
        second = lodestar_volumeWeight(lodestar_probeVolume(1, 0), world);
    }
#endif
    return lodestar_probeShares(first, second, lodestar_probeFactors.x, lodestar_probeFactors.y,
                                lodestar_probeFactors.z);
}

/// Where a probe is looked up. @param direction unit, of the lobe
vec3 lodestar_probeDirection(int k, vec3 world, vec3 direction) {
    if (lodestar_probeVector(k, 9).w < -0.5) {
        return direction;
    }
    vec3 corrected = lodestar_parallax(lodestar_probeVolume(k, 6), lodestar_probeVector(k, 10).xyz, world, direction);
    return lodestar_safeNormalize(corrected, direction);
}

/// What a probe's light gives back towards the viewer.
/// @param direction of the lookup  @param dx, dy its screen derivatives
vec3 lodestar_probeReflected(int k, LodestarSurface here, float exponent, vec3 direction, vec3 dx, vec3 dy) {
    vec4 light = lodestar_probeVector(k, 11);
    LodestarCube cube;
    cube.slot = k + 1;
    cube.width = lodestar_probeVector(k, 10).w;
    cube.maxLevel = light.w;
    cube.leastLevel = 0.0;
    if (cube.width <= 0.0 || dot(light.rgb, vec3(1.0)) <= 0.0) {
        return vec3(0.0); // it holds nothing, or keeps the sky out alone
    }
    float footprint = lodestar_footprintLevel(direction, dx, dy, cube.width);
    vec3 glossy = lodestar_specularOfTents(cube, direction, exponent, footprint);
    vec3 lambert = lodestar_host_irradiance(cube.slot, here.normal);
    glossy = lodestar_mix(glossy, lambert, max(1.0 - lodestar_repairExponent(here.exponent), 0.0));
    return light.rgb * lodestar_reflected(here, lambert, glossy);
}

/// How much of a sun a probe sees from where it captured: what its geometry leaves open.
float lodestar_probeSeesSun(int k, vec3 axis) {
    if (lodestar_probeVector(k, 10).w <= 0.0 || dot(lodestar_probeVector(k, 11).rgb, vec3(1.0)) <= 0.0) {
        return 0.0; // it holds nothing, or keeps the sky out alone
    }
#if LODESTAR_WITH_PROBES > 1
    if (k == 1) {
        return 1.0 - clamp(textureLod(lodestar_probeTexels1, axis, 0.0).a, 0.0, 1.0);
    }
#endif
    return 1.0 - clamp(textureLod(lodestar_probeTexels0, axis, 0.0).a, 0.0, 1.0);
}

/// What probes let through of a sun that casts no shadow: all outside them, inside what they see of it.
/// @param axis unit, towards it
float lodestar_sunShare(LodestarShares shares, vec3 axis) {
    float share = shares.environment;
    if (shares.first > 0.0) {
        share += shares.first * lodestar_probeSeesSun(0, axis);
    }
#if LODESTAR_WITH_PROBES > 1
    if (shares.second > 0.0) {
        share += shares.second * lodestar_probeSeesSun(1, axis);
    }
#endif
    return share;
}

/// The two probes' light, reflected towards the viewer, by their shares. Screen derivatives are taken here: it is to
/// be called where all of a surface's neighbours are.
vec3 lodestar_probesReflected(LodestarSurface here, vec3 world, LodestarShares shares) {
    LodestarLookup lookup = lodestar_lookup(here.normal, here.view, here.exponent);
    vec3 direction = lodestar_probeDirection(0, world, lookup.direction);
    vec3 sum = shares.first * lodestar_probeReflected(0, here, lookup.exponent, direction, dFdx(direction), dFdy(direction));
#if LODESTAR_WITH_PROBES > 1
    direction = lodestar_probeDirection(1, world, lookup.direction);
    sum += shares.second * lodestar_probeReflected(1, here, lookup.exponent, direction, dFdx(direction), dFdy(direction));
#endif
    return sum;
}

#endif

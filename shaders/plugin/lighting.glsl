// SPDX-License-Identifier: MIT
//
// A whole frame's lighting for a host's shader: the environment and the skies and suns of a plan, by
// the uniforms of uniforms.glsl and five samplers. A host calls lodestar_lighting for a surface and
// lodestar_backdrop for what is seen beyond all surfaces.
//
// Feature macros, as a plan names them for each draw:
//   LODESTAR_WITH_ENVIRONMENT      0: the draw takes no light of an environment
//   LODESTAR_WITH_LIGHTS           0: nor of skies and suns
//   LODESTAR_RSRM_MIRROR           0: no exponent exceeds the maps' last row
//   LODESTAR_RSRM_ROWS             0: the maps have the default rows; else a document's too
//   LODESTAR_WITH_PROBES           1, 2: as many light probes hold it; the host calls
//                                  lodestar_lightingAt
//   LODESTAR_WITH_HOST_VISIBILITY  1: the host defines lodestar_host_visibility, its shadow term
#ifndef LODESTAR_WITH_ENVIRONMENT
#define LODESTAR_WITH_ENVIRONMENT 1
#endif
#ifndef LODESTAR_WITH_LIGHTS
#define LODESTAR_WITH_LIGHTS 1
#endif
#ifndef LODESTAR_WITH_PROBES
#define LODESTAR_WITH_PROBES 0
#endif
#ifndef LODESTAR_RSRM_ROWS
#define LODESTAR_RSRM_ROWS 1
#endif
#ifndef LODESTAR_WITH_HOST_VISIBILITY
#define LODESTAR_WITH_HOST_VISIBILITY 0
#endif

#include "plugin/uniforms.glsl"
#include "lodestar/environment.glsl"
#include "lodestar/probes.glsl"
#include "lodestar/rsrm.glsl"
#include "lodestar/sun.glsl"

uniform samplerCube lodestar_environmentTexels;
uniform samplerCube lodestar_irradianceTexels;
uniform sampler2DArray lodestar_maps;
uniform sampler2DArray lodestar_lamberts;
uniform sampler2DArray lodestar_gradients; // square roots

#if LODESTAR_WITH_PROBES > 0
#include "plugin/probes.glsl"
#endif

vec4 lodestar_host_cube(int slot, vec3 direction, float level) {
#if LODESTAR_WITH_PROBES > 0
    if (slot == 1) {
        return vec4(textureLod(lodestar_probeTexels0, direction, level).rgb * lodestar_probeVector(0, 12).x, 1.0);
    }
#endif
#if LODESTAR_WITH_PROBES > 1
    if (slot == 2) {
        return vec4(textureLod(lodestar_probeTexels1, direction, level).rgb * lodestar_probeVector(1, 12).x, 1.0);
    }
#endif
    vec4 texel = textureLod(lodestar_environmentTexels, direction, level);
    return vec4(texel.rgb * lodestar_environmentCube.w, texel.a);
}

vec3 lodestar_host_irradiance(int slot, vec3 normal) {
#if LODESTAR_WITH_PROBES > 0
    if (slot == 1) {
        return textureLod(lodestar_probeIrradiance0, normal, 0.0).rgb * lodestar_probeVector(0, 12).y;
    }
#endif
#if LODESTAR_WITH_PROBES > 1
    if (slot == 2) {
        return textureLod(lodestar_probeIrradiance1, normal, 0.0).rgb * lodestar_probeVector(1, 12).y;
    }
#endif
    return textureLod(lodestar_irradianceTexels, normal, 0.0).rgb * lodestar_irradianceCube.w;
}

vec4 lodestar_host_rsrm(float column, float row, int layer) {
    vec2 at = (vec2(column, row) + 0.5) / lodestar_mapSize.xy;
    return vec4(textureLod(lodestar_maps, vec3(at, float(layer)), 0.0).rgb, 1.0);
}

/// Both ends of a line lie on texel centres.
vec3 lodestar_lineCoordinate(float at, float columns, int layer) {
    return vec3((at * (columns - 1.0) + 0.5) / columns, 0.5, float(layer));
}

vec3 lodestar_host_rsrmLambert(float u, int layer) {
    return textureLod(lodestar_lamberts, lodestar_lineCoordinate(u, lodestar_mapRows.z, layer), 0.0).rgb;
}

vec3 lodestar_host_rsrmGradient(float u2, int layer) {
    vec3 root = textureLod(lodestar_gradients, lodestar_lineCoordinate(u2, lodestar_mapRows.w, layer), 0.0).rgb;
    return root * root;
}

#if LODESTAR_RSRM_ROWS
vec4 lodestar_host_rsrmOctaves(int index) { return lodestar_mapOctaves[index]; }
#endif

#if LODESTAR_WITH_HOST_VISIBILITY
/// How much of a light the host's shadows let through, [0, 1]; below 0: it casts none there, and light
/// probes hold it back. @param light its place in the plan
float lodestar_host_visibility(int light);
#else
float lodestar_host_visibility(int light) { return -1.0; }
#endif

LodestarRsrm lodestar_lightMap(int light) {
    LodestarRsrm map;
    map.layer = int(lodestar_axes[light].w);
    map.layoutName = LODESTAR_RSRM_REFINED;
    map.axis = lodestar_axes[light].xyz;
    map.columns = lodestar_mapSize.x;
    map.rows = lodestar_mapSize.y;
    map.leastExponent = lodestar_mapSize.z;
    map.greatestExponent = lodestar_mapSize.w;
    map.firstOctave = lodestar_mapRows.x;
    map.rowsPerOctave = lodestar_mapRows.y;
    return map;
}

/// The row of an exponent, in every map the same.
float lodestar_mapRow(float exponent) {
#if LODESTAR_RSRM_ROWS
    return lodestar_rsrmOwnRow(lodestar_lightMap(0), exponent);
#else
    return lodestar_rsrmRow(lodestar_lightMap(0), exponent);
#endif
}

/// What of a sky shines on a point: what the host's shadows let through, where no probe stands before it.
float lodestar_skyVisibility(int light, LodestarShares shares) {
    float visible = lodestar_host_visibility(light);
    return (visible < 0.0 ? 1.0 : visible) * shares.environment;
}

/// What of a sun shines on a point: by the host's shadows or, without, by what probes see of it.
float lodestar_sunVisibility(int light, vec3 axis, LodestarShares shares) {
    float visible = lodestar_host_visibility(light);
#if LODESTAR_WITH_PROBES > 0
    return visible < 0.0 ? lodestar_sunShare(shares, axis) : visible;
#else
    return visible < 0.0 ? 1.0 : visible;
#endif
}

/// Radiance of the skies and suns, reflected towards the viewer. Two loops, because a driver may take both sides of a
/// branch in each turn of one.
vec3 lodestar_lightsReflected(LodestarSurface here, LodestarShares shares) {
    LodestarLookup lookup = lodestar_lookup(here.normal, here.view, here.exponent);
    vec3 lambert = vec3(0.0);
    vec3 glossy = vec3(0.0);
    int suns = int(lodestar_counts.z);
    for (int i = 0; i < suns; ++i) {
        LodestarRsrm map = lodestar_lightMap(i);
        float visible = lodestar_sunVisibility(i, map.axis, shares);
        LodestarSunLookup sun = lodestar_sunLookup(here.normal, here.view, here.exponent, lookup.direction,
                                                   lookup.exponent, map.axis, lodestar_spreads[i / 4][i % 4]);
        lambert += visible * lodestar_rsrmLambert(map, here.normal);
        glossy += visible * lodestar_rsrmAt(map, sun.halfChord, lodestar_mapRow(sun.exponent));
    }
    float row = lodestar_mapRow(lookup.exponent);
    for (int i = suns; i < int(lodestar_counts.x); ++i) {
        LodestarRsrm map = lodestar_lightMap(i);
        float visible = lodestar_skyVisibility(i, shares);
        lambert += visible * lodestar_rsrmLambert(map, here.normal);
        glossy += visible * lodestar_rsrm(map, lookup.direction, row);
    }
    return lodestar_reflected(here, lambert, glossy);
}

LodestarCube lodestar_distantCube() {
    LodestarCube cube;
    cube.slot = 0;
    cube.width = lodestar_environmentCube.x;
    cube.maxLevel = lodestar_environmentCube.y;
    cube.leastLevel = lodestar_environmentCube.z;
    return cube;
}

/// Radiance of the environment, the skies and suns, reflected towards the viewer.
vec3 lodestar_distantLighting(LodestarSurface here, LodestarShares shares, vec3 reflectionDx, vec3 reflectionDy) {
    vec3 radiance = vec3(0.0);
#if LODESTAR_WITH_ENVIRONMENT
    if (lodestar_counts.y > 0.0) {
        radiance += shares.environment * lodestar_environment(lodestar_distantCube(), here, reflectionDx, reflectionDy);
    }
#endif
#if LODESTAR_WITH_LIGHTS
    if (lodestar_counts.x > 0.0) {
        radiance += lodestar_lightsReflected(here, shares);
    }
#endif
    return radiance;
}

/// Radiance of all light but the probes', reflected towards the viewer.
/// @param reflectionDx, reflectionDy screen derivatives of 2 (n.v) n - v; 0 where there are none, in
/// a deferred pass say: then mirrors of fine environments may alias
vec3 lodestar_lighting(LodestarSurface here, vec3 reflectionDx, vec3 reflectionDy) {
    return lodestar_distantLighting(here, LodestarShares(0.0, 0.0, 1.0), reflectionDx, reflectionDy);
}

/// Radiance of all light, reflected towards the viewer. With probes it takes screen derivatives.
/// @param world where the surface is  @param reflectionDx, reflectionDy as of lodestar_lighting
vec3 lodestar_lightingAt(LodestarSurface here, vec3 world, vec3 reflectionDx, vec3 reflectionDy) {
#if LODESTAR_WITH_PROBES > 0
    LodestarShares shares = lodestar_sharesAt(world);
    return lodestar_probesReflected(here, world, shares) +
           lodestar_distantLighting(here, shares, reflectionDx, reflectionDy);
#else
    return lodestar_lighting(here, reflectionDx, reflectionDy);
#endif
}

/// Radiance from a direction beyond all surfaces.
vec3 lodestar_backdrop(vec3 direction) {
    vec3 radiance = vec3(0.0);
#if LODESTAR_WITH_ENVIRONMENT
    if (lodestar_counts.y > 0.0) {
        radiance += lodestar_host_cube(0, direction, 0.0).rgb;
    }
#endif
#if LODESTAR_WITH_LIGHTS
    for (int i = 0; i < int(lodestar_counts.x); ++i) {
        radiance += lodestar_rsrmGradient(lodestar_lightMap(i), direction);
    }
#endif
    return radiance;
}

// SPDX-License-Identifier: MIT
#include "host/blocks.glsl"
#include "lodestar/sh9.glsl"
#include "lodestar/environment.glsl"
#include "host/hooks.glsl"
#ifndef LODESTAR_REFERENCE
#define LODESTAR_REFERENCE 0
#endif
#if LODESTAR_REFERENCE
#include "lodestar/reference.glsl"
#include "host/reference.glsl"
#endif

in vec3 vPosition;
in vec3 vNormal;
in vec4 vTangent;
in vec2 vUv0;
in vec2 vUv1;
in vec4 vColor;
in float vLeastLevel;
flat in vec3 vProbes;

layout(location = 0) out vec4 oRadiance; // premultiplied by coverage

#include "host/material.glsl"
#if LODESTAR_RSRM_LIGHTS
#include "lodestar/rsrm.glsl"
#include "lodestar/sun.glsl"
#include "host/rsrm_hooks.glsl"
#include "host/rsrm_lights.glsl"
#include "host/shadow.glsl"
#if LODESTAR_REFERENCE
#include "host/reference_lights.glsl"
#endif
#endif
#if LODESTAR_PROBES
#include "lodestar/probes.glsl"
#include "host/probes.glsl"

LodestarShares hereShares; // of the fragment
#endif

#if LODESTAR_PUNCTUAL_LIGHTS
/// KHR_lights_punctual: 1/d^2 with its smooth end at the range, and the spot's cone.
vec3 punctualLights(LodestarSurface here) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < int(lightCount.x); ++i) {
        vec3 toLight = lightPosition[i].xyz - lightPosition[i].w * vPosition;
        float distanceSquared = max(dot(toLight, toLight), 1e-8);
        vec3 l = lodestar_safeNormalize(toLight, here.normal);
        vec3 light = lightColor[i].rgb;
        if (lightPosition[i].w > 0.5) {
            float ratio = distanceSquared * lightColor[i].w;
            float window = clamp(1.0 - ratio * ratio, 0.0, 1.0);
            float cone = clamp(dot(lightDirection[i].xyz, -l) * lightCone[i].x + lightCone[i].y, 0.0, 1.0);
            light *= window * cone * cone / distanceSquared;
        }
        sum += light * lodestar_directReflectanceBy(here.normal, here.view, l, here.diffuse, here.f0,
                                                    here.exponent, LODESTAR_LOBES, LODESTAR_FRESNEL);
    }
    return sum;
}
#endif

#if LODESTAR_RSRM_LIGHTS
/// Skies and suns: their means over Lambert's lobe and the glossy one summed, then weighed once.
vec3 rsrmLights(LodestarSurface here) {
    LodestarLookup lookup = rsrmLookup(here);
    float row = rsrmRow(lookup.exponent);
    vec3 lambert = vec3(0.0);
    vec3 glossy = vec3(0.0);
    for (int i = 0; i < LODESTAR_RSRM_LIGHTS; ++i) {
        float visible = lodestar_host_visibility(i);
#if LODESTAR_PROBES
        if (i >= LODESTAR_SUNS) {
            visible *= hereShares.environment; // probes hold the rest of a sky
        } else if (i >= LODESTAR_SHADOWS) {
            visible *= sunShare(hereShares, i);
        }
#endif
#if LODESTAR_REFERENCE
        lambert += visible * referenceLambert(i, here.normal);
        glossy += visible * referenceGlossy(i, here);
#else
        lambert += visible * lodestar_rsrmLambert(rsrmLight(i), here.normal);
        glossy += visible * rsrmGlossy(i, here, lookup, row);
#endif
    }
    return lodestar_reflected(here, lambert, glossy);
}
#endif

/// Radiance as it is written. What is not a number stays so, whatever the driver's min does, to be
/// repaired and counted by who reads it.
vec4 writtenAs(vec3 radiance, float coverage) {
    vec3 light = radiance * coverage * written.x;
    for (int c = 0; c < 3; ++c) {
        light[c] = isnan(light[c]) ? light[c] : min(light[c], written.y);
    }
    return vec4(light, coverage);
}

void main() {
    vec4 color = baseColorHere();
#if LODESTAR_ALPHA_MASK
    if (color.a < surface.w) {
        discard;
    }
#endif
#if !LODESTAR_ALPHA_BLEND
    color.a = 1.0;
#endif
#if LODESTAR_UNLIT
    oRadiance = writtenAs(color.rgb, color.a);
#else
    vec3 view = lodestar_safeNormalize(cameraPosition.xyz - cameraPosition.w * vPosition, vec3(0.0, 0.0, 1.0));
    LodestarSurface here = surfaceHere(view, color);
    vec3 radiance = emissiveHere();
    float open = 1.0; // the share of the distant environment
#if LODESTAR_PROBES
    hereShares = probeShares();
    radiance += probeLight(here, hereShares);
    open = hereShares.environment;
#endif
#if LODESTAR_ENVIRONMENT
    LodestarCube cube;
    cube.slot = 0;
    cube.width = environmentCube.x;
    cube.maxLevel = environmentCube.y;
#if LODESTAR_BIAS_VERTEX
    cube.leastLevel = vLeastLevel;
#else
    cube.leastLevel = environmentCube.z;
#endif
    vec3 reflection = 2.0 * dot(here.normal, view) * here.normal - view;
#if LODESTAR_REFERENCE
    radiance += open * referenceEnvironment(cube, here, reflection, dFdx(reflection), dFdy(reflection));
#else
    radiance += open * lodestar_environment(cube, here, dFdx(reflection), dFdy(reflection));
#endif
#endif
#if LODESTAR_RSRM_LIGHTS
    radiance += rsrmLights(here);
#endif
#if LODESTAR_PUNCTUAL_LIGHTS
    radiance += punctualLights(here);
#endif
    oRadiance = writtenAs(radiance, color.a);
#endif
}

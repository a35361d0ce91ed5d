// SPDX-License-Identifier: MIT
//
// A tile of balls on which one lookup alone is shaded, to be timed.
//   LODESTAR_COST_LOOKUP  0 nothing, 1 glossy, 2 diffuse, 3 glossy of all maps, 4 diffuse of them,
//                         5 direct light of LODESTAR_COST_LIGHTS lights
#include "host/blocks.glsl"
#include "lodestar/sh9.glsl"
#include "lodestar/environment.glsl"
#include "host/hooks.glsl"
#if LODESTAR_RSRM_LIGHTS
#include "lodestar/rsrm.glsl"
#include "lodestar/sun.glsl"
#include "host/rsrm_hooks.glsl"
#include "host/rsrm_lights.glsl"
#endif

uniform vec2 uTile; // pixels a side; Blinn-Phong exponent

layout(location = 0) out vec4 oRadiance;

LodestarSurface surfaceHere() {
    LodestarSurface surface;
    vec2 at = fract(gl_FragCoord.xy * (4.0 / uTile.x)) * 2.0 - 1.0;
    vec2 on = 0.9 * at * inversesqrt(max(dot(at, at), 1.0));
    surface.normal = vec3(on, sqrt(1.0 - dot(on, on)));
    surface.view = normalize(vec3(-0.4 * (gl_FragCoord.xy / uTile.x - 0.5), 1.0));
    surface.diffuse = vec3(0.5);
    surface.f0 = vec3(0.5);
    surface.exponent = uTile.y;
    surface.occlusion = 1.0;
    return surface;
}

void main() {
    LodestarSurface surface = surfaceHere();
    vec3 radiance = surface.normal + surface.view;
#if LODESTAR_COST_LOOKUP == 1
    LodestarCube cube;
    cube.slot = 0;
    cube.width = environmentCube.x;
    cube.maxLevel = environmentCube.y;
    cube.leastLevel = environmentCube.z;
    vec3 r = reflect(-surface.view, surface.normal);
    radiance = lodestar_specular(cube, surface, dFdx(r), dFdy(r));
#elif LODESTAR_COST_LOOKUP == 2
    radiance = lodestar_host_irradiance(0, surface.normal);
#elif LODESTAR_COST_LOOKUP == 3
    LodestarLookup lookup = rsrmLookup(surface);
    float row = rsrmRow(lookup.exponent);
    for (int i = 0; i < LODESTAR_RSRM_LIGHTS; ++i) {
        radiance += rsrmGlossy(i, surface, lookup, row);
    }
#elif LODESTAR_COST_LOOKUP == 4
    for (int i = 0; i < LODESTAR_RSRM_LIGHTS; ++i) {
        radiance += lodestar_rsrmLambert(rsrmLight(i), surface.normal);
    }
#elif LODESTAR_COST_LOOKUP == 5
    radiance = vec3(0.0);
    vec3 light = vec3(uTile.y / (uTile.y + 1.0), 0.3, 1.0); // known to no compiler
    for (int i = 0; i < LODESTAR_COST_LIGHTS; ++i) {
        radiance += lodestar_directReflectanceBy(surface.normal, surface.view, normalize(light), surface.diffuse,
                                                 surface.f0, surface.exponent, LODESTAR_LOBES, LODESTAR_FRESNEL);
        light = vec3(light.yx * vec2(0.8, -0.8), 1.0);
    }
#endif
    oRadiance = vec4(radiance, 1.0);
}

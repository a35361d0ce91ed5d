// SPDX-License-Identifier: MIT
//
// The built-in renderer's answers to the hooks of lodestar/environment.glsl.
// Slot 0 is the distant environment, 1 and 2 are light probes, as stored.
// LODESTAR_DIFFUSE chooses how irradiance is got: 0 irradiance cube, 1 sh9, 2 lowest mip, 3 bias.
// LODESTAR_PROBES says how many probes hold a draw; LODESTAR_PROBE_SKIES whether one keeps its sky apart.
#ifndef LODESTAR_DIFFUSE
#define LODESTAR_DIFFUSE 0
#endif
#ifndef LODESTAR_PROBE_SKIES
#define LODESTAR_PROBE_SKIES 0
#endif
#ifndef LODESTAR_PROBES
#define LODESTAR_PROBES 0
#endif

uniform samplerCube uEnvironment;
uniform samplerCube uIrradiance;
#if LODESTAR_PROBES
uniform samplerCube uFirstProbe;
#if LODESTAR_PROBES > 1
uniform samplerCube uSecondProbe;
#endif
#if LODESTAR_PROBE_SKIES
uniform samplerCube uFirstProbeSky;
#if LODESTAR_PROBES > 1
uniform samplerCube uSecondProbeSky;
#endif
#endif
#endif

vec4 lodestar_host_cube(int slot, vec3 direction, float level) {
#if LODESTAR_PROBES
    if (slot == 1) {
        vec4 light = textureLod(uFirstProbe, direction, level);
#if LODESTAR_PROBE_SKIES
        if (uProbe[0].sky.w > 0.5) {
            light.rgb += uProbe[0].sky.rgb * textureLod(uFirstProbeSky, direction, level).rgb;
        }
#endif
        return light;
    }
#if LODESTAR_PROBES > 1
    if (slot == 2) {
        vec4 light = textureLod(uSecondProbe, direction, level);
#if LODESTAR_PROBE_SKIES
        if (uProbe[1].sky.w > 0.5) {
            light.rgb += uProbe[1].sky.rgb * textureLod(uSecondProbeSky, direction, level).rgb;
        }
#endif
        return light;
    }
#endif
#endif
    vec4 texel = textureLod(uEnvironment, direction, level);
    return vec4(texel.rgb * environmentCube.w, texel.a);
}

vec3 lodestar_host_irradiance(int slot, vec3 normal) {
#if LODESTAR_DIFFUSE == 1
    return lodestar_sh9(sh9[0].rgb, sh9[1].rgb, sh9[2].rgb, sh9[3].rgb, sh9[4].rgb, sh9[5].rgb,
                        sh9[6].rgb, sh9[7].rgb, sh9[8].rgb, normal);
#elif LODESTAR_DIFFUSE == 2
    return textureLod(uIrradiance, normal, irradianceCube.y).rgb * irradianceCube.w;
#elif LODESTAR_DIFFUSE == 3
    float footprint = lodestar_footprintLevel(normal, dFdx(normal), dFdy(normal), irradianceCube.x);
    float level = lodestar_raiseLevel(min(irradianceCube.z, irradianceCube.y), footprint, irradianceCube.y);
    return textureLod(uIrradiance, normal, level).rgb * irradianceCube.w;
#else
    return textureLod(uIrradiance, normal, 0.0).rgb * irradianceCube.w;
#endif
}

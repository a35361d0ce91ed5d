// SPDX-License-Identifier: MIT
//
// A texel of a light probe's level 0: what was captured, premultiplied by its coverage, before the
// distant environment and the skies. Suns are no part of it: they light by themselves.
#include "host/probe_half.glsl"
#include "host/blocks.glsl"
#include "lodestar/cube.glsl"
#include "lodestar/power.glsl"
#if LODESTAR_RSRM_LIGHTS
#include "lodestar/rsrm.glsl"
#include "host/rsrm_hooks.glsl"
#endif

#if LODESTAR_ENVIRONMENT
uniform samplerCube uEnvironment;
#endif
uniform samplerCube uFirstProbe; ///< what was captured
uniform int uFace;
uniform float uWidth;         ///< of a face, texels
uniform float uCapturedScale; ///< of what was captured, to radiance as it is written

layout(location = 0) out vec4 oRadiance;

void main() {
    vec2 at = gl_FragCoord.xy * (2.0 / uWidth) - 1.0;
    vec3 direction = lodestar_cubeDirection(uFace, at.x, at.y);
    vec4 captured = textureLod(uFirstProbe, direction, 0.0);
    if (any(isnan(captured)) || any(isinf(captured))) {
        captured = vec4(0.0);
    }
    vec3 sky = vec3(0.0);
#if LODESTAR_ENVIRONMENT
    float level = max(log2(environmentCube.x / uWidth), 0.0);
    sky += textureLod(uEnvironment, direction, min(level, environmentCube.y)).rgb * environmentCube.w;
#endif
#if LODESTAR_RSRM_LIGHTS
    vec3 unit = normalize(direction);
    for (int i = 0; i < LODESTAR_RSRM_LIGHTS; ++i) {
        if ((LODESTAR_SKIES & (1u << uint(i))) != 0u) { // known once the loop is unrolled
            sky += lodestar_rsrmGradient(rsrmLight(i), unit);
        }
    }
#endif
    vec3 open = min(sky * written.x, vec3(written.y));
    oRadiance = nearestHalf(vec4(captured.rgb * uCapturedScale + (1.0 - captured.a) * open, 1.0));
}

// SPDX-License-Identifier: MIT
//
// A texel of a light probe's level 0: what was captured, premultiplied by its coverage, before the
// distant environment and the skies. Suns are no part of it: they light by themselves. What was
// captured is repaired, channel by channel: NaN and what is negative give no light, what is infinite the
// greatest that is held; its coverage keeps the sky out all the same.
// LODESTAR_COMPOSED: 0 both; where the sky's part is kept apart, 1 the captured part, 2 the sky's.
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
uniform samplerCube uFirstProbe; ///< what was captured; read texel by texel, or a broken one spreads
uniform int uFace;
uniform float uWidth;         ///< of a face, texels
uniform float uCapturedScale; ///< of what was captured, to radiance as it is written

layout(location = 0) out vec4 oRadiance;

float repaired(float captured) {
    return captured > 0.0 && !isnan(captured) ? min(captured * uCapturedScale, written.y) : 0.0;
}

void main() {
    vec2 at = gl_FragCoord.xy * (2.0 / uWidth) - 1.0;
    vec3 direction = lodestar_cubeDirection(uFace, at.x, at.y);
    vec4 captured = textureLod(uFirstProbe, direction, 0.0);
    vec3 light = vec3(repaired(captured.r), repaired(captured.g), repaired(captured.b));
    float coverage = isnan(captured.a) ? 1.0 : clamp(captured.a, 0.0, 1.0);
    vec3 sky = vec3(0.0);
#if LODESTAR_ENVIRONMENT
    float level = max(log2(environmentCube.x / uWidth), 0.0);
    sky += textureLod(uEnvironment, direction, min(level, environmentCube.y)).rgb * environmentCube.w;
#endif
#if LODESTAR_RSRM_LIGHTS
    vec3 unit = normalize(direction);
    for (int i = LODESTAR_SUNS; i < LODESTAR_RSRM_LIGHTS; ++i) {
        sky += lodestar_rsrmGradient(rsrmLight(i), unit);
    }
#endif
    vec3 open = min(sky * written.x, vec3(written.y));
#if LODESTAR_COMPOSED == 1
    oRadiance = nearestHalf(vec4(light, 1.0));
#elif LODESTAR_COMPOSED == 2
    oRadiance = nearestHalf(vec4((1.0 - coverage) * open, 1.0));
#else
    oRadiance = nearestHalf(vec4(min(light + (1.0 - coverage) * open, vec3(written.y)), 1.0));
#endif
}

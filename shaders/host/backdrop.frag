// SPDX-License-Identifier: MIT
//
// What is behind everything: the environment's cube, or the gradients that the lights are made of.
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

in vec3 vDirection;

layout(location = 0) out vec4 oRadiance;

void main() {
    vec3 radiance = vec3(0.0);
#if LODESTAR_ENVIRONMENT
    float footprint = lodestar_footprintLevel(vDirection, dFdx(vDirection), dFdy(vDirection), environmentCube.x);
    float level = lodestar_raiseLevel(0.0, footprint, environmentCube.y);
    radiance += textureLod(uEnvironment, vDirection, level).rgb * environmentCube.w;
#endif
#if LODESTAR_RSRM_LIGHTS
    radiance += rsrmBackdrop(normalize(vDirection));
#endif
    oRadiance = vec4(radiance, 1.0);
}

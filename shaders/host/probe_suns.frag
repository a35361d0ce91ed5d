// SPDX-License-Identifier: MIT
//
// How much of each sun a light probe sees: a texel a light, beneath the probe's tile of irradiance.
#include "host/blocks.glsl"

uniform samplerCube uFirstProbe; ///< what was captured; alpha is how much of a direction it covers
uniform ivec2 uTile;             ///< the first of these texels

layout(location = 0) out vec4 oVisibility;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy) - uTile;
    int light = min(at.x + LODESTAR_SUN_TEXELS * at.y, LODESTAR_MAX_RSRM_LIGHTS - 1);
    oVisibility = vec4(1.0 - clamp(textureLod(uFirstProbe, rsrmAxis[light].xyz, 0.0).a, 0.0, 1.0));
}

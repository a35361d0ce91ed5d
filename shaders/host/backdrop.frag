// SPDX-License-Identifier: MIT
#include "host/blocks.glsl"
#include "lodestar/cube.glsl"

uniform samplerCube uEnvironment;

in vec3 vDirection;

layout(location = 0) out vec4 oRadiance;

void main() {
    float footprint = lodestar_footprintLevel(vDirection, dFdx(vDirection), dFdy(vDirection), environmentCube.x);
    float level = lodestar_raiseLevel(0.0, footprint, environmentCube.y);
    oRadiance = vec4(textureLod(uEnvironment, vDirection, level).rgb * environmentCube.w, 1.0);
}

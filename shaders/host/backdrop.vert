// SPDX-License-Identifier: MIT
#include "host/blocks.glsl"

out vec3 vDirection;

void main() {
    vec2 p = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2)) * 2.0 - 1.0;
    // Two points along the pixel's ray: their difference needs no camera position.
    vec4 nearPoint = worldFromClip * vec4(p, -1.0, 1.0);
    vec4 farPoint = worldFromClip * vec4(p, 0.5, 1.0);
    vDirection = farPoint.xyz / farPoint.w - nearPoint.xyz / nearPoint.w;
    gl_Position = vec4(p, 1.0, 1.0);
}

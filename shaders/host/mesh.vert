// SPDX-License-Identifier: MIT
#include "host/blocks.glsl"
#include "lodestar/cube.glsl"

layout(location = 0) in vec3 aPosition;
layout(location = 1) in vec3 aNormal;
layout(location = 2) in vec4 aTangent;
layout(location = 3) in vec2 aUv0;
layout(location = 4) in vec2 aUv1;
layout(location = 5) in vec4 aColor;

out vec3 vPosition;
out vec3 vNormal;
out vec4 vTangent;
out vec2 vUv0;
out vec2 vUv1;
out vec4 vColor;
out float vLeastLevel;

void main() {
    vec4 world = worldFromModel * vec4(aPosition, 1.0);
    vPosition = world.xyz;
#if LODESTAR_NORMALS
    vNormal = mat3(normalFromModel) * aNormal;
#else
    vNormal = vec3(0.0);
#endif
#if LODESTAR_TANGENTS
    vTangent = vec4(mat3(worldFromModel) * aTangent.xyz, aTangent.w);
#else
    vTangent = vec4(0.0);
#endif
    vUv0 = aUv0;
    vUv1 = aUv1;
#if LODESTAR_VERTEX_COLORS
    vColor = aColor;
#else
    vColor = vec4(1.0);
#endif
    vec3 view = lodestar_safeNormalize(cameraPosition.xyz - cameraPosition.w * world.xyz, vec3(0.0, 0.0, 1.0));
    vec3 normal = lodestar_safeNormalize(vNormal, view);
    vLeastLevel = lodestar_biasLevelAtVertex(environmentCube.z, abs(dot(normal, view)));
    gl_Position = clipFromWorld * world;
    gl_PointSize = 3.0;
}

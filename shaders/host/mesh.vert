// SPDX-License-Identifier: MIT
#include "host/blocks.glsl"
#include "lodestar/cube.glsl"

layout(location = 0) in vec3 aPosition;
layout(location = 1) in vec3 aNormal;
layout(location = 2) in vec4 aTangent;
layout(location = 3) in vec2 aUv0;
layout(location = 4) in vec2 aUv1;
layout(location = 5) in vec4 aColor;
uniform samplerBuffer uInstances; // of each three rows of worldFromModel, then x: first texel of its joints, yzw: what probes may light of it
uniform int uFirstInstance;

vec4 instanceTexel(int k) {
    return texelFetch(uInstances, 4 * (uFirstInstance + gl_InstanceID) + k);
}

mat4 fromRows(vec4 x, vec4 y, vec4 z) {
    return transpose(mat4(x, y, z, vec4(0.0, 0.0, 0.0, 1.0)));
}

#if LODESTAR_SKINNING
layout(location = 6) in vec4 aJoints0;
layout(location = 7) in vec4 aWeights0;
#if LODESTAR_SECOND_JOINTS
layout(location = 8) in vec4 aJoints1;
layout(location = 9) in vec4 aWeights1;
#endif

uniform samplerBuffer uJoints; // three rows of worldFromMesh a joint

void addJoint(float joint, float weight, inout vec4 rows[3]) {
    int texel = int(instanceTexel(3).x + 0.5) + 3 * int(joint + 0.5);
    for (int i = 0; i < 3; ++i) {
        rows[i] += weight * texelFetch(uJoints, texel + i);
    }
}

/// The vertex's mixture of its joints' worldFromMesh.
mat4 skinned() {
    vec4 rows[3] = vec4[3](vec4(0.0), vec4(0.0), vec4(0.0));
    for (int k = 0; k < 4; ++k) {
        addJoint(aJoints0[k], aWeights0[k], rows);
#if LODESTAR_SECOND_JOINTS
        addJoint(aJoints1[k], aWeights1[k], rows);
#endif
    }
    return fromRows(rows[0], rows[1], rows[2]);
}
#endif

/// The cofactors turned by the determinant's sign: along the inverse transpose, and there for
/// singular matrices too.
mat3 normalMatrix(mat3 m) {
    mat3 cofactors = mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1]));
    return dot(m[0], cofactors[0]) < 0.0 ? -cofactors : cofactors;
}

out vec3 vPosition;
out vec3 vNormal;
out vec4 vTangent;
out vec2 vUv0;
out vec2 vUv1;
out vec4 vColor;
out float vLeastLevel;
flat out vec3 vProbes; // f0, f1 and open of lodestar_probeShares

void main() {
#if LODESTAR_SKINNING
    mat4 worldFromMesh = skinned();
#else
    mat4 worldFromMesh = fromRows(instanceTexel(0), instanceTexel(1), instanceTexel(2));
#endif
    vec4 world = worldFromMesh * vec4(aPosition, 1.0);
    vPosition = world.xyz;
#if LODESTAR_NORMALS
    vNormal = normalMatrix(mat3(worldFromMesh)) * aNormal;
#if LODESTAR_SKINNING
    vNormal = lodestar_safeNormalize(vNormal, vec3(0.0)); // its length differs from vertex to vertex
#endif
#else
    vNormal = vec3(0.0);
#endif
#if LODESTAR_TANGENTS
    // A mirror image of a bitangent is not normal x tangent, but its opposite.
    float mirrored = determinant(mat3(worldFromMesh)) < 0.0 ? -1.0 : 1.0;
    vTangent = vec4(mat3(worldFromMesh) * aTangent.xyz, mirrored * aTangent.w);
#if LODESTAR_SKINNING
    vTangent.xyz = lodestar_safeNormalize(vTangent.xyz, vec3(0.0)); // as the normal
#endif
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
    vProbes = instanceTexel(3).yzw;
}

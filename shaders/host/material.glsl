// SPDX-License-Identifier: MIT
//
// What a texel of a surface is: textures and factors of glTF's metallic-roughness, or Blinn-Phong's
// quantities given directly, as a LodestarSurface.

uniform sampler2D uBaseColorTexture;
uniform sampler2D uMetallicRoughnessTexture;
uniform sampler2D uNormalTexture;
uniform sampler2D uOcclusionTexture;
uniform sampler2D uEmissiveTexture;
uniform sampler2D uExponentTexture;
uniform sampler2D uSpecularTexture;
uniform sampler2D uSpecularColorTexture;

/// Where the texture of a unit is read.
vec2 uvOf(int unit) {
    vec4 row = uvRows[2 * unit];
    vec2 uv = row.w < 0.5 ? vUv0 : vUv1;
#if LODESTAR_TEXTURE_TRANSFORM
    vec3 from = vec3(uv, 1.0);
    uv = vec2(dot(row.xyz, from), dot(uvRows[2 * unit + 1].xyz, from));
#endif
    return uv;
}

/// The base colour without its factor.
vec4 paintHere() {
    vec4 color = vColor;
#if LODESTAR_BASE_COLOR_TEXTURE
    color *= texture(uBaseColorTexture, uvOf(LODESTAR_BASE_COLOR_UNIT));
#endif
    return color;
}

vec4 baseColorHere() {
    return baseColor * paintHere();
}

/// The geometric normal that faces the viewer, from screen derivatives of the position.
vec3 facetNormal(vec3 view) {
    vec3 n = lodestar_safeNormalize(cross(dFdx(vPosition), dFdy(vPosition)), view);
    return dot(n, view) < 0.0 ? -n : n;
}

/// The tangent frame of the mesh, turned with its texture coordinates, or one from derivatives of
/// position and uv where it has none.
/// Seen from behind, a bump turns over as a whole: tangent and bitangent flip with the normal.
/// @param n the normal that faces the viewer
mat3 tangentFrame(vec3 n, vec2 uv) {
    float facing = gl_FrontFacing ? 1.0 : -1.0;
#if LODESTAR_TANGENTS
    vec3 t = lodestar_safeNormalize(vTangent.xyz - n * dot(n, vTangent.xyz), vec3(0.0));
    vec3 b = cross(n, t) * vTangent.w;
#if LODESTAR_TEXTURE_TRANSFORM
    // The mesh's tangents belong to its own coordinates. The frame of the transformed ones: t along
    // the line on which v' stays and u' grows; v and v' run down the image, b up.
    vec4 u = uvRows[2 * LODESTAR_NORMAL_UNIT];
    vec4 v = uvRows[2 * LODESTAR_NORMAL_UNIT + 1];
    float side = u.x * v.y - u.y * v.x < 0.0 ? -1.0 : 1.0;
    t = lodestar_safeNormalize(side * (v.y * t + v.x * facing * b), vec3(0.0));
    b = cross(n, t) * (vTangent.w * side);
#endif
    t *= facing;
#else
    // The gradients of u and v on the surface; glTF's v runs down the image, a normal map's y up.
    vec3 px = cross(dFdy(vPosition), n);
    vec3 py = cross(n, dFdx(vPosition));
    vec2 ux = dFdx(uv);
    vec2 uy = dFdy(uv);
    vec3 t = px * ux.x + py * uy.x;
    vec3 b = px * ux.y + py * uy.y;
    float longest = max(dot(t, t), dot(b, b));
    float k = longest > 0.0 ? facing * inversesqrt(longest) : 0.0;
    t *= k;
    b *= -k;
#endif
    return mat3(t, b, n);
}

vec3 normalHere(vec3 view) {
    float facing = gl_FrontFacing ? 1.0 : -1.0;
#if LODESTAR_NORMALS
    vec3 n = lodestar_safeNormalize(vNormal, vec3(0.0)) * facing;
    if (dot(n, n) == 0.0) {
        n = facetNormal(view);
    }
#else
    vec3 n = view; // points and lines have no side: they face the viewer
#endif
#if LODESTAR_NORMAL_TEXTURE
    vec2 uv = uvOf(LODESTAR_NORMAL_UNIT);
    vec3 m = texture(uNormalTexture, uv).xyz * 2.0 - 1.0;
    m.xy *= emissive.w;
    n = lodestar_safeNormalize(tangentFrame(n, uv) * m, n);
#endif
    return n;
}

float exponentHere(float given, float roughness) {
#if LODESTAR_EXPONENT_TEXTURE
    float texel = texture(uExponentTexture, uvOf(LODESTAR_EXPONENT_UNIT)).r * f0.w;
    return lodestar_repairExponent(more.x > 0.5 ? exp2(texel) - 1.0 : texel);
#elif LODESTAR_BLINN_PHONG
    return given;
#else
    return more.y > 0.5 ? given : lodestar_exponentFromRoughness(roughness);
#endif
}

/// F0 where a surface is no metal: min(F0 of the index x specular colour, 1) x specular factor
/// [KHR_materials_specular]. 0.04 where a material says nothing.
vec3 dielectricF0() {
    vec3 color = specular.rgb;
    float factor = specular.w;
#if LODESTAR_SPECULAR_COLOR_TEXTURE
    color *= texture(uSpecularColorTexture, uvOf(LODESTAR_SPECULAR_COLOR_UNIT)).rgb;
#endif
#if LODESTAR_SPECULAR_TEXTURE
    factor *= texture(uSpecularTexture, uvOf(LODESTAR_SPECULAR_UNIT)).a;
#endif
    return min(color, vec3(1.0)) * factor;
}

LodestarSurface surfaceHere(vec3 view, vec4 color) {
    float metallic = surface.x;
    float roughness = surface.y;
#if LODESTAR_METALLIC_ROUGHNESS_TEXTURE
    vec4 texel = texture(uMetallicRoughnessTexture, uvOf(LODESTAR_METALLIC_ROUGHNESS_UNIT));
    metallic *= texel.b;
    roughness *= texel.g;
#endif
    LodestarSurface here;
    here.view = view;
    here.normal = normalHere(view);
#if LODESTAR_BLINN_PHONG
    here.diffuse = diffuse.rgb * color.rgb;
    here.f0 = f0.rgb;
#else
    here.diffuse = more.z > 0.5 ? diffuse.rgb * paintHere().rgb : lodestar_diffuseFromMetallic(color.rgb, metallic);
    here.f0 = more.w > 0.5 ? f0.rgb : mix(dielectricF0(), color.rgb, metallic);
#endif
    here.exponent = exponentHere(diffuse.w, roughness);
    here.occlusion = 1.0;
#if LODESTAR_OCCLUSION_TEXTURE
    here.occlusion = mix(1.0, texture(uOcclusionTexture, uvOf(LODESTAR_OCCLUSION_UNIT)).r, surface.z);
#endif
    return here;
}

vec3 emissiveHere() {
#if LODESTAR_EMISSIVE_TEXTURE
    return emissive.rgb * texture(uEmissiveTexture, uvOf(LODESTAR_EMISSIVE_UNIT)).rgb;
#else
    return emissive.rgb;
#endif
}

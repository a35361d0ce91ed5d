// SPDX-License-Identifier: MIT
//
// Cosine-power lobes: Phong about the reflection, Blinn-Phong about the half vector, their
// normalisers, and the conversions between the two and from metallic-roughness.
// Names: `exponent` alone is the one that the function says; k_L (`diffuse`) and F0 (`f0`) are
// reflectances in [0, 1]; no function here divides by pi unless it says so.
#ifndef LODESTAR_LOBES_GLSL
#define LODESTAR_LOBES_GLSL
#include "dual.glsl"
#include "power.glsl"

LODESTAR_BEGIN

/// (1 - x)^5 for x in [0, 1], clamped first: rounding makes cosines of 1.0000001.  [Schlick 1994]
LODESTAR_FN Real lodestar_schlickWeight(Real cosine) {
    Real m = clamp(1.0f - cosine, Real(0.0f), Real(1.0f));
    Real m2 = m * m;
    return m2 * m2 * m;
}

/// Schlick's Fresnel reflectance for direct light. @param cosine v.h [0, 1]
LODESTAR_FN vec3 lodestar_fresnel(vec3 f0, Real cosine) {
    return f0 + (vec3(1.0f) - f0) * lodestar_schlickWeight(cosine);
}

/// The roughness whose alpha = roughness^2 gives this Blinn-Phong exponent: s = 2 / alpha^2 - 2.
/// @return [0, 1]; 1 for s = 0
LODESTAR_FN Real lodestar_roughnessFromExponent(Real exponent) {
    return sqrt(sqrt(2.0f / (lodestar_repairExponent(exponent) + 2.0f)));
}

/// The Blinn-Phong exponent of a glTF roughness: alpha = roughness^2, s = 2 / alpha^2 - 2, the match
/// of the Beckmann slope distribution. roughness 0 gives a mirror (1e7), 1 gives 0 (Lambert's lobe).
LODESTAR_FN Real lodestar_exponentFromRoughness(Real roughness) {
    Real r = clamp(roughness, Real(0.0f), Real(1.0f));
    Real alphaSquared = r * r * r * r;
    return clamp(2.0f / max(alphaSquared, LODESTAR_LITERAL(1e-8)) - 2.0f, Real(0.0f),
                 LODESTAR_MAX_EXPONENT);
}

/// Schlick's Fresnel at n.v for light gathered over a whole lobe: the rise at grazing angles is
/// limited to 1 - roughness, so that rough things have no white rims. F0 = 1 stays 1.
LODESTAR_FN vec3 lodestar_fresnelEnvironment(vec3 f0, Real nDotV, Real exponent) {
    vec3 limit = max(vec3(1.0f - lodestar_roughnessFromExponent(exponent)), f0);
    return f0 + (limit - f0) * lodestar_schlickWeight(nDotV);
}

/// What multiplies (n.h)^s (n.l) so that the lobe reflects all light at n = v, over pi already:
/// (s + 2)(s + 4) / (8 pi (2^(-s/2) + s)), exact.  s = 0 gives 1 / pi (Lambert).
LODESTAR_FN Real lodestar_blinnPhongNormaliser(Real exponent) {
    Real s = lodestar_repairExponent(exponent);
    return (s + 2.0f) * (s + 4.0f) / (8.0f * LODESTAR_PI * (exp2(-0.5f * s) + s));
}

/// What multiplies max(r.l, 0)^s so that the lobe integrates to 1: (s + 1) / (2 pi).
LODESTAR_FN Real lodestar_phongNormaliser(Real exponent) {
    return (lodestar_repairExponent(exponent) + 1.0f) / (2.0f * LODESTAR_PI);
}

/// The Phong exponent about the reflection of the normalised Blinn-Phong lobe (n.h)^s (n.l) at
/// n = v: s' = s/4 + 3/8 + (5/8) / (1 + s/6) (LOOK-5). L2 error at most 0.029, width within 4 %, peak
/// within 3 %; exactly Lambert's (1) at s = 0.
LODESTAR_FN Real lodestar_phongFromBlinnPhong(Real exponent) {
    Real s = lodestar_repairExponent(exponent);
    return 0.25f * s + 0.375f + 0.625f / (1.0f + s * LODESTAR_LITERAL(0.166666666666666667));
}

/// The same for any view: the lobe about the reflection narrows across the plane of incidence as n.v
/// falls, so that the best round lobe is sharper by (n.v^2 + q (1 - n.v^2))^(-1/2), where q falls
/// from 1 for Lambert's lobe to 0.0373 for sharp ones (LOOK-8; constants fitted, see
/// docs/derivations/lookup.md for the errors).
/// @param exponent Blinn-Phong [0, 1e7]  @param nDotV [0, 1]
/// @return Phong exponent, [1, 1.3e7]
LODESTAR_FN Real lodestar_lookupExponent(Real exponent, Real nDotV) {
    Real s = lodestar_repairExponent(exponent);
    Real rise = 1.0f + LODESTAR_LITERAL(0.4075) * s;
    Real q = LODESTAR_LITERAL(0.0373) + LODESTAR_LITERAL(0.9627) / (rise * rise);
    Real c2 = clamp(nDotV * nDotV, Real(0.0f), Real(1.0f));
    return lodestar_phongFromBlinnPhong(s) * inversesqrt(c2 + q * (1.0f - c2));
}

/// How far from the normal (0) to the reflection (1) the lookup for a Blinn-Phong lobe points; the
/// blended vector is made unit after. t = o / (1 + o), o = a s / sqrt(1 + d s) + b s^2 n.v / (s + f)
/// (LOOK-7; constants fitted). Rises with s from 0 at s = 0 to 1; finite everywhere.
/// @param exponent Blinn-Phong [0, 1e7]  @param nDotV [0, 1]
LODESTAR_FN Real lodestar_lookupBlend(Real exponent, Real nDotV) {
    Real s = lodestar_repairExponent(exponent);
    Real odds = LODESTAR_LITERAL(0.2551) * s * inversesqrt(1.0f + LODESTAR_LITERAL(0.5623) * s) +
                LODESTAR_LITERAL(0.1426) * nDotV * s * (s / (s + LODESTAR_LITERAL(4.136)));
    return odds / (1.0f + odds);
}

/// Radiance-per-irradiance of direct light: diffuse and Blinn-Phong terms times n.l, pi divided.
/// @param n, v, l unit; l towards the light  @param diffuse k_L  @param f0 reflectance at h = v
/// @return to be multiplied by the light's irradiance on a surface facing it
LODESTAR_FN vec3 lodestar_directReflectance(vec3 n, vec3 v, vec3 l, vec3 diffuse, vec3 f0,
                                            Real exponent) {
    Real nDotL = clamp(dot(n, l), Real(0.0f), Real(1.0f));
    vec3 h = lodestar_safeNormalize(l + v, -n); // opposite l and v have no half vector: no highlight
    Real s = lodestar_repairExponent(exponent);
    vec3 fresnel = lodestar_fresnel(f0, dot(v, h));
    Real lobe = dot(n, h) > 0.0f ? lodestar_cosinePowerBetween(n, h, s) : Real(0.0f);
    vec3 specular = fresnel * (lodestar_blinnPhongNormaliser(s) * lobe);
    vec3 lambert = diffuse * (vec3(1.0f) - fresnel) * (1.0f / LODESTAR_PI);
    return (lambert + specular) * nDotL;
}

/// Occlusion of glossy light by an ambient-occlusion factor: all of it for broad lobes, none for
/// mirrors: mix(ao, 1, s / (s + 32)).
LODESTAR_FN Real lodestar_specularOcclusion(Real occlusion, Real exponent) {
    Real s = lodestar_repairExponent(exponent);
    return mix(occlusion, Real(1.0f), s / (s + 32.0f));
}

/// k_L of a metallic-roughness material: base colour scaled by 1 - metallic.
LODESTAR_FN vec3 lodestar_diffuseFromMetallic(vec3 baseColor, Real metallic) {
    return baseColor * (1.0f - metallic);
}

/// F0 of a metallic-roughness material: 0.04 for dielectrics (index 1.5), base colour for metals.
LODESTAR_FN vec3 lodestar_f0FromMetallic(vec3 baseColor, Real metallic) {
    return mix(vec3(LODESTAR_LITERAL(0.04)), baseColor, metallic);
}

/// F0 where a surface is no metal: min(F0 of the index x specular colour, 1) x specular factor; an
/// index of 0 gives an F0 of 1. [KHR_materials_ior, KHR_materials_specular]
LODESTAR_FN vec3 lodestar_f0OfDielectric(Real ior, vec3 specularColor, Real specular) {
    Real ratio = (ior - 1.0f) / (ior + 1.0f);
    return min(ratio * ratio * specularColor, vec3(1.0f)) * specular;
}

LODESTAR_END

#endif

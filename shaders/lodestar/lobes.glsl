// SPDX-License-Identifier: MIT
//
// Cosine-power lobes: Phong about the reflection, Blinn-Phong about the half vector, their
// normalisers, and the conversions between the two and from metallic-roughness. Feature macros:
//   LODESTAR_LOBES    which form direct light's highlights take, one of LODESTAR_LOBES_*
//   LODESTAR_FRESNEL  which form Fresnel's reflectance takes, one of LODESTAR_FRESNEL_*
// Names: `exponent` alone is the one that the function says; k_L (`diffuse`) and F0 (`f0`) are
// reflectances in [0, 1]; no function here divides by pi unless it says so.
#ifndef LODESTAR_LOBES_GLSL
#define LODESTAR_LOBES_GLSL
#include "dual.glsl"
#include "power.glsl"
#include "sg.glsl"

#ifndef LODESTAR_LOBES
#define LODESTAR_LOBES 0
#endif
#ifndef LODESTAR_FRESNEL
#define LODESTAR_FRESNEL 0
#endif

LODESTAR_BEGIN

LODESTAR_CONST int LODESTAR_LOBES_POWER = 0; ///< cosine powers
LODESTAR_CONST int LODESTAR_LOBES_SG = 1;    ///< spherical Gaussians
LODESTAR_CONST int LODESTAR_FRESNEL_SCHLICK = 0;
LODESTAR_CONST int LODESTAR_FRESNEL_SG = 1; ///< lodestar_sgFresnelWeight

/// (1 - x)^5 for x in [0, 1], clamped first: rounding makes cosines of 1.0000001.  [Schlick 1994]
LODESTAR_FN Real lodestar_schlickWeight(Real cosine) {
    Real m = clamp(1.0f - cosine, Real(0.0f), Real(1.0f));
    Real m2 = m * m;
    return m2 * m2 * m;
}

/// How far reflectance has risen from F0 to 1. @param form one of LODESTAR_FRESNEL_*
LODESTAR_FN Real lodestar_fresnelWeight(Real cosine, int form) {
    return form == LODESTAR_FRESNEL_SG ? lodestar_sgFresnelWeight(cosine) : lodestar_schlickWeight(cosine);
}

/// Fresnel's reflectance for direct light. @param cosine v.h [0, 1]  @param form one of LODESTAR_FRESNEL_*
LODESTAR_FN vec3 lodestar_fresnelBy(vec3 f0, Real cosine, int form) {
    return f0 + (vec3(1.0f) - f0) * lodestar_fresnelWeight(cosine, form);
}

/// The same by Schlick's form.
LODESTAR_FN vec3 lodestar_fresnel(vec3 f0, Real cosine) {
    return lodestar_fresnelBy(f0, cosine, LODESTAR_FRESNEL_SCHLICK);
}

/// The roughness whose alpha = roughness^2 gives this Blinn-Phong exponent: s = 2 / alpha^2 - 2 (EXP-1).
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

/// Fresnel's reflectance at n.v for light gathered over a whole lobe: the rise at grazing angles is
/// limited to 1 - roughness, so that rough things have no white rims. F0 = 1 stays 1.
/// @param form one of LODESTAR_FRESNEL_*
LODESTAR_FN vec3 lodestar_fresnelEnvironmentBy(vec3 f0, Real nDotV, Real exponent, int form) {
    vec3 limit = max(vec3(1.0f - lodestar_roughnessFromExponent(exponent)), f0);
    return f0 + (limit - f0) * lodestar_fresnelWeight(nDotV, form);
}

/// The same by Schlick's form.
LODESTAR_FN vec3 lodestar_fresnelEnvironment(vec3 f0, Real nDotV, Real exponent) {
    return lodestar_fresnelEnvironmentBy(f0, nDotV, exponent, LODESTAR_FRESNEL_SCHLICK);
}

/// What multiplies (n.h)^s (n.l) so that the lobe reflects all light at n = v, over pi already:
/// (s + 2)(s + 4) / (8 pi (2^(-s/2) + s)), exact.  s = 0 gives 1 / pi (Lambert).
LODESTAR_FN Real lodestar_blinnPhongNormaliser(Real exponent) {
    Real s = lodestar_repairExponent(exponent);
    return (s + 2.0f) * (s + 4.0f) / (8.0f * LODESTAR_PI * (exp2(-0.5f * s) + s));
}

/// s + 2^(-s/2) times the albedo below: what the lobe gathers from the upper hemisphere (SUN-2; the part beyond
/// the horizon is fitted, within 1.7 %).
/// @param s Blinn-Phong exponent [0, 1e7]  @param nDotV [0, 1]
LODESTAR_FN Real lodestar_blinnPhongGathered(Real s, Real nDotV) {
    Real c = clamp(nDotV, Real(0.0f), Real(1.0f));
    Real x = LODESTAR_LITERAL(0.9332) * c * sqrt(s);
    Real kept = LODESTAR_LITERAL(1.1997) * s * x * inversesqrt(1.0f + x * x) / (s + LODESTAR_LITERAL(0.6083));
    Real squared = c * c;
    return squared * (s + exp2(-0.5f * s)) + (1.0f - squared) * (1.0f + kept);
}

/// The share of light from everywhere that (n.h)^s (n.l) times its normaliser reflects: 1 at n.v = 1 and for
/// s = 0, (n.v)^2 for sharp lobes (SUN-2).
/// @param exponent Blinn-Phong [0, 1e7]  @param nDotV [0, 1]
LODESTAR_FN Real lodestar_blinnPhongAlbedo(Real exponent, Real nDotV) {
    Real s = lodestar_repairExponent(exponent);
    return lodestar_blinnPhongGathered(s, nDotV) / (s + exp2(-0.5f * s));
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

/// (n.h)^s of two unit vectors, or the spherical Gaussian nearest in shape with the same peak (SG-3);
/// 0 where h is behind. @param form one of LODESTAR_LOBES_*  @param s exponent, [0, 1e7]
LODESTAR_FN Real lodestar_highlight(vec3 n, vec3 h, Real s, int form) {
    Real lobe = form == LODESTAR_LOBES_SG
                    ? lodestar_sgBetween(n, h, lodestar_sgSharpness(s, LODESTAR_SG_SHAPE))
                    : lodestar_cosinePowerBetween(n, h, s);
    return dot(n, h) > 0.0f ? lobe : Real(0.0f);
}

/// Radiance-per-irradiance of direct light: diffuse and Blinn-Phong terms times n.l, pi divided. The
/// normaliser is the cosine power's for either form of the lobe.
/// @param n, v, l unit; l towards the light  @param diffuse k_L  @param f0 reflectance at h = v
/// @param lobes, fresnel one of LODESTAR_LOBES_*, of LODESTAR_FRESNEL_*
/// @return to be multiplied by the light's irradiance on a surface facing it
LODESTAR_FN vec3 lodestar_directReflectanceBy(vec3 n, vec3 v, vec3 l, vec3 diffuse, vec3 f0,
                                              Real exponent, int lobes, int fresnel) {
    Real nDotL = clamp(dot(n, l), Real(0.0f), Real(1.0f));
    vec3 h = lodestar_safeNormalize(l + v, -n); // opposite l and v have no half vector: no highlight
    Real s = lodestar_repairExponent(exponent);
    vec3 reflectance = lodestar_fresnelBy(f0, dot(v, h), fresnel);
    vec3 specular = reflectance * (lodestar_blinnPhongNormaliser(s) * lodestar_highlight(n, h, s, lobes));
    vec3 lambert = diffuse * (vec3(1.0f) - reflectance) * (1.0f / LODESTAR_PI);
    return (lambert + specular) * nDotL;
}

/// The same by cosine powers and Schlick's form.
LODESTAR_FN vec3 lodestar_directReflectance(vec3 n, vec3 v, vec3 l, vec3 diffuse, vec3 f0,
                                            Real exponent) {
    return lodestar_directReflectanceBy(n, v, l, diffuse, f0, exponent, LODESTAR_LOBES_POWER,
                                        LODESTAR_FRESNEL_SCHLICK);
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

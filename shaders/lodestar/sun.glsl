// SPDX-License-Identifier: MIT
//
// How the map of a sun, small beside most lobes, answers for a Blinn-Phong lobe, which is not round: it is
// read where its own, round lobe is as dense as the Blinn-Phong one is towards the sun
// (docs/derivations/sun.md). Functions of the lobe only; rsrm.glsl fetches.
#ifndef LODESTAR_SUN_GLSL
#define LODESTAR_SUN_GLSL
#include "dual.glsl"
#include "lobes.glsl"
#include "power.glsl"

LODESTAR_BEGIN

/// Below 2^-35 of its peak a lobe counts as that much: a sun's round lobe reaches below the horizon.
LODESTAR_CONST Real LODESTAR_SUN_LEAST_OCTAVES = 35.0f;

/// Where a sun's map is read.
struct LodestarSunLookup {
    Real halfChord; ///< sin of half the angle to the map's axis, [0, 1]
    Real exponent;  ///< Phong, >= 1
};

/// log2 of 2 pi times the Blinn-Phong lobe's density towards a light (SUN-1); -100 where none is there.
/// @param n, v, l unit; n.v >= 0  @param exponent Blinn-Phong [0, 1e7]
LODESTAR_FN Real lodestar_blinnPhongLogDensity(vec3 n, vec3 v, vec3 l, Real exponent) {
    Real s = lodestar_repairExponent(exponent);
    Real nDotL = dot(n, l);
    vec3 chord = n - lodestar_safeNormalize(v + l, -n);
    Real d = 0.5f * dot(chord, chord);
    // The normaliser over the albedo: what divides the one multiplies the other.
    Real density = 0.25f * (s + 2.0f) * (s + 4.0f) * nDotL / lodestar_blinnPhongGathered(s, dot(n, v));
    Real octaves = s * LODESTAR_LITERAL(1.44269504088896341) * lodestar_logCosineFromChord(min(d, LODESTAR_LITERAL(0.9999))) +
                   log2(max(density, LODESTAR_LITERAL(1e-30)));
    return nDotL > 0.0f ? max(octaves, Real(-100.0f)) : Real(-100.0f);
}

/// The lookup in a sun's map for a Blinn-Phong lobe (SUN-3 to SUN-5).
/// @param n, v, axis unit  @param exponent Blinn-Phong, [0, 1e7]
/// @param direction, round what lodestar_lookup gives for them: a direction and a Phong exponent
/// @param spread how wide the sun is, the mean of |l - axis|^2 over its squared radiance, [0, 4]
LODESTAR_FN LodestarSunLookup lodestar_sunLookup(vec3 n, vec3 v, Real exponent, vec3 direction, Real round,
                                                 vec3 axis, Real spread) {
    Real density = lodestar_blinnPhongLogDensity(n, v, axis, exponent);
    Real least = log2(round + 1.0f);
    Real sharp = density > least ? exp2(min(density, Real(24.0f))) - 1.0f : round; // 2^24 is beyond 1e7
    Real fall = max(least - density, Real(0.0f));
    Real narrow = lodestar_oneMinusExp(LODESTAR_LITERAL(0.693147180559945309) * fall / sharp);
    vec3 chord = direction - axis;
    Real wide = 0.5f * dot(chord, chord);
    Real width = max(0.5f * spread * sharp, LODESTAR_LITERAL(1e-12));
    Real share = width / (width + exp2(-0.5f * min(fall, LODESTAR_SUN_LEAST_OCTAVES)));
    LodestarSunLookup lookup;
    lookup.halfChord = min(sqrt(0.5f * (narrow + share * (wide - narrow))), Real(1.0f));
    lookup.exponent = sharp;
    return lookup;
}

LODESTAR_END

#endif

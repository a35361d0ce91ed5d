// SPDX-License-Identifier: MIT
//
// Taps of a Blinn-Phong lobe for pictures that others are compared with (docs/estimators.md): drawn by
// the half vector's own density, so that a mean needs the cosines alone.
#ifndef LODESTAR_REFERENCE_GLSL
#define LODESTAR_REFERENCE_GLSL
#include "dual.glsl"
#include "cube.glsl"
#include "power.glsl"

LODESTAR_BEGIN

/// A direction as a lobe sees it.
struct LodestarTap {
    vec3 direction; ///< towards the light, unit
    Real weight;    ///< (n.l) (h.v), 0 below the horizon; a mean over drawn taps is sum w L / sum w
    Real density;   ///< by which lodestar_drawnTap draws it, per steradian
};

/// The k-th of so many points of the golden spiral: t = (k + 1/2) / total in (0, 1), and the angle
/// k (3 - sqrt 5) / 2 in turns [0, 1), counted in parts of 64 so that a float keeps it to 2e-5.
/// @param k whole, [0, total)  @param total whole, [1, 16384]
LODESTAR_FN vec2 lodestar_spiralPoint(Real k, Real total) {
    Real high = floor(k * LODESTAR_LITERAL(0.015625));
    Real low = k - 64.0f * high;
    // 64 (3 - sqrt 5) / 2 = 24 + 0.4458...
    Real turns = LODESTAR_LITERAL(0.445824720006725984) * high + LODESTAR_LITERAL(0.381966011250105152) * low;
    return vec2((k + 0.5f) / total, turns - floor(turns));
}

/// A direction in the lobe (n.h)^s (n.l) seen from v: half vectors have the density (s + 1) (n.h)^s /
/// (2 pi), their reflections 1 / (4 h.v) of it, and (n.l) (h.v) is what is left of the lobe (LOOK-2).
/// @param l, n, v unit  @param exponent Blinn-Phong [0, 1e7]
LODESTAR_FN LodestarTap lodestar_tapOfDirection(vec3 l, vec3 n, vec3 v, Real exponent) {
    Real s = lodestar_repairExponent(exponent);
    vec3 h = lodestar_safeNormalize(l + v, -n); // opposite l and v have none
    Real hDotV = max(dot(h, v), Real(0.0f));
    Real lobe = dot(n, h) > 0.0f ? lodestar_cosinePowerBetween(n, h, s) : Real(0.0f);
    LodestarTap tap;
    tap.direction = l;
    tap.weight = hDotV * max(dot(n, l), Real(0.0f));
    tap.density = (s + 1.0f) * lobe / (8.0f * LODESTAR_PI * max(hDotV, LODESTAR_LITERAL(1e-4)));
    return tap;
}

/// A tap drawn by that density: y = (n.h)^(s + 1) is even in (0, 1).
/// @param point of lodestar_spiralPoint  @param n, v unit  @param exponent Blinn-Phong [0, 1e7]
LODESTAR_FN LodestarTap lodestar_drawnTap(vec2 point, vec3 n, vec3 v, Real exponent) {
    Real s = lodestar_repairExponent(exponent);
    // log of n.h; 1 - n.h by its series where n.h would lose it.
    Real logarithm = log2(point.x) * LODESTAR_LITERAL(0.693147180559945309) / (s + 1.0f);
    Real d = logarithm > LODESTAR_LITERAL(-0.01)
                 ? -logarithm * (1.0f + logarithm * (0.5f + logarithm * LODESTAR_LITERAL(0.16666666666666667)))
                 : 1.0f - exp(logarithm);
    Real sine = sqrt(d * (2.0f - d));
    Real angle = 2.0f * LODESTAR_PI * point.y;
    // Two axes across n. [Duff17]
    Real side = n.z < 0.0f ? -1.0f : 1.0f;
    Real a = -1.0f / (side + n.z);
    Real b = n.x * n.y * a;
    vec3 across = vec3(1.0f + side * n.x * n.x * a, side * b, -side * n.x);
    vec3 along = vec3(b, side + n.y * n.y * a, -n.y);
    vec3 h = (1.0f - d) * n + sine * (cos(angle) * across + sin(angle) * along);
    Real hDotV = dot(h, v);
    LodestarTap tap;
    tap.direction = lodestar_safeNormalize(2.0f * hDotV * h - v, n);
    tap.weight = max(hDotV, Real(0.0f)) * max(dot(n, tap.direction), Real(0.0f));
    tap.density = (s + 1.0f) * exp(s * logarithm) / (8.0f * LODESTAR_PI * max(hDotV, LODESTAR_LITERAL(1e-4)));
    return tap;
}

/// The level whose texels there have the solid angle that a tap stands for, 1 / (total density) of
/// the mean texel's 4 pi / (6 w^2); not clamped.
/// @param total taps of the mean  @param width face width of the map, texels
LODESTAR_FN Real lodestar_tapLevel(LodestarTap tap, Real total, Real width) {
    Real texels = LODESTAR_LITERAL(0.477464829275686) * width * width /
                  (total * max(tap.density, LODESTAR_LITERAL(1e-20)));
    return 0.5f * log2(texels) + lodestar_texelSizeLevel(tap.direction);
}

LODESTAR_END

#endif

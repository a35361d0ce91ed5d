// SPDX-License-Identifier: MIT
//
// Cosine powers that stay finite: x^s for x in [0, 1] and s in [0, 1e7], the repair of exponents, the
// accurate form from a chord, and 1 - exp(-x). Exponents above LODESTAR_MAX_EXPONENT are mirrors.
#ifndef LODESTAR_POWER_GLSL
#define LODESTAR_POWER_GLSL
#include "dual.glsl"

LODESTAR_BEGIN

/// The largest finite exponent; +infinity (a mirror) is repaired to it before any arithmetic.
LODESTAR_CONST Real LODESTAR_MAX_EXPONENT = 10000000.0f;

/// An exponent made valid: NaN and negative values become 0, values above 1e7 and +infinity 1e7.
/// The comparison is written so that NaN fails it.
LODESTAR_FN Real lodestar_repairExponent(Real exponent) {
    return exponent >= 0.0f ? min(exponent, LODESTAR_MAX_EXPONENT) : 0.0f;
}

/// x^s with the limits that a lobe needs: 0 for x <= 0, 1 for s = 0, never NaN.
/// @param x cosine [-1, 1]  @param s exponent [0, 1e7]
LODESTAR_FN Real lodestar_cosinePower(Real x, Real s) {
    return x > 0.0f ? (s == 0.0f ? Real(1.0f) : exp2(s * log2(x))) : Real(0.0f);
}

/// log of the cosine of the angle between two unit vectors, from half their squared chord d = |a - b|^2 / 2
/// = 1 - cos: log(1 - d), its series below 1/100. A float cosine near 1 has steps of 6e-8; the chord has no
/// such steps. @param d [0, 1)
LODESTAR_FN Real lodestar_logCosineFromChord(Real d) {
    return d < LODESTAR_LITERAL(0.01)
               ? -d * (1.0f + d * (0.5f + d * (LODESTAR_LITERAL(0.33333333333333333) +
                                               d * (0.25f + d * LODESTAR_LITERAL(0.2)))))
               : log2(1.0f - d) * LODESTAR_LITERAL(0.693147180559945309);
}

/// cos^s of that angle: exp(s log(1 - d)), by the chord because s = 1e7 turns a step of 6e-8 into 45 %.
/// @param d [0, 2]  @param s [0, 1e7]
LODESTAR_FN Real lodestar_cosinePowerFromChord(Real d, Real s) {
    return d >= 1.0f ? Real(0.0f) : exp(s * lodestar_logCosineFromChord(d));
}

/// The same, from the two vectors.
LODESTAR_FN Real lodestar_cosinePowerBetween(vec3 a, vec3 b, Real s) {
    vec3 chord = a - b;
    return lodestar_cosinePowerFromChord(0.5f * dot(chord, chord), s);
}

/// 1 - exp(-x) for x >= 0 without cancellation: the series below a tenth, where what is left out is at
/// most 2e-10 of the whole.
LODESTAR_FN Real lodestar_oneMinusExp(Real x) {
    Real series =
        x * (1.0f -
             x * (0.5f - x * (LODESTAR_LITERAL(0.16666666666666667) -
                              x * (LODESTAR_LITERAL(0.041666666666666667) -
                                   x * (LODESTAR_LITERAL(0.0083333333333333333) - x * LODESTAR_LITERAL(0.0013888888888888889))))));
    return x < LODESTAR_LITERAL(0.1) ? series : 1.0f - exp(-x);
}

/// (1 - t) a + t b of radiances, a few roundings of itself off. GLSL's mix need not be, nor that
/// expression: drivers make a + t (b - a) of both, where t = 1 leaves nothing of b = 1 beside a = 1e8.
/// Written from the nearer end it holds in every order. @param t [0, 1]
LODESTAR_FN vec3 lodestar_mix(vec3 a, vec3 b, Real t) {
    return t < 0.5f ? a + t * (b - a) : b + (1.0f - t) * (a - b);
}

/// A vector made unit, or the fallback where its length is 0 or not finite.
LODESTAR_FN vec3 lodestar_safeNormalize(vec3 v, vec3 fallback) {
    Real lengthSquared = dot(v, v);
    return lengthSquared > LODESTAR_LITERAL(1e-30) && lengthSquared < LODESTAR_LITERAL(1e30)
               ? v * inversesqrt(lengthSquared)
               : fallback;
}

LODESTAR_END

#endif

// SPDX-License-Identifier: MIT
//
// Spherical Gaussians exp(-l (1 - cos)) about an axis (docs/derivations/sg.md): their integral, their
// product, the normalised form, and what stands for a cosine power and for Schlick's Fresnel. Every
// function here is finite for any finite input. A sharpness l lies in [0, 1e7]; amplitudes are 1 and
// multiply outside; d is half the squared chord of two unit vectors, 1 - cos, [0, 2].
#ifndef LODESTAR_SG_GLSL
#define LODESTAR_SG_GLSL
#include "dual.glsl"
#include "power.glsl"

LODESTAR_BEGIN

/// What an exponent rises by to be a sharpness, where the whole of a lobe counts (SG-2).
LODESTAR_CONST Real LODESTAR_SG_ENERGY = 1.0f;
/// The same where a lobe's shape counts, as a highlight's does (SG-3).
LODESTAR_CONST Real LODESTAR_SG_SHAPE = 0.75f;

/// A spherical Gaussian, amplitude exp(-sharpness (1 - cos)) about its axis.
struct LodestarSg {
    vec3 axis;      ///< unit
    Real sharpness; ///< [0, 2e7]
    Real amplitude; ///< [0, 1]
};

/// The sharpness of a cosine power (SG-1). @param exponent repaired as everywhere
/// @param rise LODESTAR_SG_ENERGY, LODESTAR_SG_SHAPE or any other >= 0
LODESTAR_FN Real lodestar_sgSharpness(Real exponent, Real rise) {
    return lodestar_repairExponent(exponent) + rise;
}

/// exp(-l d), 1 for negative products. @param d [0, 2]
LODESTAR_FN Real lodestar_sg(Real d, Real sharpness) {
    return exp(-max(sharpness * d, Real(0.0f)));
}

/// The same, from two unit vectors, whose chord has none of the cosine's steps of 6e-8.
LODESTAR_FN Real lodestar_sgBetween(vec3 a, vec3 b, Real sharpness) {
    vec3 chord = a - b;
    return lodestar_sg(min(0.5f * dot(chord, chord), Real(2.0f)), sharpness);
}

/// Its integral over the sphere, 2 pi (1 - exp(-2 l)) / l; the series below 1/1000, where what is left
/// out is 4e-10 of the whole (SG-4). @param sharpness >= 0, not bounded above; else as 0
LODESTAR_FN Real lodestar_sgIntegral(Real sharpness) {
    Real l = sharpness > 0.0f ? sharpness : Real(0.0f);
    Real least = LODESTAR_LITERAL(0.001);
    return l < least ? 4.0f * LODESTAR_PI * (1.0f - l * (1.0f - l * LODESTAR_LITERAL(0.66666666666666667)))
                     : 2.0f * LODESTAR_PI * lodestar_oneMinusExp(2.0f * l) / max(l, least);
}

/// The von Mises-Fisher density, a spherical Gaussian of integral 1; no sinh (SG-5).
/// @param d [0, 2]  @param concentration its sharpness, any finite
LODESTAR_FN Real lodestar_vonMisesFisher(Real d, Real concentration) {
    Real k = lodestar_repairExponent(concentration);
    return lodestar_sg(d, k) / lodestar_sgIntegral(k);
}

/// The product of two spherical Gaussians of amplitude 1, one itself (SG-6). Where they are opposite
/// and equal it is constant, about the first's axis.
/// @param a, b axes, unit  @param sharpnessOfA, sharpnessOfB [0, 1e7], repaired to it
LODESTAR_FN LodestarSg lodestar_sgProduct(vec3 a, Real sharpnessOfA, vec3 b, Real sharpnessOfB) {
    Real la = lodestar_repairExponent(sharpnessOfA);
    Real lb = lodestar_repairExponent(sharpnessOfB);
    vec3 chord = a - b;
    vec3 sum = a + b;
    LodestarSg product;
    product.sharpness = sqrt((la - lb) * (la - lb) + la * lb * min(dot(sum, sum), Real(4.0f)));
    product.amplitude = exp(-la * lb * min(dot(chord, chord), Real(4.0f)) /
                            max(la + lb + product.sharpness, LODESTAR_LITERAL(1e-30)));
    product.axis = lodestar_safeNormalize(la * a + lb * b, a);
    return product;
}

/// The integral of that product over the sphere (SG-7).
LODESTAR_FN Real lodestar_sgProductIntegral(vec3 a, Real sharpnessOfA, vec3 b, Real sharpnessOfB) {
    LodestarSg product = lodestar_sgProduct(a, sharpnessOfA, b, sharpnessOfB);
    return product.amplitude * lodestar_sgIntegral(product.sharpness);
}

/// What stands for (1 - x)^5 as one exponential, 2^((-5.55473 x - 6.98316) x): at most 0.0038 from it,
/// 1.7e-4 at x = 1 (SG-8). @param cosine clamped to [0, 1]  [Lagarde12]
LODESTAR_FN Real lodestar_sgFresnelWeight(Real cosine) {
    Real x = clamp(cosine, Real(0.0f), Real(1.0f));
    return exp2((LODESTAR_LITERAL(-5.55473) * x - LODESTAR_LITERAL(6.98316)) * x);
}

LODESTAR_END

#endif

// SPDX-License-Identifier: MIT
//
// From linear radiance to a display: exposure is a factor, `filmic` the one tone map, then sRGB.
#ifndef LODESTAR_DISPLAY_GLSL
#define LODESTAR_DISPLAY_GLSL
#include "dual.glsl"

LODESTAR_BEGIN

/// The filmic curve of one channel: toe, straight part and shoulder as one rational function fitted
/// to the ACES reference transform for SDR [Narkowicz 2015]. 0 to 0, 1 to 0.804, monotone, below 1.
LODESTAR_FN Real lodestar_filmic(Real radiance) {
    Real x = clamp(radiance, Real(0.0f), Real(65504.0f));
    Real numerator = x * (LODESTAR_LITERAL(2.51) * x + LODESTAR_LITERAL(0.03));
    Real denominator = x * (LODESTAR_LITERAL(2.43) * x + LODESTAR_LITERAL(0.59)) + LODESTAR_LITERAL(0.14);
    return clamp(numerator / denominator, Real(0.0f), Real(1.0f));
}

/// The sRGB transfer function, linear [0, 1] to encoded [0, 1].
LODESTAR_FN Real lodestar_srgbFromLinear(Real linear) {
    Real x = clamp(linear, Real(0.0f), Real(1.0f));
    return x <= LODESTAR_LITERAL(0.0031308)
               ? LODESTAR_LITERAL(12.92) * x
               : LODESTAR_LITERAL(1.055) * exp2(log2(x) * LODESTAR_LITERAL(0.416666666666666667)) -
                     LODESTAR_LITERAL(0.055);
}

/// Its inverse, encoded [0, 1] to linear [0, 1].
LODESTAR_FN Real lodestar_linearFromSrgb(Real encoded) {
    Real x = clamp(encoded, Real(0.0f), Real(1.0f));
    return x <= LODESTAR_LITERAL(0.04045)
               ? x * LODESTAR_LITERAL(0.0773993808049535604)
               : exp2(log2((x + LODESTAR_LITERAL(0.055)) * LODESTAR_LITERAL(0.947867298578199052)) *
                      LODESTAR_LITERAL(2.4));
}

LODESTAR_END

#endif

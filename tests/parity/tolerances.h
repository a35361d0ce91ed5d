// SPDX-License-Identifier: MIT
//
// How far a driver may be from the exact value, from the precision that the OpenGL Shading Language
// 4.50 promises (section 4.7.1): + - * within half a unit in the last place, / within 2.5, sqrt as
// 1 / inversesqrt: 4.5, inversesqrt 2, exp and exp2 3 + 2 |x|, log2 3 outside [0.5, 2] and 2^-21
// absolute within. u below is 2^-23, the largest unit in the last place relative to a number.
#pragma once

#include "parity/rows.h"

namespace lodestar::testing {

using ToleranceFunction = Tolerance(const GlslCase& inputs, const glm::dvec4& exactValue,
                                    int specular);

ToleranceFunction exact;
// Multiples of u, absolute for values in [0, 1], or relative to the value. Counted at each.
ToleranceFunction absolute6;
ToleranceFunction absolute7;
ToleranceFunction absolute9;
ToleranceFunction absolute20;
ToleranceFunction relative5;
ToleranceFunction relative6;
ToleranceFunction relative8;
ToleranceFunction relative9;
ToleranceFunction relative12;
ToleranceFunction relative15;
ToleranceFunction cosinePowerTolerance;
ToleranceFunction chordTolerance;
ToleranceFunction betweenTolerance;
ToleranceFunction mixTolerance;
ToleranceFunction normalizeTolerance;
ToleranceFunction divisionTolerance;
ToleranceFunction mipLevelTolerance;
ToleranceFunction footprintTolerance;
ToleranceFunction texelSizeTolerance;
ToleranceFunction tentLevelTolerance;
ToleranceFunction biasTolerance;
ToleranceFunction texelSolidAngleTolerance;
ToleranceFunction exponentFromRoughnessTolerance;
ToleranceFunction directTolerance;
ToleranceFunction spiralTolerance;
ToleranceFunction tapOfDirectionTolerance;
ToleranceFunction lobeTapTolerance;
ToleranceFunction tapLevelTolerance;
ToleranceFunction sh9Tolerance;
ToleranceFunction srgbTolerance;
ToleranceFunction linearTolerance;
ToleranceFunction lookupTolerance;
ToleranceFunction lookupAsGivenTolerance;
ToleranceFunction reflectedTolerance;
ToleranceFunction hookTolerance;
ToleranceFunction specularMipTolerance;
ToleranceFunction specularTentTolerance;
ToleranceFunction specularTolerance;
ToleranceFunction specularOfTentsTolerance;
ToleranceFunction specularRingTolerance;
ToleranceFunction specularTapsTolerance;
ToleranceFunction specularPrefilteredTolerance;
ToleranceFunction prefilteredExponentTolerance;
ToleranceFunction prefilteredLevelTolerance;
ToleranceFunction oneMinusExpTolerance;
ToleranceFunction logChordTolerance;
ToleranceFunction gatheredTolerance;
ToleranceFunction albedoTolerance;
ToleranceFunction logDensityTolerance;
ToleranceFunction sunLookupTolerance;
ToleranceFunction sgTolerance;
ToleranceFunction sgBetweenTolerance;
ToleranceFunction sgIntegralTolerance;
ToleranceFunction vonMisesFisherTolerance;
ToleranceFunction sgProductTolerance;
ToleranceFunction sgProductIntegralTolerance;
ToleranceFunction highlightTolerance;
ToleranceFunction directBySgTolerance;
ToleranceFunction drawnTapTolerance;
ToleranceFunction environmentTolerance;
ToleranceFunction rsrmRefinedColumnTolerance;
ToleranceFunction rsrmColumnTolerance;
ToleranceFunction rsrmRowTolerance;
ToleranceFunction rsrmOwnRowTolerance;
ToleranceFunction rsrmMirrorShareTolerance;
ToleranceFunction rsrmAtTolerance;
ToleranceFunction rsrmTolerance;
ToleranceFunction rsrmLambertTolerance;
ToleranceFunction rsrmGradientTolerance;

ToleranceFunction densityTolerance;
ToleranceFunction meanDensityTolerance;
ToleranceFunction roundExponentTolerance;
ToleranceFunction tileTolerance;
ToleranceFunction intoVolumeTolerance;
ToleranceFunction outOfVolumeTolerance;
ToleranceFunction volumeWeightTolerance;
ToleranceFunction parallaxTolerance;

} // namespace lodestar::testing

// SPDX-License-Identifier: MIT
//
// Inputs of the parity rows: the hazards first (zeros, limits, infinities, NaN, zero and huge
// vectors), then a few hundred drawn with a fixed seed. p0.x is a row's first argument, and so on;
// each function's comment names the others.
#pragma once

#include <vector>

#include "support/glsl_function.h"

namespace lodestar::testing {

std::vector<GlslCase> exponentCases();          ///< any exponent, width, last level
std::vector<GlslCase> validExponentCases();     ///< exponent [0, 1e7], width, last level
std::vector<GlslCase> unitIntervalCases();      ///< x, a little beyond [0, 1] too
std::vector<GlslCase> radianceCases();          ///< x in [0, 1e9], negative, infinite
std::vector<GlslCase> cosineAndExponentCases(); ///< cosine [-1, 1.0000001], exponent [0, 1e7]
std::vector<GlslCase> exponentAndUnitCases();   ///< any exponent, x in [0, 1]
std::vector<GlslCase> chordCases();             ///< d in [0, 2], exponent [0, 1e7]
std::vector<GlslCase> vectorPairCases();        ///< p0.xyz, p1.xyz unit, exponent p0.w
std::vector<GlslCase> mixCases();               ///< p0.xyz, p1.xyz radiance, t p0.w
std::vector<GlslCase> anyVectorCases();         ///< p0.xyz any vector, p1.xyz a fallback
std::vector<GlslCase> moderateVectorCases();    ///< the same, squares below overflow
std::vector<GlslCase> faceCases();              ///< face, u, v
std::vector<GlslCase> footprintCases();         ///< p0 direction and width, p1, p2 derivatives
std::vector<GlslCase> raiseCases();             ///< level, floor, last level
std::vector<GlslCase> tentCases();              ///< exponentCases with a unit direction p1
std::vector<GlslCase> biasCases();              ///< least level, n.v
std::vector<GlslCase> texelCases();             ///< width, column, row
std::vector<GlslCase> reflectanceCases(); ///< cosine, exponent; p1 a reflectance, p1.w metallic
std::vector<GlslCase> directCases();      ///< p0 n and exponent, p1 v, p2 l, p3 k_L, p4 F0
std::vector<GlslCase> sh9Cases();         ///< p0 to p8 coefficients, p9 unit
/// p0 width, last level, least level, floor; p1 n and exponent; p2 v and occlusion; p3 k_L; p4 F0;
/// p5, p6 derivatives of the reflection. n.v > 0.
std::vector<GlslCase> surfaceCases();
/// p0 unit and any exponent; p1 axis and layout; p2 columns, rows, least and greatest exponent; p3
/// two logarithms, a fraction, h in [0, 1]; p4 a texel; p5 a valid exponent.
std::vector<GlslCase> rsrmCases();

std::vector<GlslCase> facePointCases();  ///< u, v up to a little beyond the face, a width
std::vector<GlslCase> roundLobeCases();  ///< exponent, a spread that leaves half of the lobe's
std::vector<GlslCase> octahedralCases(); ///< p0 unit, p1.xy a point of the square or beside it
/// p0 to p2 rows, p3 half extents and sphere, p4, p5 blends, p4.w outward, p6 a point inside, p7 a
/// unit direction, p8 where was captured.
std::vector<GlslCase> volumeCases();
/// p0 x in [0, 60], 3 or 7, a number of taps from 4; p1 unit and exponent; p2 cosine, sine, log2 of
/// a share; p3 reach, narrow, widening; p4 p1's tangent; p5 cosine, sine.
std::vector<GlslCase> tapCases();
/// p0 unit and any sharpness, p1 the same, p2.x d in [0, 2], p2.y an exponent.
std::vector<GlslCase> logChordCases(); ///< d in [0, 0.999]
/// p0 n and exponent, p1 v, p2 a sun's axis and spread, p3 the round lookup
std::vector<GlslCase> sunCases();
std::vector<GlslCase> sgCases();
std::vector<GlslCase> shareCases(); ///< p0 w0, w1, f0, f1; p1.x open

} // namespace lodestar::testing

// SPDX-License-Identifier: MIT
//
// Reading radially symmetric reflection maps: filtered light of a sky or a sun as a table over the
// angle to its axis (columns) and the Phong exponent (rows). One fetch through the hook
//   lodestar_host_rsrm(column, row, layer)
//     column  [0, columns - 1] and row [0, rows - 1] count texels from the centre of the first, the
//             fraction interpolates: a texture coordinate is (column + 0.5) / columns. row = rows,
//             one past the last, asks for the square root of the unfiltered gradient, which lies at
//             u2 = column / (columns - 1) in every layout and may be stored finer than the columns.
//     answers rgb as stored and in alpha the scale of the row (1 where the layout has none; else
//             lodestar_rsrmRowScale of the two rows about it).
//
// Source: Stone, radially symmetric reflection maps; storage and errors: docs/derivations/rsrm.md.
//
// A C++ host includes this file inside its class, after defining LODESTAR_HOST_CLASS.
#ifndef LODESTAR_RSRM_GLSL
#define LODESTAR_RSRM_GLSL
#include "dual.glsl"
#include "power.glsl"

LODESTAR_BEGIN

/// Layouts of a map: LodestarRsrm.layoutName.
LODESTAR_CONST int LODESTAR_RSRM_REFINED = 0;   // columns u2, rows in log2(s + 1), sqrt stored
LODESTAR_CONST int LODESTAR_RSRM_PUBLISHED = 1; // columns uniform in z, rows in log2(s), linear

/// What a lookup needs to know of a map.
struct LodestarRsrm {
    int layer;           ///< which map the hook fetches
    int layoutName;      ///< LODESTAR_RSRM_*
    vec3 axis;           ///< unit, towards the light (a sky's is the zenith)
    Real columns;        ///< texels
    Real rows;           ///< texels
    Real leastExponent;  ///< of row 0, > 0
    Real greatestExponent; ///< of the last row
};

/// sin of half the angle between two unit vectors, |r - axis| / 2, in [0, 1]: keeps its digits at
/// the axis, where an arc cosine steps by 0.02 degrees.
LODESTAR_FN Real lodestar_rsrmHalfChord(vec3 r, vec3 axis) {
    vec3 chord = r - axis;
    return min(0.5f * sqrt(dot(chord, chord)), Real(1.0f));
}

/// The column coordinate u2 in [0, 1], refined at the axis and at the horizon (RSRM-6).
/// @param h sin of half the angle to the axis [0, 1]
LODESTAR_FN Real lodestar_rsrmRefinedColumn(Real h) {
    Real z = 1.0f - 2.0f * h * h;
    Real root = sqrt(abs(z));
    return 0.5f * sqrt(h) + 0.25f * (z < 0.0f ? 1.0f + root : 1.0f - root);
}

/// The column of a layout in texels from the centre of the first, [0, columns - 1].
LODESTAR_FN Real lodestar_rsrmColumn(int layoutName, Real h, Real columns) {
    if (layoutName == LODESTAR_RSRM_PUBLISHED) {
        return clamp(h * h * columns - 0.5f, Real(0.0f), columns - 1.0f);
    }
    return lodestar_rsrmRefinedColumn(h) * (columns - 1.0f);
}

/// The row of an exponent in texels from the centre of the first, [0, rows - 1]: rows are uniform
/// in log2(s + shift), shift 0 as published, else 1 (RSRM-7). @param s repaired
LODESTAR_FN Real lodestar_rsrmRow(Real s, Real rows, Real leastExponent, Real greatestExponent,
                                  Real shift) {
    Real clamped = clamp(s, leastExponent, greatestExponent) + shift;
    Real least = leastExponent + shift;
    return clamp((rows - 1.0f) * log2(clamped / least) / log2((greatestExponent + shift) / least),
                 Real(0.0f), rows - 1.0f);
}

/// The scale between two rows whose scales have these base-2 logarithms.
LODESTAR_FN Real lodestar_rsrmRowScale(Real lower, Real upper, Real fraction) {
    return exp2(mix(lower, upper, fraction));
}

/// Radiance of what the hook answered: refined maps store square roots, interpolated, then squared.
LODESTAR_FN vec3 lodestar_rsrmDecode(vec4 stored, int layoutName) {
    vec3 rgb = vec3(stored);
    return layoutName == LODESTAR_RSRM_PUBLISHED ? rgb * stored.w : rgb * rgb * stored.w;
}

/// The share of the unfiltered gradient above the last row, 1 - cos(0.27 degrees)^(s - s1): at the
/// centre of a sun's disc of that radius the lobe's own answer (RSRM-8); energy is kept.
LODESTAR_FN Real lodestar_rsrmMirrorShare(Real s, Real greatestExponent) {
    return s > greatestExponent
               ? 1.0f - exp2((greatestExponent - s) * LODESTAR_LITERAL(1.60186e-5))
               : Real(0.0f);
}

LODESTAR_END

#ifndef LODESTAR_HOST_CLASS
#define LODESTAR_RSRM_WANTED
#define LODESTAR_RSRM_BEGIN LODESTAR_BEGIN
#define LODESTAR_RSRM_END LODESTAR_END
#endif
#endif

#ifdef LODESTAR_HOST_CLASS
#define LODESTAR_RSRM_WANTED
#define LODESTAR_RSRM_BEGIN
#define LODESTAR_RSRM_END
#endif

#ifdef LODESTAR_RSRM_WANTED
LODESTAR_RSRM_BEGIN

#ifndef LODESTAR_HOST_CLASS
vec4 lodestar_host_rsrm(Real column, Real row, int layer);
#endif

/// The unfiltered gradient in a direction: what a mirror and the backdrop show.
/// @param r unit
LODESTAR_FN vec3 lodestar_rsrmGradient(LodestarRsrm map, vec3 r) {
    Real column = lodestar_rsrmRefinedColumn(lodestar_rsrmHalfChord(r, map.axis)) * (map.columns - 1.0f);
    return lodestar_rsrmDecode(lodestar_host_rsrm(column, map.rows, map.layer), LODESTAR_RSRM_REFINED);
}

/// Mean radiance of a map over the Phong lobe about a direction: the glossy term's for a reflection,
/// Lambert's (over pi) for a normal and exponent 1.
/// @param r unit  @param exponent [0, 1e7], +infinity a mirror; below the first row its own answer
LODESTAR_FN vec3 lodestar_rsrm(LodestarRsrm map, vec3 r, Real exponent) {
    Real s = lodestar_repairExponent(exponent);
    Real column = lodestar_rsrmColumn(map.layoutName, lodestar_rsrmHalfChord(r, map.axis), map.columns);
    Real shift = map.layoutName == LODESTAR_RSRM_PUBLISHED ? Real(0.0f) : Real(1.0f);
    Real row = lodestar_rsrmRow(s, map.rows, map.leastExponent, map.greatestExponent, shift);
    vec3 filtered = lodestar_rsrmDecode(lodestar_host_rsrm(column, row, map.layer), map.layoutName);
    Real share = lodestar_rsrmMirrorShare(s, map.greatestExponent);
    if (map.layoutName == LODESTAR_RSRM_PUBLISHED || share <= 0.0f) {
        return filtered;
    }
    return mix(filtered, lodestar_rsrmGradient(map, r), share);
}

LODESTAR_RSRM_END
#endif
#undef LODESTAR_RSRM_WANTED
#undef LODESTAR_RSRM_BEGIN
#undef LODESTAR_RSRM_END

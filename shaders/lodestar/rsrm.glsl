// SPDX-License-Identifier: MIT
//
// Reading radially symmetric reflection maps: filtered light of a sky or a sun as a table over the
// angle to its axis (columns) and the Phong exponent (rows), its mean over Lambert's lobe as a line
// over the cosine, and the gradient that both were made of. A host fetches by three hooks:
//   vec4 lodestar_host_rsrm(column, row, layer)
//     column [0, columns - 1] and row [0, rows - 1] count texels from the centre of the first, the
//     fraction interpolates: a texture coordinate is (column + 0.5) / columns. Answers rgb as stored
//     and in alpha the map's scale (1 where the layout has none).
//   vec3 lodestar_host_rsrmLambert(u, layer)
//     radiance where u = (1 - cosine) / 2 in [0, 1] but for rounding: both ends lie on texel centres in the refined
//     layout, on texel edges in the published ones.
//   vec3 lodestar_host_rsrmGradient(u2, layer)
//     unfiltered radiance at u2 in [0, 1], both ends on texel centres, in every layout.
//   vec4 lodestar_host_rsrmOctaves(index), with LODESTAR_RSRM_ROWS
//     log2(s + 1) of the rows 4 index to 4 index + 3; index in [0, 5], only rows that there are are read.
//
// Feature macros: LODESTAR_RSRM_MIRROR 0 leaves the gradient out of lodestar_rsrm, for surfaces whose
// exponents lie within the map's rows (default 1). LODESTAR_RSRM_ROWS 1 has lodestar_rsrmOwnRow, for
// refined maps whose rows' exponents were given one by one (default 0).
//
// Source: Stone, radially symmetric reflection maps; storage and errors: docs/derivations/rsrm.md.
//
// A C++ host includes this file inside its class, after defining LODESTAR_HOST_CLASS.
#ifndef LODESTAR_RSRM_GLSL
#define LODESTAR_RSRM_GLSL
#include "dual.glsl"
#include "power.glsl"

#ifndef LODESTAR_RSRM_MIRROR
#define LODESTAR_RSRM_MIRROR 1
#endif
#ifndef LODESTAR_RSRM_ROWS
#define LODESTAR_RSRM_ROWS 0
#endif

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
    Real firstOctave;    ///< log2 of the first row's exponent, of that + 1 in the refined layout
    Real rowsPerOctave;  ///< (rows - 1) over the octaves from the first row to the last
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

/// Radiance of what the hook answered: refined maps store square roots, interpolated, then squared.
LODESTAR_FN vec3 lodestar_rsrmDecode(vec4 stored, int layoutName) {
    vec3 rgb = vec3(stored);
    return layoutName == LODESTAR_RSRM_PUBLISHED ? rgb * stored.w : rgb * rgb;
}

/// The share of the unfiltered gradient above the last row, 1 - cos(0.27 degrees)^(s - s1): at the
/// centre of a sun's disc of that radius the lobe's own answer (RSRM-8); energy is kept.
LODESTAR_FN Real lodestar_rsrmMirrorShare(Real s, Real greatestExponent) {
    return s > greatestExponent
               ? 1.0f - exp2((greatestExponent - s) * LODESTAR_LITERAL(1.60186e-5))
               : Real(0.0f);
}

/// The row of an exponent in texels from the centre of the first, [0, rows]: rows are uniform in
/// log2(s), in log2(s + 1) in the refined layout (RSRM-7). There, between the last row, rows - 1,
/// and rows, the fraction is the share of the unfiltered gradient.
/// @param exponent [0, 1e7], +infinity a mirror; below the first row's its own
LODESTAR_FN Real lodestar_rsrmRow(LodestarRsrm map, Real exponent) {
    Real s = lodestar_repairExponent(exponent);
    Real clamped = clamp(s, map.leastExponent, map.greatestExponent);
    Real shift = map.layoutName == LODESTAR_RSRM_PUBLISHED ? Real(0.0f) : Real(1.0f);
    Real row = clamp((log2(clamped + shift) - map.firstOctave) * map.rowsPerOctave, Real(0.0f),
                     map.rows - 1.0f);
#if LODESTAR_RSRM_MIRROR
    if (map.layoutName != LODESTAR_RSRM_PUBLISHED) {
        row += lodestar_rsrmMirrorShare(s, map.greatestExponent);
    }
#endif
    return row;
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
vec3 lodestar_host_rsrmLambert(Real u, int layer);
vec3 lodestar_host_rsrmGradient(Real u2, int layer);
#if LODESTAR_RSRM_ROWS
vec4 lodestar_host_rsrmOctaves(int index);
#endif
#endif

#if LODESTAR_RSRM_ROWS
/// log2(s + 1) of a row. @param row [0, 23]
LODESTAR_FN Real lodestar_rsrmOctave(int row) {
    vec4 four = lodestar_host_rsrmOctaves(row / 4);
    return four[row % 4];
}

/// lodestar_rsrmRow of a refined map whose rows were given one by one, 24 at most: between two rows
/// linear in log2(s + 1) (RSRM-13).
LODESTAR_FN Real lodestar_rsrmOwnRow(LodestarRsrm map, Real exponent) {
    Real s = lodestar_repairExponent(exponent);
    Real octave = log2(clamp(s, map.leastExponent, map.greatestExponent) + 1.0f);
    int last = int(map.rows) - 1;
    int below = 0; // the last row but one whose octave is not above, found by halving
    for (int step = 16; step > 0; step /= 2) {
        int next = below + step;
        if (next < last && lodestar_rsrmOctave(next) <= octave) {
            below = next;
        }
    }
    Real low = lodestar_rsrmOctave(below);
    Real high = lodestar_rsrmOctave(below + 1);
    Real row = Real(below) + clamp((octave - low) / (high - low), Real(0.0f), Real(1.0f));
#if LODESTAR_RSRM_MIRROR
    row += lodestar_rsrmMirrorShare(s, map.greatestExponent);
#endif
    return row;
}
#endif

/// The unfiltered gradient in a direction: what a mirror and the backdrop show.
/// @param r unit
LODESTAR_FN vec3 lodestar_rsrmGradient(LodestarRsrm map, vec3 r) {
    return lodestar_host_rsrmGradient(lodestar_rsrmRefinedColumn(lodestar_rsrmHalfChord(r, map.axis)),
                                      map.layer);
}

/// Mean radiance of a map over Lambert's lobe about a normal: irradiance over pi.
/// @param n unit
LODESTAR_FN vec3 lodestar_rsrmLambert(LodestarRsrm map, vec3 n) {
    return lodestar_host_rsrmLambert(0.5f - 0.5f * dot(n, map.axis), map.layer);
}

/// Mean radiance of a map over a Phong lobe at an angle to its axis.
/// @param h sin of half that angle, [0, 1]  @param row lodestar_rsrmRow of the lobe's exponent
LODESTAR_FN vec3 lodestar_rsrmAt(LodestarRsrm map, Real h, Real row) {
    Real last = map.rows - 1.0f;
    Real column = lodestar_rsrmColumn(map.layoutName, h, map.columns);
    vec3 filtered =
        lodestar_rsrmDecode(lodestar_host_rsrm(column, min(row, last), map.layer), map.layoutName);
#if LODESTAR_RSRM_MIRROR
    if (row > last) {
        return lodestar_mix(
            filtered, lodestar_host_rsrmGradient(lodestar_rsrmRefinedColumn(h), map.layer), row - last);
    }
#endif
    return filtered;
}

/// The same over the Phong lobe about a direction: the glossy term's.
/// @param r unit  @param row lodestar_rsrmRow of the lobe's exponent: maps of one layout share it
LODESTAR_FN vec3 lodestar_rsrm(LodestarRsrm map, vec3 r, Real row) {
    return lodestar_rsrmAt(map, lodestar_rsrmHalfChord(r, map.axis), row);
}

LODESTAR_RSRM_END
#endif
#undef LODESTAR_RSRM_WANTED
#undef LODESTAR_RSRM_BEGIN
#undef LODESTAR_RSRM_END

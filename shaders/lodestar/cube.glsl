// SPDX-License-Identifier: MIT
//
// Cube maps: faces, levels, solid angles. Faces are in GL's order and orientation, drawn unfolded
// from inside the cube, each with its row 0 at the top:
//
//                 +----+
//                 | +Y |          face 0 +X   row 0 at +Y, columns run to -Z
//            +----+----+----+----+     1 -X   row 0 at +Y, columns run to +Z
//            | -X | +Z | +X | -Z |     2 +Y   row 0 at -Z, columns run to +X
//            +----+----+----+----+     3 -Y   row 0 at +Z, columns run to +X
//                 | -Y |               4 +Z   row 0 at +Y, columns run to +X
//                 +----+               5 -Z   row 0 at +Y, columns run to -X
//
// Source of the levels: McGuire et al. 2013, eq. 12 (MIP-1); Ashikhmin and Ghosh 2002; the level by
// texel size is our own (docs/derivations/mip.md).
#ifndef LODESTAR_CUBE_GLSL
#define LODESTAR_CUBE_GLSL
#include "dual.glsl"
#include "power.glsl"

LODESTAR_BEGIN

/// The direction (not unit) of face coordinates u (along columns) and v (down rows) in [-1, 1].
LODESTAR_FN vec3 lodestar_cubeDirection(int face, Real u, Real v) {
    if (face == 0) {
        return vec3(1.0f, -v, -u);
    }
    if (face == 1) {
        return vec3(-1.0f, -v, u);
    }
    if (face == 2) {
        return vec3(u, 1.0f, v);
    }
    if (face == 3) {
        return vec3(u, -1.0f, -v);
    }
    if (face == 4) {
        return vec3(u, -v, 1.0f);
    }
    return vec3(-u, -v, -1.0f);
}

/// The face that a direction meets, 0 to 5; ties go to x, then y. Inverse of lodestar_cubeDirection.
LODESTAR_FN int lodestar_cubeFace(vec3 d) {
    vec3 a = abs(d);
    if (a.x >= a.y && a.x >= a.z) {
        return d.x >= 0.0f ? 0 : 1;
    }
    if (a.y >= a.z) {
        return d.y >= 0.0f ? 2 : 3;
    }
    return d.z >= 0.0f ? 4 : 5;
}

/// The face coordinates (u, v) in [-1, 1] of a direction on its face; (0, 0) for the zero vector.
LODESTAR_FN vec2 lodestar_cubeCoordinates(vec3 d) {
    int face = lodestar_cubeFace(d);
    vec3 a = abs(d);
    Real m = max(max(a.x, a.y), a.z);
    vec3 p = m > 0.0f ? d / m : vec3(0.0f); // 1 / m would overflow for tiny m
    if (face == 0) {
        return vec2(-p.z, -p.y);
    }
    if (face == 1) {
        return vec2(p.z, -p.y);
    }
    if (face == 2) {
        return vec2(p.x, p.z);
    }
    if (face == 3) {
        return vec2(p.x, -p.z);
    }
    if (face == 4) {
        return vec2(p.x, -p.y);
    }
    return vec2(-p.x, -p.y);
}

/// The level whose texels subtend the solid angle of a cosine-power lobe, not clamped.
/// m = log2(w sqrt 3) - log2(s + 1) / 2  [McGuire13 eq. 12]
/// @param exponent [0, 1e7]  @param width face width of level 0 in texels, >= 1
LODESTAR_FN Real lodestar_mipLevelUnclamped(Real exponent, Real width) {
    return log2(width * LODESTAR_LITERAL(1.73205080756887729)) - 0.5f * log2(exponent + 1.0f);
}

/// The same, exponent repaired and clamped to the chain [0, maxLevel].
LODESTAR_FN Real lodestar_mipLevel(Real exponent, Real width, Real maxLevel) {
    return clamp(lodestar_mipLevelUnclamped(lodestar_repairExponent(exponent), width), Real(0.0f),
                 maxLevel);
}

/// The level at which one texel covers one pixel of a lookup along d, given d's derivatives over
/// the screen. The exact chain rule of the face projection; the driver's own query is not used
/// because some drivers answer it wrongly for cubes.
/// @param d the lookup, any length  @param dx, dy its screen derivatives
/// @return level, not clamped; below -40 where the direction does not change; NaN for NaN input and
/// for the zero vector, which lodestar_raiseLevel drops
LODESTAR_FN Real lodestar_footprintLevel(vec3 d, vec3 dx, vec3 dy, Real width) {
    vec3 a = abs(d);
    vec3 axis = vec3(0.0f, 0.0f, 1.0f);
    if (a.x >= a.y && a.x >= a.z) {
        axis = vec3(1.0f, 0.0f, 0.0f);
    } else if (a.y >= a.z) {
        axis = vec3(0.0f, 1.0f, 0.0f);
    }
    Real k = dot(d, axis);
    vec3 px = (dx * k - d * dot(dx, axis)) * (1.0f / (k * k));
    vec3 py = (dy * k - d * dot(dy, axis)) * (1.0f / (k * k));
    Real span = max(dot(px, px), dot(py, py));
    // log2(0) is undefined in GLSL; a comparison keeps NaN where max() might not.
    span = span < LODESTAR_LITERAL(1e-30) ? LODESTAR_LITERAL(1e-30) : span;
    return log2(0.5f * width) + 0.5f * log2(span);
}

/// A level raised to a floor; a floor that is NaN or -infinity changes nothing.
LODESTAR_FN Real lodestar_raiseLevel(Real level, Real floorLevel, Real maxLevel) {
    return floorLevel > level ? min(floorLevel, maxLevel) : level;
}

/// Half of log2 of the mean texel's solid angle over that of the texels about d: texels at a face's
/// centre are larger than the mean, at a corner smaller, by (max |d_i| / |d|)^3.
/// q(d) = -1.5 log2(max |d_i| / |d|) - 0.467   (MIP-4; 0.467 is half of log2(6 / pi))
/// @param d any length but huge (squares must not overflow)  @return [-0.467, 0.722]; 0 for the zero
/// vector
LODESTAR_FN Real lodestar_texelSizeLevel(vec3 d) {
    vec3 a = abs(d);
    Real m = max(max(a.x, a.y), a.z);
    if (!(m > 0.0f)) {
        return 0.0f;
    }
    vec3 p = d / m; // the squares of a tiny vector would underflow
    return 0.75f * log2(dot(p, p)) - LODESTAR_LITERAL(0.467);
}

/// The level for one fetch from tent-filtered mips whose coarse levels are round (MIP-5). Narrow
/// lobes read tents: eq. 12 with the bias that fits them, following the texel's size. Wide ones
/// read the levels of 16 texels and below, half a level finer: these are means over lobes, which
/// allow for the size of each texel themselves. Between 32 and 16 texels, whose lobes are further apart
/// than a level, the level moves more slowly.
/// @param d lookup direction, unit  @param exponent [0, 1e7]
LODESTAR_FN Real lodestar_tentLevel(vec3 d, Real exponent, Real width, Real maxLevel) {
    Real s = lodestar_repairExponent(exponent);
    Real size = lodestar_texelSizeLevel(d);
    // By how much the tents' level lies beyond that of 32 texels: 5 + log2(3) / 2 - 0.65.
    Real beyond = LODESTAR_LITERAL(5.1425) + size - 0.5f * log2(s + 1.0f);
    Real lowered = max(max(LODESTAR_LITERAL(0.35) * beyond, beyond - 1.0f), Real(0.0f));
    Real bias = size - LODESTAR_LITERAL(0.65) - lowered;
    Real level = lodestar_mipLevelUnclamped(s, width) + max(bias, LODESTAR_LITERAL(-1.15));
    return clamp(level, Real(0.0f), maxLevel);
}

/// The Phong exponent of the lobe that a prefiltered level is read for: s + 1 is 3/16 of the square of
/// its faces' width, so that the lobe's spread is that of 8/3 texels of the mean size, and 1 at least
/// (PRE-1).
/// @param level >= 1; level 0 is the map itself  @param width of level 0, >= 1
LODESTAR_FN Real lodestar_prefilteredExponent(Real level, Real width) {
    Real n = width * exp2(-level);
    return max(LODESTAR_LITERAL(0.1875) * n * n, Real(1.0f)) - 1.0f;
}

/// The level for one fetch from prefiltered mips. Between two levels that hold lobes of spreads a and
/// b = r a, one of spread v = q a is nearest, in the mean square, at the fraction
/// f = r (q - 1) (q + r + 2) / ((r - 1) (q + r) (q + 1)) (PRE-4); level 0 is read for a spread of a
/// sixth of a texel's area.
/// @param exponent [0, 1e7]
LODESTAR_FN Real lodestar_prefilteredLevel(Real exponent, Real width, Real maxLevel) {
    Real s = lodestar_repairExponent(exponent);
    // 0.5 log2(3/16): the level whose own lobe this is.
    Real own = log2(width) - LODESTAR_LITERAL(1.2075187496) - 0.5f * log2(s + 1.0f);
    Real below = clamp(floor(own), Real(0.0f), max(maxLevel - 1.0f, Real(0.0f)));
    Real fine = below > 0.0f ? 1.0f / (lodestar_prefilteredExponent(below, width) + 2.0f)
                             : LODESTAR_LITERAL(0.66666667) / (width * width);
    Real r = 1.0f / ((lodestar_prefilteredExponent(below + 1.0f, width) + 2.0f) * fine);
    Real q = clamp(1.0f / ((s + 2.0f) * fine), Real(1.0f), max(r, Real(1.0f)));
    if (!(r > 1.0f)) {
        return below;
    }
    Real fraction = r * (q - 1.0f) * (q + r + 2.0f) / ((r - 1.0f) * (q + r) * (q + 1.0f));
    return clamp(below + fraction, Real(0.0f), maxLevel);
}

/// The least level of `bias` for one vertex: the object's, sharpened towards grazing angles, where
/// the Blinn-Phong lobe about the reflection covers n.v times the solid angle it covers at n = v
/// (a lobe of the half vector is 4 h.v times larger about the reflection; MIP-8). Ashikhmin and
/// Ghosh 2002 ask for a level a vertex for this purpose and leave the law open.
/// @param leastLevel the object's level, >= 0  @param nDotV [0, 1]
LODESTAR_FN Real lodestar_biasLevelAtVertex(Real leastLevel, Real nDotV) {
    return max(leastLevel + 0.5f * log2(clamp(nDotV, LODESTAR_LITERAL(1e-6), Real(1.0f))), Real(0.0f));
}

/// The solid angle of one texel: its area on the cube times the cosine over the squared distance,
/// (2 / w)^2 (1 + u^2 + v^2)^(-3/2) at its centre. The exact difference of atan(xy / sqrt(1 + x^2 +
/// y^2)) over the corners loses its digits in float.
/// @param width face width >= 1  @param i, j texel column and row
/// @return solid angle in steradians by the midpoint rule, exact as width grows: 4 % at 2 texels,
/// 3e-6 at 256. The CPU's tables use the exact difference in double.
LODESTAR_FN Real lodestar_texelSolidAngle(Real width, Real i, Real j) {
    Real u = (2.0f * i + 1.0f) / width - 1.0f;
    Real v = (2.0f * j + 1.0f) / width - 1.0f;
    Real r = inversesqrt(1.0f + u * u + v * v);
    return 4.0f / (width * width) * r * r * r;
}

/// Solid angle of a small square about face coordinates over its area: (1 + u^2 + v^2)^(-3/2) on the
/// face, beyond its edges that of the neighbouring face there.
LODESTAR_FN Real lodestar_texelDensity(Real u, Real v) {
    Real m = max(max(abs(u), abs(v)), Real(1.0f));
    Real r = m * inversesqrt(1.0f + u * u + v * v);
    return r * r * r;
}

/// Solid angle of a texel over its area: that at Gauss's two by two points, within 1e-3 at 2 texels.
LODESTAR_FN Real lodestar_meanTexelDensity(Real u, Real v, Real width) {
    Real reach = LODESTAR_LITERAL(0.57735027) / width;
    return LODESTAR_LITERAL(0.25) *
           (lodestar_texelDensity(u - reach, v - reach) + lodestar_texelDensity(u + reach, v - reach) +
            lodestar_texelDensity(u - reach, v + reach) + lodestar_texelDensity(u + reach, v + reach));
}

/// The exponent of the lobe whose mean a texel of a round coarse level holds, so that read
/// bilinearly it is the lobe wanted (MIP-12).
/// @param exponent Phong, >= 0, of the lobe that the level is read for
/// @param hat spread of the texel and of what it is read from, W (1/6 + 1/4 (n / n_read)^2)
LODESTAR_FN Real lodestar_roundExponent(Real exponent, Real hat) {
    Real spread = 1.0f / (exponent + 2.0f) - LODESTAR_LITERAL(0.6) * hat;
    return spread > LODESTAR_LITERAL(1e-7) ? max(1.0f / spread - 2.0f, Real(0.0f)) : LODESTAR_LITERAL(1e7);
}

/// A direction on the octahedron |x| + |y| + |z| = 1 laid flat: +Y in the middle, -Y at the corners.
/// @param d unit  @return [-1, 1]^2
LODESTAR_FN vec2 lodestar_octahedral(vec3 d) {
    Real sum = abs(d.x) + abs(d.y) + abs(d.z);
    Real scale = 1.0f / max(sum, LODESTAR_LITERAL(1e-30));
    Real x = d.x * scale;
    Real z = d.z * scale;
    if (d.y < 0.0f) {
        Real folded = (1.0f - abs(z)) * (x < 0.0f ? -1.0f : 1.0f);
        z = (1.0f - abs(x)) * (z < 0.0f ? -1.0f : 1.0f);
        x = folded;
    }
    return vec2(x, z);
}

/// The direction, not unit, of a point of that square.
LODESTAR_FN vec3 lodestar_octahedralDirection(vec2 p) {
    Real x = p.x;
    Real z = p.y;
    Real y = 1.0f - abs(x) - abs(z);
    if (y < 0.0f) {
        Real folded = (1.0f - abs(z)) * (x < 0.0f ? -1.0f : 1.0f);
        z = (1.0f - abs(x)) * (z < 0.0f ? -1.0f : 1.0f);
        x = folded;
    }
    return vec3(x, y, z);
}

/// Texels of a side of a tile that holds a light probe's irradiance; odd, so that the octahedron's
/// folds along the square's middles lie on texel centres, as its sides do: a bilinear fetch across
/// them misses nothing.
LODESTAR_CONST Real LODESTAR_TILE_TEXELS = LODESTAR_LITERAL(25.0);

/// Where a normal lies in such a tile, in texels from its corner: between texel centres of the tile,
/// and so far within them (1/400 of a texel) that rounding does not read the next tile's.
LODESTAR_FN vec2 lodestar_irradianceTexel(vec3 normal) {
    vec2 p = lodestar_octahedral(normal);
    Real reach = LODESTAR_LITERAL(0.9998);
    Real pitches = LODESTAR_TILE_TEXELS - 1.0f;
    return vec2((clamp(p.x, -reach, reach) * 0.5f + 0.5f) * pitches + 0.5f,
                (clamp(p.y, -reach, reach) * 0.5f + 0.5f) * pitches + 0.5f);
}

LODESTAR_END

#endif

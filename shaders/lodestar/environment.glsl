// SPDX-License-Identifier: MIT
//
// The one entry point: light of an environment reflected towards the viewer. The text fetches
// nothing itself; it calls hooks that a host defines over its own bindings:
//   lodestar_host_cube        radiance of slot's cube map along a direction at a level
//   lodestar_host_irradiance  irradiance over pi of slot's environment about a normal
// Both answer radiance: 1 everywhere under a constant environment of radiance 1.
//
// Feature macros (defaults in shaders/README.md):
//   LODESTAR_SPECULAR  which estimator the glossy term uses, one of LODESTAR_SPECULAR_*
//   LODESTAR_TAPS      LODESTAR_SPECULAR_TAPS only: how many taps, 1 to 1024
//   LODESTAR_FRESNEL   which form Fresnel's reflectance takes, one of LODESTAR_FRESNEL_*
//
// A C++ host includes this file inside its class, after defining LODESTAR_HOST_CLASS, and its
// member functions are the hooks: no global state, and the whole evaluation runs on the CPU.
#ifndef LODESTAR_HOST_CLASS
#ifndef LODESTAR_ENVIRONMENT_GLSL
#define LODESTAR_ENVIRONMENT_GLSL
#define LODESTAR_ENVIRONMENT_WANTED
#include "cube.glsl"
#include "dual.glsl"
#include "lobes.glsl"
#include "taps.glsl"
#define LODESTAR_HOST_BEGIN LODESTAR_BEGIN
#define LODESTAR_HOST_END LODESTAR_END
#endif
#else
#define LODESTAR_ENVIRONMENT_WANTED
#define LODESTAR_HOST_BEGIN
#define LODESTAR_HOST_END
#endif

#ifndef LODESTAR_SPECULAR_MIP
#define LODESTAR_SPECULAR_MIP 0
#define LODESTAR_SPECULAR_MIP_FLOOR 1
#define LODESTAR_SPECULAR_BIAS 2
#define LODESTAR_SPECULAR_TENT 3
#define LODESTAR_SPECULAR_RING3 4
#define LODESTAR_SPECULAR_RING7 5
#define LODESTAR_SPECULAR_TAPS 6
#define LODESTAR_SPECULAR_PREFILTERED 7
#endif
#ifndef LODESTAR_TAPS
#define LODESTAR_TAPS 16
#endif
#ifndef LODESTAR_SPECULAR
#define LODESTAR_SPECULAR LODESTAR_SPECULAR_TENT
#endif

#ifdef LODESTAR_ENVIRONMENT_WANTED
#undef LODESTAR_ENVIRONMENT_WANTED
LODESTAR_HOST_BEGIN

#ifndef LODESTAR_HOST_CLASS
vec4 lodestar_host_cube(int slot, vec3 direction, Real level);
vec3 lodestar_host_irradiance(int slot, vec3 normal);
#endif

/// What an environment lookup needs to know of a cube map.
struct LodestarCube {
    int slot;       ///< which cube the hooks fetch
    Real width;     ///< face width of level 0, texels
    Real maxLevel;  ///< last level of the chain
    Real leastLevel; ///< `bias` only: the object's or the vertex's least level, >= 0
};

/// A point being shaded. Vectors are unit, in the environment's frame.
struct LodestarSurface {
    vec3 normal;
    vec3 view;       ///< towards the viewer
    vec3 diffuse;    ///< k_L, reflectance [0, 1]
    vec3 f0;         ///< reflectance at normal incidence [0, 1]
    Real exponent;   ///< Blinn-Phong, [0, 1e7]
    Real occlusion;  ///< ambient occlusion, 1 open
};

/// The lookup that a Blinn-Phong lobe asks of an environment: a direction between the normal (at
/// exponent 0 the lobe is Lambert's) and the reflection, and a Phong exponent about it.
struct LodestarLookup {
    vec3 direction;
    Real exponent;
};

LODESTAR_FN LodestarLookup lodestar_lookup(vec3 n, vec3 v, Real exponent) {
    LodestarLookup lookup;
    Real nDotV = clamp(dot(n, v), Real(0.0f), Real(1.0f));
    vec3 r = 2.0f * dot(n, v) * n - v;
    lookup.direction = lodestar_safeNormalize(mix(n, r, lodestar_lookupBlend(exponent, nDotV)), n);
    lookup.exponent = lodestar_lookupExponent(exponent, nDotV);
    return lookup;
}

/// The lookup that published methods ask for: about the reflection, the exponent as given.
LODESTAR_FN LodestarLookup lodestar_lookupAsGiven(vec3 n, vec3 v, Real exponent) {
    LodestarLookup lookup;
    lookup.direction = 2.0f * dot(n, v) * n - v;
    lookup.exponent = exponent;
    return lookup;
}

/// Radiance towards the viewer of light whose means over Lambert's and the glossy lobe are known:
/// k_L (1 - F) lambert ao + F glossy ao_s, F at n.v, attenuated by roughness, by LODESTAR_FRESNEL.
LODESTAR_FN vec3 lodestar_reflected(LodestarSurface surface, vec3 lambert, vec3 glossy) {
    Real nDotV = clamp(dot(surface.normal, surface.view), Real(0.0f), Real(1.0f));
    vec3 fresnel = lodestar_fresnelEnvironmentBy(surface.f0, nDotV, surface.exponent, LODESTAR_FRESNEL);
    return surface.diffuse * (vec3(1.0f) - fresnel) * lambert * surface.occlusion +
           fresnel * glossy * lodestar_specularOcclusion(surface.occlusion, surface.exponent);
}

/// Glossy radiance as the estimators publish it: about the reflection, the exponent as given.
LODESTAR_FN vec3 lodestar_specularMip(LodestarCube cube, vec3 r, Real exponent) {
    return vec3(lodestar_host_cube(cube.slot, r, lodestar_mipLevel(exponent, cube.width, cube.maxLevel)));
}

/// `mip` with the level raised to the pixel's footprint.
LODESTAR_FN vec3 lodestar_specularMipFloor(LodestarCube cube, vec3 r, Real exponent, Real footprint) {
    Real level = lodestar_mipLevel(exponent, cube.width, cube.maxLevel);
    return vec3(lodestar_host_cube(cube.slot, r, lodestar_raiseLevel(level, footprint, cube.maxLevel)));
}

/// Ashikhmin and Ghosh: the pixel's own level, raised to the object's (or vertex's) least level.
LODESTAR_FN vec3 lodestar_specularBias(LodestarCube cube, vec3 r, Real footprint) {
    Real level = lodestar_raiseLevel(min(cube.leastLevel, cube.maxLevel), footprint, cube.maxLevel);
    return vec3(lodestar_host_cube(cube.slot, r, level));
}

/// One fetch from tent mips for a Phong lobe about a direction, level by lodestar_tentLevel, raised
/// to the pixel's footprint so that sharp reflections do not alias.
LODESTAR_FN vec3 lodestar_specularTent(LodestarCube cube, vec3 direction, Real exponent,
                                       Real footprint) {
    Real level = lodestar_tentLevel(direction, exponent, cube.width, cube.maxLevel);
    level = lodestar_raiseLevel(level, footprint, cube.maxLevel);
    return vec3(lodestar_host_cube(cube.slot, direction, level));
}

/// One tap of a Phong lobe from tent mips.
/// @param tap direction, unit, and the exponent of its own lobe
LODESTAR_FN vec3 lodestar_specularTap(LodestarCube cube, vec4 tap, Real footprint) {
    return lodestar_specularTent(cube, vec3(tap), tap.w, footprint);
}

/// A ring of taps on tent mips for a Phong lobe about a direction.
/// @param direction unit  @param count 2, 3, or 7: six about the direction and the direction itself
LODESTAR_FN vec3 lodestar_specularRing(LodestarCube cube, vec3 direction, Real exponent, Real footprint,
                                       int count) {
    LodestarTaps taps = lodestar_ring(count);
    Real s = lodestar_repairExponent(exponent);
    vec3 tangent = lodestar_tangent(direction);
    int around = count == 7 ? 6 : count;
    vec2 angle = count == 2 ? vec2(-1.0f, 0.0f)
                            : vec2(count == 7 ? 0.5f : -0.5f, LODESTAR_LITERAL(0.86602540378443865));
    vec2 turn = vec2(1.0f, 0.0f);
    vec3 sum = vec3(0.0f);
    for (int i = 0; i < around; ++i) {
        sum += lodestar_specularTap(cube, lodestar_lobeTap(direction, tangent, turn, s, -1.0f, taps), footprint);
        turn = lodestar_turned(turn, angle);
    }
    sum *= 1.0f / Real(around);
    if (count == 7) {
        vec3 centre =
            lodestar_specularTap(cube, lodestar_lobeTap(direction, tangent, turn, s, 0.0f, taps), footprint);
        sum = mix(sum, centre, LODESTAR_RING_CENTRE);
    }
    return sum;
}

/// A spiral of taps on tent mips for a Phong lobe about a direction: importance sampling, each sample
/// filtered over its share. Fewer than four, whose middle would lie beside the axis, are a ring or the
/// axis itself.
/// @param direction unit  @param count >= 1
LODESTAR_FN vec3 lodestar_specularTaps(LodestarCube cube, vec3 direction, Real exponent, Real footprint,
                                       int count) {
    if (count < 4) {
        return count > 1 ? lodestar_specularRing(cube, direction, exponent, footprint, count)
                         : lodestar_specularTent(cube, direction, exponent, footprint);
    }
    LodestarTaps taps = lodestar_spiral(Real(count));
    Real s = lodestar_repairExponent(exponent);
    vec3 tangent = lodestar_tangent(direction);
    vec2 goldenAngle = vec2(LODESTAR_LITERAL(-0.73736887807831970), LODESTAR_LITERAL(0.67549029426152380));
    vec2 turn = vec2(1.0f, 0.0f);
    vec3 sum = vec3(0.0f);
    for (int i = 0; i < count; ++i) {
        Real logShare = log2((Real(i) + 0.5f) / Real(count));
        sum += lodestar_specularTap(cube, lodestar_lobeTap(direction, tangent, turn, s, logShare, taps), footprint);
        turn = lodestar_turned(turn, goldenAngle);
    }
    return sum * (1.0f / Real(count));
}

/// One fetch from prefiltered mips for a Phong lobe about a direction, raised to the pixel's footprint.
LODESTAR_FN vec3 lodestar_specularPrefiltered(LodestarCube cube, vec3 direction, Real exponent,
                                              Real footprint) {
    Real level = lodestar_prefilteredLevel(exponent, cube.width, cube.maxLevel);
    level = lodestar_raiseLevel(level, footprint, cube.maxLevel);
    return vec3(lodestar_host_cube(cube.slot, direction, level));
}

/// Radiance over a Phong lobe about a direction from tent mips, by as many taps as LODESTAR_SPECULAR
/// says; by one where it reads other mips.
LODESTAR_FN vec3 lodestar_specularOfTents(LodestarCube cube, vec3 direction, Real exponent,
                                          Real footprint) {
#if LODESTAR_SPECULAR == LODESTAR_SPECULAR_RING3
    return lodestar_specularRing(cube, direction, exponent, footprint, 3);
#elif LODESTAR_SPECULAR == LODESTAR_SPECULAR_RING7
    return lodestar_specularRing(cube, direction, exponent, footprint, 7);
#elif LODESTAR_SPECULAR == LODESTAR_SPECULAR_TAPS
    return lodestar_specularTaps(cube, direction, exponent, footprint, LODESTAR_TAPS);
#else
    return lodestar_specularTent(cube, direction, exponent, footprint);
#endif
}

/// The glossy term's radiance by the estimator LODESTAR_SPECULAR, before Fresnel.
/// @param reflectionDx, reflectionDy screen derivatives of the reflection vector (0 on the CPU)
LODESTAR_FN vec3 lodestar_specular(LodestarCube cube, LodestarSurface surface, vec3 reflectionDx,
                                   vec3 reflectionDy) {
    vec3 r = 2.0f * dot(surface.normal, surface.view) * surface.normal - surface.view;
#if LODESTAR_SPECULAR == LODESTAR_SPECULAR_MIP
    return lodestar_specularMip(cube, r, surface.exponent);
#else
    Real footprint = lodestar_footprintLevel(r, reflectionDx, reflectionDy, cube.width);
#if LODESTAR_SPECULAR == LODESTAR_SPECULAR_MIP_FLOOR
    return lodestar_specularMipFloor(cube, r, surface.exponent, footprint);
#elif LODESTAR_SPECULAR == LODESTAR_SPECULAR_BIAS
    return lodestar_specularBias(cube, r, footprint);
#else
    LodestarLookup lookup = lodestar_lookup(surface.normal, surface.view, surface.exponent);
#if LODESTAR_SPECULAR == LODESTAR_SPECULAR_PREFILTERED
    return lodestar_specularPrefiltered(cube, lookup.direction, lookup.exponent, footprint);
#else
    return lodestar_specularOfTents(cube, lookup.direction, lookup.exponent, footprint);
#endif
#endif
#endif
}

/// Radiance towards the viewer of an environment, by lodestar_reflected. A constant environment of
/// radiance 1 gives 1 for (k_L = 1, F0 = 0) and for F0 = 1, unoccluded.
LODESTAR_FN vec3 lodestar_environment(LodestarCube cube, LodestarSurface surface, vec3 reflectionDx,
                                      vec3 reflectionDy) {
    vec3 glossy = lodestar_specular(cube, surface, reflectionDx, reflectionDy);
    vec3 lambert = lodestar_host_irradiance(cube.slot, surface.normal);
#if LODESTAR_SPECULAR >= LODESTAR_SPECULAR_TENT
    // At exponent 0 the lobe is Lambert's, whose light is at hand already and better than any mip's.
    glossy = lodestar_mix(glossy, lambert,
                          max(1.0f - lodestar_repairExponent(surface.exponent), Real(0.0f)));
#endif
    return lodestar_reflected(surface, lambert, glossy);
}

LODESTAR_HOST_END
#endif
#undef LODESTAR_HOST_BEGIN
#undef LODESTAR_HOST_END

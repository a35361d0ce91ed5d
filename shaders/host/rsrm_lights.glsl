// SPDX-License-Identifier: MIT
//
// What a light's map answers for a surface's glossy lobe, as the built-in renderer asks it.
//   LODESTAR_SUNS  how many of the lights are suns: the first
#if LODESTAR_RSRM_LIGHTS

LodestarLookup rsrmLookup(LodestarSurface here) {
    return LODESTAR_RSRM_LAYOUT == LODESTAR_RSRM_PUBLISHED ? lodestar_lookupAsGiven(here.normal, here.view, here.exponent)
                                                           : lodestar_lookup(here.normal, here.view, here.exponent);
}

/// @param light its place: a constant once loops unroll, and so is what it is: a driver may take both sides of a branch
/// @param row rsrmRow of the lookup's exponent
vec3 rsrmGlossy(int light, LodestarSurface here, LodestarLookup lookup, float row) {
    LodestarRsrm map = rsrmLight(light);
    if (light >= LODESTAR_SUNS || LODESTAR_RSRM_LAYOUT == LODESTAR_RSRM_PUBLISHED) { // the latter as published
        return lodestar_rsrm(map, lookup.direction, row);
    }
    LodestarSunLookup sun = lodestar_sunLookup(here.normal, here.view, here.exponent, lookup.direction, lookup.exponent,
                                               map.axis, rsrmScale[light].y);
    return lodestar_rsrmAt(map, sun.halfChord, rsrmRow(sun.exponent));
}

#endif

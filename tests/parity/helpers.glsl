// SPDX-License-Identifier: MIT
//
// Dual text for the parity rows of lodestar/environment.glsl: hooks that are analytic functions of
// direction and level, and arguments from vectors. In C++ it lies inside the host's class, after the
// shading text.

/// Red and green say the direction, blue the level.
LODESTAR_FN vec4 lodestar_host_cube(int slot, vec3 direction, Real level) {
    return vec4(direction.x + 0.25f * direction.y, direction.z, level, Real(slot));
}

LODESTAR_FN vec3 lodestar_host_irradiance(int slot, vec3 normal) {
    return vec3(1.0f + 0.5f * normal.x, 1.0f + 0.5f * normal.y, 1.0f + Real(slot));
}

/// Width, last level, least level.
LODESTAR_FN LodestarCube parity_cube(vec4 p) {
    LodestarCube cube;
    cube.slot = 0;
    cube.width = p.x;
    cube.maxLevel = p.y;
    cube.leastLevel = p.z;
    return cube;
}

/// Normal and exponent, view and occlusion, k_L, F0.
LODESTAR_FN LodestarSurface parity_surface(vec4 normal, vec4 view, vec4 diffuse, vec4 f0) {
    LodestarSurface surface;
    surface.normal = vec3(normal);
    surface.view = vec3(view);
    surface.diffuse = vec3(diffuse);
    surface.f0 = vec3(f0);
    surface.exponent = normal.w;
    surface.occlusion = view.w;
    return surface;
}

LODESTAR_FN vec4 parity_lookup(vec3 n, vec3 v, Real exponent) {
    LodestarLookup lookup = lodestar_lookup(n, v, exponent);
    return vec4(lookup.direction, lookup.exponent);
}

LODESTAR_FN vec4 parity_lookupAsGiven(vec3 n, vec3 v, Real exponent) {
    LodestarLookup lookup = lodestar_lookupAsGiven(n, v, exponent);
    return vec4(lookup.direction, lookup.exponent);
}

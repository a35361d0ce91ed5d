// SPDX-License-Identifier: MIT
//
// Dual text for the parity rows of lodestar/rsrm.glsl: hooks that answer where they were asked, and a
// map from vectors. In C++ it lies inside the host's class, after the shading text.

LODESTAR_FN vec4 lodestar_host_rsrm(Real column, Real row, int layer) {
    return vec4(column, row, Real(layer), 1.0f);
}

LODESTAR_FN vec3 lodestar_host_rsrmLambert(Real u, int layer) {
    return vec3(u, 1.0f - u, Real(layer));
}

LODESTAR_FN vec3 lodestar_host_rsrmGradient(Real u2, int layer) {
    return vec3(100.0f * u2, 50.0f, Real(layer));
}

/// Rows ever farther apart, 1 + r / 4 + r^2 / 128: floats hold them exactly.
LODESTAR_FN vec4 lodestar_host_rsrmOctaves(int index) {
    vec4 row = vec4(Real(4.0f) * Real(index)) + vec4(0.0f, 1.0f, 2.0f, 3.0f);
    return vec4(1.0f) + Real(0.25f) * row + Real(0.0078125f) * row * row;
}

/// Axis and layout; columns, rows, least and greatest exponent; y: first octave, z: rows an octave.
LODESTAR_FN LodestarRsrm parity_rsrm(vec4 axis, vec4 size, vec4 octaves) {
    LodestarRsrm map;
    map.layer = 3;
    map.layoutName = int(axis.w);
    map.axis = vec3(axis);
    map.columns = size.x;
    map.rows = size.y;
    map.leastExponent = size.z;
    map.greatestExponent = size.w;
    map.firstOctave = octaves.y;
    map.rowsPerOctave = octaves.z;
    return map;
}

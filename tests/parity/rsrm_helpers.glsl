// SPDX-License-Identifier: MIT
//
// Dual text for the parity rows of lodestar/rsrm.glsl: a hook that answers where it was asked, and a
// map from vectors. In C++ it lies inside the host's class, after the shading text.

LODESTAR_FN vec4 lodestar_host_rsrm(Real column, Real row, int layer) {
    return vec4(column, row, Real(layer), 1.0f);
}

/// Axis and layout; columns, rows, least and greatest exponent.
LODESTAR_FN LodestarRsrm parity_rsrm(vec4 axis, vec4 size) {
    LodestarRsrm map;
    map.layer = 3;
    map.layoutName = int(axis.w);
    map.axis = vec3(axis);
    map.columns = size.x;
    map.rows = size.y;
    map.leastExponent = size.z;
    map.greatestExponent = size.w;
    return map;
}

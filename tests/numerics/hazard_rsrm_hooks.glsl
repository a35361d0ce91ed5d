// SPDX-License-Identifier: MIT
//
// Dual text: the same for maps. In C++ it lies inside the host's class.

LODESTAR_FN vec4 lodestar_host_rsrm(Real column, Real row, int layer) {
    return vec4(10000.0f);
}

LODESTAR_FN vec3 lodestar_host_rsrmLambert(Real place, int layer) {
    return vec3(1.0f);
}

LODESTAR_FN vec3 lodestar_host_rsrmGradient(Real place, int layer) {
    return vec3(1.0f);
}

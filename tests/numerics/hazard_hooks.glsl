// SPDX-License-Identifier: MIT
//
// Dual text: the hooks that the rows of hazards call. In C++ it lies inside the host's class.

LODESTAR_FN vec4 lodestar_host_cube(int slot, vec3 direction, Real level) {
    return slot == 0 ? vec4(100000000.0f) : vec4(level);
}

LODESTAR_FN vec3 lodestar_host_irradiance(int slot, vec3 normal) {
    return vec3(1.0f);
}

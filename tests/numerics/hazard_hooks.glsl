// SPDX-License-Identifier: MIT
//
// Dual text: the hooks that the rows of hazards call. In C++ it lies inside the host's class.

LODESTAR_FN vec4 lodestar_host_cube(int slot, vec3 direction, Real level) {
    return slot == 0 ? vec4(100000000.0f) : vec4(level);
}

LODESTAR_FN vec3 lodestar_host_irradiance(int slot, vec3 normal) {
    return vec3(1.0f);
}

/// The sum of a normalised Phong lobe over the whole sphere, by the midpoint rule in its cosine.
LODESTAR_FN Real lodestar_lobeSum(Real exponent) {
    Real sum = 0.0f;
    for (int i = 0; i < 512; ++i) {
        Real cosine = 1.0f - (Real(i) + 0.5f) / 256.0f;
        sum += lodestar_cosinePower(cosine, exponent);
    }
    return sum * lodestar_phongNormaliser(exponent) * (2.0f * LODESTAR_PI / 256.0f);
}

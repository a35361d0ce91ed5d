// SPDX-License-Identifier: MIT
//
// One face's directions as each other's.

/// A direction along a face's columns, down its rows and out of it, in the cube's frame.
vec3 turned(int face, vec3 d) {
    if (face == 0) {
        return vec3(d.z, -d.y, -d.x);
    }
    if (face == 1) {
        return vec3(-d.z, -d.y, d.x);
    }
    if (face == 2) {
        return vec3(d.x, d.z, d.y);
    }
    if (face == 3) {
        return vec3(d.x, -d.z, -d.y);
    }
    if (face == 4) {
        return vec3(d.x, -d.y, d.z);
    }
    return vec3(-d.x, -d.y, -d.z);
}

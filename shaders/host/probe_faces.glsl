// SPDX-License-Identifier: MIT
//
// The six faces of a level as the six colours of one draw.
layout(location = 0) out vec4 oFaces[6];

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

void writeFaces(vec4 a, vec4 b, vec4 c, vec4 d, vec4 e, vec4 f) {
    oFaces[0] = a;
    oFaces[1] = b;
    oFaces[2] = c;
    oFaces[3] = d;
    oFaces[4] = e;
    oFaces[5] = f;
}

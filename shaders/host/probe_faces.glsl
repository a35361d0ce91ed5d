// SPDX-License-Identifier: MIT
//
// The six faces of a level as the six colours of one draw.
#include "host/probe_turned.glsl"

layout(location = 0) out vec4 oFaces[6];

void writeFaces(vec4 a, vec4 b, vec4 c, vec4 d, vec4 e, vec4 f) {
    oFaces[0] = a;
    oFaces[1] = b;
    oFaces[2] = c;
    oFaces[3] = d;
    oFaces[4] = e;
    oFaces[5] = f;
}

// SPDX-License-Identifier: MIT
//
// Sends each instance's triangle to the face of its number.
layout(triangles) in;
layout(triangle_strip, max_vertices = 3) out;

flat in int vInstance[];
flat out int vFace;

void main() {
    for (int i = 0; i < 3; ++i) {
        gl_Layer = vInstance[0];
        vFace = vInstance[0];
        gl_Position = gl_in[i].gl_Position;
        EmitVertex();
    }
    EndPrimitive();
}

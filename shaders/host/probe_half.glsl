// SPDX-License-Identifier: MIT
//
// Rounding to half floats: OpenGL leaves it to the driver, and one that cuts off loses half a step in
// every pass.
uniform uint uHalfStep; // half a step of a half float in bits of a float, where the driver cuts off; else 0

/// A value that becomes the nearest half float where it is stored. @param v at least 0
vec4 nearestHalf(vec4 v) {
    return uintBitsToFloat(floatBitsToUint(v) + uvec4(uHalfStep));
}

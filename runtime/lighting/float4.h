// SPDX-License-Identifier: MIT
//
// Four and eight floats in a register: the types of the inner loops. A GCC and Clang vector type;
// loads and stores go through pointers to texels (glm::vec4), which it may alias.
#pragma once

#include <glm/vec4.hpp>

namespace lodestar::lighting {

typedef float Float4 __attribute__((vector_size(16), aligned(4), may_alias));
typedef float Float8 __attribute__((vector_size(32), aligned(4), may_alias)); ///< two texels

[[nodiscard]] inline const Float4* asFloat4(const glm::vec4* texels) {
    return reinterpret_cast<const Float4*>(texels);
}
[[nodiscard]] inline Float4* asFloat4(glm::vec4* texels) {
    return reinterpret_cast<Float4*>(texels);
}
[[nodiscard]] inline const Float8* asFloat8(const glm::vec4* texels) {
    return reinterpret_cast<const Float8*>(texels);
}

} // namespace lodestar::lighting

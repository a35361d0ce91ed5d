// SPDX-License-Identifier: MIT
//
// The macros that let one text be GLSL (3.30 core and ES 3.00 upward) and C++20 (through GLM).
//
// Rules of the language, for every file in this folder:
//  - functions, structs and constants only: no version, main, in/out, uniform, sampler or binding;
//  - the body lies between LODESTAR_BEGIN and LODESTAR_END, and every function starts with LODESTAR_FN;
//  - a literal that float holds exactly takes the suffix f (0.5f, 3.0f); any other is written
//    LODESTAR_LITERAL(0.65), so that the double-precision compilation gets all its digits;
//  - no swizzle is written to, no array is passed by reference, outputs are LODESTAR_OUT(type).
//
// In C++ the text lands in lodestar::shader (float). A translation unit that defines
// LODESTAR_DOUBLE_PRECISION before its first include gets lodestar::shader_double instead: the same
// statements in double, which is how rounding error is told from method error.
#ifndef LODESTAR_DUAL_GLSL
#define LODESTAR_DUAL_GLSL

#ifdef __cplusplus

#include <cmath>
#include <glm/glm.hpp>

#ifdef LODESTAR_DOUBLE_PRECISION
#define LODESTAR_NAMESPACE shader_double
#else
#define LODESTAR_NAMESPACE shader
#endif

namespace lodestar::LODESTAR_NAMESPACE {
#ifdef LODESTAR_DOUBLE_PRECISION
using Real = double;
#else
using Real = float;
#endif
using vec2 = glm::vec<2, Real>;
using vec3 = glm::vec<3, Real>;
using vec4 = glm::vec<4, Real>;
using mat3 = glm::mat<3, 3, Real>;
using glm::abs;
using glm::clamp;
using glm::cos;
using glm::cross;
using glm::dot;
using glm::exp;
using glm::exp2;
using glm::floor;
using glm::inversesqrt;
using glm::log2;
using glm::max;
using glm::min;
using glm::mix;
using glm::normalize;
using glm::sin;
using glm::sqrt;
} // namespace lodestar::LODESTAR_NAMESPACE

#define LODESTAR_FN inline
#define LODESTAR_CONST constexpr
#define LODESTAR_OUT(type) type&
#define LODESTAR_LITERAL(x) Real(x)
#define LODESTAR_BEGIN namespace lodestar::LODESTAR_NAMESPACE {
#define LODESTAR_END }

#else

#define Real float
#define LODESTAR_FN
#define LODESTAR_CONST const
#define LODESTAR_OUT(type) out type
#define LODESTAR_LITERAL(x) x
#define LODESTAR_BEGIN
#define LODESTAR_END

#endif

LODESTAR_BEGIN

LODESTAR_CONST Real LODESTAR_PI = LODESTAR_LITERAL(3.14159265358979324);

LODESTAR_END

#endif

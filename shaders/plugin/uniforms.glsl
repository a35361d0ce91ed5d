// SPDX-License-Identifier: MIT
//
// What a frame's lighting asks of a host's uniforms, defined once: a std140 block with
// LODESTAR_UNIFORM_BLOCK, else plain uniforms of the same names, in C++ a struct. Only vec4 members:
// an array's data lies the same way in all three.
#ifndef LODESTAR_PLUGIN_UNIFORMS_GLSL
#define LODESTAR_PLUGIN_UNIFORMS_GLSL

#define LODESTAR_MAX_LIGHTS_SHOWN 32
#define LODESTAR_MAP_ROW_VECTORS 6

#ifdef __cplusplus
#include <glm/vec4.hpp>
namespace lodestar::plugin::blocks {
using glm::vec4;
#define LODESTAR_UNIFORM
struct LodestarLighting {
#elif defined(LODESTAR_UNIFORM_BLOCK)
#define LODESTAR_UNIFORM
layout(std140) uniform LodestarLighting {
#else
#define LODESTAR_UNIFORM uniform
#endif

/// Lights shown; 1 where there is an environment; how many of the lights are suns, the first ones; 0.
LODESTAR_UNIFORM vec4 lodestar_counts;
LODESTAR_UNIFORM vec4 lodestar_environmentCube; ///< face width, last level, 0, radiance scale
LODESTAR_UNIFORM vec4 lodestar_irradianceCube;  ///< the same of the irradiance cube
LODESTAR_UNIFORM vec4 lodestar_mapSize; ///< columns, rows, exponents of the first and the last row
LODESTAR_UNIFORM vec4 lodestar_mapRows; ///< first octave, rows an octave, columns of the two lines
LODESTAR_UNIFORM vec4 lodestar_axes[LODESTAR_MAX_LIGHTS_SHOWN]; ///< xyz unit, w layer
LODESTAR_UNIFORM vec4 lodestar_spreads[LODESTAR_MAX_LIGHTS_SHOWN / 4]; ///< how wide each is, four a vector
LODESTAR_UNIFORM vec4 lodestar_mapOctaves[LODESTAR_MAP_ROW_VECTORS]; ///< log2(s + 1) of the rows, four each

#ifdef __cplusplus
};
} // namespace lodestar::plugin::blocks
#elif defined(LODESTAR_UNIFORM_BLOCK)
};
#endif
#undef LODESTAR_UNIFORM

#endif

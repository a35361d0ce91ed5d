// SPDX-License-Identifier: MIT
//
// The built-in renderer's uniform blocks, defined once: std140 in GLSL, plain structs in C++.
// Only vec4 and mat4 members, so that both layouts are the same; a test asks the driver.
#ifndef LODESTAR_HOST_BLOCKS_GLSL
#define LODESTAR_HOST_BLOCKS_GLSL

#ifdef __cplusplus
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#define LODESTAR_BLOCK(name) struct name {
#define LODESTAR_BLOCK_END(name) };
#define LODESTAR_BLOCK_ARRAY_END(name, instances, count) };
namespace lodestar::scene::blocks {
using glm::mat4;
using glm::vec4;
#else
#define LODESTAR_BLOCK(name) layout(std140) uniform name {
#define LODESTAR_BLOCK_END(name) };
#define LODESTAR_BLOCK_ARRAY_END(name, instances, count) } instances[count];
#endif

#define LODESTAR_MAX_LIGHTS 16
#define LODESTAR_MAX_RSRM_LIGHTS 32
#define LODESTAR_MAX_SHADOWS 4
// Of four rows each, as many as a map may be given.
#define LODESTAR_ROW_VECTORS 6
// A light probe's tile has 25 texels of irradiance a side; two rows beneath it tell of suns.
#define LODESTAR_SUN_TEXELS 25
#define LODESTAR_SUN_ROWS 2
#define LODESTAR_MATERIAL_TEXTURES 8
// Texture units of a material, the k of uvRows.
#define LODESTAR_BASE_COLOR_UNIT 0
#define LODESTAR_METALLIC_ROUGHNESS_UNIT 1
#define LODESTAR_NORMAL_UNIT 2
#define LODESTAR_OCCLUSION_UNIT 3
#define LODESTAR_EMISSIVE_UNIT 4
#define LODESTAR_EXPONENT_UNIT 5
#define LODESTAR_SPECULAR_UNIT 6
#define LODESTAR_SPECULAR_COLOR_UNIT 7

LODESTAR_BLOCK(LodestarFrame)
    mat4 clipFromWorld;
    mat4 worldFromClip;
    vec4 cameraPosition;    ///< w: 1 perspective; 0 orthographic, then xyz points towards the viewer
    vec4 environmentCube;   ///< face width, last level, least level (bias), radiance scale
    vec4 irradianceCube;    ///< face width, last level, least level (bias), radiance scale
    vec4 sh9[9];            ///< irradiance over pi
    vec4 written;           ///< x: factor on radiance as it is written; y: greatest value written
    vec4 referenceTaps;     ///< of a pass of LODESTAR_REFERENCE: first, step, how many; taps in all
    vec4 lightCount;        ///< x: how many of the lights are used
    vec4 lightPosition[LODESTAR_MAX_LIGHTS];  ///< xyz position, w 1; or direction to the light, w 0
    vec4 lightColor[LODESTAR_MAX_LIGHTS];     ///< rgb irradiance or radiant intensity, w 1/range^2
    vec4 lightDirection[LODESTAR_MAX_LIGHTS]; ///< spot: unit, along which it shines
    vec4 lightCone[LODESTAR_MAX_LIGHTS];      ///< spot: x scale, y offset of the cosine
LODESTAR_BLOCK_END(LodestarFrame)

LODESTAR_BLOCK(LodestarRsrmLights)
    vec4 rsrmMap;  ///< of every map: columns, rows, exponents of the first and the last row
    vec4 rsrmTexel; ///< x, y: 1 / columns, 1 / rows
    vec4 rsrmRows; ///< first octave, rows an octave; texture coordinate of Lambert's u: z u + w
    vec4 rsrmAxis[LODESTAR_MAX_RSRM_LIGHTS]; ///< xyz unit, w layer of its maps; casters of shadows first
    vec4 rsrmShadow[LODESTAR_MAX_RSRM_LIGHTS]; ///< x: layer of its shadow map
    vec4 rsrmScale[LODESTAR_MAX_RSRM_LIGHTS];  ///< x: scale of its map; y: a sun's spread
    mat4 shadowFromWorld[LODESTAR_MAX_SHADOWS]; ///< to a layer's texture coordinates and depth
    vec4 shadowTexel[LODESTAR_MAX_SHADOWS];     ///< x: metres of one of its texels
    vec4 rsrmOctaves[LODESTAR_ROW_VECTORS]; ///< log2(s + 1) of the maps' rows where those were given one by one
LODESTAR_BLOCK_END(LodestarRsrmLights)

LODESTAR_BLOCK(LodestarMaterial)
    vec4 baseColor;
    vec4 emissive; ///< rgb, w normal-map scale
    vec4 surface;  ///< metallic, roughness, occlusion strength, alpha cutoff
    vec4 diffuse;  ///< k_L rgb, w Blinn-Phong exponent
    vec4 f0;       ///< F0 rgb, w scale of the exponent texture
    vec4 specular; ///< a dielectric's F0 by index and specular colour, rgb; w specularFactor
    vec4 more;     ///< x: 1 if the exponent texture holds log2(s + 1); without LODESTAR_BLINN_PHONG y, z, w: 1 if
                   ///< exponent, diffuse, F0 are given all the same
    /// By texture unit k: rows 2k and 2k + 1 are (a, b, c) of u' = a u + b v + c and of v'; w of row
    /// 2k is the UV set, 0 or 1. Without LODESTAR_TEXTURE_TRANSFORM only the set is read.
    vec4 uvRows[2 * LODESTAR_MATERIAL_TEXTURES];
LODESTAR_BLOCK_END(LodestarMaterial)

/// A light probe; all zero for none.
LODESTAR_BLOCK(LodestarProbe)
    vec4 influenceRows[3]; ///< of volumeFromWorld
    vec4 influenceExtents; ///< xyz half extents; w 1: a sphere
    vec4 influenceHigh;    ///< xyz blend at +X, +Y, +Z, metres; w 1: outside the faces
    vec4 influenceLow;     ///< the same at -X, -Y, -Z
    vec4 proxyRows[3];     ///< of volumeFromWorld
    vec4 proxyExtents;     ///< xyz half extents; w 1: a sphere, 0: a box, -1: there is no proxy
    vec4 capturedAt;       ///< xyz in the world; w face width
    vec4 light;            ///< rgb factor on what is fetched; w last level
    vec4 tile;             ///< xy first texel of its tile of irradiance; zw of its sky's
    vec4 sky;              ///< rgb factor on its sky's light; w 1 where that is kept apart
LODESTAR_BLOCK_ARRAY_END(LodestarProbe, uProbe, 2)

#ifdef __cplusplus
} // namespace lodestar::scene::blocks
#endif
#undef LODESTAR_BLOCK
#undef LODESTAR_BLOCK_ARRAY_END
#undef LODESTAR_BLOCK_END

#endif

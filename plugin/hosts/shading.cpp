// SPDX-License-Identifier: MIT
#include "hosts/shading.h"

#include <cstddef>

namespace lodestar::hosts {
namespace {

// The environment's own hooks are not asked for here.
constexpr const char* kHooks = R"(
vec4 lodestar_host_cube(int slot, vec3 direction, float level) { return vec4(0.0); }
vec3 lodestar_host_irradiance(int slot, vec3 normal) { return vec3(0.0); }
uniform sampler2DArray lodestar_maps;
uniform sampler2DArray lodestar_lamberts;
uniform sampler2DArray lodestar_gradients;
uniform int lodestar_count;
uniform vec4 lodestar_axes[32];   // w: layer
uniform vec4 lodestar_mapSize;    // columns, rows, exponents of the first and the last row
uniform vec4 lodestar_mapRows;    // first octave, rows an octave, columns of the two lines

vec4 lodestar_host_rsrm(float column, float row, int layer) {
    return vec4(textureLod(lodestar_maps, vec3((vec2(column, row) + 0.5) / lodestar_mapSize.xy, float(layer)), 0.0).rgb, 1.0);
}
vec3 lineAt(sampler2DArray lines, float at, float columns, int layer) {
    return textureLod(lines, vec3((at * (columns - 1.0) + 0.5) / columns, 0.5, float(layer)), 0.0).rgb;
}
vec3 lodestar_host_rsrmLambert(float u, int layer) {
    return lineAt(lodestar_lamberts, u, lodestar_mapRows.z, layer);
}
vec3 lodestar_host_rsrmGradient(float u2, int layer) {
    return lineAt(lodestar_gradients, u2, lodestar_mapRows.w, layer);
}

vec3 lodestar_lights(LodestarSurface here) {
    LodestarLookup lookup = lodestar_lookup(here.normal, here.view, here.exponent);
    vec3 lambert = vec3(0.0);
    vec3 glossy = vec3(0.0);
    for (int i = 0; i < lodestar_count; ++i) {
        LodestarRsrm map;
        map.layer = int(lodestar_axes[i].w);
        map.layoutName = LODESTAR_RSRM_REFINED;
        map.axis = lodestar_axes[i].xyz;
        map.columns = lodestar_mapSize.x;
        map.rows = lodestar_mapSize.y;
        map.leastExponent = lodestar_mapSize.z;
        map.greatestExponent = lodestar_mapSize.w;
        map.firstOctave = lodestar_mapRows.x;
        map.rowsPerOctave = lodestar_mapRows.y;
        lambert += lodestar_rsrmLambert(map, here.normal);
        glossy += lodestar_rsrm(map, lookup.direction, lodestar_rsrmRow(map, lookup.exponent));
    }
    return lodestar_reflected(here, lambert, glossy);
}
)";

std::string textOf(const LodestarApi& api, const char* file, std::int32_t profile) {
    LodestarDialect dialect{};
    dialect.struct_size = sizeof dialect;
    dialect.version = 330;
    dialect.profile = profile;
    dialect.without_version_line = 1;
    std::size_t size = 0;
    api.glsl_text(file, &dialect, nullptr, &size);
    std::string text(size, '\0');
    api.glsl_text(file, &dialect, text.data(), &size);
    text.resize(size > 0 ? size - 1 : 0);
    return text;
}

} // namespace

std::string shadingText(const LodestarApi& api, std::int32_t profile) {
    std::string text;
    for (const char* file :
         {"lodestar/environment.glsl", "lodestar/rsrm.glsl", "lodestar/display.glsl"}) {
        text += textOf(api, file, profile);
    }
    return text + kHooks;
}

MapUniforms mapUniforms(const LodestarMapLayout& layout) {
    return {.size = {static_cast<float>(layout.columns), static_cast<float>(layout.rows),
                     layout.least_exponent, layout.greatest_exponent},
            .rows = {layout.first_octave, layout.rows_per_octave,
                     static_cast<float>(layout.lambert_columns),
                     static_cast<float>(layout.gradient_columns)}};
}

} // namespace lodestar::hosts

// SPDX-License-Identifier: MIT
//
// The built-in renderer's light probes: LODESTAR_PROBES of them hold a draw, 1 or 2.

uniform sampler2D uProbeIrradiance;

LodestarVolume volumeOf(vec4 x, vec4 y, vec4 z, vec4 extents, vec4 high, vec4 low) {
    LodestarVolume volume;
    volume.rowX = x;
    volume.rowY = y;
    volume.rowZ = z;
    volume.halfExtents = extents.xyz;
    volume.blendHigh = high.xyz;
    volume.blendLow = low.xyz;
    volume.sphere = extents.w;
    volume.outward = high.w;
    return volume;
}

// An array of blocks takes a constant index only.
#define LODESTAR_INFLUENCE(k) \
    volumeOf(uProbe[k].influenceRows[0], uProbe[k].influenceRows[1], uProbe[k].influenceRows[2], \
             uProbe[k].influenceExtents, uProbe[k].influenceHigh, uProbe[k].influenceLow)
#define LODESTAR_PROXY(k) \
    volumeOf(uProbe[k].proxyRows[0], uProbe[k].proxyRows[1], uProbe[k].proxyRows[2], \
             uProbe[k].proxyExtents, vec4(0.0), vec4(0.0))
#define LODESTAR_PROBE_RADIANCE(k, surface, lookup, direction) \
    probeRadiance(k + 1, surface, lookup, direction, \
                  lodestar_footprintLevel(direction, dFdx(direction), dFdy(direction), max(uProbe[k].capturedAt.w, 1.0)), \
                  uProbe[k].capturedAt.w, uProbe[k].light, uProbe[k].tile, uProbe[k].sky)

LodestarShares probeShares() {
    float first = uProbe[0].influenceExtents.x > 0.0 ? lodestar_volumeWeight(LODESTAR_INFLUENCE(0), vPosition) : 0.0;
    float second = 0.0;
#if LODESTAR_PROBES > 1
    second = lodestar_volumeWeight(LODESTAR_INFLUENCE(1), vPosition);
#endif
    return lodestar_probeShares(first, second, vProbes.x, vProbes.y, vProbes.z);
}

vec3 towards(LodestarVolume proxy, vec3 captured, vec3 direction) {
    return proxy.sphere < -0.5
               ? direction
               : lodestar_safeNormalize(lodestar_parallax(proxy, captured, vPosition, direction), direction);
}

/// What a probe's light gives back towards the viewer.
/// @param direction of the lookup, corrected for parallax
/// @param footprint the pixel's level there
vec3 probeRadiance(int slot, LodestarSurface surface, LodestarLookup lookup, vec3 direction, float footprint,
                   float width, vec4 light, vec4 tile, vec4 sky) {
    if (width <= 0.0 || dot(light.rgb, vec3(1.0)) <= 0.0) {
        return vec3(0.0); // it holds nothing, or keeps the sky out alone
    }
    LodestarCube cube;
    cube.slot = slot;
    cube.width = width;
    cube.maxLevel = light.w;
    cube.leastLevel = 0.0;
    vec3 glossy = lodestar_specularOfTents(cube, direction, lookup.exponent, footprint);
    vec2 texel = lodestar_irradianceTexel(surface.normal);
    vec2 size = vec2(textureSize(uProbeIrradiance, 0));
    vec3 lambert = textureLod(uProbeIrradiance, (tile.xy + texel) / size, 0.0).rgb;
#if LODESTAR_PROBE_SKIES
    if (sky.w > 0.5) {
        lambert += sky.rgb * textureLod(uProbeIrradiance, (tile.zw + texel) / size, 0.0).rgb;
    }
#endif
    glossy = lodestar_mix(glossy, lambert, max(1.0 - lodestar_repairExponent(surface.exponent), 0.0));
    return light.rgb * lodestar_reflected(surface, lambert, glossy);
}

vec3 probeLight(LodestarSurface surface, LodestarShares shares) {
    LodestarLookup lookup = lodestar_lookup(surface.normal, surface.view, surface.exponent);
    vec3 direction = towards(LODESTAR_PROXY(0), uProbe[0].capturedAt.xyz, lookup.direction);
    vec3 sum = shares.first * LODESTAR_PROBE_RADIANCE(0, surface, lookup, direction);
#if LODESTAR_PROBES > 1
    direction = towards(LODESTAR_PROXY(1), uProbe[1].capturedAt.xyz, lookup.direction);
    sum += shares.second * LODESTAR_PROBE_RADIANCE(1, surface, lookup, direction);
#endif
    return sum;
}

#if LODESTAR_RSRM_LIGHTS
float seenSun(vec4 light, vec2 tile, int sun) {
    ivec2 at = ivec2(tile) + ivec2(sun % LODESTAR_SUN_TEXELS, LODESTAR_SUN_TEXELS + sun / LODESTAR_SUN_TEXELS);
    return dot(light.rgb, vec3(1.0)) > 0.0 ? texelFetch(uProbeIrradiance, at, 0).r : 0.0;
}

/// What probes let through of a sun that casts no shadow: all outside them, inside what they see of it
/// from where they captured.
float sunShare(LodestarShares shares, int sun) {
    float share = shares.environment + shares.first * seenSun(uProbe[0].light, uProbe[0].tile.xy, sun);
#if LODESTAR_PROBES > 1
    share += shares.second * seenSun(uProbe[1].light, uProbe[1].tile.xy, sun);
#endif
    return share;
}
#endif

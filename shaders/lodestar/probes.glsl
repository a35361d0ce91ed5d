// SPDX-License-Identifier: MIT
//
// Light probes: how strongly each of two lights a point, and where its captured light is looked up.
// Weights are smooth; a constant world is unchanged by them, since they sum to 1.
#ifndef LODESTAR_PROBES_GLSL
#define LODESTAR_PROBES_GLSL
#include "dual.glsl"

LODESTAR_BEGIN

/// A box or an ellipsoid in the world.
struct LodestarVolume {
    vec4 rowX;        ///< the rows of volumeFromWorld, an affine matrix; the volume's centre is its origin
    vec4 rowY;
    vec4 rowZ;
    vec3 halfExtents; ///< metres of the volume's frame, > 0; a sphere's radius in all three
    vec3 blendHigh;   ///< >= 0, over which the weight falls at +X, +Y, +Z; a sphere's in x
    vec3 blendLow;    ///< the same at -X, -Y, -Z
    Real sphere;      ///< 1: a sphere in its frame; 0: a box
    Real outward;     ///< 1: blends lie outside the faces; 0: inside
};

/// What of a point's light comes from where. The three sum to 1.
struct LodestarShares {
    Real first;       ///< the first probe
    Real second;      ///< the second
    Real environment; ///< the distant environment and the skies
};

LODESTAR_FN vec3 lodestar_intoVolume(LodestarVolume volume, vec3 world) {
    vec4 p = vec4(world, 1.0f);
    return vec3(dot(volume.rowX, p), dot(volume.rowY, p), dot(volume.rowZ, p));
}

/// 0 at 0 and below, 1 at `blend` and above, smooth between; a step at 0 where blend is 0.
/// @param inside metres
LODESTAR_FN Real lodestar_probeFade(Real inside, Real blend) {
    if (!(blend > 0.0f)) {
        return inside >= 0.0f ? Real(1.0f) : Real(0.0f);
    }
    Real t = clamp(inside / blend, Real(0.0f), Real(1.0f));
    return t * t * (3.0f - 2.0f * t);
}

/// How strongly a volume holds a point, [0, 1]: for a box the product of its six faces' fades.
LODESTAR_FN Real lodestar_volumeWeight(LodestarVolume volume, vec3 world) {
    vec3 p = lodestar_intoVolume(volume, world);
    if (volume.sphere > 0.5f) {
        Real inside = volume.halfExtents.x - sqrt(dot(p, p)) + volume.outward * volume.blendHigh.x;
        return lodestar_probeFade(inside, volume.blendHigh.x);
    }
    vec3 high = volume.halfExtents - p + volume.outward * volume.blendHigh;
    vec3 low = volume.halfExtents + p + volume.outward * volume.blendLow;
    return lodestar_probeFade(high.x, volume.blendHigh.x) * lodestar_probeFade(low.x, volume.blendLow.x) *
           lodestar_probeFade(high.y, volume.blendHigh.y) * lodestar_probeFade(low.y, volume.blendLow.y) *
           lodestar_probeFade(high.z, volume.blendHigh.z) * lodestar_probeFade(low.z, volume.blendLow.z);
}

/// The first probe stands before the second, both before the environment.
/// @param w0, w1 weights of the two at the point
/// @param f0, f1 what the draw lets them have, [0, 1]: falls to 0 before another takes their place
/// @param open how much of what they leave the environment may light, [0, 1]; the rest is theirs
LODESTAR_FN LodestarShares lodestar_probeShares(Real w0, Real w1, Real f0, Real f1, Real open) {
    LodestarShares shares;
    Real a0 = f0 * w0;
    Real a1 = f1 * w1;
    Real left = (1.0f - a0) * (1.0f - a1);
    Real kept = left * (1.0f - open);
    Real sum = f0 + f1;
    Real toFirst = sum > 0.0f ? f0 / sum : Real(0.5f);
    shares.first = a0 + kept * toFirst;
    shares.second = (1.0f - a0) * a1 + kept * (1.0f - toFirst);
    shares.environment = left * open;
    return shares;
}

/// A step in a volume's frame as one of the world. @pre the frame is not sheared
LODESTAR_FN vec3 lodestar_outOfVolume(LodestarVolume volume, vec3 step) {
    vec3 x = vec3(volume.rowX);
    vec3 y = vec3(volume.rowY);
    vec3 z = vec3(volume.rowZ);
    Real least = LODESTAR_LITERAL(1e-30);
    return x * (step.x / max(dot(x, x), least)) + y * (step.y / max(dot(y, y), least)) +
           z * (step.z / max(dot(z, z), least));
}

/// Where a ray leaves a volume, seen from where the probe captured: the direction of its lookup. A
/// point outside is taken to the volume's surface first, so that nothing jumps at a face.
/// @param direction unit, in the world  @param captured where the probe captured, in the world
/// @return not unit; the direction itself where the ray meets nothing
LODESTAR_FN vec3 lodestar_parallax(LodestarVolume volume, vec3 captured, vec3 world, vec3 direction) {
    vec3 inside = lodestar_intoVolume(volume, world);
    vec3 p = inside;
    vec3 d = vec3(dot(vec3(volume.rowX), direction), dot(vec3(volume.rowY), direction),
                  dot(vec3(volume.rowZ), direction));
    Real t = 0.0f;
    if (volume.sphere > 0.5f) {
        Real radius = volume.halfExtents.x;
        Real far = sqrt(dot(p, p));
        p = far > radius ? p * (radius / far) : p;
        Real a = max(dot(d, d), LODESTAR_LITERAL(1e-30));
        Real b = dot(p, d);
        Real c = min(dot(p, p) - radius * radius, Real(0.0f));
        t = (sqrt(max(b * b - a * c, Real(0.0f))) - b) / a;
    } else {
        vec3 h = volume.halfExtents;
        p = clamp(p, -h, h);
        Real tx = abs(d.x) > LODESTAR_LITERAL(1e-12) ? ((d.x > 0.0f ? h.x : -h.x) - p.x) / d.x : LODESTAR_LITERAL(1e30);
        Real ty = abs(d.y) > LODESTAR_LITERAL(1e-12) ? ((d.y > 0.0f ? h.y : -h.y) - p.y) / d.y : LODESTAR_LITERAL(1e30);
        Real tz = abs(d.z) > LODESTAR_LITERAL(1e-12) ? ((d.z > 0.0f ? h.z : -h.z) - p.z) / d.z : LODESTAR_LITERAL(1e30);
        t = min(min(tx, ty), tz);
        if (!(t < LODESTAR_LITERAL(1e29))) {
            return direction;
        }
    }
    return world + lodestar_outOfVolume(volume, p - inside) + t * direction - captured;
}

LODESTAR_END

#endif

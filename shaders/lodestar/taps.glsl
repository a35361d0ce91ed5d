// SPDX-License-Identifier: MIT
//
// Where several lookups in tent mips stand for one cosine lobe, and of which lobe each of them is
// (docs/derivations/taps.md): a ring about the lobe's axis, or a spiral at the golden angle. A tap is a
// lookup of a narrower lobe, by lodestar_tentLevel. Functions of the lobe only; environment.glsl fetches.
#ifndef LODESTAR_TAPS_GLSL
#define LODESTAR_TAPS_GLSL
#include "dual.glsl"
#include "power.glsl"

LODESTAR_BEGIN

/// How a set of taps stands for a lobe of exponent s.
struct LodestarTaps {
    Real reach;    ///< the taps lie by the shares of the lobe whose exponent plus 1 is this times s + 1
    Real narrow;   ///< a tap's own exponent plus 1 is this times s + 1, on the axis
    Real widening; ///< and falls outwards with this power of the lobe's density there
};

/// A unit vector at right angles to a unit direction, the same for the same direction and continuous
/// but at -Y, about which it turns twice. ([Duff17] has two branches, and a seam between.)
LODESTAR_FN vec3 lodestar_tangent(vec3 d) {
    // 1 / (1 + y), without its cancellation near -Y.
    Real a = d.y < 0.0f ? (1.0f - d.y) / max(d.x * d.x + d.z * d.z, LODESTAR_LITERAL(1e-20)) : 1.0f / (1.0f + d.y);
    return vec3(1.0f - d.x * d.x * a, -d.x, -d.x * d.z * a);
}

/// A tap of a lobe (TAP-1, TAP-2).
/// @param d the lobe's axis  @param tangent lodestar_tangent(d)  @param turn cosine and sine of the azimuth
/// @param exponent Phong, [0, 1e7]  @param logShare log2 of the lobe's share outside the tap, <= 0
/// @return the tap's direction, and the exponent of its own lobe
LODESTAR_FN vec4 lodestar_lobeTap(vec3 d, vec3 tangent, vec2 turn, Real exponent, Real logShare, LodestarTaps taps) {
    // cos^(reach (s + 1)) = share: -log of the squared cosine is twice this.
    Real s = exponent + 1.0f;
    Real fall = -LODESTAR_LITERAL(0.693147180559945309) * logShare / (taps.reach * s);
    Real sine = sqrt(lodestar_oneMinusExp(2.0f * fall));
    Real cosine = 1.0f - lodestar_oneMinusExp(fall);
    vec3 direction = cosine * d + sine * (turn.x * tangent + turn.y * cross(d, tangent));
    Real own = taps.narrow * s * exp2(taps.widening * logShare * (exponent / s)) - 1.0f;
    return vec4(direction, max(own, Real(0.0f)));
}

/// A ring about the lobe's axis, each tap with logShare -1; of 7 the first is the axis itself, with
/// logShare 0 (TAP-4). Fitted on the ladder's first set.
/// @param count 2, 3 or 7
LODESTAR_FN LodestarTaps lodestar_ring(int count) {
    LodestarTaps taps;
    taps.reach = count == 7 ? Real(1.5f) : (count == 3 ? LODESTAR_LITERAL(2.7) : Real(7.0f));
    taps.narrow = count == 7 ? LODESTAR_LITERAL(2.1) : (count == 3 ? LODESTAR_LITERAL(1.55) : LODESTAR_LITERAL(1.2));
    taps.widening = 0.0f;
    return taps;
}

/// Weight of the axis in the ring of 7. Fitted.
LODESTAR_CONST Real LODESTAR_RING_CENTRE = LODESTAR_LITERAL(0.15);

/// A spiral: tap i has logShare log2((i + 1/2) / count) and the azimuth i pi (3 - sqrt 5) (TAP-5). Fitted
/// for 4 to 128 taps at once on the ladder's first set.
/// @param count >= 4
LODESTAR_FN LodestarTaps lodestar_spiral(Real count) {
    LodestarTaps taps;
    taps.reach = 1.0f + 4.25f / count;
    taps.narrow = LODESTAR_LITERAL(0.3) * count + 1.5f;
    taps.widening = LODESTAR_LITERAL(0.6);
    return taps;
}

/// An azimuth turned by another, each as cosine and sine.
LODESTAR_FN vec2 lodestar_turned(vec2 turn, vec2 by) {
    return vec2(turn.x * by.x - turn.y * by.y, turn.x * by.y + turn.y * by.x);
}

LODESTAR_END

#endif

// SPDX-License-Identifier: MIT
//
// Mip chains of cube maps on the CPU (docs/derivations/mip.md).
#pragma once

#include "lighting/cubemap.h"

namespace lodestar::lighting {

/// The as-published chain: plain 2x2 means within each face (3-tap polyphase for odd widths), every
/// level down to 1x1. This is what a driver's mipmap call makes. [McGuire13 section 4]
[[nodiscard]] Cubemap boxMips(const Cubemap& base);

/// 2x2 means weighted by solid angle: every level keeps the sphere's mean exactly (to rounding).
[[nodiscard]] Cubemap solidAngleMips(const Cubemap& base);

/// Tent mips: each texel is the (1 3 3 1) x (1 3 3 1) weighted mean of the 4x4 finer texels about
/// it, across face borders, weighted by solid angle; each level and channel is then scaled to keep
/// the sphere's mean. Levels with faces of at most 16 texels are means over round lobes instead,
/// since tents as coarse are stars about the cube's corners. For glossy lookups with
/// lodestar_tentLevel.
[[nodiscard]] Cubemap tentMips(const Cubemap& base);

/// The same in place: fills levels 1 and up of a map that has them from its level 0, without
/// allocating the map again. For maps that change every frame. @pre not empty
void fillTentMips(Cubemap& chain);

/// Mean radiance over the sphere of one level, weighted by solid angle.
[[nodiscard]] glm::dvec4 sphereMean(const Cubemap& map, int level);

} // namespace lodestar::lighting

// SPDX-License-Identifier: MIT
//
// The coarse levels of tent mips as means over round lobes (docs/derivations/mip.md).
#pragma once

#include "lighting/cubemap.h"

namespace lodestar::lighting {

/// Levels with faces of at most this many texels are made round.
inline constexpr int kWidestRound = 16;

/// Replaces the levels of a chain of tent mips below level 0 whose faces are at most kWidestRound
/// wide, read from level 0 and from tents of at least that width alone: each texel becomes the mean
/// over the cosine lobe that, read bilinearly, is the lobe for which lodestar_tentLevel reads the
/// level. Texels of the cube projection differ in size and shape, so that coarse tents are
/// three-armed stars about the cube's corners; lobes are round everywhere. The sums of the new
/// levels over the sphere are not corrected.
void roundCoarseLevels(Cubemap& chain);

/// The Phong exponent for which lodestar_tentLevel reads a level of effective width w 2^-k, without
/// the texel's size; 0 where there is none. @param width > 0
[[nodiscard]] double exponentOfTentLevel(double width);

} // namespace lodestar::lighting

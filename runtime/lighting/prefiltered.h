// SPDX-License-Identifier: MIT
//
// A cube whose levels are means over cosine lobes, for the estimator `prefiltered`
// (docs/derivations/prefiltered.md): for maps that stay, and one fetch.
#pragma once

#include <functional>

#include "lighting/cubemap.h"

namespace lodestar::lighting {

/// How the levels are made.
struct PrefilterRun {
    /// Means at least this wide are summed over, and twice as wide as the level; from the map's own
    /// width on all sums run over its texels.
    int leastSourceWidth = 64;
    std::size_t threads = 0; ///< 0: as many as there are processors; the levels are the same
    std::function<void(double share)> progress =
        {}; ///< on the caller's thread, (0, 1]; may be empty
};

/// A full chain: level 0 is the map, a texel of another the mean over the lobe that, read
/// bilinearly, is the Phong lobe of lodestar_prefilteredExponent. What summing over means of
/// texels adds to its spread is taken off too.
/// @pre base not empty
[[nodiscard]] Cubemap prefilteredMips(const Cubemap& base, const PrefilterRun& run = {});

} // namespace lodestar::lighting

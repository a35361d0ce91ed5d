// SPDX-License-Identifier: MIT
//
// Means of a cube over cosine lobes, in single precision by vector code, fast enough to filter
// whole maps (docs/derivations/prefiltered.md, PRE-3). `reference` is the exact one.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "lighting/cubemap.h"

namespace lodestar::lighting {

/// A level whose texels are summed, with what depends on its width alone.
struct LobeSource {
    /// Where a face as another sees it lies in the map: texel (x, y) is number first + x alongX + y
    /// alongY.
    struct Placed {
        std::ptrdiff_t first = 0;
        std::ptrdiff_t alongX = 0;
        std::ptrdiff_t alongY = 0;
    };
    int width = 0;
    const glm::vec4* texels = nullptr;
    std::vector<float> coordinates;  ///< u of each column, and v of each row
    std::vector<float> inverseNorms; ///< 1 / |(u, v, 1)|, row by row
    std::vector<float> solidAngles;
    std::array<std::array<Placed, 6>, 6> placed; ///< by the seeing face, then the seen one
};

/// @param chain stays as long as the source does  @param level of it
[[nodiscard]] LobeSource lobeSource(const Cubemap& chain, int level);

/// The mean over max(cos^s - 1e-4, 0) about a direction; texels' centres stand for them, so that
/// the lobe must be wider than a texel, s + 1 <= 3/16 of the width squared. @param direction unit
/// @param exponent Phong, >= 0  @param scratch kept between calls
[[nodiscard]] glm::vec4 lobeMean(const LobeSource& source, const glm::dvec3& direction,
                                 double exponent, std::vector<float>& scratch);

/// The same about the directions that the six faces see as +Z sees this one.
[[nodiscard]] std::array<glm::vec4, 6> sixLobeMeans(const LobeSource& source,
                                                    const glm::dvec3& direction, double exponent,
                                                    std::vector<float>& scratch);

} // namespace lodestar::lighting

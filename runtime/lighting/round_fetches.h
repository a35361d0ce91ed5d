// SPDX-License-Identifier: MIT
//
// Round coarse levels as weighted sums of bilinear fetches, as a GPU makes them
// (docs/derivations/mip.md).
#pragma once

#include <memory>
#include <vector>

#include <glm/vec4.hpp>

namespace lodestar::lighting {

/// What the texels of one face of a level read; those of the other faces read the same, turned.
struct RoundFetches {
    int texels = 0; ///< of the face that is made, row by row
    int most = 0;   ///< fetches of a texel
    /// Fetch i of texel t is at i * texels + t. xyz: where, not unit, along the columns, down the
    /// rows and out of the face that is made; a point between at most four texel centres of one
    /// face. w: its share, > 0, or 0 after a texel's last. A texel's shares sum to 1.
    std::vector<glm::vec4> fetches;
};

/// The level that is read.
struct RoundSource {
    double effectiveWidth = 0.0; ///< w 2^-k
    int width = 0;               ///< of its faces, texels
    bool round = false;          ///< made of such fetches itself, not of tents

    bool operator==(const RoundSource&) const = default;
};

/// The fetches whose sums are the texels of a round level: of the lobe for which lodestar_tentLevel
/// reads it, less what reading it adds and what is read holds already. All texels together read
/// each that is read as often as the next, by solid angle, so that the level keeps the sphere's
/// mean. Made once and kept; for any number of threads.
/// @param effectiveWidth w 2^-k of the level  @param width of its faces, texels
[[nodiscard]] std::shared_ptr<const RoundFetches> roundFetches(double effectiveWidth, int width,
                                                               const RoundSource& source);

} // namespace lodestar::lighting

// SPDX-License-Identifier: MIT
//
// Radially symmetric reflection maps on the CPU: from baked radiance to the texels of a layout, and
// from texels to radiance by the shading text itself.
//
//   RadianceProfile -> zonalRadiance -> RsrmKernel::bake -> encode -> texture, or rsrmRadiance
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "lighting/rsrm_kernel.h"

namespace lodestar::lighting {

/// A map's texels as a GPU reads them, and what belongs to them.
struct RsrmTexels {
    RsrmLayout layout;
    /// rows x columns texels, row 0 first, native byte order: RGBA8, RGB10_A2
    /// (GL_UNSIGNED_INT_2_10_10_10_REV), RGBA16F or RGBA32F. Alpha is 1.
    std::vector<std::uint8_t> bytes;
    /// log2 of each row's scale, the hook's alpha between rows by lodestar_rsrmRowScale; all 0
    /// where the layout has no scales, all the same where it has one.
    std::vector<float> logScales;
    /// The unfiltered gradient at the columns, linear radiance (means over a column's width), for
    /// the row past the last.
    std::vector<glm::vec3> gradient;
};

/// Texels from a bake. @pre the bake is of the layout's own exponents and columns, the gradient has
/// a value a column
/// @param gradient the unfiltered gradient at the columns, as unfiltered() makes it
[[nodiscard]] RsrmTexels encode(const RsrmLayout& layout, const RsrmBake& bake,
                                std::vector<glm::vec3> gradient);

/// The gradient at a layout's columns: means over the ring half way to either neighbour.
[[nodiscard]] std::vector<glm::vec3> unfiltered(const RadianceProfile& profile,
                                                const RsrmLayout& layout);

/// The rgb that a GPU reads at a texel, alpha 1. @pre column and row inside
[[nodiscard]] glm::vec4 storedTexel(const RsrmTexels& texels, int column, int row);

/// Radiance about a direction at an angle from the axis, by shaders/lodestar/rsrm.glsl in float
/// with exact bilinear weights. @param theta radians [0, pi]  @param exponent [0, 1e7] or +infinity
[[nodiscard]] glm::vec3 rsrmRadiance(const RsrmTexels& texels, double theta, double exponent);

} // namespace lodestar::lighting

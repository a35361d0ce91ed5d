// SPDX-License-Identifier: MIT
//
// Radially symmetric reflection maps on the CPU: from baked radiance to the texels of a layout, and
// from texels to radiance by the shading text itself.
//
//   RadianceProfile -> zonalRadiance -> RsrmKernel::bake -> encode -> texture, or rsrmRadiance
//                   -> unfiltered, the gradient beside the map
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "lighting/rsrm_kernel.h"

namespace lodestar::lighting {

/// Columns of the unfiltered gradient, uniform in u2: 0.011 degrees at the edge of a sun's disc; as
/// half floats 16 KB a light.
inline constexpr int kGradientColumns = 2048;

/// A map's texels as a GPU reads them, and what belongs to them.
struct RsrmTexels {
    RsrmLayout layout;
    /// rows x columns texels, row 0 first, native byte order: RGBA8, RGB9_E5
    /// (GL_UNSIGNED_INT_5_9_9_9_REV), RGBA16F or RGBA32F. Alpha is 1.
    std::vector<std::uint8_t> bytes;
    float scale = 1.0f; ///< the hook's alpha; 1 for fitted layouts
    /// Radiance over Lambert's lobe, uniform in z from the axis: kLambertColumns from pole to pole,
    /// or a value a column for the published layouts.
    std::vector<glm::vec3> lambert;
};

/// Texels from a bake. @pre the bake is of the layout's own exponents and columns
[[nodiscard]] RsrmTexels encode(const RsrmLayout& layout, const RsrmBake& bake);

/// The gradient at kGradientColumns, linear radiance: means over the ring half way to either
/// neighbour.
[[nodiscard]] std::vector<glm::vec3> unfiltered(const RadianceProfile& profile);

/// How wide a light is: the mean of |l - axis|^2 over its squared radiance, (r + g + b)^2, and
/// solid angle, [0, 4]; 0 for one without light (SUN-4). @param gradient as unfiltered gives it
[[nodiscard]] double spread(std::span<const glm::vec3> gradient);

/// The rgb that a GPU reads at a texel, alpha 1. @pre column and row inside
[[nodiscard]] glm::vec4 storedTexel(const RsrmTexels& texels, int column, int row);

/// What a layout's encoding keeps of a bake as it is, without rows fitted between exponents: linear
/// radiance, [exponent][column].
[[nodiscard]] std::vector<glm::vec3> storedRows(const RsrmLayout& layout, const RsrmBake& bake);

/// Radiance about a direction at an angle from the axis, by shaders/lodestar/rsrm.glsl in float
/// with exact bilinear weights. @param gradient unfiltered radiance, uniform in u2 from pole to
/// pole
/// @param theta radians [0, pi]  @param exponent [0, 1e7] or +infinity
[[nodiscard]] glm::vec3 rsrmRadiance(const RsrmTexels& texels, std::span<const glm::vec3> gradient,
                                     double theta, double exponent);
/// Mean radiance over Lambert's lobe about a normal at an angle from the axis, by the same text.
[[nodiscard]] glm::vec3 rsrmLambert(const RsrmTexels& texels, double theta);

} // namespace lodestar::lighting

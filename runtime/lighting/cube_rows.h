// SPDX-License-Identifier: MIT
//
// Which rows and columns of a cube's face a round lobe reaches: a cone cuts a face in a conic,
// whose extents are the roots of quadratics. Used by sums over a cube's texels.
#pragma once

#include <cstddef>

#include <glm/vec3.hpp>

namespace lodestar::lighting {

/// A linear function of direction as one of (u, v) on a face: constant + alongU u + alongV v.
struct FaceLinear {
    double constant = 0.0;
    double alongU = 0.0;
    double alongV = 0.0;
};

/// The dot product with an axis, on a face.
[[nodiscard]] FaceLinear onFace(int face, const glm::dvec3& axis);

/// Rows or columns, [begin, end).
struct TexelRange {
    std::size_t begin;
    std::size_t end;
};

/// Columns of row v outside which no texel's cosine with an axis exceeds `least`, one more at
/// either end; those of the opposite cone may be among them.
[[nodiscard]] TexelRange columnsWithin(const FaceLinear& axis, double v, double least,
                                       std::size_t width);

/// Rows outside which no texel of the face has such a cosine, likewise.
[[nodiscard]] TexelRange rowsWithin(const FaceLinear& axis, double least, std::size_t width);

} // namespace lodestar::lighting

// SPDX-License-Identifier: MIT
//
// A cube map with its mip levels, as float pixels on the CPU. Faces are in GL's order and
// orientation, drawn in shaders/lodestar/cube.glsl.
#pragma once

#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace lodestar::lighting {

/// Number of levels of a full chain: floor(log2 width) + 1.
[[nodiscard]] int fullLevelCount(int width);

/// Six square faces a level. Texels are linear radiance in rgb (Rec. 709) and coverage in a (1 for
/// loaded maps). Level k has faces of max(1, width >> k) texels.
class Cubemap {
public:
    Cubemap() = default;
    /// All texels zero. @pre width in [1, 16384], levelCount in [1, fullLevelCount(width)]
    explicit Cubemap(int width, int levelCount = 1);

    [[nodiscard]] int width(int level = 0) const;
    [[nodiscard]] int levelCount() const { return static_cast<int>(levels_.size()); }
    [[nodiscard]] bool empty() const { return levels_.empty(); }

    /// All six faces of a level, face by face, row by row.
    [[nodiscard]] std::vector<glm::vec4>& level(int level) {
        return levels_[static_cast<size_t>(level)];
    }
    [[nodiscard]] const std::vector<glm::vec4>& level(int level) const {
        return levels_[static_cast<size_t>(level)];
    }
    [[nodiscard]] glm::vec4& texel(int face, int x, int y, int level = 0);
    [[nodiscard]] const glm::vec4& texel(int face, int x, int y, int level = 0) const;

    /// Seamless bilinear lookup at one level, as GL 3.2+ filters cubes: across an edge the texel is
    /// the neighbouring face's, at a corner the missing one is the mean of the other three.
    /// @param direction any length; the zero vector reads the centre of +X
    [[nodiscard]] glm::vec4 sampleLevel(const glm::vec3& direction, int level) const;

    /// Seamless trilinear lookup. @param level clamped to [0, levelCount - 1]; NaN reads level 0
    [[nodiscard]] glm::vec4 sample(const glm::vec3& direction, float level) const;

private:
    int width_ = 0;
    std::vector<std::vector<glm::vec4>> levels_;
};

/// Solid angles of the texels of one face of a level in steradians, row by row; exact (the
/// difference of atan(xy / sqrt(1 + x^2 + y^2)) over the corners, in double). Six times their sum
/// is 4 pi.
[[nodiscard]] std::vector<double> texelSolidAngles(int width);

} // namespace lodestar::lighting

// SPDX-License-Identifier: MIT
//
// Where faces of a cube are drawn: half-float colour and depth of several samples a texel, resolved
// into a face of a cube texture. Move-only.
#pragma once

#include "gl/texture.h"

namespace lodestar::gl {

class FaceTarget {
public:
    FaceTarget() = default;
    FaceTarget(FaceTarget&& other) noexcept;
    FaceTarget& operator=(FaceTarget&& other) noexcept;
    ~FaceTarget();

    /// @param width texels of a face's side  @param samples a texel, as many as the driver has at
    /// most  @errors NoOpenGl if the driver has no memory or cannot render to half floats
    [[nodiscard]] static core::Result<FaceTarget> make(Device& device, int width, int samples);

    /// Binds it with a viewport over all of it, cleared to 0 and depth 1. Counts a pass.
    void begin();
    /// The mean of each texel's samples into a face's level 0. @pre a half-float cube of this width
    void resolve(const Texture& cube, int face);

    [[nodiscard]] int width() const { return width_; }

private:
    Device* device_ = nullptr;
    unsigned id_ = 0;       ///< of several samples
    unsigned resolved_ = 0; ///< framebuffer with a face attached
    unsigned color_ = 0;
    unsigned depth_ = 0;
    int width_ = 0;
    std::size_t bytes_ = 0;
};

/// A framebuffer whose colour is a face of a cube, changed from draw to draw. Move-only.
class CubeFaces {
public:
    CubeFaces() = default;
    explicit CubeFaces(Device& device);
    CubeFaces(CubeFaces&& other) noexcept;
    CubeFaces& operator=(CubeFaces&& other) noexcept;
    ~CubeFaces();

    /// Binds a face's level 0 with a viewport over all of it, not cleared. Counts a pass.
    void begin(const Texture& cube, int face);
    /// Copies a face's level 0. @pre cubes of one format and width
    void copy(const Texture& from, const Texture& to, int face);

private:
    Device* device_ = nullptr;
    unsigned draw_ = 0;
    unsigned read_ = 0;
};

} // namespace lodestar::gl

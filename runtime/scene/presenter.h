// SPDX-License-Identifier: MIT
//
// Shows linear radiance that is on the GPU in a window, without reading it back.
#pragma once

#include <glm/vec2.hpp>

#include "gl/buffer.h"
#include "gl/framebuffer.h"
#include "gl/program.h"

namespace lodestar::scene {

/// Draws tiles into a framebuffer: the mean of each pixel's samples, times an exposure, through
/// the filmic curve and sRGB, as a PNG of the same radiance would hold it, on black.
class Presenter {
public:
    /// @errors Internal (a shader that the driver refuses)
    [[nodiscard]] static core::Result<Presenter> make(gl::Device& device);

    /// @param tile its size is a multiple of samplesPerSide  @param origin the tile's lower left
    /// pixel in the window, from the lower left  @param exposure factor on radiance, > 0
    /// @param framebuffer of the context, 0 the window's own
    void show(const gl::Framebuffer& tile, const glm::ivec2& origin, int samplesPerSide,
              float exposure, unsigned framebuffer = 0);

private:
    Presenter(gl::Device& device, gl::Program program);

    gl::Device* device_;
    gl::Program program_;
    gl::VertexArray fullScreen_;
    int origin_ = -1;
    int samplesPerSide_ = -1;
    int exposure_ = -1;
};

} // namespace lodestar::scene

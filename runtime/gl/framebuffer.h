// SPDX-License-Identifier: MIT
//
// An offscreen target of float colour and depth. Move-only.
#pragma once

#include "core/image.h"
#include "gl/texture.h"

namespace lodestar::gl {

class Framebuffer {
public:
    Framebuffer() = default;
    Framebuffer(Framebuffer&& other) noexcept;
    Framebuffer& operator=(Framebuffer&& other) noexcept;
    ~Framebuffer();

    /// @errors NoOpenGl if the driver has no memory or cannot render to float colour
    [[nodiscard]] static core::Result<Framebuffer> make(Device& device, int width, int height);

    /// Binds it with a viewport over all of it, cleared to 0 and depth 1. Counts a pass.
    void begin();
    /// Reads all pixels back, row 0 at the top, 4 channels. Blocks until drawing is done.
    [[nodiscard]] core::Image read() const;

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] const Texture& color() const { return color_; }

private:
    Device* device_ = nullptr;
    unsigned id_ = 0;
    int width_ = 0;
    int height_ = 0;
    Texture color_;
    Texture depth_;
};

/// Depth alone, in layers that a shader compares with. Move-only.
class DepthLayers {
public:
    DepthLayers() = default;
    DepthLayers(DepthLayers&& other) noexcept;
    DepthLayers& operator=(DepthLayers&& other) noexcept;
    ~DepthLayers();

    /// @errors NoOpenGl if the driver has no memory or cannot render to depth alone
    [[nodiscard]] static core::Result<DepthLayers> make(Device& device, int side, int layers);

    /// Binds a layer with a viewport over all of it, cleared to 1. Counts a pass.
    void begin(int layer);

    [[nodiscard]] explicit operator bool() const { return id_ != 0; }
    [[nodiscard]] int side() const { return side_; }
    [[nodiscard]] const Texture& depths() const { return depths_; }

private:
    Device* device_ = nullptr;
    unsigned id_ = 0;
    int side_ = 0;
    Texture depths_;
};

/// A picture of 8 bits a channel that is drawn into and then drawn as a texture. Move-only.
class DisplayTarget {
public:
    DisplayTarget() = default;
    DisplayTarget(DisplayTarget&& other) noexcept;
    DisplayTarget& operator=(DisplayTarget&& other) noexcept;
    ~DisplayTarget();

    /// @errors NoOpenGl if the driver has no memory for it
    [[nodiscard]] static core::Result<DisplayTarget> make(Device& device, int width, int height);

    [[nodiscard]] unsigned framebuffer() const { return id_; }
    [[nodiscard]] const Texture& color() const { return color_; }
    [[nodiscard]] int width() const { return color_.width(); }
    [[nodiscard]] int height() const { return color_.height(); }
    /// Reads all pixels back, row 0 at the top, 4 channels in [0, 1] as they are shown.
    [[nodiscard]] core::Image read() const;

private:
    unsigned id_ = 0;
    Texture color_;
};

/// Binds a framebuffer of the context, 0 the window's own, with a viewport from the lower left, not
/// cleared. Counts a pass.
void beginWindowPass(Device& device, unsigned framebuffer, int x, int y, int width, int height);

} // namespace lodestar::gl

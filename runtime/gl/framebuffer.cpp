// SPDX-License-Identifier: MIT
#include "gl/framebuffer.h"

#include <algorithm>
#include <utility>

#include <epoxy/gl.h>

namespace lodestar::gl {
namespace {

core::Image readPixels(unsigned framebuffer, int width, int height) {
    core::Image image(width, height, 4);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, image.pixels().data());
    for (int y = 0; y < height / 2; ++y) {
        std::swap_ranges(image.at(0, y), image.at(0, y) + std::ptrdiff_t{4} * width,
                         image.at(0, height - 1 - y));
    }
    return image;
}

} // namespace

Framebuffer::Framebuffer(Framebuffer&& other) noexcept {
    *this = std::move(other);
}

Framebuffer& Framebuffer::operator=(Framebuffer&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(id_, other.id_);
    std::swap(width_, other.width_);
    std::swap(height_, other.height_);
    std::swap(color_, other.color_);
    std::swap(depth_, other.depth_);
    return *this;
}

Framebuffer::~Framebuffer() {
    if (id_ != 0) {
        glDeleteFramebuffers(1, &id_);
    }
}

core::Result<Framebuffer> Framebuffer::make(Device& device, int width, int height) {
    auto color = Texture::makeColorTarget(device, width, height);
    if (!color) {
        return color.error();
    }
    auto depth = Texture::makeDepthTarget(device, width, height);
    if (!depth) {
        return depth.error();
    }
    Framebuffer framebuffer;
    framebuffer.device_ = &device;
    framebuffer.width_ = width;
    framebuffer.height_ = height;
    framebuffer.color_ = std::move(*color);
    framebuffer.depth_ = std::move(*depth);
    glGenFramebuffers(1, &framebuffer.id_);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.id_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                           framebuffer.color_.id(), 0);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D,
                           framebuffer.depth_.id(), 0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        return core::Error{
            core::ErrorCode::NoOpenGl, "the driver cannot render to 32-bit float colour", {}, {}};
    }
    return framebuffer;
}

void Framebuffer::begin() {
    glBindFramebuffer(GL_FRAMEBUFFER, id_);
    glViewport(0, 0, width_, height_);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    glClearDepth(1.0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    ++device_->counters().passes;
    device_->counters().texelsWritten +=
        static_cast<std::uint64_t>(width_) * static_cast<std::uint64_t>(height_);
}

DepthLayers::DepthLayers(DepthLayers&& other) noexcept {
    *this = std::move(other);
}

DepthLayers& DepthLayers::operator=(DepthLayers&& other) noexcept {
    if (this != &other) {
        if (id_ != 0) {
            glDeleteFramebuffers(1, &id_);
        }
        device_ = std::exchange(other.device_, nullptr);
        id_ = std::exchange(other.id_, 0u);
        side_ = other.side_;
        depths_ = std::move(other.depths_);
    }
    return *this;
}

DepthLayers::~DepthLayers() {
    if (id_ != 0) {
        glDeleteFramebuffers(1, &id_);
    }
}

core::Result<DepthLayers> DepthLayers::make(Device& device, int side, int layers) {
    auto depths = Texture::makeDepthArray(device, side, layers, "shadow maps");
    if (!depths) {
        return depths.error();
    }
    DepthLayers target;
    target.device_ = &device;
    target.side_ = side;
    target.depths_ = std::move(*depths);
    glGenFramebuffers(1, &target.id_);
    glBindFramebuffer(GL_FRAMEBUFFER, target.id_);
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, target.depths_.id(), 0, 0);
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        return core::Error{
            core::ErrorCode::NoOpenGl, "the driver cannot render to depth alone", {}, {}};
    }
    return target;
}

void DepthLayers::begin(int layer) {
    glBindFramebuffer(GL_FRAMEBUFFER, id_);
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, depths_.id(), 0, layer);
    glViewport(0, 0, side_, side_);
    glDepthMask(GL_TRUE);
    glClearDepth(1.0);
    glClear(GL_DEPTH_BUFFER_BIT);
    ++device_->counters().passes;
    device_->counters().texelsWritten +=
        static_cast<std::uint64_t>(side_) * static_cast<std::uint64_t>(side_);
}

void beginWindowPass(Device& device, unsigned framebuffer, int x, int y, int width, int height) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(x, y, width, height);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    ++device.counters().passes;
    device.counters().texelsWritten +=
        static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
}

DisplayTarget::DisplayTarget(DisplayTarget&& other) noexcept {
    *this = std::move(other);
}

DisplayTarget& DisplayTarget::operator=(DisplayTarget&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(color_, other.color_);
    return *this;
}

DisplayTarget::~DisplayTarget() {
    if (id_ != 0) {
        glDeleteFramebuffers(1, &id_);
    }
}

core::Result<DisplayTarget> DisplayTarget::make(Device& device, int width, int height) {
    auto color =
        Texture::makeTarget(device, width, height, ArrayFormat::Rgba8, true, "displayed picture");
    if (!color) {
        return color.error();
    }
    DisplayTarget target;
    target.color_ = std::move(*color);
    glGenFramebuffers(1, &target.id_);
    glBindFramebuffer(GL_FRAMEBUFFER, target.id_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target.color_.id(),
                           0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        return core::Error{
            core::ErrorCode::NoOpenGl, "the driver cannot render to 8-bit colour", {}, {}};
    }
    return target;
}

core::Image DisplayTarget::read() const {
    return readPixels(id_, width(), height());
}

core::Image Framebuffer::read() const {
    return readPixels(id_, width_, height_);
}

} // namespace lodestar::gl

// SPDX-License-Identifier: MIT
#include "gl/face_target.h"

#include <algorithm>
#include <utility>

#include <epoxy/gl.h>

namespace lodestar::gl {
namespace {

GLenum faceOf(int face) {
    return GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face);
}

/// A colour and a depth sample.
constexpr std::size_t kSampleBytes = 8 + 4;

void countTexels(Device& device, int width) {
    device.counters().texelsWritten +=
        static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(width);
}

} // namespace

FaceTarget::FaceTarget(FaceTarget&& other) noexcept {
    *this = std::move(other);
}

FaceTarget& FaceTarget::operator=(FaceTarget&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(id_, other.id_);
    std::swap(resolved_, other.resolved_);
    std::swap(color_, other.color_);
    std::swap(depth_, other.depth_);
    std::swap(width_, other.width_);
    std::swap(bytes_, other.bytes_);
    return *this;
}

FaceTarget::~FaceTarget() {
    if (device_ == nullptr) {
        return;
    }
    const GLuint framebuffers[] = {id_, resolved_};
    const GLuint buffers[] = {color_, depth_};
    glDeleteFramebuffers(2, framebuffers);
    glDeleteRenderbuffers(2, buffers);
    device_->counters().textureBytes -= bytes_;
}

core::Result<FaceTarget> FaceTarget::make(Device& device, int width, int samples) {
    GLint most = 1;
    glGetIntegerv(GL_MAX_SAMPLES, &most);
    ++device.counters().stateQueries;
    const int used = std::min(samples, std::max(static_cast<int>(most), 1));
    while (glGetError() != GL_NO_ERROR) {
    }
    FaceTarget target;
    target.device_ = &device;
    target.width_ = width;
    glGenFramebuffers(1, &target.resolved_);
    glGenFramebuffers(1, &target.id_);
    glGenRenderbuffers(1, &target.color_);
    glGenRenderbuffers(1, &target.depth_);
    glBindRenderbuffer(GL_RENDERBUFFER, target.color_);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, used, GL_RGBA16F, width, width);
    glBindRenderbuffer(GL_RENDERBUFFER, target.depth_);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, used, GL_DEPTH_COMPONENT24, width, width);
    glBindFramebuffer(GL_FRAMEBUFFER, target.id_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, target.color_);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, target.depth_);
    if (glGetError() != GL_NO_ERROR ||
        glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        return core::Error{core::ErrorCode::NoOpenGl,
                           "the driver has no target for a light probe's faces of " +
                               std::to_string(width) + " texels",
                           {},
                           {}};
    }
    target.bytes_ = kSampleBytes * static_cast<std::size_t>(used) *
                    static_cast<std::size_t>(width) * static_cast<std::size_t>(width);
    device.counters().textureBytes += target.bytes_;
    return target;
}

void FaceTarget::begin() {
    glBindFramebuffer(GL_FRAMEBUFFER, id_);
    glViewport(0, 0, width_, width_);
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glClearColor(0.0f, 0.0f, 0.0f, 0.0f);
    glClearDepth(1.0);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    ++device_->counters().passes;
    countTexels(*device_, width_);
}

void FaceTarget::resolve(const Texture& cube, int face) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, id_);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_);
    glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, faceOf(face), cube.id(), 0);
    glBlitFramebuffer(0, 0, width_, width_, 0, 0, width_, width_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    countTexels(*device_, width_);
}

CubeFaces::CubeFaces(Device& device) : device_(&device) {
    glGenFramebuffers(1, &draw_);
    glGenFramebuffers(1, &read_);
}

CubeFaces::CubeFaces(CubeFaces&& other) noexcept {
    *this = std::move(other);
}

CubeFaces& CubeFaces::operator=(CubeFaces&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(draw_, other.draw_);
    std::swap(read_, other.read_);
    return *this;
}

CubeFaces::~CubeFaces() {
    if (device_ != nullptr) {
        const GLuint framebuffers[] = {draw_, read_};
        glDeleteFramebuffers(2, framebuffers);
    }
}

void CubeFaces::begin(const Texture& cube, int face) {
    glBindFramebuffer(GL_FRAMEBUFFER, draw_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, faceOf(face), cube.id(), 0);
    glViewport(0, 0, cube.width(), cube.width());
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    ++device_->counters().passes;
    countTexels(*device_, cube.width());
}

void CubeFaces::copy(const Texture& from, const Texture& to, int face) {
    const int width = to.width();
    glBindFramebuffer(GL_READ_FRAMEBUFFER, read_);
    glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, faceOf(face), from.id(), 0);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, draw_);
    glFramebufferTexture2D(GL_DRAW_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, faceOf(face), to.id(), 0);
    glBlitFramebuffer(0, 0, width, width, 0, 0, width, width, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    countTexels(*device_, width);
}

} // namespace lodestar::gl

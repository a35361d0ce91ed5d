// SPDX-License-Identifier: MIT
#include "gl/irradiance_atlas.h"

#include <utility>

#include <epoxy/gl.h>

namespace lodestar::gl {
namespace {

constexpr int kTilesARow = 40; // 1,000 texels
constexpr int kFirstRows = 4;

} // namespace

core::Result<IrradianceAtlas> IrradianceAtlas::make(Device& device) {
    IrradianceAtlas atlas;
    atlas.device_ = &device;
    if (auto allocated = atlas.allocate(kFirstRows); !allocated) {
        return allocated.error();
    }
    return atlas;
}

core::Result<void> IrradianceAtlas::allocate(int rows) {
    auto made = Texture::makeTarget(*device_, kTilesARow * kTileWidth, rows * kTileHeight,
                                    ArrayFormat::Rgba16F, true, "irradiance of light probes");
    if (!made) {
        return made.error();
    }
    unsigned framebuffer = 0;
    glGenFramebuffers(1, &framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, made->id(), 0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        glDeleteFramebuffers(1, &framebuffer);
        return core::Error{
            core::ErrorCode::NoOpenGl, "the driver cannot render to half floats", {}, {}};
    }
    if (id_ != 0) {
        glBindFramebuffer(GL_READ_FRAMEBUFFER, id_);
        const int width = texture_.width();
        const int height = texture_.height();
        glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT,
                          GL_NEAREST);
        glDeleteFramebuffers(1, &id_);
    }
    id_ = framebuffer;
    texture_ = std::move(*made);
    rows_ = rows;
    return {};
}

IrradianceAtlas::IrradianceAtlas(IrradianceAtlas&& other) noexcept {
    *this = std::move(other);
}

IrradianceAtlas& IrradianceAtlas::operator=(IrradianceAtlas&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(id_, other.id_);
    std::swap(texture_, other.texture_);
    std::swap(rows_, other.rows_);
    std::swap(tiles_, other.tiles_);
    return *this;
}

IrradianceAtlas::~IrradianceAtlas() {
    if (id_ != 0) {
        glDeleteFramebuffers(1, &id_);
    }
}

core::Result<int> IrradianceAtlas::add() {
    if (tiles_ == rows_ * kTilesARow) {
        if (auto grown = allocate(rows_ + (rows_ + 1) / 2); !grown) {
            return grown.error();
        }
    }
    return tiles_++;
}

glm::ivec2 IrradianceAtlas::tile(int number) const {
    return {number % kTilesARow * kTileWidth, number / kTilesARow * kTileHeight};
}

void IrradianceAtlas::begin(int number) {
    beginAt(number, 0, kTileWidth);
}

void IrradianceAtlas::beginRows(int number) {
    beginAt(number, kTileWidth, kTileHeight);
}

void IrradianceAtlas::beginAt(int number, int firstRow, int endRow) {
    const glm::ivec2 first = tile(number);
    glBindFramebuffer(GL_FRAMEBUFFER, id_);
    glViewport(first.x, first.y + firstRow, kTileWidth, endRow - firstRow);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    ++device_->counters().passes;
    device_->counters().texelsWritten +=
        std::uint64_t{kTileWidth} * static_cast<std::uint64_t>(endRow - firstRow);
}

} // namespace lodestar::gl

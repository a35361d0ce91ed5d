// SPDX-License-Identifier: MIT
#include "gl/texture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <epoxy/gl.h>

#include "core/contract.h"
#include "lighting/cube_texels.h"
#include "lodestar/display.glsl"

namespace lodestar::gl {
namespace {

GLint glWrap(Wrap wrap) {
    switch (wrap) {
    case Wrap::MirroredRepeat:
        return GL_MIRRORED_REPEAT;
    case Wrap::ClampToEdge:
        return GL_CLAMP_TO_EDGE;
    case Wrap::Repeat:
        break;
    }
    return GL_REPEAT;
}

GLint glMinification(const SamplerState& sampler) {
    if (!sampler.mipmapped) {
        return sampler.minifyLinear ? GL_LINEAR : GL_NEAREST;
    }
    if (sampler.mipLinear) {
        return sampler.minifyLinear ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_LINEAR;
    }
    return sampler.minifyLinear ? GL_LINEAR_MIPMAP_NEAREST : GL_NEAREST_MIPMAP_NEAREST;
}

core::Error noMemoryFor(const char* label) {
    return {core::ErrorCode::NoOpenGl,
            std::string("the driver has no memory for the texture '") + label + "'",
            {},
            {}};
}

/// Drains the error flags; out of memory is the one that is the world's fault.
core::Result<void> checkAllocation(const char* label) {
    bool outOfMemory = false;
    bool other = false;
    for (GLenum error = glGetError(); error != GL_NO_ERROR; error = glGetError()) {
        outOfMemory = outOfMemory || error == GL_OUT_OF_MEMORY;
        other = true;
    }
    if (other) {
        return core::Error{core::ErrorCode::NoOpenGl,
                           std::string("the driver ") +
                               (outOfMemory ? "has no memory for" : "refused") + " the texture '" +
                               label + "'",
                           {},
                           {}};
    }
    return {};
}

void setLabel(const Device& device, unsigned id, const char* label) {
    if (device.capabilities().debugOutput) {
        glObjectLabel(GL_TEXTURE, id, -1, label);
    }
}

/// Seamless and trilinear, of the cube that is bound.
void setCubeState(int levels) {
    glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAX_LEVEL, levels - 1);
    glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    constexpr GLenum kWraps[] = {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R};
    for (const GLenum wrap : kWraps) {
        glTexParameteri(GL_TEXTURE_CUBE_MAP, wrap, GL_CLAMP_TO_EDGE);
    }
}

/// Uploads the six faces of one level.
void uploadLevel(const lighting::CubeTexels& cube, int level) {
    const std::vector<std::uint8_t>& bytes = cube.levels[static_cast<std::size_t>(level)];
    const GLsizei width = std::max(1, cube.width >> level);
    for (std::size_t face = 0; face < 6; ++face) {
        glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face), level,
                     cube.half ? GL_RGBA16F : GL_RGBA32F, width, width, 0, GL_RGBA,
                     cube.half ? GL_HALF_FLOAT : GL_FLOAT, &bytes[face * (bytes.size() / 6)]);
    }
}

/// sRGB samples as linear ones of as many bits; alpha is kept.
core::Texels linear(const core::Texels& encoded) {
    core::Texels result(encoded.width(), encoded.height(), encoded.depth());
    for (int y = 0; y < encoded.height(); ++y) {
        for (int x = 0; x < encoded.width(); ++x) {
            for (int c = 0; c < 3; ++c) {
                result.set(x, y, c, shader::lodestar_linearFromSrgb(encoded.value(x, y, c)));
            }
            result.set(x, y, 3, encoded.value(x, y, 3));
        }
    }
    return result;
}

} // namespace

Texture::Texture(Device& device, unsigned target) : device_(&device), target_(target) {
    glGenTextures(1, &id_);
}

Texture::Texture(Texture&& other) noexcept {
    *this = std::move(other);
}

Texture& Texture::operator=(Texture&& other) noexcept {
    if (this != &other) {
        reset();
        device_ = std::exchange(other.device_, nullptr);
        id_ = std::exchange(other.id_, 0u);
        target_ = other.target_;
        width_ = other.width_;
        height_ = other.height_;
        format_ = other.format_;
        levelCount_ = other.levelCount_;
        scale_ = other.scale_;
        bytes_ = std::exchange(other.bytes_, 0u);
    }
    return *this;
}

Texture::~Texture() {
    reset();
}

void Texture::reset() {
    if (id_ != 0) {
        glDeleteTextures(1, &id_);
        device_->counters().textureBytes -= bytes_;
        id_ = 0;
        bytes_ = 0;
    }
}

Texture Texture::adopt(Device& device, unsigned id, unsigned target) {
    Texture texture;
    texture.device_ = &device;
    texture.id_ = id;
    texture.target_ = target;
    return texture;
}

unsigned Texture::release() {
    if (device_ != nullptr) {
        device_->counters().textureBytes -= bytes_;
    }
    bytes_ = 0;
    return std::exchange(id_, 0u);
}

core::Result<Texture> Texture::make2D(Device& device, const core::Texels& texels,
                                      TexelEncoding encoding, const SamplerState& sampler,
                                      const char* label) {
    LODESTAR_EXPECT(!texels.empty(), "a 2-D texture has texels");
    const bool wide = texels.depth() == core::SampleDepth::Bits16;
    const bool srgb = encoding == TexelEncoding::Srgb;
    const core::Texels decoded = wide && srgb ? linear(texels) : core::Texels();
    const std::vector<unsigned char>& bytes = decoded.empty() ? texels.bytes() : decoded.bytes();
    Texture texture(device, GL_TEXTURE_2D);
    texture.width_ = texels.width();
    glBindTexture(GL_TEXTURE_2D, texture.id_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    const GLint format = wide ? GL_RGBA16 : srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8;
    glTexImage2D(GL_TEXTURE_2D, 0, format, texels.width(), texels.height(), 0, GL_RGBA,
                 wide ? GL_UNSIGNED_SHORT : GL_UNSIGNED_BYTE, bytes.data());
    if (auto allocated = checkAllocation(label); !allocated) {
        return allocated.error();
    }
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, glWrap(sampler.wrapS));
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, glWrap(sampler.wrapT));
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER,
                    sampler.magnifyLinear ? GL_LINEAR : GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, glMinification(sampler));
    const std::size_t count = bytes.size() / (wide ? 8 : 4);
    texture.bytes_ = bytes.size();
    if (sampler.mipmapped) {
        glGenerateMipmap(GL_TEXTURE_2D);
        texture.bytes_ += bytes.size() / 3;
        ++device.counters().passes;
        device.counters().texelsWritten += count / 3;
    }
    setLabel(device, texture.id_, label);
    ++device.counters().uploads;
    device.counters().uploadBytes += bytes.size();
    device.counters().texelsWritten += count;
    device.counters().textureBytes += texture.bytes_;
    return texture;
}

core::Result<Texture> Texture::makeCube(Device& device, const lighting::Cubemap& map,
                                        const char* label) {
    LODESTAR_EXPECT(!map.empty(), "a cube texture takes a map with at least one level");
    const lighting::CubeTexels cube = lighting::cubeTexels(map);
    Texture texture(device, GL_TEXTURE_CUBE_MAP);
    texture.width_ = map.width();
    texture.levelCount_ = map.levelCount();
    texture.scale_ = cube.scale;
    glBindTexture(GL_TEXTURE_CUBE_MAP, texture.id_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (int level = 0; level < map.levelCount(); ++level) {
        uploadLevel(cube, level);
    }
    texture.bytes_ = cube.bytes();
    device.counters().texelsWritten += cube.texels();
    device.counters().uploads += static_cast<std::uint64_t>(6 * map.levelCount());
    device.counters().uploadBytes += texture.bytes_;
    if (auto allocated = checkAllocation(label); !allocated) {
        return allocated.error();
    }
    setCubeState(map.levelCount());
    setLabel(device, texture.id_, label);
    device.counters().textureBytes += texture.bytes_;
    return texture;
}

core::Result<Texture> Texture::makeCubeTarget(Device& device, int width, int levels,
                                              const char* label) {
    LODESTAR_EXPECT(width > 0 && levels > 0 && levels <= lighting::fullLevelCount(width),
                    "a cube target has texels and levels");
    (void)checkAllocation(label); // what was reported before is not this texture's
    if (!device.hasBytesFor(std::uint64_t{64} * static_cast<std::uint64_t>(width) *
                            static_cast<std::uint64_t>(width))) {
        return noMemoryFor(label);
    }
    Texture texture(device, GL_TEXTURE_CUBE_MAP);
    texture.width_ = width;
    texture.levelCount_ = levels;
    glBindTexture(GL_TEXTURE_CUBE_MAP, texture.id_);
    for (int level = 0; level < levels; ++level) {
        const GLsizei side = std::max(1, width >> level);
        for (GLenum face = 0; face < 6; ++face) {
            glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, level, GL_RGBA16F, side, side, 0,
                         GL_RGBA, GL_HALF_FLOAT, nullptr);
        }
        texture.bytes_ +=
            std::size_t{48} * static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    }
    if (auto allocated = checkAllocation(label); !allocated) {
        texture.bytes_ = 0;
        return allocated.error();
    }
    setCubeState(levels);
    setLabel(device, texture.id_, label);
    device.counters().textureBytes += texture.bytes_;
    return texture;
}

void Texture::readNearest(bool nearest) const {
    glBindTexture(target_, id_);
    glTexParameteri(target_, GL_TEXTURE_MAG_FILTER, nearest ? GL_NEAREST : GL_LINEAR);
    glTexParameteri(target_, GL_TEXTURE_MIN_FILTER, nearest ? GL_NEAREST : GL_LINEAR_MIPMAP_LINEAR);
}

void Texture::showLevels(int first, int last) const {
    glBindTexture(target_, id_);
    glTexParameteri(target_, GL_TEXTURE_BASE_LEVEL, first);
    glTexParameteri(target_, GL_TEXTURE_MAX_LEVEL, last);
}

namespace {

struct GlFormat {
    GLint internal;
    GLenum format;
    GLenum type;
    std::size_t bytes; ///< a texel
};

GlFormat glFormat(ArrayFormat format) {
    switch (format) {
    case ArrayFormat::Rgba8:
        return {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4};
    case ArrayFormat::Rgb9E5:
        return {GL_RGB9_E5, GL_RGB, GL_UNSIGNED_INT_5_9_9_9_REV, 4};
    case ArrayFormat::Rgba16F:
        return {GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, 8};
    case ArrayFormat::Rgba32F:
        break;
    }
    return {GL_RGBA32F, GL_RGBA, GL_FLOAT, 16};
}

void setArrayState(GLenum target, GLint wrap) {
    glTexParameteri(target, GL_TEXTURE_MAX_LEVEL, 0);
    glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(target, GL_TEXTURE_WRAP_S, wrap);
    glTexParameteri(target, GL_TEXTURE_WRAP_T, wrap);
}

} // namespace

core::Result<Texture> Texture::makeTarget(Device& device, int width, int height, ArrayFormat format,
                                          bool linear, const char* label) {
    Texture texture(device, GL_TEXTURE_2D);
    texture.width_ = width;
    texture.height_ = height;
    texture.format_ = format;
    const GlFormat gl = glFormat(format);
    const std::size_t bytes =
        gl.bytes * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    const std::vector<std::uint8_t> black(bytes);
    glBindTexture(GL_TEXTURE_2D, texture.id_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, gl.internal, width, height, 0, gl.format, gl.type, black.data());
    if (auto allocated = checkAllocation(label); !allocated) {
        return allocated.error();
    }
    setArrayState(GL_TEXTURE_2D, GL_CLAMP_TO_EDGE);
    if (!linear) {
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    setLabel(device, texture.id_, label);
    texture.bytes_ = bytes;
    device.counters().textureBytes += bytes;
    return texture;
}

core::Result<void> Texture::allocateArray(int layers, const char* label) {
    LODESTAR_EXPECT(width_ > 0 && height_ > 0 && layers > 0, "an array has texels and layers");
    const GlFormat gl = glFormat(format_);
    const std::vector<std::uint8_t> black(gl.bytes * static_cast<std::size_t>(width_) *
                                          static_cast<std::size_t>(height_) *
                                          static_cast<std::size_t>(layers));
    glBindTexture(target_, id_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    if (target_ == GL_TEXTURE_1D_ARRAY) {
        glTexImage2D(target_, 0, gl.internal, width_, layers, 0, gl.format, gl.type, black.data());
    } else {
        glTexImage3D(target_, 0, gl.internal, width_, height_, layers, 0, gl.format, gl.type,
                     black.data());
    }
    if (auto allocated = checkAllocation(label); !allocated) {
        return allocated;
    }
    bytes_ = black.size();
    setArrayState(target_, GL_CLAMP_TO_EDGE);
    setLabel(*device_, id_, label);
    device_->counters().textureBytes += bytes_;
    return {};
}

core::Result<Texture> Texture::makeArray(Device& device, int width, int height, int layers,
                                         ArrayFormat format, const char* label) {
    Texture texture(device, GL_TEXTURE_2D_ARRAY);
    texture.width_ = width;
    texture.height_ = height;
    texture.format_ = format;
    if (auto allocated = texture.allocateArray(layers, label); !allocated) {
        return allocated.error();
    }
    return texture;
}

core::Result<Texture> Texture::makeLineArray(Device& device, int width, int layers,
                                             ArrayFormat format, const char* label) {
    Texture texture(device, GL_TEXTURE_1D_ARRAY);
    texture.width_ = width;
    texture.height_ = 1;
    texture.format_ = format;
    if (auto allocated = texture.allocateArray(layers, label); !allocated) {
        return allocated.error();
    }
    return texture;
}

void Texture::updateLayer(int layer, std::span<const std::uint8_t> texels) {
    const GlFormat gl = glFormat(format_);
    const std::size_t count = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    LODESTAR_EXPECT((target_ == GL_TEXTURE_2D_ARRAY || target_ == GL_TEXTURE_1D_ARRAY) &&
                        texels.size() == count * gl.bytes,
                    "a layer's texels are of the array's size and format");
    glBindTexture(target_, id_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    if (target_ == GL_TEXTURE_1D_ARRAY) {
        glTexSubImage2D(target_, 0, 0, layer, width_, 1, gl.format, gl.type, texels.data());
    } else {
        glTexSubImage3D(target_, 0, 0, 0, layer, width_, height_, 1, gl.format, gl.type,
                        texels.data());
    }
    ++device_->counters().uploads;
    device_->counters().uploadBytes += texels.size();
    device_->counters().texelsWritten += count;
}

core::Result<Texture> Texture::makeDepthArray(Device& device, int side, int layers,
                                              const char* label) {
    Texture texture(device, GL_TEXTURE_2D_ARRAY);
    texture.width_ = side;
    texture.height_ = side;
    glBindTexture(GL_TEXTURE_2D_ARRAY, texture.id_);
    glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, GL_DEPTH_COMPONENT32F, side, side, layers, 0,
                 GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
    if (auto allocated = checkAllocation(label); !allocated) {
        return allocated.error();
    }
    setArrayState(GL_TEXTURE_2D_ARRAY, GL_CLAMP_TO_BORDER);
    constexpr float kFar[4] = {1.0f, 1.0f, 1.0f, 1.0f};
    glTexParameterfv(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BORDER_COLOR, kFar);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    setLabel(device, texture.id_, label);
    texture.bytes_ = 4 * static_cast<std::size_t>(side) * static_cast<std::size_t>(side) *
                     static_cast<std::size_t>(layers);
    device.counters().textureBytes += texture.bytes_;
    return texture;
}

namespace {

void allocateTarget(GLint format, GLenum layout, int width, int height) {
    glTexImage2D(GL_TEXTURE_2D, 0, format, width, height, 0, layout, GL_FLOAT, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

} // namespace

core::Result<Texture> Texture::makeColorTarget(Device& device, int width, int height) {
    Texture texture(device, GL_TEXTURE_2D);
    texture.width_ = width;
    glBindTexture(GL_TEXTURE_2D, texture.id_);
    allocateTarget(GL_RGBA32F, GL_RGBA, width, height);
    if (auto allocated = checkAllocation("frame colour"); !allocated) {
        return allocated.error();
    }
    texture.bytes_ = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 16;
    device.counters().textureBytes += texture.bytes_;
    return texture;
}

core::Result<Texture> Texture::makeDepthTarget(Device& device, int width, int height) {
    Texture texture(device, GL_TEXTURE_2D);
    texture.width_ = width;
    glBindTexture(GL_TEXTURE_2D, texture.id_);
    allocateTarget(GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, width, height);
    if (auto allocated = checkAllocation("frame depth"); !allocated) {
        return allocated.error();
    }
    texture.bytes_ = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4;
    device.counters().textureBytes += texture.bytes_;
    return texture;
}

void Texture::bind(int unit) const {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(target_, id_);
}

} // namespace lodestar::gl

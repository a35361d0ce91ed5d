// SPDX-License-Identifier: MIT
#include "gl/buffer.h"

#include <cstdint>
#include <utility>

#include <epoxy/gl.h>

#include "core/contract.h"

namespace lodestar::gl {
namespace {

GLenum glTarget(BufferKind kind) {
    switch (kind) {
    case BufferKind::Index:
        return GL_ELEMENT_ARRAY_BUFFER;
    case BufferKind::Uniform:
        return GL_UNIFORM_BUFFER;
    case BufferKind::Texel:
        return GL_TEXTURE_BUFFER;
    case BufferKind::Vertex:
        break;
    }
    return GL_ARRAY_BUFFER;
}

} // namespace

Buffer::Buffer(Device& device, BufferKind kind, std::span<const std::byte> bytes)
    : device_(&device), kind_(kind) {
    glGenBuffers(1, &id_);
    update(bytes);
}

Buffer::Buffer(Device& device, BufferKind kind, std::size_t size)
    : device_(&device), kind_(kind), size_(size) {
    glGenBuffers(1, &id_);
    const GLenum target = kind == BufferKind::Index ? GL_ARRAY_BUFFER : glTarget(kind);
    glBindBuffer(target, id_);
    glBufferData(target, static_cast<GLsizeiptr>(size), nullptr, GL_STATIC_DRAW);
}

Buffer::Buffer(Buffer&& other) noexcept {
    *this = std::move(other);
}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(kind_, other.kind_);
    std::swap(id_, other.id_);
    std::swap(size_, other.size_);
    return *this;
}

Buffer::~Buffer() {
    if (id_ != 0) {
        glDeleteBuffers(1, &id_);
    }
}

void Buffer::update(std::span<const std::byte> bytes) {
    // An index buffer binding belongs to a vertex array: fill through a target that does not.
    const GLenum target = kind_ == BufferKind::Index ? GL_ARRAY_BUFFER : glTarget(kind_);
    glBindBuffer(target, id_);
    if (bytes.size() > size_) {
        glBufferData(target, static_cast<GLsizeiptr>(bytes.size()), bytes.data(),
                     kind_ == BufferKind::Uniform || kind_ == BufferKind::Texel ? GL_DYNAMIC_DRAW
                                                                                : GL_STATIC_DRAW);
        size_ = bytes.size();
    } else {
        glBufferSubData(target, 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
    }
    ++device_->counters().uploads;
    device_->counters().uploadBytes += bytes.size();
}

void Buffer::updatePart(std::size_t offset, std::span<const std::byte> bytes) {
    LODESTAR_EXPECT(offset + bytes.size() <= size_, "a part lies within the buffer");
    const GLenum target = kind_ == BufferKind::Index ? GL_ARRAY_BUFFER : glTarget(kind_);
    glBindBuffer(target, id_);
    glBufferSubData(target, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes.size()),
                    bytes.data());
    ++device_->counters().uploads;
    device_->counters().uploadBytes += bytes.size();
}

void Buffer::bindBlock(unsigned binding, std::size_t offset, std::size_t size) const {
    glBindBufferRange(GL_UNIFORM_BUFFER, binding, id_, static_cast<GLintptr>(offset),
                      static_cast<GLsizeiptr>(size));
}

void Buffer::bindBlock(unsigned binding) const {
    glBindBufferBase(GL_UNIFORM_BUFFER, binding, id_);
}

void Buffer::bind() const {
    glBindBuffer(glTarget(kind_), id_);
}

VertexArray::VertexArray(Device&) {
    glGenVertexArrays(1, &id_);
}

VertexArray::VertexArray(VertexArray&& other) noexcept {
    *this = std::move(other);
}

VertexArray& VertexArray::operator=(VertexArray&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
}

VertexArray::~VertexArray() {
    if (id_ != 0) {
        glDeleteVertexArrays(1, &id_);
    }
}

void VertexArray::setAttribute(Attribute attribute, const Buffer& buffer, int components,
                               int first) {
    const auto location = static_cast<GLuint>(attribute);
    bind();
    buffer.bind();
    glEnableVertexAttribArray(location);
    const auto offset = static_cast<std::uintptr_t>(first) *
                        static_cast<std::uintptr_t>(components) * sizeof(float);
    glVertexAttribPointer(location, components, GL_FLOAT, GL_FALSE, 0,
                          reinterpret_cast<const void*>(offset));
}

void VertexArray::setIndices(const Buffer& buffer) {
    bind();
    buffer.bind();
}

void VertexArray::bind() const {
    glBindVertexArray(id_);
}

void drawIndexed(Device& device, DrawMode mode, const IndexRange& indices, int instances) {
    const GLenum glMode = mode == DrawMode::Points  ? GL_POINTS
                          : mode == DrawMode::Lines ? GL_LINES
                                                    : GL_TRIANGLES;
    const void* first = reinterpret_cast<const void*>(static_cast<std::uintptr_t>(indices.first) *
                                                      sizeof(std::uint32_t));
    if (instances == 1) {
        glDrawElementsBaseVertex(glMode, indices.count, GL_UNSIGNED_INT, first, indices.baseVertex);
    } else {
        glDrawElementsInstancedBaseVertex(glMode, indices.count, GL_UNSIGNED_INT, first, instances,
                                          indices.baseVertex);
    }
    ++device.counters().draws;
}

void drawFullScreen(Device& device, int instances) {
    glDrawArraysInstanced(GL_TRIANGLES, 0, 3, instances);
    ++device.counters().draws;
}

} // namespace lodestar::gl

// SPDX-License-Identifier: MIT
//
// Vertex, index, uniform and texel buffers, and vertex arrays. Move-only.
#pragma once

#include <cstddef>
#include <span>

#include "gl/device.h"

namespace lodestar::gl {

enum class BufferKind { Vertex, Index, Uniform, Texel };

class Buffer {
public:
    Buffer() = default;
    /// Makes a buffer of the bytes.
    Buffer(Device& device, BufferKind kind, std::span<const std::byte> bytes);
    /// Makes a buffer of a size whose content is not defined yet.
    Buffer(Device& device, BufferKind kind, std::size_t size);
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;
    ~Buffer();

    /// Replaces the content; the storage grows if it must.
    void update(std::span<const std::byte> bytes);
    /// Replaces a part of the content. @pre it lies within what the buffer has held
    void updatePart(std::size_t offset, std::span<const std::byte> bytes);
    /// Binds a uniform buffer to a block's binding point.
    void bindBlock(unsigned binding) const;
    /// The same with a part of it. @pre offset is a multiple of Capabilities::uniformAlignment
    void bindBlock(unsigned binding, std::size_t offset, std::size_t size) const;
    void bind() const;
    [[nodiscard]] unsigned id() const { return id_; }

private:
    Device* device_ = nullptr;
    BufferKind kind_ = BufferKind::Vertex;
    unsigned id_ = 0;
    std::size_t size_ = 0;
};

/// Attribute locations shared by C++ and shaders/host/mesh.vert.
enum class Attribute : unsigned {
    Position = 0,
    Normal = 1,
    Tangent = 2,
    Uv0 = 3,
    Uv1 = 4,
    Color = 5,
    Joints0 = 6,
    Weights0 = 7,
    Joints1 = 8,
    Weights1 = 9
};

class VertexArray {
public:
    VertexArray() = default;
    explicit VertexArray(Device& device);
    VertexArray(VertexArray&& other) noexcept;
    VertexArray& operator=(VertexArray&& other) noexcept;
    ~VertexArray();

    /// Adds a float attribute of 1 to 4 components, tightly packed in its buffer.
    /// @param first vertex, of those in the buffer
    void setAttribute(Attribute attribute, const Buffer& buffer, int components, int first = 0);
    void setIndices(const Buffer& buffer);
    void bind() const;

private:
    unsigned id_ = 0;
};

enum class DrawMode { Points, Lines, Triangles };
/// Indices of a buffer, and what is added to each.
struct IndexRange {
    int first = 0;
    int count = 0;
    int baseVertex = 0;
};
/// Draws indexed triangles (or lines, points) of 32-bit indices from the bound vertex array.
void drawIndexed(Device& device, DrawMode mode, const IndexRange& indices, int instances = 1);
/// Draws one triangle that covers the viewport; the vertex shader makes it from gl_VertexID.
void drawFullScreen(Device& device, int instances = 1);

} // namespace lodestar::gl

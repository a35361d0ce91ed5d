// SPDX-License-Identifier: MIT
//
// A uniform block on the GPU that is uploaded when it is another than before.
#pragma once

#include <cstring>
#include <span>
#include <type_traits>

#include "gl/buffer.h"

namespace lodestar::scene {

/// @tparam Block a struct of blocks.glsl: no padding, all its bytes are values
template <class Block>
class UniformBlock {
public:
    explicit UniformBlock(gl::Device& device)
        : buffer_(device, gl::BufferKind::Uniform, bytesOf(held_)) {}

    void set(const Block& block) {
        if (std::memcmp(&block, &held_, sizeof block) != 0) {
            held_ = block;
            buffer_.update(bytesOf(held_));
        }
    }
    void bind(unsigned binding) const { buffer_.bindBlock(binding); }

private:
    static_assert(std::is_trivially_copyable_v<Block>);
    static std::span<const std::byte> bytesOf(const Block& block) {
        return std::as_bytes(std::span(&block, 1));
    }
    Block held_{};
    gl::Buffer buffer_;
};

} // namespace lodestar::scene

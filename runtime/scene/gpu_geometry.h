// SPDX-License-Identifier: MIT
//
// A scene's vertices and indices on the GPU. Primitives of the same attributes lie one behind the
// other in shared buffers, a pool, so that draws of different meshes need no other vertex array.
#pragma once

#include <vector>

#include "gl/buffer.h"
#include "scene/scene.h"

namespace lodestar::scene {

/// Where a primitive lies.
struct GpuPrimitive {
    std::size_t pool = 0;
    gl::DrawMode mode = gl::DrawMode::Triangles;
    gl::IndexRange indices; ///< in the pool's
};

class GpuGeometry {
public:
    /// An attribute of a pool's vertices.
    struct Stored {
        gl::Attribute attribute = gl::Attribute::Position;
        int components = 0;
        gl::Buffer buffer{};
    };
    struct Pool {
        std::vector<Stored> attributes;
        gl::Buffer indices;
        gl::VertexArray vertices;
    };

    GpuGeometry() = default;
    GpuGeometry(gl::Device& device, const Scene& scene);

    [[nodiscard]] const GpuPrimitive& primitive(int mesh, int part) const {
        return meshes_[static_cast<std::size_t>(mesh)][static_cast<std::size_t>(part)];
    }
    [[nodiscard]] const Pool& pool(const GpuPrimitive& primitive) const {
        return pools_[primitive.pool];
    }

private:
    std::vector<std::vector<GpuPrimitive>> meshes_;
    std::vector<Pool> pools_;
};

} // namespace lodestar::scene

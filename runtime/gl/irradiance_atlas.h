// SPDX-License-Identifier: MIT
//
// The irradiance of light probes, a tile each, in one texture: a shader reads any of them through
// one unit. Move-only.
#pragma once

#include <glm/vec2.hpp>

#include "gl/texture.h"

namespace lodestar::gl {

/// A tile's texels: lodestar_irradianceTexel's square, beneath it rows for other values of the
/// probe.
inline constexpr int kTileWidth = 25;
inline constexpr int kTileHeight = 27;

class IrradianceAtlas {
public:
    IrradianceAtlas() = default;
    /// @errors NoOpenGl if the driver has no memory or cannot render to it
    [[nodiscard]] static core::Result<IrradianceAtlas> make(Device& device);
    IrradianceAtlas(IrradianceAtlas&& other) noexcept;
    IrradianceAtlas& operator=(IrradianceAtlas&& other) noexcept;
    ~IrradianceAtlas();

    /// Takes a tile more; the texture grows by half of its rows again and keeps what it holds.
    /// @return its number  @errors NoOpenGl if the driver has no memory for more
    [[nodiscard]] core::Result<int> add();
    /// The first texel of a tile.
    [[nodiscard]] glm::ivec2 tile(int number) const;
    /// Binds a tile's square to draw in, or the rows beneath it, not cleared. Counts a pass.
    void begin(int number);
    void beginRows(int number);
    [[nodiscard]] const Texture& texture() const { return texture_; }

private:
    [[nodiscard]] core::Result<void> allocate(int rows);
    void beginAt(int number, int first, int end);

    Device* device_ = nullptr;
    unsigned id_ = 0; ///< framebuffer of the texture
    Texture texture_;
    int rows_ = 0;
    int tiles_ = 0;
};

} // namespace lodestar::gl

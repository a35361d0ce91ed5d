// SPDX-License-Identifier: MIT
//
// Textures, move-only. A moved-from texture holds no GL object.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/result.h"
#include "core/texels.h"
#include "gl/device.h"
#include "lighting/cubemap.h"

namespace lodestar::gl {

enum class Wrap { Repeat, MirroredRepeat, ClampToEdge };

/// How a 2-D texture is read.
struct SamplerState {
    Wrap wrapS = Wrap::Repeat;
    Wrap wrapT = Wrap::Repeat;
    bool magnifyLinear = true;
    bool minifyLinear = true;
    bool mipmapped = true;
    bool mipLinear = true;
};

/// What texels mean.
enum class TexelEncoding { Linear, Srgb };

/// How the texels of an array lie in memory.
enum class ArrayFormat {
    Rgba8,   ///< GL_UNSIGNED_BYTE
    Rgb9E5,  ///< GL_UNSIGNED_INT_5_9_9_9_REV
    Rgba16F, ///< GL_HALF_FLOAT
    Rgba32F, ///< GL_FLOAT
};

class Texture {
public:
    Texture() = default;
    Texture(Texture&& other) noexcept;
    Texture& operator=(Texture&& other) noexcept;
    ~Texture();

    /// An RGBA texture of the texels' depth, mipmapped as the sampler says. It gives linear values;
    /// sRGB of 8 bits is decoded by the GPU, of 16 bits, which it does not know, here.
    /// @pre not empty
    [[nodiscard]] static core::Result<Texture> make2D(Device& device, const core::Texels& texels,
                                                      TexelEncoding encoding,
                                                      const SamplerState& sampler,
                                                      const char* label);
    /// A cube with all levels of the map, sampled seamlessly and trilinearly. Half floats with a
    /// power-of-two scale where the largest value allows it, else floats: nothing is clamped.
    [[nodiscard]] static core::Result<Texture>
    makeCube(Device& device, const lighting::Cubemap& map, const char* label);
    /// A cube of half floats that passes draw into, sampled seamlessly and trilinearly. Its texels
    /// are not defined yet. @pre levels in [1, fullLevelCount(width)]
    [[nodiscard]] static core::Result<Texture> makeCubeTarget(Device& device, int width, int levels,
                                                              const char* label);
    /// A texture that passes draw into, filtered linearly or not, clamped at its edges; black.
    [[nodiscard]] static core::Result<Texture> makeTarget(Device& device, int width, int height,
                                                          ArrayFormat format, bool linear,
                                                          const char* label);
    /// Layers of one size, filtered linearly within each, clamped at their edges; black until
    /// `updateLayer`.
    [[nodiscard]] static core::Result<Texture> makeArray(Device& device, int width, int height,
                                                         int layers, ArrayFormat format,
                                                         const char* label);
    /// The same of lines, a layer each (GL_TEXTURE_1D_ARRAY): half the taps of a filtered fetch.
    [[nodiscard]] static core::Result<Texture> makeLineArray(Device& device, int width, int layers,
                                                             ArrayFormat format, const char* label);
    /// Replaces a layer of an array. @pre the bytes are width x height texels of its format
    void updateLayer(int layer, std::span<const std::uint8_t> texels);
    /// Layers of depths, read by comparison (GL_LEQUAL) with linear filtering; 1 beyond the edges.
    [[nodiscard]] static core::Result<Texture> makeDepthArray(Device& device, int side, int layers,
                                                              const char* label);
    /// A float colour target and a depth target, one level, not filtered.
    [[nodiscard]] static core::Result<Texture> makeColorTarget(Device& device, int width,
                                                               int height);
    [[nodiscard]] static core::Result<Texture> makeDepthTarget(Device& device, int width,
                                                               int height);

    /// Takes over a texture made elsewhere. @param target a GL texture target
    [[nodiscard]] static Texture adopt(Device& device, unsigned id, unsigned target);
    /// Gives the GL object up; the caller deletes it.
    [[nodiscard]] unsigned release();

    [[nodiscard]] unsigned id() const { return id_; }
    [[nodiscard]] explicit operator bool() const { return id_ != 0; }
    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int levelCount() const { return levelCount_; }
    /// What a fetched value is multiplied by to be radiance; 1 but for scaled cubes.
    [[nodiscard]] float scale() const { return scale_; }

    [[nodiscard]] int height() const { return height_; }

    void bind(int unit) const;
    /// Lets lookups see a range of levels alone. @pre a cube target
    void showLevels(int first, int last) const;
    /// Fetches read the nearest texel from now on, or between texels and levels, as a cube is made.
    /// Leaves it bound to the unit that is active. @pre a cube
    void readNearest(bool nearest) const;

private:
    Texture(Device& device, unsigned target);
    [[nodiscard]] core::Result<void> allocateArray(int layers, const char* label);
    void reset();

    Device* device_ = nullptr;
    unsigned id_ = 0;
    unsigned target_ = 0;
    int width_ = 0;
    int height_ = 0; ///< of an array, as its format
    ArrayFormat format_ = ArrayFormat::Rgba8;
    int levelCount_ = 1;
    float scale_ = 1.0f;
    std::size_t bytes_ = 0;
};

} // namespace lodestar::gl

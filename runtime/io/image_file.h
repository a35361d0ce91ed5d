// SPDX-License-Identifier: MIT
//
// Images on disk: EXR through OpenImageIO, Radiance HDR, PNG through libpng, JPEG through libjpeg.
// Panoramas and renders are float pixels, textures' images are texels of the file's own depth.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "core/image.h"
#include "core/result.h"
#include "core/tally.h"
#include "core/texels.h"
#include "io/file.h"

namespace lodestar::io {

inline constexpr int kMaxImageSide = 16384;
inline constexpr std::size_t kMaxDecodedBytes = std::size_t{256} << 20;

/// Which environment layout an EXR's header declares.
enum class DeclaredLayout { None, LatLong, Cube };

struct ImageInfo {
    std::string format; ///< "openexr", "hdr", "png", "jpeg"
    int width = 0;
    int height = 0;
    int channels = 0;
    int bits = 0; ///< of a sample once decoded: 8, 16, or 32 (float)
    DeclaredLayout layout = DeclaredLayout::None;
};

struct DecodedImage {
    core::Image
        image; ///< as stored: linear for EXR and HDR, encoded as in the file for PNG and JPEG
    ImageInfo info;
};

/// Decodes an image from memory; the format is told by its first bytes, of the four above only.
/// Sizes are checked against the limits before any pixel is allocated.
/// @param channels wanted count, 1 to 4: grey is spread, missing alpha is 1; 0 keeps the file's (at
/// most 4)
/// @errors InputRefused
[[nodiscard]] core::Result<DecodedImage> decodeImage(const Bytes& bytes, int channels);

/// The same for a texture: texels of 16 bits where the file has more than 8, encoded as in the
/// file; grey is spread, missing alpha is 1. Floats (EXR, HDR) are clamped to [0, 1].
/// @errors InputRefused
[[nodiscard]] core::Result<core::Texels> decodeTexels(const Bytes& bytes);

/// Header only. @errors as decodeImage
[[nodiscard]] core::Result<ImageInfo> imageInfo(const Bytes& bytes);

/// Texts of a file's header, by name.
using ImageTexts = std::map<std::string, std::string>;

/// Writes linear float pixels as EXR (half or float), or encoded [0, 1] pixels as 8-bit PNG, by the
/// path's extension; whole or not at all. Non-finite pixels are a contract violation: the renderer
/// has none. @param texts string attributes of an EXR  @errors OutputFailed
[[nodiscard]] core::Result<void> writeImage(const std::filesystem::path& path,
                                            const core::Image& image, const ImageTexts& texts = {});

} // namespace lodestar::io

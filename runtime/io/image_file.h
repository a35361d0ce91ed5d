// SPDX-License-Identifier: MIT
//
// Images on disk, through OpenImageIO: EXR, Radiance HDR, PNG, JPEG.
#pragma once

#include <filesystem>
#include <string>

#include "core/image.h"
#include "core/result.h"
#include "core/tally.h"
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

/// Header only. @errors as decodeImage
[[nodiscard]] core::Result<ImageInfo> imageInfo(const Bytes& bytes);

/// Writes linear float pixels as EXR (half or float), or encoded [0, 1] pixels as 8-bit PNG, by the
/// path's extension; whole or not at all. Non-finite pixels are a contract violation: the renderer
/// has none. @errors OutputFailed
[[nodiscard]] core::Result<void> writeImage(const std::filesystem::path& path,
                                            const core::Image& image);

} // namespace lodestar::io

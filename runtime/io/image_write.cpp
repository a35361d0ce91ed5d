// SPDX-License-Identifier: MIT
//
// Images are encoded into memory and written by writeFile: OpenImageIO's PNG writer reports success
// on a full disk, and a half-written file must never stand under the final name.
#include <algorithm>
#include <cctype>
#include <cmath>

#include "io/image_codec.h"
#include "io/image_file.h"

namespace lodestar::io {
namespace {

core::Error failed(const std::filesystem::path& path, std::string what) {
    return {core::ErrorCode::OutputFailed, std::move(what), path.string(), {}};
}

} // namespace

core::Result<void> writeImage(const std::filesystem::path& path, const core::Image& image,
                              const ImageTexts& texts) {
    LODESTAR_EXPECT(!image.empty(), "an image to write has pixels");
    LODESTAR_EXPECT(std::all_of(image.pixels().begin(), image.pixels().end(),
                                [](float value) { return std::isfinite(value); }),
                    "an image to write holds finite numbers only");
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension != ".exr" && extension != ".png") {
        return failed(path, "an image is written as .exr or .png, by the name's ending");
    }
    const core::Result<const ImageCodec*> codec = imageCodec();
    if (!codec) {
        return codec.error();
    }
    core::Result<Bytes> bytes =
        (*codec)->encode(image, extension == ".png" ? "png" : "openexr", texts);
    if (!bytes) {
        return core::inFile(bytes.error(), path.string());
    }
    return writeFile(path, bytes->data(), bytes->size());
}

} // namespace lodestar::io

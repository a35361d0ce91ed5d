// SPDX-License-Identifier: MIT
//
// Images are encoded into memory and written by writeFile: OpenImageIO's PNG writer reports success
// on a full disk, and a half-written file must never stand under the final name.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <exception>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "io/image_file.h"

namespace lodestar::io {
namespace {

core::Error failed(const std::filesystem::path& path, std::string what) {
    return {core::ErrorCode::OutputFailed, std::move(what), path.string(), {}};
}

std::vector<std::string> channelNames(int channels) {
    switch (channels) {
    case 1:
        return {"Y"};
    case 2:
        return {"Y", "A"};
    case 3:
        return {"R", "G", "B"};
    default:
        return {"R", "G", "B", "A"};
    }
}

/// [0, 1] to the nearest of 256 levels.
std::vector<unsigned char> quantised(const core::Image& image) {
    std::vector<unsigned char> levels(image.pixels().size());
    std::transform(image.pixels().begin(), image.pixels().end(), levels.begin(), [](float value) {
        return static_cast<unsigned char>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
    });
    return levels;
}

core::Result<void> encode(const std::filesystem::path& path, const core::Image& image,
                          const std::string& format, Bytes& bytes) {
    const bool png = format == "png";
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
    if (!output || !output->supports("ioproxy")) {
        static_cast<void>(OIIO::geterror());
        return failed(path, "OpenImageIO cannot write " + format + " into memory");
    }
    OIIO::ImageSpec spec(image.width(), image.height(), image.channels(),
                         png ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT);
    spec.channelnames = channelNames(image.channels());
    spec.alpha_channel = image.channels() % 2 == 0 ? image.channels() - 1 : -1;
    if (png) {
        spec.attribute("oiio:ColorSpace", "sRGB");
        spec.attribute("oiio:UnassociatedAlpha", 1);
    } else {
        spec.attribute("compression", "zip");
    }
    OIIO::Filesystem::IOVecOutput memory(bytes);
    output->set_ioproxy(&memory);
    const std::vector<unsigned char> levels = png ? quantised(image) : std::vector<unsigned char>();
    bool good = output->open(path.filename().string(), spec);
    good = good && (png ? output->write_image(OIIO::TypeDesc::UINT8, levels.data())
                        : output->write_image(OIIO::TypeDesc::FLOAT, image.pixels().data()));
    good = output->close() && good;
    const std::string message = output->has_error() ? output->geterror() : std::string();
    if (!good || !message.empty()) {
        return failed(path, "image cannot be encoded: " + (message.empty() ? format : message));
    }
    return {};
}

} // namespace

core::Result<void> writeImage(const std::filesystem::path& path, const core::Image& image) {
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
    Bytes bytes;
    try {
        core::Result<void> encoded =
            encode(path, image, extension == ".png" ? "png" : "openexr", bytes);
        if (!encoded) {
            return encoded;
        }
    } catch (const std::exception& exception) {
        return failed(path, std::string("image cannot be encoded: ") + exception.what());
    }
    return writeFile(path, bytes.data(), bytes.size());
}

} // namespace lodestar::io

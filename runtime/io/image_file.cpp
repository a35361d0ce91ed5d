// SPDX-License-Identifier: MIT
#include "io/image_file.h"

#include <algorithm>
#include <array>

#include "io/image_codec.h"
#include "io/image_internal.h"

namespace lodestar::io {
namespace detail {

core::Result<void> checkSize(std::int64_t width, std::int64_t height, std::size_t bytesPerPixel) {
    if (width < 1 || height < 1 || width > kMaxImageSide || height > kMaxImageSide) {
        return core::refused("image claims " + std::to_string(width) + " x " +
                             std::to_string(height) + " pixels; a side is 1 to " +
                             std::to_string(kMaxImageSide));
    }
    // At most 2^14 x 2^14 x 2^10: no overflow.
    const std::size_t decoded =
        static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * bytesPerPixel;
    if (decoded > kMaxDecodedBytes) {
        return core::refused("image of " + std::to_string(width) + " x " + std::to_string(height) +
                             " decodes to " + std::to_string(decoded >> 20) +
                             " MiB; the limit is " + std::to_string(kMaxDecodedBytes >> 20));
    }
    return {};
}

} // namespace detail

namespace {

using detail::ImageHeader;

enum class Format { Unknown, Exr, Hdr, Png, Jpeg };

bool startsWith(const Bytes& bytes, std::initializer_list<unsigned char> magic) {
    return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
}

Format formatOf(const Bytes& bytes) {
    if (startsWith(bytes, {0x76, 0x2f, 0x31, 0x01})) {
        return Format::Exr;
    }
    if (startsWith(bytes, {'#', '?'})) {
        return Format::Hdr;
    }
    if (startsWith(bytes, {0x89, 'P', 'N', 'G', 0x0d, 0x0a, 0x1a, 0x0a})) {
        return Format::Png;
    }
    return startsWith(bytes, {0xff, 0xd8, 0xff}) ? Format::Jpeg : Format::Unknown;
}

core::Error unknownFormat() {
    return core::refused("is not an image that is read: OpenEXR, Radiance HDR, PNG or JPEG");
}

core::Result<core::Image> decodeWithLibrary(const Bytes& bytes, const ImageInfo& info) {
    const core::Result<const ImageCodec*> codec = imageCodec();
    return codec ? (*codec)->decode(bytes, info) : core::Result<core::Image>(codec.error());
}

/// The same pixels with another count of channels.
core::Image withChannels(const core::Image& image, int channels) {
    core::Image result(image.width(), image.height(), channels);
    const int from = image.channels();
    const bool grey = from <= 2;
    // For each wanted channel the one it is copied from; -1 for an alpha that is not there.
    std::array<int, 4> source{0, grey ? 0 : 1, grey ? 0 : 2, from == 4 ? 3 : (from == 2 ? 1 : -1)};
    if (channels == 2) {
        source[1] = source[3];
    }
    const std::size_t count =
        static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
    const float* read = image.pixels().data();
    float* write = result.pixels().data();
    for (std::size_t i = 0; i < count; ++i, read += from) {
        for (int c = 0; c < channels; ++c) {
            const int at = source[static_cast<std::size_t>(c)];
            *write++ = at < 0 ? 1.0f : read[at];
        }
    }
    return result;
}

core::Result<core::Texels> decodeStored(Format format, const Bytes& bytes, ImageInfo& info) {
    const core::Result<detail::StrippedImage> stripped =
        format == Format::Png ? detail::pngHeader(bytes) : detail::jpegHeader(bytes);
    if (!stripped) {
        return stripped.error();
    }
    info = stripped->header.info;
    return format == Format::Png ? detail::decodePng(*stripped) : detail::decodeJpeg(*stripped);
}

/// Texels as floats, in the channels that the file has.
core::Image floatsOf(const core::Texels& texels, int channels) {
    core::Image image(texels.width(), texels.height(), channels);
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            for (int c = 0; c < channels; ++c) {
                const bool alpha = channels % 2 == 0 && c + 1 == channels;
                image.at(x, y)[c] = texels.value(x, y, alpha ? 3 : c);
            }
        }
    }
    return image;
}

core::Texels texelsOf(const core::Image& image) {
    core::Texels texels(image.width(), image.height(), core::SampleDepth::Bits16);
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            for (int c = 0; c < 4; ++c) {
                texels.set(x, y, c, image.at(x, y)[c]);
            }
        }
    }
    return texels;
}

core::Result<core::Image> decodeAs(Format format, const Bytes& bytes, ImageInfo& info) {
    if (format == Format::Unknown) {
        return unknownFormat();
    }
    if (format == Format::Png || format == Format::Jpeg) {
        const core::Result<core::Texels> texels = decodeStored(format, bytes, info);
        return texels ? floatsOf(*texels, info.channels)
                      : core::Result<core::Image>(texels.error());
    }
    core::Result<ImageHeader> header =
        format == Format::Exr ? detail::exrHeader(bytes) : detail::hdrHeader(bytes);
    if (!header) {
        return header.error();
    }
    info = header->info;
    return format == Format::Hdr ? detail::decodeHdr(bytes) : decodeWithLibrary(bytes, info);
}

} // namespace

core::Result<ImageInfo> imageInfo(const Bytes& bytes) {
    const auto infoOf = [](auto header) -> core::Result<ImageInfo> {
        if (!header) {
            return header.error();
        }
        if constexpr (requires { header->header; }) {
            return header->header.info;
        } else {
            return header->info;
        }
    };
    switch (formatOf(bytes)) {
    case Format::Exr:
        return infoOf(detail::exrHeader(bytes));
    case Format::Hdr:
        return infoOf(detail::hdrHeader(bytes));
    case Format::Png:
        return infoOf(detail::pngHeader(bytes));
    case Format::Jpeg:
        return infoOf(detail::jpegHeader(bytes));
    case Format::Unknown:
        break;
    }
    return unknownFormat();
}

core::Result<DecodedImage> decodeImage(const Bytes& bytes, int channels) {
    LODESTAR_EXPECT(channels >= 0 && channels <= 4, "1 to 4 channels, or 0 for the file's own");
    DecodedImage decoded;
    core::Result<core::Image> image = decodeAs(formatOf(bytes), bytes, decoded.info);
    if (!image) {
        return image.error();
    }
    decoded.info.channels = image->channels();
    decoded.image = channels == 0 || channels == image->channels() ? std::move(*image)
                                                                   : withChannels(*image, channels);
    return decoded;
}

core::Result<core::Texels> decodeTexels(const Bytes& bytes) {
    const Format format = formatOf(bytes);
    if (format == Format::Png || format == Format::Jpeg) {
        ImageInfo info;
        return decodeStored(format, bytes, info);
    }
    const core::Result<DecodedImage> decoded = decodeImage(bytes, 4);
    return decoded ? texelsOf(decoded->image) : core::Result<core::Texels>(decoded.error());
}

} // namespace lodestar::io

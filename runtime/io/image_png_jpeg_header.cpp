// SPDX-License-Identifier: MIT
//
// PNG and JPEG headers. Sources: PNG specification (W3C), chunks; ITU-T T.81, annex B, markers.
#include <algorithm>
#include <cstring>
#include <string_view>

#include "io/image_internal.h"

namespace lodestar::io::detail {
namespace {

constexpr std::size_t kPngSignatureBytes = 8;
/// Deflate packs at most 1032:1.
constexpr std::size_t kMaxDeflateRatio = 1100;
/// Pixels x scans of a progressive JPEG: 10 scans of 128 Mpixels; a scan of a tiny file can still
/// touch every pixel.
constexpr std::uint64_t kMaxJpegScanPixels = std::uint64_t{10} << 27;

struct PngShape {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    unsigned depth = 0;
    unsigned colorType = 0;
};

void append(Bytes& to, const Bytes& from, std::size_t begin, std::size_t end) {
    to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(begin),
              from.begin() + static_cast<std::ptrdiff_t>(end));
}

int pngChannels(unsigned colorType, bool transparency) {
    switch (colorType) {
    case 0:
        return transparency ? 2 : 1;
    case 2:
        return transparency ? 4 : 3;
    case 3:
        return transparency ? 4 : 3;
    case 4:
        return 2;
    case 6:
        return 4;
    default:
        return 0;
    }
}

core::Result<PngShape> readIhdr(ByteReader reader, std::uint32_t length) {
    PngShape shape;
    if (length != 13 || !reader.bigEndian(4, shape.width) || !reader.bigEndian(4, shape.height) ||
        !reader.byte(shape.depth) || !reader.byte(shape.colorType)) {
        return core::refused("damaged PNG: its first chunk is not a header");
    }
    if (pngChannels(shape.colorType, false) == 0) {
        return core::refused("PNG colour type " + std::to_string(shape.colorType) +
                             " does not exist");
    }
    if (shape.depth != 1 && shape.depth != 2 && shape.depth != 4 && shape.depth != 8 &&
        shape.depth != 16) {
        return core::refused("PNG bit depth " + std::to_string(shape.depth) + " does not exist");
    }
    core::Result<void> size = checkSize(
        shape.width, shape.height,
        static_cast<std::size_t>(pngChannels(shape.colorType, true)) * (shape.depth == 16 ? 2 : 1));
    if (!size) {
        return size.error();
    }
    return shape;
}

bool isSizeMarker(unsigned marker) {
    // SOF0..SOF15 without DHT (C4), JPG (C8) and DAC (CC).
    return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

bool isDroppedMarker(unsigned marker) {
    // Comments and application data, save JFIF (E0) and Adobe (EE), which say the colour space.
    return marker == 0xfe || (marker >= 0xe1 && marker <= 0xef && marker != 0xee);
}

core::Result<ImageInfo> readFrame(ByteReader reader) {
    std::uint32_t precision = 0;
    std::uint32_t height = 0;
    std::uint32_t width = 0;
    std::uint32_t components = 0;
    if (!reader.bigEndian(1, precision) || !reader.bigEndian(2, height) ||
        !reader.bigEndian(2, width) || !reader.bigEndian(1, components)) {
        return core::refused("JPEG is cut off in its frame header");
    }
    if (precision != 8) {
        return core::refused("JPEG with " + std::to_string(precision) + " bits; 8 are read");
    }
    if (components != 1 && components != 3 && components != 4) {
        return core::refused("JPEG with " + std::to_string(components) +
                             " components; 1, 3 or 4 are read");
    }
    core::Result<void> size = checkSize(width, height, components);
    if (!size) {
        return size.error();
    }
    return ImageInfo{"jpeg", static_cast<int>(width), static_cast<int>(height),
                     components == 1 ? 1 : 3, DeclaredLayout::None};
}

/// The end of a scan's entropy-coded data: the next marker that is neither stuffing nor restart.
std::size_t endOfScan(const Bytes& bytes, std::size_t position) {
    while (position + 1 < bytes.size()) {
        const auto* found = static_cast<const unsigned char*>(
            std::memchr(bytes.data() + position, 0xff, bytes.size() - 1 - position));
        if (found == nullptr) {
            break;
        }
        position = static_cast<std::size_t>(found - bytes.data());
        const unsigned next = bytes[position + 1];
        if (next != 0 && next != 0xff && (next < 0xd0 || next > 0xd7)) {
            return position;
        }
        position += next == 0xff ? 1 : 2;
    }
    return bytes.size();
}

} // namespace

core::Result<StrippedImage> pngHeader(const Bytes& bytes) {
    StrippedImage result;
    append(result.bytes, bytes, 0, std::min(kPngSignatureBytes, bytes.size()));
    ByteReader reader(bytes, std::min(kPngSignatureBytes, bytes.size()));
    PngShape shape;
    bool transparency = false;
    std::size_t dataBytes = 0;
    for (bool first = true;; first = false) {
        const std::size_t begin = reader.position();
        std::uint32_t length = 0;
        if (!reader.bigEndian(4, length) || reader.remaining() < std::size_t{length} + 8) {
            return core::refused("PNG is cut off", "byte " + std::to_string(begin));
        }
        const std::string type(bytes.begin() + static_cast<std::ptrdiff_t>(begin + 4),
                               bytes.begin() + static_cast<std::ptrdiff_t>(begin + 8));
        if (first) {
            core::Result<PngShape> read =
                type == "IHDR" ? readIhdr(ByteReader(bytes, begin + 8), length)
                               : core::refused("damaged PNG: its first chunk is not a header");
            if (!read) {
                return read.error();
            }
            shape = *read;
        }
        transparency = transparency || type == "tRNS";
        dataBytes += type == "IDAT" ? length : 0;
        static_cast<void>(reader.skip(std::size_t{length} + 8));
        if (type == "IHDR" || type == "PLTE" || type == "tRNS" || type == "IDAT" ||
            type == "IEND") {
            append(result.bytes, bytes, begin, reader.position());
        }
        if (type == "IEND") {
            break;
        }
    }
    const int channels = pngChannels(shape.colorType, transparency);
    const unsigned samples =
        shape.colorType == 3 ? 1U : static_cast<unsigned>(pngChannels(shape.colorType, false));
    const std::uint64_t packed =
        (std::uint64_t{shape.width} * samples * shape.depth + 7) / 8 * shape.height;
    if (dataBytes == 0 || packed / kMaxDeflateRatio > dataBytes) {
        return core::refused("PNG is cut off: " + std::to_string(dataBytes) +
                             " bytes of pixel data cannot hold the " + std::to_string(shape.width) +
                             " x " + std::to_string(shape.height) + " pixels it claims");
    }
    result.header.info = {"png", static_cast<int>(shape.width), static_cast<int>(shape.height),
                          channels, DeclaredLayout::None};
    return result;
}

core::Result<StrippedImage> jpegHeader(const Bytes& bytes) {
    StrippedImage result;
    append(result.bytes, bytes, 0, std::min<std::size_t>(2, bytes.size()));
    std::size_t position = result.bytes.size();
    std::uint64_t scans = 0;
    for (;;) {
        while (position + 1 < bytes.size() && bytes[position] == 0xff &&
               bytes[position + 1] == 0xff) {
            ++position; // fill bytes
        }
        if (position + 1 >= bytes.size() || bytes[position] != 0xff) {
            return core::refused("JPEG is cut off or damaged", "byte " + std::to_string(position));
        }
        const unsigned marker = bytes[position + 1];
        if (marker == 0xd9) {
            append(result.bytes, bytes, position, position + 2);
            break;
        }
        std::uint32_t length = 0;
        ByteReader reader(bytes, position + 2);
        if (!reader.bigEndian(2, length) || length < 2 || length - 2 > reader.remaining()) {
            return core::refused("JPEG is cut off or damaged", "byte " + std::to_string(position));
        }
        if (isSizeMarker(marker)) {
            core::Result<ImageInfo> info = readFrame(reader);
            if (!info) {
                return info.error();
            }
            result.header.info = *info;
        }
        std::size_t end = position + 2 + length;
        if (marker == 0xda) {
            end = endOfScan(bytes, end);
            ++scans;
        }
        if (!isDroppedMarker(marker)) {
            append(result.bytes, bytes, position, end);
        }
        position = end;
    }
    const ImageInfo& info = result.header.info;
    if (info.width == 0 || scans == 0) {
        return core::refused("JPEG without a picture");
    }
    if (scans * static_cast<std::uint64_t>(info.width) * static_cast<std::uint64_t>(info.height) >
        kMaxJpegScanPixels) {
        return core::refused("JPEG with " + std::to_string(scans) + " scans over " +
                             std::to_string(info.width) + " x " + std::to_string(info.height) +
                             " pixels, which is too much work");
    }
    return result;
}

} // namespace lodestar::io::detail

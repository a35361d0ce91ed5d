// SPDX-License-Identifier: MIT
//
// The JPEG header: sizes, and how much work its scans are. Source: ITU-T T.81, annex B.
#include <algorithm>
#include <cstring>

#include "io/image_internal.h"

namespace lodestar::io::detail {
namespace {

/// Pixels x scans of a progressive JPEG: 10 scans of 128 Mpixels; a scan of a tiny file can still
/// touch every pixel.
constexpr std::uint64_t kMaxJpegScanPixels = std::uint64_t{10} << 27;

void append(Bytes& to, const Bytes& from, std::size_t begin, std::size_t end) {
    to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(begin),
              from.begin() + static_cast<std::ptrdiff_t>(end));
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
    return ImageInfo{
        "jpeg", static_cast<int>(width), static_cast<int>(height), components == 1 ? 1 : 3,
        8,      DeclaredLayout::None};
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

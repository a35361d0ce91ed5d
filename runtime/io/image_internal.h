// SPDX-License-Identifier: MIT
//
// What the image_*.cpp share: headers read by our own bounded parsers, before any library sees the
// bytes, so that a file's claims are checked before memory is spent on them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/image_file.h"

namespace lodestar::io::detail {

/// Reads bytes with every step checked against the end.
class ByteReader {
public:
    explicit ByteReader(const Bytes& bytes, std::size_t position = 0)
        : bytes_(&bytes), position_(position) {}

    [[nodiscard]] std::size_t position() const { return position_; }
    [[nodiscard]] std::size_t remaining() const { return bytes_->size() - position_; }
    /// Moves on; false and no move where that is past the end.
    [[nodiscard]] bool skip(std::size_t count) {
        if (count > remaining()) {
            return false;
        }
        position_ += count;
        return true;
    }
    [[nodiscard]] bool byte(unsigned& value) {
        if (remaining() < 1) {
            return false;
        }
        value = (*bytes_)[position_++];
        return true;
    }
    [[nodiscard]] bool bigEndian(int count, std::uint32_t& value) {
        return number(count, value, true);
    }
    [[nodiscard]] bool littleEndian(int count, std::uint32_t& value) {
        return number(count, value, false);
    }
    /// A text ended by a zero byte, of at most maxLength bytes.
    [[nodiscard]] bool text(std::size_t maxLength, std::string& value) {
        value.clear();
        unsigned c = 0;
        while (byte(c)) {
            if (c == 0) {
                return true;
            }
            if (value.size() == maxLength) {
                return false;
            }
            value += static_cast<char>(c);
        }
        return false;
    }

private:
    bool number(int count, std::uint32_t& value, bool big) {
        if (static_cast<std::size_t>(count) > remaining()) {
            return false;
        }
        value = 0;
        for (int i = 0; i < count; ++i) {
            const std::uint32_t next = (*bytes_)[position_++];
            value = big ? (value << 8) | next : value | (next << (8 * i));
        }
        return true;
    }

    const Bytes* bytes_;
    std::size_t position_;
};

/// A header's claims, already checked by checkSize.
struct ImageHeader {
    ImageInfo info;
    std::vector<std::string> channelNames; ///< EXR only, in the file's order
};

/// Refuses sizes outside [1, kMaxImageSide] and more than kMaxDecodedBytes at the file's own sample
/// size.
[[nodiscard]] core::Result<void> checkSize(std::int64_t width, std::int64_t height,
                                           std::size_t bytesPerPixel);

[[nodiscard]] core::Result<ImageHeader> exrHeader(const Bytes& bytes);
[[nodiscard]] core::Result<ImageHeader> hdrHeader(const Bytes& bytes);

/// A PNG or JPEG header, and the file cut down to what pixels are made of: no profiles, comments or
/// camera data reach the decoders.
struct StrippedImage {
    ImageHeader header;
    Bytes bytes;
};
[[nodiscard]] core::Result<StrippedImage> pngHeader(const Bytes& bytes);
[[nodiscard]] core::Result<StrippedImage> jpegHeader(const Bytes& bytes);

/// Texels, encoded as in the file. @errors InputRefused
[[nodiscard]] core::Result<core::Texels> decodePng(const StrippedImage& png);
[[nodiscard]] core::Result<core::Texels> decodeJpeg(const StrippedImage& jpeg);

/// Pixels of a Radiance file, 3 channels.
[[nodiscard]] core::Result<core::Image> decodeHdr(const Bytes& bytes);

} // namespace lodestar::io::detail

// SPDX-License-Identifier: MIT
//
// The OpenEXR header. Source: "OpenEXR File Layout" (openexr.com). Only what bounds memory and time
// is checked here; the library checks the rest.
#include <algorithm>
#include <array>

#include "io/image_internal.h"

namespace lodestar::io::detail {
namespace {

constexpr std::uint32_t kTiledFlag = 0x200;
constexpr std::uint32_t kDeepFlag = 0x800;
constexpr std::uint32_t kMultiPartFlag = 0x1000;
constexpr int kMaxParts = 64;
constexpr int kMaxChannels = 256;
constexpr std::size_t kMaxTileBytes = std::size_t{64} << 20;
/// A chunk's entry in the offset table, and the least head of the chunk itself.
constexpr std::size_t kBytesPerChunk = 16;
/// Deflate packs at most 1032:1, and no other codec more tightly, save that DWA leaves one
/// coefficient of 64 before it deflates. A file shorter than that allows is cut off or lies.
constexpr std::size_t kMaxPackingRatio = 1100;
constexpr std::size_t kMaxDwaPackingRatio = 64 * kMaxPackingRatio;
constexpr std::uint32_t kFirstDwa = 8;
/// Scan lines in one chunk by compression 0..9: none, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A, DWAA,
/// DWAB.
constexpr std::array<int, 10> kLinesPerChunk{1, 1, 1, 16, 32, 16, 32, 32, 32, 256};

struct Part {
    bool hasChannels = false;
    bool hasDataWindow = false;
    bool hasCompression = false;
    bool hasTiles = false;
    std::int64_t width = 0;
    std::int64_t height = 0;
    std::size_t bytesPerPixel = 0;
    std::uint32_t compression = 0;
    std::uint32_t tileWidth = 0;
    std::uint32_t tileHeight = 0;
    std::vector<std::string> channels;
    DeclaredLayout layout = DeclaredLayout::None;
    std::string type;
};

core::Error damaged(const std::string& what, const ByteReader& reader) {
    return core::refused("damaged EXR header: " + what,
                         "byte " + std::to_string(reader.position()));
}

core::Result<void> readChannels(ByteReader reader, Part& part) {
    for (;;) {
        std::string name;
        if (!reader.text(255, name)) {
            return damaged("a channel's name has no end", reader);
        }
        if (name.empty()) {
            part.hasChannels = true;
            return {};
        }
        std::uint32_t pixelType = 0;
        std::uint32_t linear = 0;
        std::uint32_t xSampling = 0;
        std::uint32_t ySampling = 0;
        if (!reader.littleEndian(4, pixelType) || !reader.littleEndian(4, linear) ||
            !reader.littleEndian(4, xSampling) || !reader.littleEndian(4, ySampling)) {
            return damaged("the channel list is cut off", reader);
        }
        if (pixelType > 2) {
            return damaged("a channel is neither half, float nor integer", reader);
        }
        if (xSampling != 1 || ySampling != 1) {
            return core::refused("EXR channel '" + name +
                                 "' is subsampled; only full-resolution channels are read");
        }
        if (part.channels.size() == kMaxChannels) {
            return core::refused("EXR with more than " + std::to_string(kMaxChannels) +
                                 " channels");
        }
        part.channels.push_back(name);
        part.bytesPerPixel += pixelType == 1 ? 2U : 4U;
    }
}

/// The attributes that matter; `reader` stands at the value, which is `size` bytes long.
core::Result<void> readAttribute(const std::string& name, ByteReader reader, std::uint32_t size,
                                 const Bytes& bytes, Part& part) {
    if (name == "channels") {
        return readChannels(reader, part);
    }
    std::uint32_t value = 0;
    if (name == "dataWindow" && size == 16) {
        std::array<std::uint32_t, 4> box{};
        for (std::uint32_t& corner : box) {
            if (!reader.littleEndian(4, corner)) {
                return damaged("the data window is cut off", reader);
            }
        }
        const auto signedValue = [](std::uint32_t v) {
            return static_cast<std::int64_t>(static_cast<std::int32_t>(v));
        };
        part.width = signedValue(box[2]) - signedValue(box[0]) + 1;
        part.height = signedValue(box[3]) - signedValue(box[1]) + 1;
        part.hasDataWindow = true;
    } else if (name == "compression" && size == 1 && reader.littleEndian(1, value)) {
        part.compression = value;
        part.hasCompression = true;
    } else if (name == "tiles" && size == 9 && reader.littleEndian(4, part.tileWidth) &&
               reader.littleEndian(4, part.tileHeight)) {
        part.hasTiles = true;
    } else if (name == "envmap" && size == 1 && reader.littleEndian(1, value)) {
        part.layout = value == 0   ? DeclaredLayout::LatLong
                      : value == 1 ? DeclaredLayout::Cube
                                   : DeclaredLayout::None;
    } else if (name == "type") {
        part.type.assign(bytes.begin() + static_cast<std::ptrdiff_t>(reader.position()),
                         bytes.begin() + static_cast<std::ptrdiff_t>(reader.position() + size));
    }
    return {};
}

/// One header up to its closing zero; `empty` where the list of headers ends.
core::Result<Part> readPart(ByteReader& reader, const Bytes& bytes, bool& empty) {
    Part part;
    empty = true;
    for (;;) {
        std::string name;
        if (!reader.text(255, name)) {
            return damaged("an attribute's name has no end", reader);
        }
        if (name.empty()) {
            return part;
        }
        empty = false;
        std::string type;
        std::uint32_t size = 0;
        if (!reader.text(255, type) || !reader.littleEndian(4, size) || size > reader.remaining()) {
            return damaged("attribute '" + name + "' is cut off", reader);
        }
        core::Result<void> read = readAttribute(name, reader, size, bytes, part);
        if (!read) {
            return read.error();
        }
        if (!reader.skip(size)) {
            return damaged("attribute '" + name + "' is cut off", reader);
        }
    }
}

core::Result<void> checkPart(const Part& part, bool tiled, std::size_t fileSize,
                             const ByteReader& reader) {
    if (!part.hasChannels || part.channels.empty() || !part.hasDataWindow || !part.hasCompression) {
        return damaged("it lacks channels, dataWindow or compression", reader);
    }
    if (part.type.starts_with("deep")) {
        return core::refused("a deep EXR; only flat ones are read");
    }
    if (part.compression >= kLinesPerChunk.size()) {
        return core::refused("EXR compression " + std::to_string(part.compression) + " is unknown");
    }
    core::Result<void> size = checkSize(part.width, part.height, part.bytesPerPixel);
    if (!size) {
        return size;
    }
    const auto width = static_cast<std::size_t>(part.width);
    const auto height = static_cast<std::size_t>(part.height);
    std::size_t chunks = 0;
    if (tiled || part.type == "tiledimage") {
        if (!part.hasTiles || part.tileWidth < 1 || part.tileHeight < 1 ||
            part.tileWidth > static_cast<std::uint32_t>(kMaxImageSide) ||
            part.tileHeight > static_cast<std::uint32_t>(kMaxImageSide) ||
            std::size_t{part.tileWidth} * part.tileHeight * part.bytesPerPixel > kMaxTileBytes) {
            return damaged("its tile size is missing or out of range", reader);
        }
        chunks = ((width + part.tileWidth - 1) / part.tileWidth) *
                 ((height + part.tileHeight - 1) / part.tileHeight);
    } else {
        const auto lines = static_cast<std::size_t>(kLinesPerChunk[part.compression]);
        chunks = (height + lines - 1) / lines;
    }
    const std::size_t ratio =
        part.compression >= kFirstDwa ? kMaxDwaPackingRatio : kMaxPackingRatio;
    if (chunks > fileSize / kBytesPerChunk ||
        width * height * part.bytesPerPixel / ratio > fileSize) {
        return core::refused("EXR is cut off: " + std::to_string(fileSize) +
                             " bytes cannot hold the " + std::to_string(width) + " x " +
                             std::to_string(height) + " pixels it claims");
    }
    return {};
}

} // namespace

core::Result<ImageHeader> exrHeader(const Bytes& bytes) {
    ByteReader reader(bytes, 4);
    std::uint32_t version = 0;
    if (bytes.size() < 8 || !reader.littleEndian(4, version)) {
        return core::refused("EXR is cut off in its first 8 bytes");
    }
    if ((version & 0xffU) != 2) {
        return core::refused("EXR version " + std::to_string(version & 0xffU) +
                             "; version 2 is read");
    }
    if ((version & kDeepFlag) != 0) {
        return core::refused("a deep EXR; only flat ones are read");
    }
    const bool multiPart = (version & kMultiPartFlag) != 0;
    const bool tiled = !multiPart && (version & kTiledFlag) != 0;
    ImageHeader header;
    for (int i = 0; i < (multiPart ? kMaxParts : 1); ++i) {
        bool empty = false;
        core::Result<Part> part = readPart(reader, bytes, empty);
        if (!part) {
            return part.error();
        }
        if (multiPart && empty && i > 0) {
            return header;
        }
        core::Result<void> checked = checkPart(*part, tiled, bytes.size(), reader);
        if (!checked) {
            return checked.error();
        }
        if (i == 0) {
            const int channels = static_cast<int>(std::min<std::size_t>(part->channels.size(), 4));
            header.info = {"openexr",
                           static_cast<int>(part->width),
                           static_cast<int>(part->height),
                           channels,
                           32,
                           part->layout};
            header.channelNames = part->channels;
        }
    }
    if (multiPart) {
        return core::refused("EXR with more than " + std::to_string(kMaxParts - 1) + " parts");
    }
    return header;
}

} // namespace lodestar::io::detail

// SPDX-License-Identifier: MIT
//
// The PNG header and the checksums of its chunks.
// Source: PNG specification (W3C), sections 5, 8, 9, 11.
#include <algorithm>
#include <array>

#include <zlib.h>

#include "io/image_internal.h"

namespace lodestar::io::detail {
namespace {

constexpr std::size_t kSignatureBytes = 8;
/// Deflate packs at most 1032:1.
constexpr std::size_t kMaxDeflateRatio = 1100;

struct Shape {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    unsigned depth = 0;
    unsigned colorType = 0;
    bool interlaced = false;
};

/// A chunk with the place of its data.
struct Chunk {
    std::string type;
    std::size_t begin = 0; ///< of the whole chunk
    std::size_t data = 0;
    std::uint32_t size = 0;
};

core::Error damaged(const std::string& what) {
    return core::refused("damaged PNG: " + what);
}

int channelsOf(unsigned colorType, bool transparency) {
    switch (colorType) {
    case 0:
        return transparency ? 2 : 1;
    case 2:
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

std::size_t bitsPerPixel(const Shape& shape) {
    const int samples = shape.colorType == 3 ? 1 : channelsOf(shape.colorType, false);
    return static_cast<std::size_t>(samples) * shape.depth;
}

bool depthAllowed(unsigned colorType, unsigned depth) {
    const bool small = depth == 1 || depth == 2 || depth == 4;
    switch (colorType) {
    case 0:
        return small || depth == 8 || depth == 16;
    case 3:
        return small || depth == 8;
    default:
        return depth == 8 || depth == 16;
    }
}

core::Result<Shape> readShape(const Bytes& bytes, const Chunk& chunk) {
    ByteReader reader(bytes, chunk.data);
    Shape shape;
    unsigned compression = 0;
    unsigned filter = 0;
    unsigned interlace = 0;
    if (chunk.type != "IHDR" || chunk.size != 13 || !reader.bigEndian(4, shape.width) ||
        !reader.bigEndian(4, shape.height) || !reader.byte(shape.depth) ||
        !reader.byte(shape.colorType) || !reader.byte(compression) || !reader.byte(filter) ||
        !reader.byte(interlace)) {
        return damaged("its first chunk is not a header");
    }
    if (channelsOf(shape.colorType, false) == 0) {
        return core::refused("PNG colour type " + std::to_string(shape.colorType) +
                             " does not exist");
    }
    if (!depthAllowed(shape.colorType, shape.depth)) {
        return core::refused("PNG colour type " + std::to_string(shape.colorType) + " with " +
                             std::to_string(shape.depth) + " bits does not exist");
    }
    if (compression != 0 || filter != 0 || interlace > 1) {
        return damaged("its header names methods that do not exist");
    }
    shape.interlaced = interlace == 1;
    const std::size_t bytesPerPixel =
        static_cast<std::size_t>(channelsOf(shape.colorType, true)) * (shape.depth == 16 ? 2 : 1);
    core::Result<void> size = checkSize(shape.width, shape.height, bytesPerPixel);
    if (!size) {
        return size.error();
    }
    return shape;
}

/// The next chunk, its checksum verified where its content is used.
core::Result<Chunk> takeChunk(ByteReader& reader, const Bytes& bytes) {
    Chunk chunk;
    chunk.begin = reader.position();
    if (!reader.bigEndian(4, chunk.size) || reader.remaining() < std::size_t{chunk.size} + 8) {
        return core::refused("PNG is cut off", "byte " + std::to_string(chunk.begin));
    }
    chunk.type.assign(reinterpret_cast<const char*>(bytes.data()) + reader.position(), 4);
    chunk.data = reader.position() + 4;
    static_cast<void>(reader.skip(std::size_t{chunk.size} + 4));
    std::uint32_t checksum = 0;
    static_cast<void>(reader.bigEndian(4, checksum));
    // Bit 5 of the first letter: ancillary chunks are dropped or tell little, critical ones count.
    const bool used = (chunk.type[0] & 0x20) == 0 || chunk.type == "tRNS";
    if (used && crc32(0, bytes.data() + chunk.begin + 4, chunk.size + 4) != checksum) {
        return core::refused("damaged PNG: a chunk's checksum is wrong",
                             "byte " + std::to_string(chunk.begin));
    }
    return chunk;
}

void appendNumber(Bytes& to, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) {
        to.push_back(static_cast<unsigned char>(value >> shift));
    }
}

/// A palette filled up with black to all that the depth can name: libpng complains otherwise.
void appendPalette(Bytes& to, const Bytes& bytes, const Chunk& chunk, unsigned depth) {
    const std::size_t size = std::max<std::size_t>(chunk.size, std::size_t{3} << depth);
    appendNumber(to, static_cast<std::uint32_t>(size));
    const std::size_t begin = to.size();
    to.insert(to.end(), {'P', 'L', 'T', 'E'});
    to.insert(to.end(), bytes.begin() + static_cast<std::ptrdiff_t>(chunk.data),
              bytes.begin() + static_cast<std::ptrdiff_t>(chunk.data + chunk.size));
    to.resize(begin + 4 + size);
    appendNumber(to, static_cast<std::uint32_t>(
                         crc32(0, to.data() + begin, static_cast<unsigned>(size + 4))));
}

void append(Bytes& to, const Bytes& bytes, const Chunk& chunk) {
    to.insert(to.end(), bytes.begin() + static_cast<std::ptrdiff_t>(chunk.begin),
              bytes.begin() + static_cast<std::ptrdiff_t>(chunk.data + chunk.size + 4));
}

/// The chunks that make pixels.
struct Parts {
    Chunk header;
    Chunk palette;
    Chunk transparency;
    std::vector<Chunk> data;
    Chunk end;
};

core::Result<Parts> readParts(const Bytes& bytes, Shape& shape) {
    ByteReader reader(bytes, kSignatureBytes);
    Parts parts;
    for (bool first = true;; first = false) {
        core::Result<Chunk> chunk = takeChunk(reader, bytes);
        if (!chunk) {
            return chunk.error();
        }
        if (first) {
            core::Result<Shape> read = readShape(bytes, *chunk);
            if (!read) {
                return read.error();
            }
            shape = *read;
            parts.header = *chunk;
        } else if (chunk->type == "PLTE" && parts.data.empty()) {
            parts.palette = *chunk;
        } else if (chunk->type == "tRNS" && parts.data.empty()) {
            parts.transparency = *chunk;
        } else if (chunk->type == "IDAT") {
            parts.data.push_back(*chunk);
        } else if (chunk->type == "IEND") {
            parts.end = *chunk;
            return parts;
        }
    }
}

core::Result<void> checkPalette(const Parts& parts, const Shape& shape) {
    const std::uint32_t palette = parts.palette.size;
    const std::uint32_t transparent = parts.transparency.size;
    if (shape.colorType == 3 &&
        (palette == 0 || palette % 3 != 0 || palette > (3U << shape.depth))) {
        return damaged("its palette is missing or of a wrong length");
    }
    const bool fits = shape.colorType == 0   ? transparent == 2
                      : shape.colorType == 2 ? transparent == 6
                                             : transparent * 3 <= palette;
    if (transparent != 0 && shape.colorType <= 3 && !fits) {
        return damaged("its transparency has a wrong length");
    }
    return {};
}

} // namespace

core::Result<StrippedImage> pngHeader(const Bytes& bytes) {
    Shape shape;
    core::Result<Parts> parts = readParts(bytes, shape);
    if (!parts) {
        return parts.error();
    }
    const core::Result<void> checked = checkPalette(*parts, shape);
    if (!checked) {
        return checked.error();
    }
    std::size_t dataBytes = 0;
    for (const Chunk& chunk : parts->data) {
        dataBytes += chunk.size;
    }
    const std::size_t packed = (shape.width * bitsPerPixel(shape) + 7) / 8 * shape.height;
    if (dataBytes == 0 || packed / kMaxDeflateRatio > dataBytes) {
        return core::refused("PNG is cut off: " + std::to_string(dataBytes) +
                             " bytes of pixel data cannot hold the " + std::to_string(shape.width) +
                             " x " + std::to_string(shape.height) + " pixels it claims");
    }
    StrippedImage result;
    result.bytes.assign(bytes.begin(), bytes.begin() + kSignatureBytes);
    append(result.bytes, bytes, parts->header);
    const bool transparency = parts->transparency.size != 0 && shape.colorType <= 3;
    if (shape.colorType == 3) {
        appendPalette(result.bytes, bytes, parts->palette, shape.depth);
    }
    if (transparency) {
        append(result.bytes, bytes, parts->transparency);
    }
    for (const Chunk& chunk : parts->data) {
        append(result.bytes, bytes, chunk);
    }
    append(result.bytes, bytes, parts->end);
    result.header.info = {"png",
                          static_cast<int>(shape.width),
                          static_cast<int>(shape.height),
                          channelsOf(shape.colorType, transparency),
                          shape.depth == 16 ? 16 : 8,
                          DeclaredLayout::None};
    return result;
}

} // namespace lodestar::io::detail

// SPDX-License-Identifier: MIT
//
// The PNG header and the soundness of its data: checksums, the compressed stream and the filter of
// each row are checked here, because libpng reports what it finds on stderr, which is the user's.
// Source: PNG specification (W3C), sections 5, 8, 9, 11.
#include <algorithm>
#include <array>
#include <cstring>

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

/// Rows as they come out of the compressed stream, each with a filter byte before it.
struct Pass {
    std::size_t rows = 0;
    std::size_t rowBytes = 0;
};

std::vector<Pass> passesOf(const Shape& shape) {
    struct Grid {
        unsigned x, y, stepX, stepY;
    };
    constexpr std::array<Grid, 7> kAdam7{{{0, 0, 8, 8},
                                          {4, 0, 8, 8},
                                          {0, 4, 4, 8},
                                          {2, 0, 4, 4},
                                          {0, 2, 2, 4},
                                          {1, 0, 2, 2},
                                          {0, 1, 1, 2}}};
    const auto steps = [](std::uint32_t size, unsigned from, unsigned step) {
        return size > from ? (std::size_t{size} - from + step - 1) / step : 0;
    };
    const auto rowBytes = [&](std::size_t width) { return (width * bitsPerPixel(shape) + 7) / 8; };
    if (!shape.interlaced) {
        return {{shape.height, rowBytes(shape.width)}};
    }
    std::vector<Pass> passes;
    for (const Grid& grid : kAdam7) {
        const std::size_t width = steps(shape.width, grid.x, grid.stepX);
        const std::size_t rows = steps(shape.height, grid.y, grid.stepY);
        if (width > 0 && rows > 0) {
            passes.push_back({rows, rowBytes(width)});
        }
    }
    return passes;
}

/// Follows the inflated bytes row by row.
class RowWalk {
public:
    explicit RowWalk(std::vector<Pass> passes) : passes_(std::move(passes)) {}

    [[nodiscard]] bool finished() const { return pass_ == passes_.size(); }
    /// False for a filter that does not exist.
    bool take(const unsigned char* bytes, std::size_t count) {
        while (count > 0 && !finished()) {
            if (left_ == 0) {
                if (*bytes > 4) {
                    return false;
                }
                ++bytes;
                --count;
                left_ = passes_[pass_].rowBytes;
            }
            const std::size_t step = std::min(left_, count);
            bytes += step;
            count -= step;
            left_ -= step;
            if (left_ == 0 && ++row_ == passes_[pass_].rows) {
                row_ = 0;
                ++pass_;
            }
        }
        return true;
    }

private:
    std::vector<Pass> passes_;
    std::size_t pass_ = 0;
    std::size_t row_ = 0;
    std::size_t left_ = 0; ///< bytes to come in the current row
};

core::Result<void> checkStream(const Bytes& bytes, const std::vector<Chunk>& data,
                               const Shape& shape) {
    z_stream stream{};
    if (inflateInit(&stream) != Z_OK) {
        return core::Error{core::ErrorCode::Internal, "zlib cannot be started", {}, {}};
    }
    RowWalk rows(passesOf(shape));
    std::vector<unsigned char> window(std::size_t{1} << 16);
    int state = Z_OK;
    bool good = true;
    for (std::size_t i = 0; i < data.size() && state == Z_OK && good; ++i) {
        stream.next_in = const_cast<unsigned char*>(bytes.data()) + data[i].data;
        stream.avail_in = data[i].size;
        while (stream.avail_in > 0 && state == Z_OK && good) {
            stream.next_out = window.data();
            stream.avail_out = static_cast<unsigned>(window.size());
            state = inflate(&stream, Z_NO_FLUSH);
            good = rows.take(window.data(), window.size() - stream.avail_out);
        }
    }
    // What the input left behind in the window's size.
    while (state == Z_OK && good && !rows.finished()) {
        stream.next_out = window.data();
        stream.avail_out = static_cast<unsigned>(window.size());
        state = inflate(&stream, Z_NO_FLUSH);
        good = rows.take(window.data(), window.size() - stream.avail_out);
    }
    inflateEnd(&stream);
    if (!good) {
        return damaged("a row's filter does not exist");
    }
    if (state == Z_DATA_ERROR || state == Z_NEED_DICT || state == Z_STREAM_ERROR) {
        return damaged("its compressed data are broken");
    }
    if (!rows.finished()) {
        return core::refused("PNG is cut off: its data end before its pixels do");
    }
    return {};
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

core::Result<StrippedImage> pngHeader(const Bytes& bytes, bool checkPixels) {
    Shape shape;
    core::Result<Parts> parts = readParts(bytes, shape);
    if (!parts) {
        return parts.error();
    }
    core::Result<void> checked = checkPalette(*parts, shape);
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
    checked = checkPixels ? checkStream(bytes, parts->data, shape) : checked;
    if (!checked) {
        return checked.error();
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
    result.header.info = {"png", static_cast<int>(shape.width), static_cast<int>(shape.height),
                          channelsOf(shape.colorType, transparency), DeclaredLayout::None};
    return result;
}

} // namespace lodestar::io::detail

// SPDX-License-Identifier: MIT
//
// Radiance RGBE pictures, read here rather than by OpenImageIO, whose reader believes any size and
// stops at the old run-length code. Source: Ward, "Real Pixels", Graphics Gems II, 1991, and the
// "Radiance File Formats" page: a value is mantissa x 2^(exponent - 136), 0 where the exponent is
// 0.
#include <charconv>
#include <cmath>
#include <string_view>
#include <system_error>

#include "io/image_internal.h"

namespace lodestar::io::detail {
namespace {

constexpr std::size_t kMaxHeaderBytes = 65536;
/// The new run-length code is used for widths in this range only.
constexpr int kMinRleWidth = 8;
constexpr int kMaxRleWidth = 32767;

struct HdrLayout {
    int width = 0;
    int height = 0;
    bool flipX = false;
    bool flipY = false;
    std::size_t pixels = 0; ///< byte at which they begin
};

/// Takes one line off the reader; false where the header has no end.
bool takeLine(const Bytes& bytes, std::size_t& position, std::string_view& line) {
    const std::size_t limit = std::min(bytes.size(), kMaxHeaderBytes);
    for (std::size_t end = position; end < limit; ++end) {
        if (bytes[end] == '\n') {
            line = {reinterpret_cast<const char*>(bytes.data()) + position, end - position};
            position = end + 1;
            return true;
        }
    }
    return false;
}

/// "-Y 512", "+X 1024": the axis, its sign and its length.
bool takeAxis(std::string_view& text, char& sign, char& axis, std::int64_t& length) {
    while (!text.empty() && text.front() == ' ') {
        text.remove_prefix(1);
    }
    if (text.size() < 4 || text[2] != ' ') {
        return false;
    }
    sign = text[0];
    axis = text[1];
    text.remove_prefix(3);
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), length);
    if (code != std::errc()) {
        return false;
    }
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return (sign == '-' || sign == '+') && (axis == 'X' || axis == 'Y');
}

core::Result<HdrLayout> readLayout(const Bytes& bytes) {
    std::size_t position = 0;
    std::string_view line;
    do {
        if (!takeLine(bytes, position, line)) {
            return core::refused("HDR header has no end");
        }
        if (line.starts_with("FORMAT=") && line.find("rgbe") == std::string_view::npos) {
            return core::refused("HDR pixels are not RGBE (the header's FORMAT says otherwise)");
        }
    } while (!line.empty() && line != "\r");
    if (!takeLine(bytes, position, line)) {
        return core::refused("HDR header has no resolution line");
    }
    char ySign = 0;
    char xSign = 0;
    char first = 0;
    char second = 0;
    std::int64_t height = 0;
    std::int64_t width = 0;
    if (!takeAxis(line, ySign, first, height) || !takeAxis(line, xSign, second, width) ||
        first == second) {
        return core::refused("HDR resolution line is not of the form '-Y height +X width'");
    }
    if (first != 'Y') {
        return core::refused("HDR is stored by columns; only pictures stored by rows are read");
    }
    core::Result<void> size = checkSize(width, height, 4);
    if (!size) {
        return size.error();
    }
    return HdrLayout{static_cast<int>(width), static_cast<int>(height), xSign == '-', ySign == '+',
                     position};
}

core::Error cutOff(int row) {
    return core::refused("HDR is cut off or damaged", "scan line " + std::to_string(row));
}

/// A scan line in the new code: four planes of runs.
bool readPlanes(ByteReader& reader, int width, Bytes& line) {
    for (int plane = 0; plane < 4; ++plane) {
        for (int x = 0; x < width;) {
            unsigned count = 0;
            unsigned value = 0;
            if (!reader.byte(count) || count == 0) {
                return false;
            }
            const bool run = count > 128;
            const int length = static_cast<int>(run ? count - 128 : count);
            if (length > width - x || (run && !reader.byte(value))) {
                return false;
            }
            for (int i = 0; i < length; ++i, ++x) {
                if (!run && !reader.byte(value)) {
                    return false;
                }
                line[static_cast<std::size_t>(4 * x + plane)] = static_cast<unsigned char>(value);
            }
        }
    }
    return true;
}

/// A scan line without runs or in the old code, where mantissas 1 1 1 repeat the pixel before;
/// consecutive counts are the digits, least first, of a number to the base 256.
bool readPixels(ByteReader& reader, int width, Bytes& line) {
    unsigned shift = 0;
    for (int x = 0; x < width;) {
        unsigned pixel[4];
        for (unsigned& channel : pixel) {
            if (!reader.byte(channel)) {
                return false;
            }
        }
        if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {
            if (x == 0 || shift > 16) {
                return false;
            }
            const std::size_t length = static_cast<std::size_t>(pixel[3]) << shift;
            if (length > static_cast<std::size_t>(width - x)) {
                return false;
            }
            for (std::size_t i = 0; i < length * 4; ++i) {
                const std::size_t to = static_cast<std::size_t>(x) * 4 + i;
                line[to] = line[to - 4];
            }
            x += static_cast<int>(length);
            shift += 8;
        } else {
            for (std::size_t c = 0; c < 4; ++c) {
                line[static_cast<std::size_t>(x) * 4 + c] = static_cast<unsigned char>(pixel[c]);
            }
            ++x;
            shift = 0;
        }
    }
    return true;
}

bool readScanLine(ByteReader& reader, const Bytes& bytes, int width, Bytes& line) {
    const std::size_t at = reader.position();
    const bool coded = width >= kMinRleWidth && width <= kMaxRleWidth && reader.remaining() >= 4 &&
                       bytes[at] == 2 && bytes[at + 1] == 2 && bytes[at + 2] < 128;
    if (!coded) {
        return readPixels(reader, width, line);
    }
    return (bytes[at + 2] << 8 | bytes[at + 3]) == width && reader.skip(4) &&
           readPlanes(reader, width, line);
}

} // namespace

core::Result<ImageHeader> hdrHeader(const Bytes& bytes) {
    core::Result<HdrLayout> layout = readLayout(bytes);
    if (!layout) {
        return layout.error();
    }
    // A coded scan line takes at least two bytes for 127 texels of each of four planes; the old
    // code can be shorter, so only a line's least size, 4 bytes, is asked for.
    if (static_cast<std::size_t>(layout->height) * 4 > bytes.size() - layout->pixels) {
        return core::refused("HDR is cut off: " + std::to_string(bytes.size()) +
                             " bytes cannot hold the " + std::to_string(layout->width) + " x " +
                             std::to_string(layout->height) + " pixels it claims");
    }
    ImageHeader header;
    header.info = {"hdr", layout->width, layout->height, 3, 32, DeclaredLayout::None};
    return header;
}

core::Result<core::Image> decodeHdr(const Bytes& bytes) {
    core::Result<HdrLayout> layout = readLayout(bytes);
    if (!layout) {
        return layout.error();
    }
    float scale[256];
    scale[0] = 0.0f;
    for (int e = 1; e < 256; ++e) {
        scale[e] = std::ldexp(1.0f, e - 136);
    }
    const int width = layout->width;
    const int height = layout->height;
    core::Image image(width, height, 3);
    Bytes line(static_cast<std::size_t>(width) * 4);
    ByteReader reader(bytes, layout->pixels);
    for (int row = 0; row < height; ++row) {
        if (!readScanLine(reader, bytes, width, line)) {
            return cutOff(row);
        }
        const int y = layout->flipY ? height - 1 - row : row;
        for (int column = 0; column < width; ++column) {
            const unsigned char* rgbe = line.data() + static_cast<std::size_t>(column) * 4;
            float* to = image.at(layout->flipX ? width - 1 - column : column, y);
            for (int c = 0; c < 3; ++c) {
                to[c] = static_cast<float>(rgbe[c]) * scale[rgbe[3]];
            }
        }
    }
    return image;
}

} // namespace lodestar::io::detail

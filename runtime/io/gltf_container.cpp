// SPDX-License-Identifier: MIT
//
// .glb and .gltf up to parsed JSON. Source: glTF 2.0 specification, section 4.4 (GLB).
#include <algorithm>
#include <cstring>
#include <string_view>

#include "io/gltf_internal.h"

namespace lodestar::io::detail {
namespace {

constexpr std::uint32_t kGlbMagic = 0x46546c67;
constexpr std::uint32_t kJsonChunk = 0x4e4f534a;
constexpr std::uint32_t kBinaryChunk = 0x004e4942;
constexpr std::size_t kGlbHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;

std::uint32_t word(const Bytes& bytes, std::size_t at) {
    return static_cast<std::uint32_t>(bytes[at]) | static_cast<std::uint32_t>(bytes[at + 1]) << 8 |
           static_cast<std::uint32_t>(bytes[at + 2]) << 16 |
           static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

std::string atByte(std::size_t position) {
    return "byte " + std::to_string(position);
}

/// Bounds depth and size of the tree before any parser builds it.
core::Result<void> checkJsonText(std::span<const unsigned char> text) {
    int depth = 0;
    std::size_t values = 0;
    bool inString = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const unsigned char c = text[i];
        if (inString) {
            if (c == '\\') {
                ++i;
            } else if (c == '"') {
                inString = false;
            }
            continue;
        }
        switch (c) {
        case '"':
            inString = true;
            break;
        case '[':
        case '{':
            ++values;
            if (++depth > kMaxJsonDepth) {
                return core::refused("JSON is nested more than " + std::to_string(kMaxJsonDepth) +
                                         " deep",
                                     atByte(i));
            }
            break;
        case ']':
        case '}':
            --depth;
            break;
        case ',':
            ++values;
            break;
        default:
            break;
        }
        if (values > kMaxJsonValues) {
            return core::refused(
                "JSON holds more than " + std::to_string(kMaxJsonValues) + " values", atByte(i));
        }
    }
    return {};
}

core::Result<Json> parseJson(std::span<const unsigned char> text, std::size_t offset) {
    core::Result<void> checked = checkJsonText(text);
    if (!checked) {
        return checked.error();
    }
    try {
        Json document = Json::parse(text.begin(), text.end());
        if (!document.is_object()) {
            return core::refused("is not glTF: the JSON is not an object");
        }
        return document;
    } catch (const Json::parse_error& error) {
        return core::refused("is not valid JSON", atByte(offset + error.byte));
    } catch (const Json::exception& error) {
        // "[json.exception.out_of_range.406] number overflow parsing '1e999'"
        const std::string_view message = error.what();
        return core::refused("is not valid JSON: " + std::string(message.substr(std::min(
                                                         message.size(), message.find("] ") + 2))));
    } catch (const std::exception& error) {
        return core::refused(std::string("is not valid JSON: ") + error.what());
    }
}

struct Chunk {
    std::uint32_t type = 0;
    std::size_t begin = 0;
    std::size_t size = 0;
};

core::Result<std::vector<Chunk>> readChunks(const Bytes& bytes) {
    if (bytes.size() < kGlbHeaderBytes + kChunkHeaderBytes) {
        return core::refused("GLB is cut off in its header", atByte(bytes.size()));
    }
    if (word(bytes, 4) != 2) {
        return core::refused(
            "GLB version " + std::to_string(word(bytes, 4)) + "; version 2 is read", atByte(4));
    }
    if (word(bytes, 8) != bytes.size()) {
        return core::refused("GLB says it is " + std::to_string(word(bytes, 8)) +
                                 " bytes long, the file is " + std::to_string(bytes.size()),
                             atByte(8));
    }
    std::vector<Chunk> chunks;
    std::size_t position = kGlbHeaderBytes;
    while (position < bytes.size() && chunks.size() < 2) {
        if (bytes.size() - position < kChunkHeaderBytes) {
            return core::refused("GLB is cut off in a chunk's header", atByte(position));
        }
        Chunk chunk{word(bytes, position + 4), position + kChunkHeaderBytes, word(bytes, position)};
        if (chunk.size > bytes.size() - chunk.begin) {
            return core::refused("GLB chunk of " + std::to_string(chunk.size) +
                                     " bytes is longer than the rest of the file",
                                 atByte(position));
        }
        position = chunk.begin + chunk.size;
        chunks.push_back(chunk);
    }
    if (chunks.front().type != kJsonChunk) {
        return core::refused("GLB does not begin with its JSON chunk", atByte(kGlbHeaderBytes));
    }
    return chunks;
}

} // namespace

core::Result<GltfSource> readContainer(Bytes bytes) {
    GltfSource source;
    Chunk text{kJsonChunk, 0, bytes.size()};
    if (bytes.size() >= 4 && word(bytes, 0) == kGlbMagic) {
        core::Result<std::vector<Chunk>> chunks = readChunks(bytes);
        if (!chunks) {
            return chunks.error();
        }
        text = chunks->front();
        if (chunks->size() > 1 && chunks->back().type == kBinaryChunk) {
            const Chunk& binary = chunks->back();
            source.hasBinary = true;
            source.binary.assign(bytes.begin() + static_cast<std::ptrdiff_t>(binary.begin),
                                 bytes.begin() +
                                     static_cast<std::ptrdiff_t>(binary.begin + binary.size));
        }
    }
    core::Result<Json> document =
        parseJson(std::span<const unsigned char>(bytes).subspan(text.begin, text.size), text.begin);
    if (!document) {
        return document.error();
    }
    source.document = std::move(*document);
    return source;
}

} // namespace lodestar::io::detail

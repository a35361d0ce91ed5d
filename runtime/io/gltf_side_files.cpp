// SPDX-License-Identifier: MIT
//
// Buffers and side files of a document: data: URIs (RFC 2397), the GLB's binary chunk, and files
// below the asset root.
#include <algorithm>
#include <array>
#include <system_error>

#include "io/gltf_internal.h"

namespace lodestar::io::detail {
namespace {

int base64Digit(char c) {
    if (c >= 'A' && c <= 'Z') {
        return c - 'A';
    }
    if (c >= 'a' && c <= 'z') {
        return c - 'a' + 26;
    }
    if (c >= '0' && c <= '9') {
        return c - '0' + 52;
    }
    return c == '+' ? 62 : (c == '/' ? 63 : -1);
}

/// RFC 4648, section 4; the padding may be left away. False for any other character.
bool decodeBase64(std::string_view text, Bytes& bytes) {
    for (int i = 0; i < 2 && text.ends_with('='); ++i) {
        text.remove_suffix(1);
    }
    if (text.size() % 4 == 1) {
        return false;
    }
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        const int digit = base64Digit(c);
        if (digit < 0) {
            return false;
        }
        bits = bits << 6 | static_cast<std::uint32_t>(digit);
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes.push_back(static_cast<unsigned char>(bits >> count));
        }
    }
    return true;
}

int hexDigit(char c) {
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    const char lower = static_cast<char>(c | 0x20);
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

std::string percentDecoded(std::string_view text) {
    std::string decoded;
    decoded.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && i + 2 < text.size() && hexDigit(text[i + 1]) >= 0 &&
            hexDigit(text[i + 2]) >= 0) {
            decoded += static_cast<char>(hexDigit(text[i + 1]) * 16 + hexDigit(text[i + 2]));
            i += 2;
        } else {
            decoded += text[i];
        }
    }
    return decoded;
}

/// RFC 2397: nothing, or TYPE/SUBTYPE, then parameters ";NAME=VALUE". What these say is not asked.
bool isMediaType(std::string_view text) {
    for (bool first = true; first || !text.empty(); first = false) {
        const std::size_t end = std::min(text.find(';', 1), text.size());
        const std::string_view part = text.substr(0, end);
        const bool parameter = part.starts_with(';');
        const std::size_t mark = part.find(parameter ? '=' : '/');
        const bool whole = mark != std::string_view::npos && mark > (parameter ? 1u : 0u) &&
                           mark + 1 < part.size();
        if (!whole && !(first && part.empty())) {
            return false;
        }
        text.remove_prefix(end);
    }
    return true;
}

core::Result<Bytes> decodeDataUri(std::string_view uri, std::size_t maxBytes) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos) {
        return core::refused("data: URI has no comma before its data");
    }
    const std::string_view data = uri.substr(comma + 1);
    constexpr std::string_view kScheme = "data:";
    constexpr std::string_view kBase64 = ";base64";
    std::string_view mediaType = uri.substr(kScheme.size(), comma - kScheme.size());
    const bool base64 = mediaType.ends_with(kBase64);
    mediaType.remove_suffix(base64 ? kBase64.size() : 0);
    if (!isMediaType(mediaType)) {
        return core::refused("data: URI has no valid media type before its comma (RFC 2397)");
    }
    Bytes bytes;
    if (base64) {
        if (!decodeBase64(data, bytes)) {
            return core::refused("data: URI is not valid base64");
        }
    } else {
        const std::string decoded = percentDecoded(data);
        bytes.assign(decoded.begin(), decoded.end());
    }
    if (bytes.size() > maxBytes) {
        return core::refused("data: URI holds " + std::to_string(bytes.size()) +
                             " bytes, the limit is " + std::to_string(maxBytes));
    }
    return bytes;
}

core::Result<Bytes> loadBuffer(const Json& buffer, GltfSource& source, bool first,
                               const SideFiles& files, std::size_t left, const std::string& at) {
    const Json* uri = member(buffer, "uri");
    if (uri == nullptr) {
        if (first && source.hasBinary) {
            return std::move(source.binary);
        }
        const Json* extensions = member(buffer, "extensions");
        if (extensions != nullptr && extensions->is_object() && !extensions->empty()) {
            return core::refused("buffer has no data without the extension " +
                                     extensions->begin().key().substr(0, 128) +
                                     ", which is not read",
                                 at);
        }
        return core::refused("buffer has no data: no uri and no binary chunk", at);
    }
    core::Result<Bytes> bytes =
        files.read(uri->get_ref<const std::string&>(), std::min(left, kMaxFileBytes));
    return bytes ? std::move(bytes) : core::refused("buffer: " + bytes.error().what, at + "/uri");
}

} // namespace

core::Result<SideFiles> SideFiles::open(const std::filesystem::path& document,
                                        const std::filesystem::path& assetRoot) {
    std::filesystem::path folder = document.parent_path();
    if (folder.empty()) {
        folder = ".";
    }
    core::Result<AssetRoot> root = AssetRoot::open(assetRoot.empty() ? folder : assetRoot);
    if (!root) {
        return root.error();
    }
    SideFiles files(std::move(*root));
    if (!assetRoot.empty()) {
        std::error_code code;
        const std::filesystem::path below = std::filesystem::relative(folder, assetRoot, code);
        if (code || below.empty() || *below.begin() == "..") {
            return core::refused("lies outside the asset root " + assetRoot.string());
        }
        if (below != ".") {
            files.prefix_ = below.generic_string() + "/";
        }
    }
    return files;
}

core::Result<Bytes> SideFiles::read(const std::string& uri, std::size_t maxBytes) const {
    if (uri.starts_with("data:")) {
        return decodeDataUri(uri, maxBytes);
    }
    const std::string path = percentDecoded(uri);
    if (path.empty() || path.front() == '/') {
        return core::refused(
            std::string("'").append(uri, 0, 256).append("' leads out of the asset folder"));
    }
    return root_.read(prefix_ + path, maxBytes);
}

std::vector<Bytes> loadBuffers(GltfSource& source, const SideFiles& files, GltfProblems& problems) {
    std::vector<Bytes> buffers(memberSize(source.document, "buffers"));
    std::size_t left = kMaxBufferBytes;
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const std::string at = pointer("/buffers", i);
        if (!problems.clean(at)) {
            continue;
        }
        const Json& buffer = source.document["buffers"][i];
        core::Result<Bytes> bytes = loadBuffer(buffer, source, i == 0, files, left, at);
        if (!bytes) {
            problems.refuse(bytes.error());
            continue;
        }
        left -= std::min(left, bytes->size());
        const auto length = buffer["byteLength"].get<std::size_t>();
        if (bytes->size() < length) {
            problems.refuse("buffer should hold " + std::to_string(length) + " bytes but has " +
                                std::to_string(bytes->size()),
                            at + "/byteLength");
            continue;
        }
        bytes->resize(length);
        buffers[i] = std::move(*bytes);
    }
    return buffers;
}

} // namespace lodestar::io::detail

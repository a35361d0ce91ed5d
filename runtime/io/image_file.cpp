// SPDX-License-Identifier: MIT
#include "io/image_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <exception>
#include <mutex>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

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

/// The bytes of a file for OpenImageIO. Its own reader of this kind lets an offset near 2^64 wrap.
class MemoryFile final : public OIIO::Filesystem::IOProxy {
public:
    explicit MemoryFile(const Bytes& bytes) : IOProxy("", Read), bytes_(bytes) {}

    const char* proxytype() const override { return "memory"; }
    std::size_t size() const override { return bytes_.size(); }
    std::size_t read(void* buffer, std::size_t count) override {
        const std::size_t got = pread(buffer, count, m_pos);
        m_pos += static_cast<std::int64_t>(got);
        return got;
    }
    std::size_t pread(void* buffer, std::size_t count, std::int64_t offset) override {
        if (offset < 0 || static_cast<std::uint64_t>(offset) >= bytes_.size()) {
            return 0;
        }
        const auto from = static_cast<std::size_t>(offset);
        const std::size_t got = std::min(count, bytes_.size() - from);
        std::memcpy(buffer, bytes_.data() + from, got);
        return got;
    }

private:
    const Bytes& bytes_;
};

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

std::string firstLine(std::string text) {
    const std::size_t end = text.find('\n');
    return end == std::string::npos ? text : text.substr(0, end);
}

void quietThreads() {
    // One thread: results and memory do not depend on the machine, and a damaged file cannot leave
    // workers behind.
    static std::once_flag once;
    std::call_once(once, [] {
        OIIO::attribute("threads", 1);
        OIIO::attribute("exr_threads", -1);
    });
}

/// The channels to read, as indices into OpenImageIO's order: R G B A by name where the file has
/// them, else Y [A], else the first four.
std::vector<int> chosenChannels(const OIIO::ImageSpec& spec) {
    const auto find = [&](const char* name) {
        for (int i = 0; i < spec.nchannels; ++i) {
            const std::string& candidate = spec.channelnames[static_cast<std::size_t>(i)];
            if (candidate.size() == 1 &&
                std::toupper(static_cast<unsigned char>(candidate[0])) == name[0]) {
                return i;
            }
        }
        return -1;
    };
    std::vector<int> chosen;
    for (const char* name : {"R", "G", "B", "A"}) {
        if (const int i = find(name); i >= 0) {
            chosen.push_back(i);
        }
    }
    if (find("Y") >= 0 && find("R") < 0 && find("G") < 0 && find("B") < 0) {
        chosen.insert(chosen.begin(), find("Y"));
    }
    if (chosen.empty() || (chosen.size() == 1 && chosen[0] == find("A"))) {
        chosen.clear();
        for (int i = 0; i < std::min(spec.nchannels, 4); ++i) {
            chosen.push_back(i);
        }
    }
    return chosen;
}

core::Error undecodable(OIIO::ImageInput& input, const char* fallback) {
    const std::string message = firstLine(input.geterror());
    return core::refused("image cannot be decoded: " + (message.empty() ? fallback : message));
}

/// Reads the chosen channels of the first picture at full size.
core::Result<core::Image> readPixels(OIIO::ImageInput& input, const ImageInfo& info) {
    const OIIO::ImageSpec spec = input.spec();
    if (spec.width != info.width || spec.height != info.height || spec.depth > 1 || spec.deep ||
        spec.nchannels < 1) {
        return core::refused("image cannot be decoded: its header says two different things");
    }
    const std::vector<int> chosen = chosenChannels(spec);
    const int count = static_cast<int>(chosen.size());
    core::Image image(info.width, info.height, count);
    const bool together = std::adjacent_find(chosen.begin(), chosen.end(), [](int a, int b) {
                              return b != a + 1;
                          }) == chosen.end();
    if (together) {
        if (!input.read_image(0, 0, chosen.front(), chosen.front() + count, OIIO::TypeDesc::FLOAT,
                              image.pixels().data())) {
            return undecodable(input, "its pixels are damaged");
        }
    } else {
        const auto stride = static_cast<OIIO::stride_t>(sizeof(float)) * count;
        for (int c = 0; c < count; ++c) {
            const int from = chosen[static_cast<std::size_t>(c)];
            if (!input.read_image(0, 0, from, from + 1, OIIO::TypeDesc::FLOAT,
                                  image.pixels().data() + c, stride, stride * info.width)) {
                return undecodable(input, "its pixels are damaged");
            }
        }
    }
    if (input.has_error()) {
        return undecodable(input, "its pixels are damaged");
    }
    return image;
}

core::Result<core::Image> decodeWithLibrary(const Bytes& bytes, const ImageInfo& info) {
    quietThreads();
    try {
        const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(info.format);
        if (!input) {
            static_cast<void>(OIIO::geterror());
            return core::Error{
                core::ErrorCode::Internal, "OpenImageIO was built without " + info.format, {}, {}};
        }
        // The JPEG reader takes no proxy but the library's own, whose whole buffer it reads in
        // order.
        MemoryFile checked(bytes);
        OIIO::Filesystem::IOMemReader plain(bytes.data(), bytes.size());
        OIIO::ImageSpec config;
        config.attribute("oiio:UnassociatedAlpha", 1);
        OIIO::ImageSpec spec;
        if (info.format == "jpeg") {
            input->set_ioproxy(&plain);
        } else {
            input->set_ioproxy(&checked);
        }
        if (!input->open("image." + info.format, spec, config)) {
            return undecodable(*input, "its header is damaged");
        }
        core::Result<core::Image> image = readPixels(*input, info);
        input->close();
        static_cast<void>(input->geterror());
        return image;
    } catch (const std::exception& exception) {
        return core::refused("image cannot be decoded: " + firstLine(exception.what()));
    }
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

core::Result<core::Image> decodeStripped(core::Result<detail::StrippedImage> stripped,
                                         ImageInfo& info) {
    if (!stripped) {
        return stripped.error();
    }
    info = stripped->header.info;
    return decodeWithLibrary(stripped->bytes, info);
}

core::Result<core::Image> decodeAs(Format format, const Bytes& bytes, ImageInfo& info) {
    switch (format) {
    case Format::Png:
        return decodeStripped(detail::pngHeader(bytes, true), info);
    case Format::Jpeg:
        return decodeStripped(detail::jpegHeader(bytes), info);
    case Format::Exr:
    case Format::Hdr:
        break;
    case Format::Unknown:
        return unknownFormat();
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
        return infoOf(detail::pngHeader(bytes, false));
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

} // namespace lodestar::io

// SPDX-License-Identifier: MIT
//
// OpenImageIO behind ImageCodec. Everything here runs inside the module; exceptions end here.
#include "io/image_codec.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <exception>
#include <mutex>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace lodestar::io {
namespace {

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

std::string firstLine(const std::string& text) {
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
        MemoryFile checked(bytes);
        OIIO::ImageSpec config;
        config.attribute("oiio:UnassociatedAlpha", 1);
        OIIO::ImageSpec spec;
        input->set_ioproxy(&checked);
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

core::Error failed(std::string what) {
    return {core::ErrorCode::OutputFailed, std::move(what), {}, {}};
}

std::vector<std::string> channelNames(int channels) {
    switch (channels) {
    case 1:
        return {"Y"};
    case 2:
        return {"Y", "A"};
    case 3:
        return {"R", "G", "B"};
    default:
        return {"R", "G", "B", "A"};
    }
}

/// [0, 1] to the nearest of 256 levels.
std::vector<unsigned char> quantised(const core::Image& image) {
    std::vector<unsigned char> levels(image.pixels().size());
    std::transform(image.pixels().begin(), image.pixels().end(), levels.begin(), [](float value) {
        return static_cast<unsigned char>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
    });
    return levels;
}

core::Result<Bytes> encodeUnguarded(const core::Image& image, const std::string& format,
                                    const ImageTexts& texts) {
    const bool png = format == "png";
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
    if (!output || !output->supports("ioproxy")) {
        static_cast<void>(OIIO::geterror());
        return failed("OpenImageIO cannot write " + format + " into memory");
    }
    OIIO::ImageSpec spec(image.width(), image.height(), image.channels(),
                         png ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT);
    spec.channelnames = channelNames(image.channels());
    spec.alpha_channel = image.channels() % 2 == 0 ? image.channels() - 1 : -1;
    if (png) {
        spec.attribute("oiio:ColorSpace", "sRGB");
        spec.attribute("oiio:UnassociatedAlpha", 1);
    } else {
        spec.attribute("compression", "zip");
    }
    for (const auto& [name, text] : texts) {
        spec.attribute(name, text);
    }
    Bytes bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    output->set_ioproxy(&memory);
    const std::vector<unsigned char> levels = png ? quantised(image) : std::vector<unsigned char>();
    bool good = output->open("image." + format, spec);
    good = good && (png ? output->write_image(OIIO::TypeDesc::UINT8, levels.data())
                        : output->write_image(OIIO::TypeDesc::FLOAT, image.pixels().data()));
    good = output->close() && good;
    const std::string message = output->has_error() ? output->geterror() : std::string();
    if (!good || !message.empty()) {
        return failed("image cannot be encoded: " + (message.empty() ? format : message));
    }
    return bytes;
}

core::Result<Bytes> encode(const core::Image& image, const std::string& format,
                           const ImageTexts& texts) {
    try {
        return encodeUnguarded(image, format, texts);
    } catch (const std::exception& exception) {
        return failed(std::string("image cannot be encoded: ") + exception.what());
    }
}

constexpr ImageCodec kCodec{decodeWithLibrary, encode};

} // namespace

const ImageCodec* lodestarImageCodec() {
    return &kCodec;
}

} // namespace lodestar::io

// SPDX-License-Identifier: MIT
//
// Small valid images of each format, as bytes to spoil, and a PNG made by hand.
#pragma once

#include <cmath>
#include <random>

#include <zlib.h>

#include <OpenImageIO/imageio.h>

#include "core/image.h"
#include "io/image_file.h"
#include "unit/io/io_support.h"

namespace lodestar::testing {

/// Smooth colours with a little noise: compressible, yet no codec makes nothing of it.
inline core::Image pattern(int width, int height, int channels) {
    core::Image image(width, height, channels);
    std::mt19937 random(3);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < channels; ++c) {
                const float noise = static_cast<float>(random() % 64) / 640.0f;
                image.at(x, y)[c] = 0.45f +
                                    0.4f * std::sin(0.2f * static_cast<float>(x + c) +
                                                    0.1f * static_cast<float>(y)) +
                                    noise;
            }
        }
    }
    return image;
}

/// Written by OpenImageIO itself, so that reader and writer under test are not each other's oracle.
inline io::Bytes encodedByLibrary(const core::Image& image, const std::string& extension,
                                  const std::string& compression = {},
                                  OIIO::TypeDesc type = OIIO::TypeDesc::UNKNOWN) {
    const TemporaryFolder folder;
    const std::string path = (folder / ("x." + extension)).string();
    const bool ldr = extension == "png" || extension == "jpg";
    if (type == OIIO::TypeDesc::UNKNOWN) {
        type = ldr ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::HALF;
    }
    OIIO::ImageSpec spec(image.width(), image.height(), image.channels(), type);
    if (!compression.empty()) {
        spec.attribute("compression", compression);
    }
    spec.attribute("oiio:UnassociatedAlpha", 1);
    const auto output = OIIO::ImageOutput::create(path);
    EXPECT_TRUE(output && output->open(path, spec));
    EXPECT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, image.pixels().data()));
    EXPECT_TRUE(output->close());
    return *io::readFile(path);
}

struct Sample {
    std::string name;
    io::Bytes bytes;
};

inline const std::vector<Sample>& goodImages() {
    static const std::vector<Sample> samples = [] {
        std::vector<Sample> made;
        for (const char* compression :
             {"none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"}) {
            made.push_back({std::string("exr-") + compression,
                            encodedByLibrary(pattern(48, 24, 3), "exr", compression)});
        }
        made.push_back({"hdr", encodedByLibrary(pattern(48, 24, 3), "hdr")});
        made.push_back({"png8", encodedByLibrary(pattern(48, 24, 4), "png")});
        made.push_back(
            {"png16", encodedByLibrary(pattern(48, 24, 3), "png", "", OIIO::TypeDesc::UINT16)});
        made.push_back({"png-grey", encodedByLibrary(pattern(48, 24, 1), "png")});
        made.push_back({"jpeg", encodedByLibrary(pattern(48, 24, 3), "jpg")});
        made.push_back({"jpeg-grey", encodedByLibrary(pattern(48, 24, 1), "jpg")});
        return made;
    }();
    return samples;
}

inline void putBig(io::Bytes& bytes, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) {
        bytes.push_back(static_cast<unsigned char>(value >> shift));
    }
}

inline void putChunk(io::Bytes& png, const std::string& type, const io::Bytes& data) {
    putBig(png, static_cast<std::uint32_t>(data.size()));
    io::Bytes body(type.begin(), type.end());
    body.insert(body.end(), data.begin(), data.end());
    png.insert(png.end(), body.begin(), body.end());
    putBig(png,
           static_cast<std::uint32_t>(crc32(0, body.data(), static_cast<unsigned>(body.size()))));
}

/// A PNG from its header fields and its unpacked rows, filter bytes included.
inline io::Bytes handMadePng(std::uint32_t width, std::uint32_t height, unsigned depth,
                             unsigned colorType, bool interlaced, const io::Bytes& rows,
                             const io::Bytes& palette = {}, const io::Bytes& transparency = {}) {
    io::Bytes png{0x89, 'P', 'N', 'G', 0x0d, 0x0a, 0x1a, 0x0a};
    io::Bytes header;
    putBig(header, width);
    putBig(header, height);
    put<unsigned char>(header,
                       {static_cast<unsigned char>(depth), static_cast<unsigned char>(colorType), 0,
                        0, static_cast<unsigned char>(interlaced ? 1 : 0)});
    putChunk(png, "IHDR", header);
    if (!palette.empty()) {
        putChunk(png, "PLTE", palette);
    }
    if (!transparency.empty()) {
        putChunk(png, "tRNS", transparency);
    }
    io::Bytes packed(compressBound(rows.size()));
    uLongf size = packed.size();
    EXPECT_EQ(compress2(packed.data(), &size, rows.data(), rows.size(), 9), Z_OK);
    packed.resize(size);
    putChunk(png, "tEXt", {'k', 0, 'v'});
    putChunk(png, "IDAT", packed);
    putChunk(png, "IEND", {});
    return png;
}

/// Decodes and checks what holds for any input: in time, nothing on stderr, a value or a sentence.
inline bool decodesOrRefuses(const io::Bytes& bytes, const std::string& name) {
    const StopWatch watch;
    ::testing::internal::CaptureStderr();
    const core::Result<io::DecodedImage> decoded = io::decodeImage(bytes, 0);
    const std::string printed = ::testing::internal::GetCapturedStderr();
    EXPECT_EQ(printed, "") << name;
    EXPECT_LT(watch.seconds(), kMaxSeconds) << name;
    if (!decoded) {
        EXPECT_GT(decoded.error().what.size(), 10U) << name;
        EXPECT_EQ(decoded.error().message().find('\n'), std::string::npos) << name;
        EXPECT_EQ(decoded.error().code, core::ErrorCode::InputRefused)
            << name << decoded.error().what;
    }
    return decoded.ok();
}

} // namespace lodestar::testing

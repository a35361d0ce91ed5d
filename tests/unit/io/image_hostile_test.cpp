// SPDX-License-Identifier: MIT
//
// Images that lie, are cut off or are damaged: an error or an image, in bounded time and memory.
#include <random>

#include <rapidcheck.h>

#include "support/fuzz.h"
#include "support/shared.h"
#include "unit/io/image_support.h"

namespace lodestar {
namespace {

using testing::decodesOrRefuses;
using testing::goodImages;
using testing::Sample;

io::Bytes bytesOf(const std::string& text) {
    return io::Bytes(text.begin(), text.end());
}

TEST(HostileImage, TheGoodOnesAreGood) {
    ASSERT_EQ(goodImages().size(), 16U);
    for (const Sample& sample : goodImages()) {
        EXPECT_TRUE(decodesOrRefuses(sample.bytes, sample.name)) << sample.name;
        const auto info = io::imageInfo(sample.bytes);
        ASSERT_TRUE(info.ok()) << sample.name;
        EXPECT_EQ(info->width, 48);
        EXPECT_EQ(info->height, 24);
    }
}

TEST(HostileImage, CutOffIsRefused) {
    for (const Sample& sample : goodImages()) {
        // The last 12 bytes of a PNG say no more than that it ends; all else must be missed.
        const std::size_t count = 40;
        for (std::size_t i = 0; i < count; ++i) {
            io::Bytes cut = sample.bytes;
            cut.resize(sample.bytes.size() * i / count);
            EXPECT_FALSE(
                decodesOrRefuses(cut, sample.name + " cut at " + std::to_string(cut.size())))
                << sample.name << " cut at " << cut.size();
        }
    }
}

TEST(HostileImage, FlippedBitsNeverCrash) {
    std::mt19937 random(20250101);
    const int rounds = testing::fuzzRounds(150);
    for (const Sample& sample : goodImages()) {
        for (int i = 0; i < rounds; ++i) {
            io::Bytes spoiled = sample.bytes;
            const int flips = 1 + static_cast<int>(random() % 8);
            for (int k = 0; k < flips; ++k) {
                // Half of them in the header, where sizes are.
                const std::size_t range =
                    k % 2 == 0 ? std::min<std::size_t>(spoiled.size(), 400) : spoiled.size();
                spoiled[random() % range] ^= static_cast<unsigned char>(1U << (random() % 8));
            }
            decodesOrRefuses(spoiled, sample.name + " mutation " + std::to_string(i));
        }
    }
}

TEST(HostileImage, AnyBytesBehindAMagicAreHandled) {
    const std::vector<io::Bytes> magics{{0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0},
                                        bytesOf("#?RADIANCE\n\n-Y 3 +X 9\n"),
                                        {0x89, 'P', 'N', 'G', 0x0d, 0x0a, 0x1a, 0x0a},
                                        {0xff, 0xd8, 0xff}};
    const bool passed = rc::check("decodeImage ends with a value or an error", [&] {
        io::Bytes bytes = magics[*rc::gen::inRange<std::size_t>(0, magics.size())];
        const auto tail = *rc::gen::arbitrary<std::vector<unsigned char>>();
        bytes.insert(bytes.end(), tail.begin(), tail.end());
        RC_ASSERT(decodesOrRefuses(bytes, "arbitrary") || true);
    });
    EXPECT_TRUE(passed);
}

TEST(HostileImage, HdrHeadersThatLie) {
    const std::string pixels(400, '\x80');
    for (const char* resolution :
         {"-Y 2000000000 +X 2000000000", "-Y 40000 +X 40000", "-Y -5 +X 99999", "-Y 0 +X 0",
          "-Y 16385 +X 1", "-Y 16384 +X 16384", "-Y 16384 +X 4096", "-Y 99999999999999999999 +X 1",
          "+X 4 -Y 4", "-X 4 -Y 4", "-Y 4 +Y 4", "-Y 4", "", "hello", "-Y 4 +X", "- 4 + 4"}) {
        const io::Bytes bytes = bytesOf(std::string("#?RADIANCE\n\n") + resolution + "\n" + pixels);
        EXPECT_FALSE(decodesOrRefuses(bytes, resolution)) << resolution;
        EXPECT_FALSE(io::imageInfo(bytes).ok() && std::string(resolution).size() < 8) << resolution;
    }
    for (const std::string& head :
         {std::string("#?"), std::string("#?RADIANCE"), std::string("#?RADIANCE\n"),
          "#?" + std::string(100000, 'x'),
          std::string("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd")}) {
        EXPECT_FALSE(decodesOrRefuses(bytesOf(head), head.substr(0, 40)));
    }
    // A run that is longer than its line, a run of nothing, an old run with no pixel before it.
    const std::vector<io::Bytes> lines{{2, 2, 0, 8, 255, 1},
                                       {2, 2, 0, 8, 0, 1},
                                       {2, 2, 0, 9, 136, 1},
                                       {1, 1, 1, 5},
                                       {9, 9, 9, 9, 1, 1, 1, 255}};
    for (const io::Bytes& line : lines) {
        io::Bytes bytes = bytesOf("#?RADIANCE\n\n-Y 1 +X 8\n");
        bytes.insert(bytes.end(), line.begin(), line.end());
        bytes.resize(bytes.size() + 40, 1);
        EXPECT_FALSE(decodesOrRefuses(bytes, "line"));
    }
}

TEST(HostileImage, PngsThatLie) {
    const io::Bytes row{0, 1, 2, 3};
    const auto refused = [&](const io::Bytes& png, const char* name) {
        EXPECT_FALSE(decodesOrRefuses(png, name)) << name;
    };
    refused(testing::handMadePng(40000, 40000, 8, 2, false, row), "40000 x 40000");
    refused(testing::handMadePng(16000, 16000, 8, 6, false, row), "16000 x 16000");
    refused(testing::handMadePng(0, 1, 8, 2, false, row), "no width");
    refused(testing::handMadePng(0x7fffffff, 1, 8, 2, false, row), "2^31 wide");
    refused(testing::handMadePng(0xffffffff, 0xffffffff, 16, 6, true, row), "2^32 wide");
    refused(testing::handMadePng(8000, 8000, 8, 2, false, row), "data too short by far");
    refused(testing::handMadePng(1, 2, 8, 2, false, row), "a row missing");
    refused(testing::handMadePng(1, 1, 8, 2, false, {5, 1, 2, 3}), "filter 5");
    refused(testing::handMadePng(1, 1, 8, 1, false, row), "colour type 1");
    refused(testing::handMadePng(1, 1, 3, 0, false, row), "3 bits");
    refused(testing::handMadePng(1, 1, 16, 3, false, row, {1, 2, 3}), "16-bit palette");
    refused(testing::handMadePng(1, 1, 8, 3, false, {0, 0}), "palette missing");
    refused(testing::handMadePng(1, 1, 8, 3, false, {0, 0}, {1, 2}), "palette cut off");
    refused(testing::handMadePng(1, 1, 8, 3, false, {0, 0}, {1, 2, 3}, {1, 2}),
            "more alpha than palette");
    refused(testing::handMadePng(1, 1, 8, 2, false, row, {}, {1}), "transparency of one byte");
    io::Bytes checksum = testing::handMadePng(1, 1, 8, 2, false, row);
    checksum[checksum.size() - 14] ^= 1;
    refused(checksum, "wrong checksum");
}

TEST(HostileImage, BombWithinTheLimitsEndsInTime) {
    // 4096 x 4096 of zeros packs a thousandfold: large, legal, and decoded.
    const io::Bytes rows(4096 * (4096 * 3 + 1), 0);
    const io::Bytes png = testing::handMadePng(4096, 4096, 8, 2, false, rows);
    EXPECT_LT(png.size(), 100000U);
    const auto decoded = io::decodeImage(png, 0);
    EXPECT_TRUE(decoded.ok());
}

/// Finds an attribute's value in an EXR.
std::size_t attributeValue(const io::Bytes& exr, const std::string& name, const std::string& type) {
    const std::string key = name + '\0' + type + '\0';
    const auto found = std::search(exr.begin(), exr.end(), key.begin(), key.end());
    EXPECT_NE(found, exr.end()) << name;
    return static_cast<std::size_t>(found - exr.begin()) + key.size() + 4;
}

TEST(HostileImage, ExrHeadersThatLie) {
    const io::Bytes good = goodImages()[3].bytes; // zip
    const auto patched = [&](const std::string& name, const std::string& type, std::size_t offset,
                             std::initializer_list<std::int32_t> values) {
        io::Bytes bytes = good;
        std::size_t at = attributeValue(bytes, name, type) + offset;
        for (const std::int32_t value : values) {
            std::memcpy(bytes.data() + at, &value, 4);
            at += 4;
        }
        return bytes;
    };
    constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min();
    constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
    const std::vector<std::pair<std::int32_t, std::int32_t>> windows{
        {0, 16384}, {0, kMost}, {kLeast, kMost}, {kLeast, 0}, {10, 9}, {100, 0}, {kMost, kLeast}};
    for (const auto& [low, high] : windows) {
        EXPECT_FALSE(
            decodesOrRefuses(patched("dataWindow", "box2i", 0, {low, 0, high, 23}), "wide"));
        EXPECT_FALSE(
            decodesOrRefuses(patched("dataWindow", "box2i", 0, {0, low, 47, high}), "tall"));
        EXPECT_FALSE(
            decodesOrRefuses(patched("dataWindow", "box2i", 0, {low, low, high, high}), "both"));
    }
    // Pixel type, then sampling, of the first channel ("B\0").
    for (const std::int32_t type : {3, -1, kMost}) {
        EXPECT_FALSE(decodesOrRefuses(patched("channels", "chlist", 2, {type}), "pixel type"));
    }
    for (const std::int32_t sampling : {0, 2, -1, kMost}) {
        EXPECT_FALSE(decodesOrRefuses(patched("channels", "chlist", 10, {sampling}), "sampling"));
    }
    for (std::size_t i = 0; i < 24; ++i) {
        io::Bytes deep = good;
        deep[5] = static_cast<unsigned char>(i << 2 | 2U);
        decodesOrRefuses(deep, "version flags " + std::to_string(i));
    }
    // Offsets of the two chunks pointing before, behind and near the end of 64 bits.
    std::size_t table = attributeValue(good, "screenWindowWidth", "float") + 4;
    while (good[table] != 0) {
        ++table; // other attributes follow in some versions
    }
    for (const std::uint64_t offset :
         {std::uint64_t{0}, std::uint64_t{1}, ~std::uint64_t{0}, ~std::uint64_t{7},
          std::uint64_t{1} << 63, std::uint64_t{good.size()}, std::uint64_t{good.size() - 2}}) {
        io::Bytes bytes = good;
        std::memcpy(bytes.data() + table + 1, &offset, 8);
        // OpenEXR rebuilds a table with entries at or below 0 from the chunks; then the pixels are
        // right.
        if (decodesOrRefuses(bytes, "offset " + std::to_string(offset))) {
            EXPECT_EQ(io::decodeImage(bytes, 0)->image.pixels(),
                      io::decodeImage(good, 0)->image.pixels());
        }
    }
}

TEST(HostileImage, JpegsThatLie) {
    const io::Bytes good = goodImages()[14].bytes;
    const io::Bytes marker{0xff, 0xc0};
    const auto frame = std::search(good.begin(), good.end(), marker.begin(), marker.end());
    ASSERT_NE(frame, good.end());
    const auto at = static_cast<std::size_t>(frame - good.begin()) + 5;
    for (const auto& [height, width] :
         {std::pair{65500, 65500}, {0, 48}, {24, 0}, {65535, 1}, {16384, 16384}}) {
        io::Bytes bytes = good;
        bytes[at] = static_cast<unsigned char>(height >> 8);
        bytes[at + 1] = static_cast<unsigned char>(height & 255);
        bytes[at + 2] = static_cast<unsigned char>(width >> 8);
        bytes[at + 3] = static_cast<unsigned char>(width & 255);
        EXPECT_FALSE(decodesOrRefuses(bytes, "size")) << height << " x " << width;
    }
    io::Bytes twelve = good;
    twelve[at - 1] = 12;
    EXPECT_FALSE(decodesOrRefuses(twelve, "12 bits"));
    EXPECT_FALSE(decodesOrRefuses({0xff, 0xd8, 0xff}, "three bytes"));
    EXPECT_FALSE(decodesOrRefuses({0xff, 0xd8, 0xff, 0xd9}, "nothing between"));
}

TEST(HostileImage, WhatIsNoImageIsRefused) {
    for (const std::string& text :
         {std::string(), std::string("x"), std::string("GIF89a"), std::string("BM"),
          std::string("II*\0", 4), std::string("{}"), std::string(1000, '\0')}) {
        EXPECT_FALSE(decodesOrRefuses(bytesOf(text), "no image"));
        EXPECT_FALSE(io::imageInfo(bytesOf(text)).ok());
    }
}

TEST(HostileImage, PublishedDamage) {
    LODESTAR_NEEDS_SHARED();
    int count = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(
             testing::sharedPath("assets/malformed-images"))) {
        if (entry.is_regular_file()) {
            ++count;
            EXPECT_FALSE(decodesOrRefuses(*io::readFile(entry.path()), entry.path().string()))
                << entry.path();
        }
    }
    EXPECT_EQ(count, 12);
}

} // namespace
} // namespace lodestar

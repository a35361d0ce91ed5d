// SPDX-License-Identifier: MIT
#include <csignal>
#include <stdexcept>

#include <sys/resource.h>

#include "support/shared.h"
#include "unit/io/image_support.h"

namespace lodestar {
namespace {

using testing::handMadePng;
using testing::pattern;
using testing::TemporaryFolder;

std::size_t filesIn(const std::filesystem::path& folder) {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder),
                                                  std::filesystem::directory_iterator()));
}

core::Image reread(const std::filesystem::path& path) {
    const core::Result<io::Bytes> bytes = io::readFile(path);
    EXPECT_TRUE(bytes.ok());
    core::Result<io::DecodedImage> decoded = io::decodeImage(*bytes, 0);
    EXPECT_TRUE(decoded.ok()) << decoded.error().message();
    return decoded.ok() ? decoded->image : core::Image();
}

TEST(ImageFile, ExrRoundTripsExactly) {
    const TemporaryFolder folder;
    for (int channels = 1; channels <= 4; ++channels) {
        core::Image image = pattern(13, 7, channels);
        image.pixels()[0] = 69120.0f;  // above the largest half
        image.pixels()[1] = -1.5e-30f; // below the smallest
        ASSERT_TRUE(io::writeImage(folder / "x.exr", image).ok());
        const core::Image back = reread(folder / "x.exr");
        EXPECT_EQ(back.channels(), channels);
        EXPECT_EQ(back.width(), 13);
        EXPECT_EQ(back.height(), 7);
        EXPECT_EQ(back.pixels(), image.pixels()) << channels;
    }
}

TEST(ImageFile, PngRoundTripsItsLevels) {
    const TemporaryFolder folder;
    for (int channels = 1; channels <= 4; ++channels) {
        core::Image image(16, 16, channels);
        for (std::size_t i = 0; i < image.pixels().size(); ++i) {
            image.pixels()[i] = static_cast<float>(i % 256) / 255.0f;
        }
        ASSERT_TRUE(io::writeImage(folder / "x.png", image).ok());
        const core::Image back = reread(folder / "x.png");
        ASSERT_EQ(back.channels(), channels);
        for (std::size_t i = 0; i < image.pixels().size(); ++i) {
            // Both are level / 255 rounded to float, by a division here and a product there.
            ASSERT_NEAR(back.pixels()[i], image.pixels()[i], 1e-7f)
                << channels << " channels, " << i;
        }
    }
}

TEST(ImageFile, PngRoundsToTheNearestLevelAndClamps) {
    const TemporaryFolder folder;
    core::Image image(4, 1, 1);
    image.pixels() = {-3.0f, 100.4f / 255.0f, 100.6f / 255.0f, 7.0f};
    ASSERT_TRUE(io::writeImage(folder / "x.png", image).ok());
    const core::Image back = reread(folder / "x.png");
    EXPECT_EQ(back.pixels()[0], 0.0f);
    EXPECT_NEAR(back.pixels()[1] * 255.0f, 100.0f, 1e-4f);
    EXPECT_NEAR(back.pixels()[2] * 255.0f, 101.0f, 1e-4f);
    EXPECT_EQ(back.pixels()[3], 1.0f);
}

TEST(ImageFile, WritesAreTheSameBytesEachTime) {
    const TemporaryFolder folder;
    for (const char* name : {"x.exr", "x.png"}) {
        ASSERT_TRUE(io::writeImage(folder / name, pattern(20, 10, 4)).ok());
        const io::Bytes first = *io::readFile(folder / name);
        ASSERT_TRUE(io::writeImage(folder / name, pattern(20, 10, 4)).ok());
        EXPECT_EQ(first, *io::readFile(folder / name)) << name;
    }
}

TEST(ImageFile, UnwritableTargetsAreReported) {
    const TemporaryFolder folder;
    for (const std::filesystem::path& path :
         {folder / "none/x.exr", folder / "x.jpg", folder / "x", std::filesystem::path("/dev/full"),
          folder / "x.tiff"}) {
        const core::Result<void> written = io::writeImage(path, pattern(4, 4, 3));
        ASSERT_FALSE(written.ok()) << path;
        EXPECT_EQ(written.error().code, core::ErrorCode::OutputFailed);
        EXPECT_EQ(written.error().file, path.string());
    }
    EXPECT_EQ(filesIn(folder.path()), 0U);
}

TEST(ImageFile, FullDiskLeavesTheOldImage) {
    const TemporaryFolder folder;
    const auto before = std::signal(SIGXFSZ, SIG_IGN);
    for (const char* name : {"x.exr", "x.png"}) {
        ASSERT_TRUE(io::writeImage(folder / name, pattern(8, 8, 3)).ok());
        const io::Bytes old = *io::readFile(folder / name);
        rlimit limit{};
        ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
        const rlimit tight{2048, limit.rlim_max};
        ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &tight), 0);
        const core::Result<void> written = io::writeImage(folder / name, pattern(128, 128, 3));
        ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
        ASSERT_FALSE(written.ok()) << name;
        EXPECT_EQ(written.error().code, core::ErrorCode::OutputFailed);
        EXPECT_EQ(*io::readFile(folder / name), old) << name;
    }
    std::signal(SIGXFSZ, before);
    EXPECT_EQ(filesIn(folder.path()), 2U);
}

TEST(ImageFile, NonFinitePixelsAreTheCallersBug) {
    const TemporaryFolder folder;
    core::setContractHandler([](const char*, const char* message, const char*, int) {
        throw std::logic_error(message);
    });
    core::Image image(2, 2, 3);
    image.pixels()[5] = std::nanf("");
    EXPECT_THROW(static_cast<void>(io::writeImage(folder / "x.exr", image)), std::logic_error);
    image.pixels()[5] = HUGE_VALF;
    EXPECT_THROW(static_cast<void>(io::writeImage(folder / "x.png", image)), std::logic_error);
    core::setContractHandler(nullptr);
    EXPECT_EQ(filesIn(folder.path()), 0U);
}

TEST(ImageFile, ChannelsAsAskedFor) {
    core::Image grey(1, 1, 2);
    grey.pixels() = {0.25f, 0.5f};
    const io::Bytes bytes = testing::encodedByLibrary(grey, "exr", "zip", OIIO::TypeDesc::FLOAT);
    const auto pixelsOf = [](const io::Bytes& from, int channels) {
        return io::decodeImage(from, channels)->image.pixels();
    };
    EXPECT_EQ(pixelsOf(bytes, 0), (std::vector<float>{0.25f, 0.5f}));
    EXPECT_EQ(pixelsOf(bytes, 1), (std::vector<float>{0.25f}));
    EXPECT_EQ(pixelsOf(bytes, 3), (std::vector<float>{0.25f, 0.25f, 0.25f}));
    EXPECT_EQ(pixelsOf(bytes, 4), (std::vector<float>{0.25f, 0.25f, 0.25f, 0.5f}));
    core::Image color(1, 1, 3);
    color.pixels() = {0.25f, 0.5f, 0.75f};
    const io::Bytes rgb = testing::encodedByLibrary(color, "exr", "zip", OIIO::TypeDesc::FLOAT);
    EXPECT_EQ(pixelsOf(rgb, 4), (std::vector<float>{0.25f, 0.5f, 0.75f, 1.0f}));
    EXPECT_EQ(pixelsOf(rgb, 2), (std::vector<float>{0.25f, 1.0f}));
}

TEST(ImageFile, ExrChannelsAreFoundByName) {
    const TemporaryFolder folder;
    const std::string path = (folder / "x.exr").string();
    OIIO::ImageSpec spec(1, 1, 5, OIIO::TypeDesc::FLOAT);
    spec.channelnames = {"Z", "B", "A", "depth.G", "R"};
    const float pixels[] = {9.0f, 0.3f, 0.4f, 7.0f, 0.1f};
    const auto output = OIIO::ImageOutput::create(path);
    ASSERT_TRUE(output->open(path, spec) && output->write_image(OIIO::TypeDesc::FLOAT, pixels) &&
                output->close());
    const auto decoded = io::decodeImage(*io::readFile(path), 0);
    ASSERT_TRUE(decoded.ok()) << decoded.error().message();
    EXPECT_EQ(decoded->image.pixels(), (std::vector<float>{0.1f, 0.3f, 0.4f}));
}

TEST(ImageFile, TransparentColoursAreKept) {
    // Associated alpha would multiply the colour away.
    const io::Bytes png = handMadePng(1, 1, 8, 6, false, {0, 200, 100, 50, 0});
    const auto decoded = io::decodeImage(png, 4);
    ASSERT_TRUE(decoded.ok());
    EXPECT_NEAR(decoded->image.pixels()[0], 200.0f / 255.0f, 1e-6f);
    EXPECT_EQ(decoded->image.pixels()[3], 0.0f);
}

TEST(ImageFile, PalettesAndInterlacingAreRead) {
    // Two bits a pixel, four in a row; the last index has no palette entry and reads black.
    const io::Bytes palette{255, 0, 0, 0, 255, 0, 0, 0, 255};
    const auto paletted =
        io::decodeImage(handMadePng(4, 1, 2, 3, false, {0, 0x1b}, palette, {255, 128}), 4);
    ASSERT_TRUE(paletted.ok()) << paletted.error().message();
    const std::vector<float>& p = paletted->image.pixels();
    EXPECT_EQ(std::vector<float>(p.begin(), p.begin() + 3), (std::vector<float>{1, 0, 0}));
    EXPECT_NEAR(p[7], 128.0f / 255.0f, 1e-6f);
    EXPECT_EQ(std::vector<float>(p.begin() + 8, p.begin() + 12), (std::vector<float>{0, 0, 1, 1}));
    // Adam7 on 5 x 5: the passes hold 1, 1, 2 x 1, 2 x 2 (columns 2..), 3, 3 x 2 and 2 rows of 5.
    io::Bytes rows;
    const auto row = [&](std::initializer_list<int> columns, int y) {
        rows.push_back(0);
        for (const int x : columns) {
            rows.push_back(static_cast<unsigned char>(10 * y + x));
        }
    };
    row({0}, 0);
    row({4}, 0);
    row({0, 4}, 4);
    row({2}, 0);
    row({2}, 4);
    row({0, 2, 4}, 2);
    row({1, 3}, 0);
    row({1, 3}, 2);
    row({1, 3}, 4);
    row({0, 1, 2, 3, 4}, 1);
    row({0, 1, 2, 3, 4}, 3);
    const auto interlaced = io::decodeImage(handMadePng(5, 5, 8, 0, true, rows), 0);
    ASSERT_TRUE(interlaced.ok()) << interlaced.error().message();
    for (int y = 0; y < 5; ++y) {
        for (int x = 0; x < 5; ++x) {
            EXPECT_NEAR(interlaced->image.at(x, y)[0] * 255.0f, static_cast<float>(10 * y + x),
                        1e-3f);
        }
    }
}

TEST(ImageFile, TexelsKeepTheFilesDepth) {
    struct Case {
        const char* name;
        io::Bytes png;
        core::SampleDepth depth;
        std::vector<int> samples; // of the first texel, then of the second
    };
    using enum core::SampleDepth;
    const io::Bytes palette{255, 0, 0, 10, 20, 30};
    const Case cases[] = {
        {"8-bit RGB",
         handMadePng(2, 1, 8, 2, false, {0, 1, 2, 3, 4, 5, 6}),
         Bits8,
         {1, 2, 3, 255, 4, 5, 6, 255}},
        {"8-bit RGBA",
         handMadePng(2, 1, 8, 6, false, {0, 1, 2, 3, 0, 5, 6, 7, 9}),
         Bits8,
         {1, 2, 3, 0, 5, 6, 7, 9}},
        {"grey",
         handMadePng(2, 1, 8, 0, false, {0, 7, 200}),
         Bits8,
         {7, 7, 7, 255, 200, 200, 200, 255}},
        {"grey of 2 bits",
         handMadePng(2, 1, 2, 0, false, {0, 0x90}),
         Bits8,
         {170, 170, 170, 255, 85, 85, 85, 255}},
        {"grey, one shade transparent",
         handMadePng(2, 1, 8, 0, false, {0, 7, 200}, {}, {0, 200}),
         Bits8,
         {7, 7, 7, 255, 200, 200, 200, 0}},
        {"grey and alpha",
         handMadePng(2, 1, 8, 4, false, {0, 7, 3, 200, 0}),
         Bits8,
         {7, 7, 7, 3, 200, 200, 200, 0}},
        {"palette",
         handMadePng(2, 1, 8, 3, false, {0, 1, 0}, palette, {128}),
         Bits8,
         {10, 20, 30, 255, 255, 0, 0, 128}},
        {"16-bit RGB",
         handMadePng(2, 1, 16, 2, false, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}),
         Bits16,
         {258, 772, 1286, 65535, 1800, 2314, 2828, 65535}},
        {"16-bit grey and alpha",
         handMadePng(2, 1, 16, 4, false, {0, 1, 2, 3, 4, 0, 9, 255, 254}),
         Bits16,
         {258, 258, 258, 772, 9, 9, 9, 65534}},
    };
    for (const Case& c : cases) {
        const core::Result<core::Texels> texels = io::decodeTexels(c.png);
        ASSERT_TRUE(texels.ok()) << c.name << texels.error().message();
        ASSERT_EQ(texels->depth(), c.depth) << c.name;
        const float most = c.depth == Bits8 ? 255.0f : 65535.0f;
        for (int i = 0; i < 8; ++i) {
            EXPECT_EQ(texels->value(i / 4, 0, i % 4),
                      static_cast<float>(c.samples[static_cast<std::size_t>(i)]) / most)
                << c.name << " sample " << i;
        }
    }
}

TEST(ImageFile, FloatsAsTexelsAreClampedTo16Bits) {
    core::Image image(1, 1, 4);
    image.pixels() = {-1.0f, 0.25f, 7.0f, 0.5f};
    const core::Result<core::Texels> texels =
        io::decodeTexels(testing::encodedByLibrary(image, "exr", "zip", OIIO::TypeDesc::FLOAT));
    ASSERT_TRUE(texels.ok());
    EXPECT_EQ(texels->depth(), core::SampleDepth::Bits16);
    const float expected[] = {0.0f, 16384.0f / 65535.0f, 1.0f, 32768.0f / 65535.0f};
    for (int c = 0; c < 4; ++c) {
        EXPECT_EQ(texels->value(0, 0, c), expected[c]) << c;
    }
}

TEST(ImageFile, StoredTexelsAreThoseOfAnotherReader) {
    const TemporaryFolder folder;
    int read = 0;
    for (const testing::Sample& sample : testing::goodImages()) {
        const bool png = sample.name.rfind("png", 0) == 0;
        if (!png && sample.name.rfind("jpeg", 0) != 0) {
            continue;
        }
        ++read;
        const std::filesystem::path path = folder / (png ? "x.png" : "x.jpg");
        ASSERT_TRUE(io::writeFile(path, sample.bytes.data(), sample.bytes.size()).ok());
        OIIO::ImageSpec config;
        config.attribute("oiio:UnassociatedAlpha", 1);
        const auto input = OIIO::ImageInput::open(path.string(), &config);
        ASSERT_TRUE(input);
        const int channels = input->spec().nchannels;
        std::vector<std::uint16_t> theirs(static_cast<std::size_t>(48 * 24 * channels));
        ASSERT_TRUE(input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT16, theirs.data()));
        const core::Result<core::Texels> ours = io::decodeTexels(sample.bytes);
        ASSERT_TRUE(ours.ok()) << sample.name;
        for (std::size_t i = 0; i < theirs.size(); ++i) {
            const int texel = static_cast<int>(i) / channels;
            ASSERT_EQ(
                std::lround(ours->value(texel % 48, texel / 48, static_cast<int>(i) % channels) *
                            65535.0f),
                theirs[i])
                << sample.name << " sample " << i;
        }
    }
    EXPECT_EQ(read, 5);
}

TEST(ImageFile, HdrPixelsAreMantissaTimesPowerOfTwo) {
    std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n";
    const unsigned char pixels[] = {128, 64, 32, 129, 1, 2, 3, 128, 0, 0, 0, 0, 255, 255, 255, 136};
    text.append(reinterpret_cast<const char*>(pixels), sizeof pixels);
    const auto decode = [](const std::string& file) {
        return io::decodeImage(io::Bytes(file.begin(), file.end()), 0);
    };
    const auto decoded = decode(text);
    ASSERT_TRUE(decoded.ok()) << decoded.error().message();
    EXPECT_EQ(decoded->image.pixels(),
              (std::vector<float>{1.0f, 0.5f, 0.25f, 1 / 256.0f, 2 / 256.0f, 3 / 256.0f, 0, 0, 0,
                                  255, 255, 255}));
    std::string flipped = text;
    flipped.replace(flipped.find("-Y 2 +X 2"), 9, "+Y 2 -X 2");
    const auto turned = decode(flipped);
    ASSERT_TRUE(turned.ok());
    EXPECT_EQ(turned->image.at(1, 1)[0], 1.0f);
    EXPECT_EQ(turned->image.at(0, 0)[0], 255.0f);
}

TEST(ImageFile, OldRunsRepeatThePixel) {
    std::string text = "#?RGBE\n\n-Y 1 +X 300\n";
    const unsigned char pixels[] = {128, 128, 128, 129, 1, 1, 1, 43, 1, 1, 1, 1};
    text.append(reinterpret_cast<const char*>(pixels), sizeof pixels);
    // 1 + 43 + 256 = 300
    const auto decoded = io::decodeImage(io::Bytes(text.begin(), text.end()), 3);
    ASSERT_TRUE(decoded.ok()) << decoded.error().message();
    for (const float value : decoded->image.pixels()) {
        ASSERT_EQ(value, 1.0f);
    }
}

TEST(ImageFile, AgreesWithTheLibrarysOwnReader) {
    LODESTAR_NEEDS_SHARED();
    for (const char* name : {"pmndrs/park.hdr", "pmndrs/city.hdr", "blender-data/forest.exr",
                             "openexr-images/KernerEnvLatLong.exr"}) {
        const std::string path = testing::sharedPath("assets/hdr/").string() + name;
        const auto input = OIIO::ImageInput::open(path);
        ASSERT_TRUE(input);
        const OIIO::ImageSpec spec = input->spec();
        std::vector<float> pixels(static_cast<std::size_t>(spec.width) *
                                  static_cast<std::size_t>(spec.height) * 3);
        ASSERT_TRUE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, pixels.data()));
        const auto decoded = io::decodeImage(*io::readFile(path), 3);
        ASSERT_TRUE(decoded.ok()) << name;
        EXPECT_EQ(decoded->image.pixels(), pixels) << name;
    }
}

TEST(ImageFile, NonFinitePixelsLoadAsTheyAre) {
    LODESTAR_NEEDS_SHARED();
    const auto decoded = io::decodeImage(
        *io::readFile(testing::sharedPath("assets/hdr/OpenImageIO/oiiotool-fixnan/src/bad.exr")),
        0);
    ASSERT_TRUE(decoded.ok());
    const std::vector<float>& pixels = decoded->image.pixels();
    EXPECT_EQ(
        std::count_if(pixels.begin(), pixels.end(), [](float v) { return !std::isfinite(v); }), 2);
}

} // namespace
} // namespace lodestar

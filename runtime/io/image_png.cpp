// SPDX-License-Identifier: MIT
//
// PNG pixels through libpng, whose every complaint is caught: none reaches stderr. Its errors jump,
// so the functions between them own nothing.
#include <algorithm>
#include <csetjmp>
#include <cstring>

#include <png.h>

#include "io/image_internal.h"

namespace lodestar::io::detail {
namespace {

/// What the callbacks share.
struct Source {
    const unsigned char* at;
    std::size_t left;
    char message[96];
};

void onError(png_structp png, png_const_charp message) {
    auto* source = static_cast<Source*>(png_get_error_ptr(png));
    std::strncpy(source->message, message, sizeof source->message - 1);
    png_longjmp(png, 1);
}

void onWarning(png_structp /*png*/, png_const_charp /*message*/) {}

void onRead(png_structp png, png_bytep to, png_size_t count) {
    auto* source = static_cast<Source*>(png_get_io_ptr(png));
    if (count > source->left) {
        png_error(png, "it ends too early");
    }
    std::memcpy(to, source->at, count);
    source->at += count;
    source->left -= count;
}

/// Whatever is stored, as RGBA samples of 8 bits or, where the file has 16, of 16.
void askForRgba(png_structp png, bool wide) {
    png_set_expand(png);
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, 0xffff, PNG_FILLER_AFTER);
    constexpr std::uint16_t kOne = 1;
    unsigned char first = 0;
    std::memcpy(&first, &kOne, 1);
    if (wide && first == 1) {
        png_set_swap(png);
    }
}

/// False with a message where the file is damaged. @param rows one pointer a row
bool readRows(Source& source, bool wide, std::size_t rowBytes, png_bytepp rows) {
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, onError, onWarning);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    if (info == nullptr) {
        png_destroy_read_struct(&png, nullptr, nullptr);
        std::strncpy(source.message, "libpng cannot be started", sizeof source.message - 1);
        return false;
    }
    if (setjmp(png_jmpbuf(png)) != 0) {
        png_destroy_read_struct(&png, &info, nullptr);
        return false;
    }
    png_set_read_fn(png, &source, onRead);
    // The checksums of all chunks have been checked.
    png_set_crc_action(png, PNG_CRC_QUIET_USE, PNG_CRC_QUIET_USE);
    png_read_info(png, info);
    askForRgba(png, wide);
    static_cast<void>(png_set_interlace_handling(png));
    png_read_update_info(png, info);
    if (png_get_rowbytes(png, info) != rowBytes) {
        png_error(png, "its header says two different things");
    }
    png_read_image(png, rows);
    png_destroy_read_struct(&png, &info, nullptr);
    return true;
}

} // namespace

core::Result<core::Texels> decodePng(const StrippedImage& png) {
    const ImageInfo& info = png.header.info;
    const bool wide = info.bits == 16;
    core::Texels texels(info.width, info.height,
                        wide ? core::SampleDepth::Bits16 : core::SampleDepth::Bits8);
    const std::size_t rowBytes = texels.rowBytes();
    std::vector<png_bytep> rows(static_cast<std::size_t>(info.height));
    for (std::size_t y = 0; y < rows.size(); ++y) {
        rows[y] = texels.bytes().data() + y * rowBytes;
    }
    Source source{png.bytes.data(), png.bytes.size(), {}};
    if (!readRows(source, wide, rowBytes, rows.data())) {
        return core::refused(std::string("damaged PNG: ") + source.message);
    }
    return texels;
}

} // namespace lodestar::io::detail

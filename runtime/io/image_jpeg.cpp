// SPDX-License-Identifier: MIT
//
// JPEG pixels through libjpeg, whose every complaint is caught: none reaches stderr. Its errors
// jump, so the functions between them own nothing.
#include <algorithm>
#include <csetjmp>
#include <cstdio>

#include <jpeglib.h>

#include "io/image_internal.h"

namespace lodestar::io::detail {
namespace {

struct ErrorManager {
    jpeg_error_mgr base; ///< first: libjpeg knows no other
    std::jmp_buf jump;
    char message[JMSG_LENGTH_MAX];
};

[[noreturn]] void onError(j_common_ptr jpeg) {
    auto* manager = reinterpret_cast<ErrorManager*>(jpeg->err);
    jpeg->err->format_message(jpeg, manager->message);
    std::longjmp(manager->jump, 1);
}

/// Warnings mean lost pixels; trace messages mean nothing.
void onMessage(j_common_ptr jpeg, int level) {
    if (level < 0) {
        onError(jpeg);
    }
}

/// Inks, which files hold inverted, as light: R = C K.
void lightFromInks(unsigned char* pixels, int width) {
    for (int x = 0; x < width; ++x, pixels += 4) {
        for (int c = 0; c < 3; ++c) {
            pixels[c] = static_cast<unsigned char>((pixels[c] * pixels[3] + 127) / 255);
        }
        pixels[3] = 255;
    }
}

/// False with a message where the file is damaged.
bool readRows(const Bytes& bytes, ErrorManager& manager, core::Texels& texels) {
    jpeg_decompress_struct jpeg;
    jpeg.err = jpeg_std_error(&manager.base);
    manager.base.error_exit = onError;
    manager.base.emit_message = onMessage;
    jpeg_create_decompress(&jpeg);
    if (setjmp(manager.jump) != 0) {
        jpeg_destroy_decompress(&jpeg);
        return false;
    }
    jpeg_mem_src(&jpeg, bytes.data(), static_cast<unsigned long>(bytes.size()));
    static_cast<void>(jpeg_read_header(&jpeg, TRUE));
    const bool inks = jpeg.num_components == 4;
    jpeg.out_color_space = inks ? JCS_CMYK : JCS_EXT_RGBA;
    static_cast<void>(jpeg_start_decompress(&jpeg));
    if (static_cast<int>(jpeg.output_width) != texels.width() ||
        static_cast<int>(jpeg.output_height) != texels.height()) {
        std::snprintf(manager.message, sizeof manager.message,
                      "its header says two different things");
        jpeg_destroy_decompress(&jpeg);
        return false;
    }
    while (jpeg.output_scanline < jpeg.output_height) {
        JSAMPROW row = texels.bytes().data() + texels.rowBytes() * jpeg.output_scanline;
        static_cast<void>(jpeg_read_scanlines(&jpeg, &row, 1));
        if (inks) {
            lightFromInks(row, texels.width());
        }
    }
    static_cast<void>(jpeg_finish_decompress(&jpeg));
    jpeg_destroy_decompress(&jpeg);
    return true;
}

} // namespace

core::Result<core::Texels> decodeJpeg(const StrippedImage& jpeg) {
    core::Texels texels(jpeg.header.info.width, jpeg.header.info.height);
    ErrorManager manager{};
    if (!readRows(jpeg.bytes, manager, texels)) {
        return core::refused(std::string("damaged JPEG: ") + manager.message);
    }
    return texels;
}

} // namespace lodestar::io::detail

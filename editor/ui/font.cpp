// SPDX-License-Identifier: MIT
#include "ui/font.h"

#ifdef LODESTAR_FONT

asm(".section .rodata\n"
    ".balign 16\n"
    "lodestar_font_begin:\n"
    ".incbin \"" LODESTAR_FONT "\"\n"
    "lodestar_font_end:\n"
    ".byte 0\n"
    ".previous\n");

extern "C" {
extern const unsigned char lodestar_font_begin[] __attribute__((visibility("hidden")));
extern const unsigned char lodestar_font_end[] __attribute__((visibility("hidden")));
}
#endif

namespace lodestar::ui {

std::span<const unsigned char> embeddedFont() {
#ifdef LODESTAR_FONT
    return {lodestar_font_begin, lodestar_font_end};
#else
    return {};
#endif
}

} // namespace lodestar::ui

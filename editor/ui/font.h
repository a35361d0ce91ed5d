// SPDX-License-Identifier: MIT
//
// DejaVu Sans as bytes of the program, so that no file is needed when it runs.
#pragma once

#include <span>

namespace lodestar::ui {

/// A TrueType font; empty where none was there when the program was built.
[[nodiscard]] std::span<const unsigned char> embeddedFont();

} // namespace lodestar::ui

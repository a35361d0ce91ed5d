// SPDX-License-Identifier: MIT
//
// Debian's Dear ImGui asserts in release builds too. While a frame of ours is built, an assertion
// is an exception and not the end of the process: the document outlives it.
#pragma once

#include <functional>
#include <string>

namespace lodestar::ui {

/// Runs a piece of a frame. @return what was asserted in vain, with its place; empty: nothing was
[[nodiscard]] std::string guarded(const std::function<void()>& piece);

} // namespace lodestar::ui

// SPDX-License-Identifier: MIT
//
// An OpenGL context without a window or display server, through EGL.
#pragma once

#include <memory>

#include "core/result.h"

namespace lodestar::platform {

/// A current core-profile context of OpenGL 3.3 or later, with debug output where the driver has
/// it. Move-only; ends with the object. One thread at a time.
class HeadlessContext {
public:
    /// Tries EGL's surfaceless platform, then its devices.
    /// @errors NoOpenGl, saying what was asked for and what was found
    [[nodiscard]] static core::Result<HeadlessContext> create();

    HeadlessContext(HeadlessContext&& other) noexcept;
    HeadlessContext& operator=(HeadlessContext&& other) noexcept;
    ~HeadlessContext();

private:
    struct Handles;
    explicit HeadlessContext(std::unique_ptr<Handles> handles);
    std::unique_ptr<Handles> handles_;
};

} // namespace lodestar::platform

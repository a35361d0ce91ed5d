// SPDX-License-Identifier: MIT
//
// A picture of errors as a texture that a window shows.
#pragma once

#include "app/error_view.h"
#include "gl/texture.h"

namespace lodestar::app {

/// The view's picture with its legend over the lowest rows; row 0 at the top.
/// @pre a pass has been added  @errors NoOpenGl
[[nodiscard]] core::Result<gl::Texture> errorTexture(gl::Device& device, const ErrorView& view);

} // namespace lodestar::app

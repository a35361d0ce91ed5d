// SPDX-License-Identifier: MIT
//
// What OpenImageIO does for this room. It lives in a module that is loaded at the first image that
// needs it: the library draws in some 260 others, whose loading costs a third of a second that a
// run without such an image need not pay.
#pragma once

#include <string>

#include "core/image.h"
#include "core/result.h"
#include "io/image_file.h"

namespace lodestar::io {

/// The module's functions.
struct ImageCodec {
    /// Pixels of an EXR whose header has been checked. @errors InputRefused
    core::Result<core::Image> (*decode)(const Bytes& bytes, const ImageInfo& info);
    /// A whole file. @param format "openexr" or "png"  @errors OutputFailed
    core::Result<Bytes> (*encode)(const core::Image& image, const std::string& format,
                                  const ImageTexts& texts);
};

/// The module, loaded on the first call. @errors Internal if it is not beside the program
[[nodiscard]] core::Result<const ImageCodec*> imageCodec();

/// The module's only exported symbol.
extern "C" __attribute__((visibility("default"))) const ImageCodec* lodestarImageCodec();

} // namespace lodestar::io

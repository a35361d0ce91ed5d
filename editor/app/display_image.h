// SPDX-License-Identifier: MIT
//
// A rendered picture as a display shows it.
#pragma once

#include "core/image.h"

namespace lodestar::app {

/// Premultiplied linear radiance to encoded, unassociated display values in [0, 1]: exposure, the
/// filmic curve, sRGB. @param exposure stops
[[nodiscard]] core::Image toDisplay(const core::Image& radiance, double exposure);

} // namespace lodestar::app

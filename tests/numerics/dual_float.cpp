// SPDX-License-Identifier: MIT
#include "lodestar/cube.glsl"
#include "lodestar/display.glsl"
#include "lodestar/lobes.glsl"
#include "lodestar/sh9.glsl"

#include "numerics/dual_rows.h"
#include "numerics/dual_rows_body.h"

namespace lodestar::testing {

std::vector<DualRow> floatRows() {
    return allRows();
}

} // namespace lodestar::testing

// SPDX-License-Identifier: MIT
#pragma once

namespace lodestar::testing {

/// How far lodestar_prefilteredLevel may be from the exact level.
/// @param off of the exponent plus 1, relative
double prefilteredLevelError(double exponent, double width, double maxLevel, double off);

} // namespace lodestar::testing

// SPDX-License-Identifier: MIT
//
// What a light's day is between two keys, as a key.
#pragma once

#include "core/result.h"
#include "document/document.h"

namespace lodestar::model {

/// A key with what the light is at an hour. Its gradient has the stops of both neighbours; between
/// two it is exact where both are linear in linear radiance or both constant, else stops are added
/// until it is within 1/256 of the radiance or 256 are reached. A tint that both share is kept,
/// others are in the colours.
/// @param hour [0, 24)  @errors InputRefused as document::dayLights
[[nodiscard]] core::Result<document::Key> keyAt(const document::Light& light, double hour);

} // namespace lodestar::model

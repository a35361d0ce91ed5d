// SPDX-License-Identifier: MIT
//
// Which values a command may bring into a document. Internal.
#pragma once

#include <initializer_list>

#include "core/result.h"
#include "document/document.h"
#include "model/state.h"

namespace lodestar::model {

/// A finite number without what text and arithmetic treat apart: -0 and denormals become 0.
[[nodiscard]] double plain(double value);
[[nodiscard]] glm::dvec3 plain(const glm::dvec3& value);

[[nodiscard]] bool finite(double value);
[[nodiscard]] bool finite(const glm::dvec3& value);

/// An angle brought into its range. @errors InputRefused: not finite
[[nodiscard]] core::Result<double> checkedAngle(double at, lighting::LightKind kind);
/// An hour brought into [0, 24). @errors InputRefused: not finite
[[nodiscard]] core::Result<double> checkedHour(double hour);
/// @errors InputRefused: stop_commands.h
[[nodiscard]] core::Result<document::Stop> checkedStop(document::Stop stop,
                                                       lighting::LightKind kind);
/// Every stop by `checkedStop`; members that no version knows as they are read. @errors
/// InputRefused: none, more than kMostStops
[[nodiscard]] core::Result<document::Gradient> checkedGradient(document::Gradient gradient,
                                                               lighting::LightKind kind);
/// @errors InputRefused: not finite, negative, above 1e9
[[nodiscard]] core::Result<glm::dvec3> checkedTint(const glm::dvec3& tint);
/// @errors InputRefused: not finite, no direction
[[nodiscard]] core::Result<glm::dvec3> checkedAxis(const glm::dvec3& axis);
[[nodiscard]] core::Result<document::Key> checkedKey(document::Key key, lighting::LightKind kind);
/// @errors InputRefused: no keys, a key's, what document::parseDocument refuses
[[nodiscard]] core::Result<document::Light> checkedLight(document::Light light);
/// A light but for its keys. @errors as `checkedLight`
[[nodiscard]] core::Result<document::Light> checkedValues(document::Light light);

/// A document as it is read from the text that it is written as: what is kept is what a later load
/// finds. @errors InputRefused by document::parseDocument
[[nodiscard]] core::Result<document::Document> asRead(const document::Document& document);

/// Whether some stop's radiance times its key's tint lies above 1e9, where lighting lowers it.
[[nodiscard]] bool tooBright(const document::Document& document);

/// A document's text fits what is read again. @errors InputRefused: larger
[[nodiscard]] core::Result<void> checkedSize(const document::Document& document);

} // namespace lodestar::model

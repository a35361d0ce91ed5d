// SPDX-License-Identifier: MIT
//
// Values of commands as JSON: numbers, choices by name, parts of a document by the document's own
// reader and writer. Internal to command_text.cpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/result.h"
#include "model/command.h"

namespace lodestar::model {

using Json = nlohmann::ordered_json;

/// The JSON pointer of a light, key, stop or probe in the document; empty for a name of none.
[[nodiscard]] std::string pointerOf(const Identities& ids, Id id);
/// The part at such a pointer; None where none is.
[[nodiscard]] Id partAt(const Identities& ids, std::string_view pointer);

/// Degrees that are read as the same radians.
[[nodiscard]] Json jsonOfAngle(double radians);
[[nodiscard]] core::Result<void> readAngle(const Json& json, double& radians);

[[nodiscard]] Json jsonOf(double value);
[[nodiscard]] Json jsonOf(bool value);
[[nodiscard]] Json jsonOf(std::size_t value);
[[nodiscard]] Json jsonOf(const std::string& value);
[[nodiscard]] Json jsonOf(const glm::dvec3& value);
[[nodiscard]] Json jsonOf(lighting::GradientInterpolation value);
[[nodiscard]] Json jsonOf(lighting::GradientSpace value);
[[nodiscard]] Json jsonOf(BrushMode value);
[[nodiscard]] Json jsonOf(MaterialField value);
[[nodiscard]] Json jsonOf(const lighting::SunPath& value);
[[nodiscard]] Json jsonOf(const std::vector<document::Stop>& value);
[[nodiscard]] Json jsonOf(const document::Gradient& value);
[[nodiscard]] Json jsonOf(const document::Key& value);
[[nodiscard]] Json jsonOf(const document::Light& value);
[[nodiscard]] Json jsonOf(const std::vector<document::Light>& value);
[[nodiscard]] Json jsonOf(const lighting::Probe& value);
[[nodiscard]] Json jsonOf(const document::Document& value);

/// @errors InputRefused; its place is a pointer below the value
[[nodiscard]] core::Result<void> readPart(const Json& json, double& value);
[[nodiscard]] core::Result<void> readPart(const Json& json, bool& value);
[[nodiscard]] core::Result<void> readPart(const Json& json, std::size_t& value);
[[nodiscard]] core::Result<void> readPart(const Json& json, std::string& value);
[[nodiscard]] core::Result<void> readPart(const Json& json, glm::dvec3& value);
[[nodiscard]] core::Result<void> readPart(const Json& json, lighting::GradientInterpolation& value);
[[nodiscard]] core::Result<void> readPart(const Json& json, lighting::GradientSpace& value);
[[nodiscard]] core::Result<void> readPart(const Json& json, BrushMode& value);
[[nodiscard]] core::Result<void> readPart(const Json& json, MaterialField& value);
[[nodiscard]] core::Result<void> readPart(const Json& json, lighting::SunPath& value);
[[nodiscard]] core::Result<void> readPart(const Json& json, std::vector<document::Stop>& value);
[[nodiscard]] core::Result<void> readPart(const Json& json, document::Gradient& value);
[[nodiscard]] core::Result<void> readPart(const Json& json, document::Key& value);
[[nodiscard]] core::Result<void> readPart(const Json& json, document::Light& value);
[[nodiscard]] core::Result<void> readPart(const Json& json, std::vector<document::Light>& value);
[[nodiscard]] core::Result<void> readPart(const Json& json, lighting::Probe& value);
[[nodiscard]] core::Result<void> readPart(const Json& json, document::Document& value);

} // namespace lodestar::model

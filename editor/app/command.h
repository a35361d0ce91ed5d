// SPDX-License-Identifier: MIT
//
// What the subcommands share: how errors and warnings are printed, and words become numbers.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/result.h"
#include "core/tally.h"

namespace lodestar::app {

/// Prints `lodestar: FILE: what (where)` and returns the exit status of the error.
int fail(const core::Error& error);

/// Prints a line `lodestar: warning: FILE: rule (count times)` for each rule.
void warn(const core::Tally& warnings, const std::string& file);

/// A line on the error stream that overwrites itself where someone watches.
void progress(const std::string& what, std::size_t done, std::size_t of);
/// Takes it away.
void endProgress();

[[nodiscard]] core::Error usage(std::string what, std::string where = {});

/// "a,b,c" as numbers. @errors Usage naming the option if there are not `count` finite numbers
[[nodiscard]] core::Result<std::vector<double>>
parseNumbers(std::string_view text, std::size_t count, const std::string& option);
[[nodiscard]] core::Result<glm::dvec3> parseVector(std::string_view text,
                                                   const std::string& option);

/// The same as a unit vector. @errors Usage naming the option if it has no length
[[nodiscard]] core::Result<glm::dvec3> parseAxis(std::string_view text, const std::string& option);

/// "a,b,c" as exponents of finite lobes, [0, 1e7], in their order. @errors Usage naming the option
[[nodiscard]] core::Result<std::vector<double>> parseExponents(std::string_view text,
                                                               const std::string& option);

/// A Blinn-Phong or Phong exponent: a number from 0, or `inf` or `mirror`. @errors Usage
[[nodiscard]] core::Result<double> parseExponent(std::string_view text, const std::string& option);

} // namespace lodestar::app

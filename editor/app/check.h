// SPDX-License-Identifier: MIT
//
// `lodestar check`: what a file holds, or why it is refused.
#pragma once

#include <string>
#include <vector>

namespace lodestar::app {

/// Prints one JSON object on stdout, or an array of them for several files: what a scene or an
/// image holds, or `error`. The first refused file is also named by a line on stderr.
/// @return the exit status: 0, or 3 if any file was refused
int runCheck(const std::vector<std::string>& files);

} // namespace lodestar::app

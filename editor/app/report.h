// SPDX-License-Identifier: MIT
//
// How the command line speaks of failures: one line on stderr, an exit status.
#pragma once

#include <cstdio>
#include <string>

#include "core/result.h"
#include "core/tally.h"

namespace lodestar::app {

/// Prints `lodestar: FILE: what is wrong (where)`. @return the exit status, a core::ErrorCode
inline int reportError(const core::Error& error) {
    std::fprintf(stderr, "lodestar: %s\n", error.message().c_str());
    return static_cast<int>(error.code);
}

/// Prints `lodestar: warning: FILE: rule (count times)` for each rule counted.
inline void reportWarnings(const std::string& file, const core::Tally& warnings) {
    for (const auto& [rule, count] : warnings.counts()) {
        std::fprintf(stderr, "lodestar: warning: %s: %s (%llu times)\n", file.c_str(), rule.c_str(),
                     static_cast<unsigned long long>(count));
    }
}

} // namespace lodestar::app

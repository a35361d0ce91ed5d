// SPDX-License-Identifier: MIT
//
// Files that not every machine has. A test that needs them reports a skip with its reason; the run
// counts and prints the skips.
#pragma once

#include <filesystem>

#include <gtest/gtest.h>

namespace lodestar::testing {

inline std::filesystem::path sharedPath(const char* relative) {
    return std::filesystem::path(LODESTAR_SHARED) / relative;
}

} // namespace lodestar::testing

/// Skips the test where the shared folder is absent.
#define LODESTAR_NEEDS_SHARED()                                                                    \
    if (!std::filesystem::exists(::lodestar::testing::sharedPath("assets"))) {                     \
        GTEST_SKIP() << "needs the shared assets, which this machine lacks";                       \
    }

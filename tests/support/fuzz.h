// SPDX-License-Identifier: MIT
//
// How much random input a test tries: more where LODESTAR_FUZZ_FACTOR says so (tests/run.sh
// --long).
#pragma once

#include <algorithm>
#include <cstdlib>

namespace lodestar::testing {

/// @param rounds of the normal run  @return rounds times LODESTAR_FUZZ_FACTOR, taken as 1 to 1000
[[nodiscard]] inline int fuzzRounds(int rounds) {
    const char* text = std::getenv("LODESTAR_FUZZ_FACTOR");
    const long factor = text != nullptr ? std::strtol(text, nullptr, 10) : 1;
    return rounds * static_cast<int>(std::clamp(factor, 1L, 1000L));
}

} // namespace lodestar::testing

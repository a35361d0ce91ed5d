// SPDX-License-Identifier: MIT
//
// Independent pieces of work on all processors.
#pragma once

#include <cstddef>
#include <functional>

namespace lodestar::core {

/// Calls `work` once for each index below `count`, on as many threads as there are processors, this
/// one too. Which thread gets which index is left open: results must not depend on it. `work` does
/// not throw.
/// @param progress called on this thread now and then with how many are done; may be empty
/// @param threads how many at most; 0: as many as there are processors
void inParallel(std::size_t count, const std::function<void(std::size_t)>& work,
                const std::function<void(std::size_t)>& progress = {}, std::size_t threads = 0);

} // namespace lodestar::core

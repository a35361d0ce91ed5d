// SPDX-License-Identifier: MIT
#include "core/parallel.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace lodestar::core {

void inParallel(std::size_t count, const std::function<void(std::size_t)>& work,
                const std::function<void(std::size_t)>& progress, std::size_t threads) {
    std::atomic<std::size_t> next{0};
    std::atomic<std::size_t> done{0};
    const auto run = [&](const std::function<void(std::size_t)>& tell) {
        for (std::size_t i = next++; i < count; i = next++) {
            work(i);
            ++done;
            if (tell) {
                tell(done);
            }
        }
    };
    const std::size_t processors =
        threads > 0 ? threads : std::max<std::size_t>(std::thread::hardware_concurrency(), 1);
    std::vector<std::jthread> helpers;
    for (std::size_t i = 1; i < std::min(processors, count); ++i) {
        helpers.emplace_back([&] { run({}); });
    }
    run(progress);
}

} // namespace lodestar::core

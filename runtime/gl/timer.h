// SPDX-License-Identifier: MIT
//
// Time that the GPU takes for a stretch of commands. Neither copied nor moved.
#pragma once

#include <chrono>

#include "gl/device.h"

namespace lodestar::gl {

/// On software rasterisers the time between two waits for all that was asked for: llvmpipe begins
/// its own queries anew with each tile of a picture, and so tells of the last tile alone.
class Timer {
public:
    explicit Timer(Device& device);
    Timer(const Timer&) = delete;
    Timer& operator=(const Timer&) = delete;
    ~Timer();

    /// Stretches do not nest.
    void begin();
    void end();
    /// Milliseconds of the last stretch; waits for the result.
    [[nodiscard]] double milliseconds() const;
    /// Whether the result is there: then nothing waits for it.
    [[nodiscard]] bool isReady() const;

private:
    using Clock = std::chrono::steady_clock;
    unsigned id_ = 0; ///< 0: on a software rasteriser
    Clock::time_point begun_{}, ended_{};
};

} // namespace lodestar::gl

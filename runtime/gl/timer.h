// SPDX-License-Identifier: MIT
//
// GPU time of a stretch of commands. Move-only.
#pragma once

#include "gl/device.h"

namespace lodestar::gl {

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
    unsigned id_ = 0;
};

} // namespace lodestar::gl

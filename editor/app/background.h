// SPDX-License-Identifier: MIT
//
// Long work beside the frames: on a thread of its own, its result brought in between two frames.
#pragma once

#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "core/result.h"

namespace lodestar::app {

class Background {
public:
    /// What the work says of itself and asks.
    struct Progress {
        std::atomic<std::size_t> stage{0}; ///< of the work's, which it counts up
        std::atomic<bool> cancelled{false};
    };
    /// Brings a result in, on the thread of the frames.
    using Finish = std::function<void()>;
    /// Runs on the other thread: no OpenGL, nothing that the frames change.
    /// @errors what the work's file is refused for
    using Task = std::function<core::Result<Finish>(Progress&)>;

    Background() = default;
    Background(const Background&) = delete;
    Background& operator=(const Background&) = delete;
    /// Waits for what still runs: no library can be stopped within a call.
    ~Background();

    /// Begins work; what was under way is cancelled. @param stages in words, at least one
    void start(std::vector<std::string> stages, Task task);
    /// Nothing comes of what is under way: it ends at its next stage.
    void cancel();
    [[nodiscard]] bool runs() const { return work_ != nullptr; }
    /// The stage in words, and the share of the stages that are done. @pre runs()
    [[nodiscard]] const std::string& stage() const;
    [[nodiscard]] double share() const;

    /// Brings in what is done. Call it between frames.
    /// @return whether another stage or the end was reached since the last call
    /// @errors the work's
    [[nodiscard]] core::Result<bool> poll();

private:
    struct Work {
        std::vector<std::string> stages;
        Progress progress;
        std::size_t seen = 0; ///< stage
        std::future<core::Result<Finish>> result;
    };
    std::unique_ptr<Work> work_;
    std::vector<std::unique_ptr<Work>> cancelled_; ///< that have not ended yet
};

} // namespace lodestar::app

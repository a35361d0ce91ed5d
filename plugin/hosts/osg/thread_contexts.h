// SPDX-License-Identifier: MIT
//
// Contexts end on the thread that opened them: the library's [main] functions refuse any other.
#pragma once

#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "hosts/lit_context.h"

namespace lodestar::osghost {

/// The contexts of one thread. What uses one may be deleted on any thread: the context then ends at
/// its own thread's next endReleased, and with that thread at the latest.
class ThreadContexts {
public:
    [[nodiscard]] static std::shared_ptr<ThreadContexts> ofThisThread();
    ThreadContexts(const ThreadContexts&) = delete;
    ThreadContexts& operator=(const ThreadContexts&) = delete;

    /// On its thread. @return the context, until it is released or the thread ends
    hosts::LitContext* keep(hosts::LitContext context);
    /// On any thread, also after its own has ended.
    void release(const hosts::LitContext* context);
    /// On its thread: ends what other threads have released.
    void endReleased();
    /// On any thread. @return how many have not ended yet
    [[nodiscard]] std::size_t size() const;

private:
    struct OfThread;
    struct Kept {
        std::unique_ptr<hosts::LitContext> context;
        bool released = false;
    };
    ThreadContexts() = default;

    const std::thread::id thread_ = std::this_thread::get_id();
    mutable std::mutex mutex_;
    std::vector<Kept> kept_;
};

} // namespace lodestar::osghost

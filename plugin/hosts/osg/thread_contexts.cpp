// SPDX-License-Identifier: MIT
#include "hosts/osg/thread_contexts.h"

#include <utility>

namespace lodestar::osghost {

/// Dies with its thread, and on it; nodes may keep the list itself for longer.
struct ThreadContexts::OfThread {
    std::shared_ptr<ThreadContexts> contexts{new ThreadContexts};

    ~OfThread() {
        const std::lock_guard lock(contexts->mutex_);
        contexts->kept_.clear();
    }
};

std::shared_ptr<ThreadContexts> ThreadContexts::ofThisThread() {
    thread_local const OfThread own;
    return own.contexts;
}

hosts::LitContext* ThreadContexts::keep(hosts::LitContext context) {
    const std::lock_guard lock(mutex_);
    kept_.push_back({std::make_unique<hosts::LitContext>(std::move(context))});
    return kept_.back().context.get();
}

void ThreadContexts::release(const hosts::LitContext* context) {
    const std::lock_guard lock(mutex_);
    for (Kept& kept : kept_) {
        kept.released = kept.released || kept.context.get() == context;
    }
    if (std::this_thread::get_id() == thread_) {
        std::erase_if(kept_, [](const Kept& kept) { return kept.released; });
    }
}

void ThreadContexts::endReleased() {
    const std::lock_guard lock(mutex_);
    std::erase_if(kept_, [](const Kept& kept) { return kept.released; });
}

std::size_t ThreadContexts::size() const {
    const std::lock_guard lock(mutex_);
    return kept_.size();
}

} // namespace lodestar::osghost

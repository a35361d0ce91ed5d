// SPDX-License-Identifier: MIT
//
// Tables that depend on widths alone, kept for the next map of the same widths.
#pragma once

#include <cstddef>
#include <list>
#include <memory>
#include <mutex>

#include "core/shared_memory.h"

namespace lodestar::lighting {

/// The most recently used tables, at most a number of them; for any number of threads.
template <class Table>
class TableCache {
public:
    explicit TableCache(std::size_t most) : most_(most) {}

    /// The first table that `matches(table)` accepts, else what `make()` returns, in shared memory,
    /// kept where `keeps` says so. It is made outside the lock: two threads may each make one,
    /// which does no harm.
    template <class Matches, class Make>
    [[nodiscard]] std::shared_ptr<const Table> get(Matches matches, Make make, bool keeps = true) {
        if (auto found = find(matches)) {
            return found;
        }
        const core::SharedMemory shared;
        auto table = std::make_shared<const Table>(make());
        if (keeps) {
            const std::lock_guard lock(mutex_);
            tables_.push_front(table);
            if (tables_.size() > most_) {
                tables_.pop_back();
            }
        }
        return table;
    }

private:
    template <class Matches>
    [[nodiscard]] std::shared_ptr<const Table> find(Matches matches) {
        const std::lock_guard lock(mutex_);
        for (auto i = tables_.begin(); i != tables_.end(); ++i) {
            if (matches(**i)) {
                tables_.splice(tables_.begin(), tables_, i);
                return tables_.front();
            }
        }
        return nullptr;
    }

    std::size_t most_;
    std::mutex mutex_;
    std::list<std::shared_ptr<const Table>> tables_;
};

} // namespace lodestar::lighting

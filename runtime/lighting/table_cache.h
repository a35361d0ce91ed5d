// SPDX-License-Identifier: MIT
//
// Tables that depend on widths alone, kept for the next map of the same widths.
#pragma once

#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <utility>

namespace lodestar::lighting {

/// The most recently used tables, at most a number of them; for any number of threads.
template <class Table>
class TableCache {
public:
    explicit TableCache(std::size_t most) : most_(most) {}

    /// The first table that `matches(table)` accepts, moved to the front, or null.
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

    /// Keeps a table. It is made outside the lock: two threads may each make one, which does no
    /// harm.
    void keep(std::shared_ptr<const Table> table) {
        const std::lock_guard lock(mutex_);
        tables_.push_front(std::move(table));
        if (tables_.size() > most_) {
            tables_.pop_back();
        }
    }

private:
    std::size_t most_;
    std::mutex mutex_;
    std::list<std::shared_ptr<const Table>> tables_;
};

} // namespace lodestar::lighting

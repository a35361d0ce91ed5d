// SPDX-License-Identifier: MIT
//
// Memory from the host: while a scope lives, what its thread allocates in this library comes from
// the scope's allocator, and goes back to the one that it came from, whoever frees it and when.
#pragma once

#include <cstddef>

namespace lodestar::plugin {

struct Allocator {
    void* user = nullptr;
    void* (*allocate)(void* user, std::size_t size) = nullptr;
    void (*release)(void* user, void* memory) = nullptr;
};

class AllocatorScope {
public:
    /// @param allocator that outlives the scope; without functions: the C library's
    explicit AllocatorScope(const Allocator& allocator);
    AllocatorScope(const AllocatorScope&) = delete;
    AllocatorScope& operator=(const AllocatorScope&) = delete;
    ~AllocatorScope();

private:
    const Allocator* before_;
};

/// What contexts share, tables by widths say, is the library's own memory from now on.
void keepSharedMemoryApart();

} // namespace lodestar::plugin

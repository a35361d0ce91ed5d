// SPDX-License-Identifier: MIT
//
// Memory that outlives the call it is made in, tables kept for the next map, say; or of things
// whose end takes memory itself. Where callers lend a library their memory, which may run out or
// go, such things must not be of it.
#pragma once

namespace lodestar::core {

/// Called when a thread begins to make shared things, and when it ends.
struct SharedMemoryHooks {
    void (*begin)() = nullptr;
    void (*end)() = nullptr;
};

/// Set once, before anything is made. Without hooks all memory is the program's.
void setSharedMemoryHooks(const SharedMemoryHooks& hooks);

/// While one lives its thread makes shared things.
class SharedMemory {
public:
    SharedMemory();
    SharedMemory(const SharedMemory&) = delete;
    SharedMemory& operator=(const SharedMemory&) = delete;
    ~SharedMemory();
};

} // namespace lodestar::core

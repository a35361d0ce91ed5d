// SPDX-License-Identifier: MIT
//
// The library has its own operators new and delete, which its C++ runtime, linked in, uses too;
// they are not visible outside. Every block is preceded by the allocator that it came from.
#include "memory.h"

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>

#include "core/shared_memory.h"

namespace lodestar::plugin {
namespace {

constexpr std::size_t kHeader = 32; // keeps the alignment of 16
static_assert(sizeof(Allocator) <= kHeader);

void* fromLibrary(void*, std::size_t size) {
    return std::malloc(size);
}
void toLibrary(void*, void* memory) {
    std::free(memory);
}

thread_local const Allocator* current = nullptr;
thread_local int sharing = 0; ///< how many shared things are being made

void* allocate(std::size_t size) noexcept {
    Allocator from = current != nullptr && sharing == 0 ? *current : Allocator{};
    if (from.allocate == nullptr) {
        from = {nullptr, fromLibrary, toLibrary};
    }
    void* block = size > SIZE_MAX - kHeader ? nullptr : from.allocate(from.user, size + kHeader);
    if (block == nullptr) {
        return nullptr;
    }
    std::memcpy(block, &from, sizeof from);
    return static_cast<char*>(block) + kHeader;
}

void release(void* memory) noexcept {
    if (memory != nullptr) {
        char* block = static_cast<char*>(memory) - kHeader;
        Allocator from;
        std::memcpy(&from, block, sizeof from);
        from.release(from.user, block);
    }
}

} // namespace

AllocatorScope::AllocatorScope(const Allocator& allocator) : before_(current) {
    current = &allocator;
}

AllocatorScope::~AllocatorScope() {
    current = before_;
}

void keepSharedMemoryApart() {
    core::setSharedMemoryHooks({[] { ++sharing; }, [] { --sharing; }});
}

} // namespace lodestar::plugin

namespace __gnu_cxx {
/// Frees the room that the C++ runtime keeps for exceptions when memory has run out.
void __freeres(); // NOLINT(readability-identifier-naming)
} // namespace __gnu_cxx

/// That room is taken when the library is loaded and by itself never given back.
[[gnu::destructor]] static void leave() {
    __gnu_cxx::__freeres();
}

void* operator new(std::size_t size) {
    if (void* memory = lodestar::plugin::allocate(size)) {
        return memory;
    }
    throw std::bad_alloc();
}
void* operator new[](std::size_t size) {
    return operator new(size);
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    return lodestar::plugin::allocate(size);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
    return lodestar::plugin::allocate(size);
}
void operator delete(void* memory) noexcept {
    lodestar::plugin::release(memory);
}
void operator delete[](void* memory) noexcept {
    lodestar::plugin::release(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    lodestar::plugin::release(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
    lodestar::plugin::release(memory);
}
void operator delete(void* memory, const std::nothrow_t&) noexcept {
    lodestar::plugin::release(memory);
}
void operator delete[](void* memory, const std::nothrow_t&) noexcept {
    lodestar::plugin::release(memory);
}

// SPDX-License-Identifier: MIT
#include "core/shared_memory.h"

#include <atomic>

namespace lodestar::core {
namespace {

std::atomic<void (*)()> begin{nullptr};
std::atomic<void (*)()> end{nullptr};

void call(const std::atomic<void (*)()>& hook) {
    if (void (*const function)() = hook.load()) {
        function();
    }
}

} // namespace

void setSharedMemoryHooks(const SharedMemoryHooks& hooks) {
    begin = hooks.begin;
    end = hooks.end;
}

SharedMemory::SharedMemory() {
    call(begin);
}

SharedMemory::~SharedMemory() {
    call(end);
}

} // namespace lodestar::core

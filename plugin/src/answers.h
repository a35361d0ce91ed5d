// SPDX-License-Identifier: MIT
//
// How functions of plans and of OpenGL answer.
#pragma once

#include <cstring>
#include <memory>
#include <new>
#include <thread>
#include <utility>
#include <vector>

#include "context.h"

namespace lodestar::plugin {

/// Answers from a plan, on any thread: a failure is said by its status alone.
template <class Of>
LodestarStatus answered(LodestarContext* context, LodestarPlan plan, const void* place,
                        const Of& of) noexcept {
    if (!lives(context) || place == nullptr) {
        return LODESTAR_E_ARG;
    }
    const AllocatorScope scope(context->allocator);
    try {
        const std::shared_ptr<const Packet> packet = context->plans.find(plan);
        return packet ? LodestarStatus{of(*packet)} : LodestarStatus{LODESTAR_E_ARG};
    } catch (const std::bad_alloc&) {
        return LODESTAR_E_NOMEM;
    } catch (...) {
        return LODESTAR_E_STATE;
    }
}

/// Runs a [gl] function's body on the thread that attached.
template <class Body>
LodestarStatus attached(LodestarContext* context, Body&& body) noexcept {
    if (!lives(context)) {
        return LODESTAR_E_ARG;
    }
    const std::thread::id gl = context->glThread;
    if (gl == std::thread::id()) {
        return context->thread == std::this_thread::get_id()
                   ? context->fail(LODESTAR_E_ARG, "no OpenGL context is attached")
                   : LODESTAR_E_ARG;
    }
    return gl == std::this_thread::get_id() ? guarded(*context, std::forward<Body>(body))
                                            : LODESTAR_E_THREAD;
}

/// Structs of the host's size, which its first one says.
template <class T>
LodestarStatus answerStructs(const std::vector<T>& from, T* into, size_t* count) {
    const std::size_t room = *count;
    *count = from.size();
    if (into == nullptr || room < from.size()) {
        return LODESTAR_MORE;
    }
    if (from.empty()) {
        return LODESTAR_OK;
    }
    const std::uint32_t stride = into->struct_size;
    auto* bytes = reinterpret_cast<unsigned char*>(into);
    for (std::size_t i = 0; i < from.size(); ++i) {
        auto* one = reinterpret_cast<T*>(bytes + i * stride);
        std::memcpy(one, &stride, sizeof stride);
        if (!writeStruct(from[i], one)) {
            return LODESTAR_E_ABI;
        }
    }
    return LODESTAR_OK;
}

} // namespace lodestar::plugin

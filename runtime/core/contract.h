// SPDX-License-Identifier: MIT
//
// Contracts: a caller's bug. On in every build. The handler prints and aborts by default; tests
// install one that throws, so functions that check contracts are not noexcept.
#pragma once

namespace lodestar::core {

using ContractHandler = void (*)(const char* rule, const char* message, const char* file, int line);

/// Replaces the handler; returns the one before. A null handler restores the default.
ContractHandler setContractHandler(ContractHandler handler);

/// Calls the handler; aborts if it returns.
[[noreturn]] void contractViolated(const char* rule, const char* message, const char* file,
                                   int line);

} // namespace lodestar::core

#define LODESTAR_EXPECT(condition, message)                                                        \
    ((condition) ? static_cast<void>(0)                                                            \
                 : ::lodestar::core::contractViolated(#condition, message, __FILE__, __LINE__))

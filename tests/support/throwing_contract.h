// SPDX-License-Identifier: MIT
//
// Contracts that throw while an object of this class lives, so that tests can break them.
#pragma once

#include <stdexcept>
#include <string>

#include "core/contract.h"

namespace lodestar::testing {

/// What the handler was told.
struct ContractBroken : std::logic_error {
    ContractBroken(const char* brokenRule, const char* message, const char* sourceFile,
                   int sourceLine)
        : std::logic_error(message), rule(brokenRule), file(sourceFile), line(sourceLine) {}
    std::string rule;
    std::string file;
    int line;
};

class ThrowingContracts {
public:
    ThrowingContracts() : before_(core::setContractHandler(&raise)) {}
    ThrowingContracts(const ThrowingContracts&) = delete;
    ThrowingContracts& operator=(const ThrowingContracts&) = delete;
    ~ThrowingContracts() { core::setContractHandler(before_); }

private:
    static void raise(const char* rule, const char* message, const char* file, int line) {
        throw ContractBroken(rule, message, file, line);
    }
    core::ContractHandler before_;
};

} // namespace lodestar::testing

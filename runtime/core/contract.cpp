// SPDX-License-Identifier: MIT
#include "core/contract.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>

namespace lodestar::core {
namespace {

void printViolation(const char* rule, const char* message, const char* file, int line) {
    std::fprintf(stderr, "lodestar: contract violated: %s [%s] (%s:%d)\n", message, rule, file,
                 line);
}

std::atomic<ContractHandler> currentHandler{printViolation};

} // namespace

ContractHandler setContractHandler(ContractHandler handler) {
    return currentHandler.exchange(handler != nullptr ? handler : printViolation);
}

void contractViolated(const char* rule, const char* message, const char* file, int line) {
    currentHandler.load()(rule, message, file, line);
    std::abort();
}

} // namespace lodestar::core

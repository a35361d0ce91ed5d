// SPDX-License-Identifier: MIT
#include "context.h"

void LodestarContext::log(const lodestar::core::Tally& warnings) const {
    if (host.log == nullptr) {
        return;
    }
    for (const auto& [rule, count] : warnings.counts()) {
        char line[256];
        std::snprintf(line, sizeof line, "%s (%llu times)", rule.c_str(),
                      static_cast<unsigned long long>(count));
        host.log(host.user, LODESTAR_LOG_REPAIRED, line);
    }
}

LodestarStatus LodestarContext::fail(LodestarStatus status, const char* what) {
    std::snprintf(error, sizeof error, "%s", what);
    log(LODESTAR_LOG_REFUSED, error);
    return status;
}

LodestarStatus LodestarContext::fail(LodestarStatus status, const lodestar::core::Error& refused) {
    return fail(status, refused.message().c_str());
}

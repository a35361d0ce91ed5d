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
    char(&words)[512] = thread == std::this_thread::get_id() ? error : glError;
    std::snprintf(words, sizeof words, "%s", what);
    log(LODESTAR_LOG_REFUSED, words);
    return status;
}

LodestarStatus LodestarContext::fail(LodestarStatus status, const lodestar::core::Error& refused) {
    return fail(status, refused.message().c_str());
}

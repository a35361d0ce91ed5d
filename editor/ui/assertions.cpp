// SPDX-License-Identifier: MIT
#include "ui/assertions.h"

#include <cstdio>
#include <cstdlib>

namespace lodestar::ui {
namespace {

struct Assertion {
    std::string text;
};

thread_local bool guarding = false;

} // namespace

std::string guarded(const std::function<void()>& piece) {
    std::string failed;
    guarding = true;
    try {
        piece();
    } catch (const Assertion& assertion) {
        failed = assertion.text;
    } catch (...) {
        guarding = false;
        throw;
    }
    guarding = false;
    return failed;
}

[[noreturn]] static void assertionFailed(const char* expression, const char* file, unsigned line) {
    const std::string text =
        std::string(file) + ":" + std::to_string(line) + ": " + std::string(expression);
    if (guarding) {
        throw Assertion{text};
    }
    std::fprintf(stderr, "%s\n", text.c_str());
    std::abort();
}

} // namespace lodestar::ui

// In place of the C library's, whose declaration promises not to throw: <cassert> stays out.
// NOLINTNEXTLINE(readability-identifier-naming): its name.
extern "C" [[noreturn]] void __assert_fail(const char* expression, const char* file, unsigned line,
                                           const char*) {
    lodestar::ui::assertionFailed(expression, file, line);
}

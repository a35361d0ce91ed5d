// SPDX-License-Identifier: MIT
//
// A host of the library in tests: it loads it, counts its memory, and has a sun to give.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include <dlfcn.h>
#include <gtest/gtest.h>

#include "sun.h"

namespace lodestar::testing {

/// The library, loaded as a host loads it.
class Library {
public:
    Library() : handle_(dlopen(LODESTAR_LIBRARY, RTLD_NOW | RTLD_LOCAL)) {
        EXPECT_NE(handle_, nullptr) << dlerror();
    }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
    ~Library() { dlclose(handle_); }
    [[nodiscard]] LodestarStatus get(std::uint32_t abi, LodestarApi& api) const {
        using Get = LodestarStatus (*)(std::uint32_t, LodestarApi*);
        return reinterpret_cast<Get>(dlsym(handle_, "lodestar_get_api"))(abi, &api);
    }
    [[nodiscard]] LodestarApi api() const {
        LodestarApi api{};
        api.struct_size = sizeof api;
        EXPECT_EQ(get(LODESTAR_ABI_VERSION, api), LODESTAR_OK);
        return api;
    }

private:
    void* handle_;
};

/// A host that counts its blocks and can run out of them.
struct CountingHost {
    std::size_t alive = 0;
    std::size_t calls = 0;
    std::size_t failAt = std::numeric_limits<std::size_t>::max(); ///< the call that gives null
    std::vector<std::string> logged;

    [[nodiscard]] LodestarHost host() {
        LodestarHost host{};
        host.struct_size = sizeof host;
        host.user = this;
        host.allocate = [](void* user, std::size_t size) -> void* {
            auto& self = *static_cast<CountingHost*>(user);
            if (self.calls++ == self.failAt) {
                return nullptr;
            }
            ++self.alive;
            return std::malloc(size);
        };
        host.release = [](void* user, void* memory) {
            --static_cast<CountingHost*>(user)->alive;
            std::free(memory);
        };
        host.log = [](void* user, std::int32_t number, const char* text) {
            static_cast<CountingHost*>(user)->logged.push_back(std::to_string(number) + " " + text);
        };
        return host;
    }
};

class AbiHost : public ::testing::Test {
protected:
    void SetUp() override {
        const LodestarHost host = counting.host();
        ASSERT_EQ(api.context_create(&host, &context), LODESTAR_OK);
    }
    void TearDown() override {
        if (context != nullptr) {
            EXPECT_EQ(api.context_destroy(context), LODESTAR_OK);
        }
        EXPECT_EQ(counting.alive, 0u) << "blocks of the host are left";
    }
    Library library;
    LodestarApi api = library.api();
    CountingHost counting;
    LodestarContext* context = nullptr;
};

} // namespace lodestar::testing

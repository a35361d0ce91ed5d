// SPDX-License-Identifier: MIT
//
// A test fixture with a current context. Where there is no usable OpenGL the tests skip with the
// reason, or fail if LODESTAR_REQUIRE_GL=1. Any GL error during a test fails it.
#pragma once

#include <cstdlib>
#include <memory>
#include <optional>
#include <string_view>

#include <gtest/gtest.h>

#include "gl/device.h"
#include "platform/headless_context.h"

namespace lodestar::testing {

class GlTest : public ::testing::Test {
protected:
    void SetUp() override {
        auto context = platform::HeadlessContext::create();
        if (!context) {
            const char* required = std::getenv("LODESTAR_REQUIRE_GL");
            if (required != nullptr && std::string_view(required) == "1") {
                FAIL() << context.error().message();
            }
            GTEST_SKIP() << context.error().message();
        }
        context_.emplace(std::move(*context));
        auto device = gl::Device::create();
        ASSERT_TRUE(device.ok()) << device.error().message();
        device_ = std::move(*device);
    }
    void TearDown() override {
        if (device_ && !errorsExpected_) {
            for (const std::string& message : device_->messages()) {
                ADD_FAILURE() << "OpenGL: " << message;
            }
        }
        device_.reset();
        context_.reset();
    }

    gl::Device& device() { return *device_; }
    /// For tests that provoke GL errors on purpose.
    void expectErrors() { errorsExpected_ = true; }

private:
    std::optional<platform::HeadlessContext> context_;
    std::unique_ptr<gl::Device> device_;
    bool errorsExpected_ = false;
};

} // namespace lodestar::testing

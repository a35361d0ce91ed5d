// SPDX-License-Identifier: MIT
#include "core/result.h"

#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "support/throwing_contract.h"

namespace lodestar::core {
namespace {

TEST(Error, MessageNamesFileFaultAndPlace) {
    struct Case {
        Error error;
        const char* message;
    };
    const std::vector<Case> cases = {
        {{ErrorCode::InputRefused, "a number is missing", "a.gltf", "/nodes/3"},
         "a.gltf: a number is missing (/nodes/3)"},
        {{ErrorCode::InputRefused, "a number is missing", "a.gltf", ""},
         "a.gltf: a number is missing"},
        {{ErrorCode::Usage, "no such option", "", "--x"}, "no such option (--x)"},
        {{ErrorCode::Internal, "broken", "", ""}, "broken"},
    };
    for (const Case& one : cases) {
        EXPECT_EQ(one.error.message(), one.message);
    }
}

TEST(Error, MessageIsOneLineWhateverItsPartsHold) {
    const Error error{ErrorCode::InputRefused, "what\nis\twrong\r", "a\nb",
                      std::string("\x01\0", 2)};
    for (const char c : error.message()) {
        EXPECT_GE(static_cast<unsigned char>(c), 0x20u);
    }
    EXPECT_EQ(error.message(), "a b: what is wrong  (  )");
}

TEST(Error, MessageKeepsUtf8) {
    EXPECT_EQ((Error{ErrorCode::InputRefused, "refused", "h\xC3\xB6he.png", ""}).message(),
              "h\xC3\xB6he.png: refused");
}

TEST(Error, CodesAreTheExitStatuses) {
    EXPECT_EQ(static_cast<int>(ErrorCode::Internal), 1);
    EXPECT_EQ(static_cast<int>(ErrorCode::Usage), 2);
    EXPECT_EQ(static_cast<int>(ErrorCode::InputRefused), 3);
    EXPECT_EQ(static_cast<int>(ErrorCode::NoOpenGl), 4);
    EXPECT_EQ(static_cast<int>(ErrorCode::OutputFailed), 5);
}

TEST(Error, InFileFillsInAFileOnlyWhereThereIsNone) {
    EXPECT_EQ(inFile(refused("bad", "/a"), "one").message(), "one: bad (/a)");
    EXPECT_EQ(inFile(inFile(refused("bad"), "one"), "two").file, "one");
    EXPECT_EQ(refused("bad").code, ErrorCode::InputRefused);
}

TEST(Result, HoldsAValueOrAnError) {
    const Result<int> value(7);
    EXPECT_TRUE(value.ok());
    EXPECT_TRUE(static_cast<bool>(value));
    EXPECT_EQ(value.value(), 7);
    EXPECT_EQ(*value, 7);
    const Result<int> failure(refused("bad"));
    EXPECT_FALSE(failure.ok());
    EXPECT_EQ(failure.error().what, "bad");
}

TEST(Result, MovesAValueThatCannotBeCopied) {
    Result<std::unique_ptr<int>> result(std::make_unique<int>(5));
    EXPECT_EQ(**result, 5);
    const std::unique_ptr<int> taken = std::move(result).value();
    EXPECT_EQ(*taken, 5);
    EXPECT_EQ(*Result<std::string>("text"), "text");
    EXPECT_EQ(Result<std::string>("text")->size(), 4u);
}

TEST(Result, ReadingTheWrongSideIsACallersBug) {
    const testing::ThrowingContracts throwing;
    Result<int> failure(refused("bad"));
    const Result<int> value(7);
    EXPECT_THROW((void)failure.value(), testing::ContractBroken);
    EXPECT_THROW((void)*failure, testing::ContractBroken);
    EXPECT_THROW((void)std::move(failure).value(), testing::ContractBroken);
    EXPECT_THROW((void)value.error(), testing::ContractBroken);
}

TEST(Result, OfNothingIsSuccessOrAnError) {
    const testing::ThrowingContracts throwing;
    const Result<void> done;
    EXPECT_TRUE(done.ok());
    EXPECT_THROW((void)done.error(), testing::ContractBroken);
    const Result<void> failure(refused("bad"));
    EXPECT_FALSE(failure);
    EXPECT_EQ(failure.error().what, "bad");
}

} // namespace
} // namespace lodestar::core

// SPDX-License-Identifier: MIT
#include "core/contract.h"

#include <gtest/gtest.h>

#include "support/throwing_contract.h"

namespace lodestar::core {
namespace {

int checkedHalf(int even) {
    LODESTAR_EXPECT(even % 2 == 0, "the number is even");
    return even / 2;
}

TEST(Contract, AHeldRuleCostsNothingAndSaysNothing) {
    const testing::ThrowingContracts throwing;
    EXPECT_EQ(checkedHalf(6), 3);
}

TEST(Contract, ABrokenRuleReachesTheHandlerWithRuleMessageAndPlace) {
    const testing::ThrowingContracts throwing;
    try {
        (void)checkedHalf(7);
        FAIL() << "the contract did not fire";
    } catch (const testing::ContractBroken& broken) {
        EXPECT_STREQ(broken.what(), "the number is even");
        EXPECT_EQ(broken.rule, "even % 2 == 0");
        EXPECT_NE(broken.file.find("contract_test.cpp"), std::string::npos);
        EXPECT_GT(broken.line, 0);
    }
}

TEST(Contract, ConditionIsEvaluatedOnce) {
    const testing::ThrowingContracts throwing;
    int evaluated = 0;
    LODESTAR_EXPECT(++evaluated == 1, "counted");
    EXPECT_EQ(evaluated, 1);
}

TEST(Contract, HandlersAreReturnedAndRestored) {
    const auto first = [](const char*, const char*, const char*, int) {};
    const auto second = [](const char*, const char*, const char*, int) {};
    const ContractHandler original = setContractHandler(first);
    EXPECT_EQ(setContractHandler(second), static_cast<ContractHandler>(first));
    EXPECT_EQ(setContractHandler(nullptr), static_cast<ContractHandler>(second));
    EXPECT_EQ(setContractHandler(original), original) << "null restores the default handler";
}

TEST(ContractDeathTest, TheDefaultPrintsOneLineAndAborts) {
    EXPECT_DEATH((void)checkedHalf(7),
                 "lodestar: contract violated: the number is even \\[even % 2 == 0\\]");
}

TEST(ContractDeathTest, AHandlerThatReturnsAborts) {
    EXPECT_DEATH(
        {
            setContractHandler([](const char*, const char*, const char*, int) {});
            (void)checkedHalf(7);
        },
        "");
}

} // namespace
} // namespace lodestar::core

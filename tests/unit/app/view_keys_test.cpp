// SPDX-License-Identifier: MIT
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "app/view_keys.h"

namespace lodestar::app {
namespace {

TEST(ViewKeys, NoChordMeansTwoThings) {
    const auto bindings = keyBindings();
    for (std::size_t i = 0; i < bindings.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            EXPECT_FALSE(bindings[i].key == bindings[j].key &&
                         bindings[i].modifiers == bindings[j].modifiers)
                << i << " and " << j;
        }
    }
}

TEST(ViewKeys, EveryActionHasAKey) {
    std::set<Action> bound;
    for (const KeyBinding& binding : keyBindings()) {
        bound.insert(binding.action);
    }
    EXPECT_EQ(bound.size(), static_cast<std::size_t>(Action::Close) + 1) << "Close is the last";
}

TEST(ViewKeys, APressIsBoundAndAReleaseIsNot) {
    platform::KeyEvent event{platform::Key::Q, true, false, {false, true, false}};
    ASSERT_TRUE(bindingOf(event));
    EXPECT_EQ(bindingOf(event)->action, Action::Close);
    event.down = false;
    EXPECT_FALSE(bindingOf(event));
    event = {platform::Key::Q, true, false, {}}; // flies down
    EXPECT_FALSE(bindingOf(event));
}

TEST(ViewKeys, EveryChoiceIsAnEstimatorOfItsTermAndHasAKeyAndItsNameInTheHelp) {
    std::string help;
    for (const HelpLine& line : helpLines()) {
        EXPECT_NE(std::string(line.keys), "");
        help += std::string(line.does) + ",";
    }
    for (auto [term, action] : {std::pair(lighting::Term::Glossy, Action::ChooseSpecular),
                                std::pair(lighting::Term::Diffuse, Action::ChooseDiffuse)}) {
        const auto choices = estimatorChoices(term);
        std::set<int> bound;
        for (const KeyBinding& binding : keyBindings()) {
            if (binding.action == action) {
                bound.insert(binding.choice);
            }
        }
        EXPECT_EQ(bound.size(), choices.size());
        EXPECT_EQ(*bound.rbegin(), static_cast<int>(choices.size()) - 1);
        for (const lighting::Estimator& choice : choices) {
            EXPECT_TRUE(lighting::serves(choice.kind, term));
            const std::string name = lighting::estimatorName(choice);
            EXPECT_NE(help.find(" " + name + ","), std::string::npos) << name;
            EXPECT_TRUE(lighting::parseEstimator(name, term)) << name;
        }
    }
}

} // namespace
} // namespace lodestar::app

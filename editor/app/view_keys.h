// SPDX-License-Identifier: MIT
//
// The viewer's keys as data: one table that both decides and is shown.
#pragma once

#include <optional>
#include <span>

#include "lighting/estimator.h"
#include "platform/window.h"

namespace lodestar::app {

/// What a key press asks the viewer to do, once.
enum class Action {
    FrameAll,
    ResetCamera,
    NextCamera,
    PreviousCamera,
    NextScene,
    PreviousScene,
    Play,
    Earlier,
    Later,
    NextAnimation,
    HourEarlier,
    HourLater,
    PlayDay,
    DaySpeed,
    Brighter,
    Darker,
    ChooseSpecular,
    ChooseDiffuse,
    ChooseForms,
    ErrorView,
    Screenshot,
    Help,
    Text,
    FullScreen,
    Close,
};

struct KeyBinding {
    platform::Key key = platform::Key::Space;
    platform::Modifiers modifiers;
    Action action = Action::Help;
    int choice = 0; ///< which estimator; of forms 0 the highlight's, 1 Fresnel's
};

/// Every binding.
[[nodiscard]] std::span<const KeyBinding> keyBindings();

/// The binding of a key press, if it has one.
[[nodiscard]] std::optional<KeyBinding> bindingOf(const platform::KeyEvent& event);

/// A line of the help: what to press, and what it does.
struct HelpLine {
    const char* keys;
    const char* does;
};
/// What the pointer and the held keys do, and every action, in the order shown.
[[nodiscard]] std::span<const HelpLine> helpLines();

/// The estimators of the number keys, 1 first.
[[nodiscard]] std::span<const lighting::Estimator> estimatorChoices(lighting::Term term);

} // namespace lodestar::app

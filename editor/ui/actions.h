// SPDX-License-Identifier: MIT
//
// The editor's keys as data: one table that decides, is shown in the menus and in the help.
#pragma once

#include <span>
#include <string>

#include "ui/input.h"

namespace lodestar::ui {

enum class Action {
    Open,
    OpenLighting,
    OpenPhotograph,
    Save,
    SaveAs,
    SaveCommands,
    Quit,
    Undo,
    Redo,
    Copy,
    CopyCommands,
    Cut,
    Paste,
    Delete,
    SelectAllStops,
    PreviousStop,
    NextStop,
    AddStop,
    Reverse,
    Mirror,
    Distribute,
    DistributeFromLeft,
    Brush,
    Pick,
    FrameSelection,
    FrameAll,
    ResetCamera,
    Brighter,
    Darker,
    FalseColor,
    ErrorView,
    HourLater,
    HourEarlier,
    PlayDay,
    PreviousLight,
    NextLight,
    Help,
};

enum class Menu { File, Edit, Gradient, View, Help, None };

struct Binding {
    Action action;
    Menu menu;
    const char* label;
    Key key;
    bool control = false, shift = false;
    bool repeats = false; ///< while the key is held
};

[[nodiscard]] std::span<const Binding> bindings();
/// "Ctrl+Shift+Z".
[[nodiscard]] std::string shortcutText(const Binding& binding);

} // namespace lodestar::ui

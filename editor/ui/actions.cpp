// SPDX-License-Identifier: MIT
#include "ui/actions.h"

#include <array>

namespace lodestar::ui {
namespace {

constexpr Binding kBindings[] = {
    {Action::Open, Menu::File, "Open scene...", Key::O, true},
    {Action::OpenLighting, Menu::File, "Open lighting...", Key::L, true},
    {Action::OpenPhotograph, Menu::File, "Lights from a photograph...", Key::P, true},
    {Action::Save, Menu::File, "Save lighting", Key::S, true},
    {Action::SaveAs, Menu::File, "Save lighting as...", Key::S, true, true},
    {Action::SaveCommands, Menu::File, "Save steps as commands...", Key::E, true},
    {Action::Quit, Menu::File, "Quit", Key::Q, true},
    {Action::Undo, Menu::Edit, "Undo", Key::Z, true, false, true},
    {Action::Redo, Menu::Edit, "Redo", Key::Z, true, true, true},
    {Action::Redo, Menu::None, "Redo", Key::Y, true, false, true},
    {Action::Copy, Menu::Edit, "Copy", Key::C, true},
    {Action::Cut, Menu::Edit, "Cut", Key::X, true},
    {Action::Paste, Menu::Edit, "Paste", Key::V, true},
    {Action::Delete, Menu::Edit, "Delete", Key::Delete},
    {Action::SelectAllStops, Menu::Edit, "Select all stops", Key::A, true},
    {Action::PreviousLight, Menu::Edit, "Previous light", Key::L, false, true},
    {Action::NextLight, Menu::Edit, "Next light", Key::L},
    {Action::CopyCommands, Menu::Edit, "Copy steps as commands", Key::C, true, true},
    {Action::AddStop, Menu::Gradient, "Add stop", Key::Insert},
    {Action::PreviousStop, Menu::Gradient, "Previous stop", Key::Comma, false, false, true},
    {Action::NextStop, Menu::Gradient, "Next stop", Key::Period, false, false, true},
    {Action::Reverse, Menu::Gradient, "Reverse", Key::R},
    {Action::Mirror, Menu::Gradient, "Mirror", Key::M},
    {Action::Distribute, Menu::Gradient, "Distribute", Key::D},
    {Action::DistributeFromLeft, Menu::Gradient, "Distribute from the left", Key::D, false, true},
    {Action::Brush, Menu::Gradient, "Brush", Key::B},
    {Action::Pick, Menu::Gradient, "Pick radiance from the viewport", Key::I},
    {Action::FrameSelection, Menu::View, "Frame what is selected", Key::F},
    {Action::FrameAll, Menu::View, "Frame all", Key::F, false, true},
    {Action::ResetCamera, Menu::View, "Reset camera", Key::Home},
    {Action::Brighter, Menu::View, "Brighter", Key::Plus, false, false, true},
    {Action::Darker, Menu::View, "Darker", Key::Minus, false, false, true},
    {Action::FalseColor, Menu::View, "False colours of radiance", Key::V},
    {Action::ErrorView, Menu::View, "Error against the reference", Key::E},
    {Action::HourLater, Menu::View, "Later", Key::T, false, false, true},
    {Action::HourEarlier, Menu::View, "Earlier", Key::T, false, true, true},
    {Action::PlayDay, Menu::View, "Play the day", Key::Y},
    {Action::Help, Menu::Help, "Keys", Key::F1},
};

constexpr std::array<const char*, 26> kOthers = {
    "Space",     "Comma", "Period", "+",     "-",    "Tab",  "Esc",  "Enter",
    "Backspace", "Del",   "Ins",    "Home",  "End",  "PgUp", "PgDn", "Left",
    "Right",     "Up",    "Down",   "Shift", "Ctrl", "Alt"};

std::string nameOf(Key key) {
    if (key <= Key::Z) {
        return {static_cast<char>('A' + static_cast<int>(key))};
    }
    if (key <= Key::Digit9) {
        return {static_cast<char>('0' + static_cast<int>(key) - static_cast<int>(Key::Digit0))};
    }
    if (key <= Key::F12) {
        return "F" + std::to_string(static_cast<int>(key) - static_cast<int>(Key::F1) + 1);
    }
    return kOthers[static_cast<std::size_t>(key) - static_cast<std::size_t>(Key::Space)];
}

} // namespace

std::span<const Binding> bindings() {
    return kBindings;
}

std::string shortcutText(const Binding& binding) {
    return std::string(binding.control ? "Ctrl+" : "") + (binding.shift ? "Shift+" : "") +
           nameOf(binding.key);
}

} // namespace lodestar::ui

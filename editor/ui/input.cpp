// SPDX-License-Identifier: MIT
#include "ui/input.h"

#include <algorithm>
#include <bitset>
#include <cmath>

#include <imgui.h>

namespace lodestar::ui {
namespace {

/// What a frame holds already.
struct Held {
    std::bitset<kKeyCount> keys;
    std::bitset<5> buttons;
    bool text = false, wheel = false;
    bool acts = false; ///< something that the modifiers change the meaning of
};

bool apply(const KeyInput& input, ImGuiIO& io, Held& held) {
    const auto index = static_cast<std::size_t>(input.key);
    if (held.keys[index] || held.text) {
        return false;
    }
    const bool shift = input.key == Key::Shift ? input.down : input.shift;
    const bool control = input.key == Key::Control ? input.down : input.control;
    const bool alt = input.key == Key::Alt ? input.down : input.alt;
    const bool modifies = shift != io.KeyShift || control != io.KeyCtrl || alt != io.KeyAlt;
    if (modifies && held.acts) {
        return false; // the frame's keys and clicks were with those before
    }
    held.acts = held.acts ||
                (input.key != Key::Shift && input.key != Key::Control && input.key != Key::Alt);
    held.keys[index] = true;
    io.KeysDown[index] = input.down;
    io.KeyShift = shift;
    io.KeyCtrl = control;
    io.KeyAlt = alt;
    return true;
}

bool apply(const TextInput& input, ImGuiIO& io, Held& held) {
    held.text = true;
    io.AddInputCharacter(static_cast<unsigned>(input.character));
    return true;
}

bool apply(const ButtonInput& input, ImGuiIO& io, Held& held) {
    const auto index = static_cast<std::size_t>(std::clamp(input.button, 0, 4));
    if (held.buttons[index]) {
        return false;
    }
    held.buttons[index] = held.acts = true;
    io.MouseDown[index] = input.down;
    return true;
}

bool apply(const MotionInput& input, ImGuiIO& io, Held& held) {
    if (held.buttons.any() || held.keys.any() || held.wheel) {
        return false;
    }
    if (std::isfinite(input.x) && std::isfinite(input.y)) {
        io.MousePos = {input.x, input.y};
    }
    return true;
}

bool apply(const WheelInput& input, ImGuiIO& io, Held& held) {
    if (held.buttons.any()) {
        return false;
    }
    held.wheel = held.acts = true;
    io.MouseWheel += std::isfinite(input.steps) ? std::clamp(input.steps, -50.0f, 50.0f) : 0.0f;
    return true;
}

bool apply(const FocusLostInput&, ImGuiIO& io, Held& held) {
    if (held.keys.any() || held.buttons.any()) {
        return false;
    }
    std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
    std::fill(std::begin(io.MouseDown), std::end(io.MouseDown), false);
    io.KeyShift = io.KeyCtrl = io.KeyAlt = false;
    held.keys.set();
    return true;
}

} // namespace

void InputQueue::feed(ImGuiIO& io) {
    Held held;
    while (
        !waiting_.empty() &&
        std::visit([&](const auto& input) { return apply(input, io, held); }, waiting_.front())) {
        waiting_.pop_front();
    }
}

void mapKeys(ImGuiIO& io) {
    constexpr std::pair<ImGuiKey_, Key> kKeys[] = {
        {ImGuiKey_Tab, Key::Tab},
        {ImGuiKey_LeftArrow, Key::Left},
        {ImGuiKey_RightArrow, Key::Right},
        {ImGuiKey_UpArrow, Key::Up},
        {ImGuiKey_DownArrow, Key::Down},
        {ImGuiKey_PageUp, Key::PageUp},
        {ImGuiKey_PageDown, Key::PageDown},
        {ImGuiKey_Home, Key::Home},
        {ImGuiKey_End, Key::End},
        {ImGuiKey_Insert, Key::Insert},
        {ImGuiKey_Delete, Key::Delete},
        {ImGuiKey_Backspace, Key::Backspace},
        {ImGuiKey_Space, Key::Space},
        {ImGuiKey_Enter, Key::Enter},
        {ImGuiKey_Escape, Key::Escape},
        {ImGuiKey_A, Key::A},
        {ImGuiKey_C, Key::C},
        {ImGuiKey_V, Key::V},
        {ImGuiKey_X, Key::X},
        {ImGuiKey_Y, Key::Y},
        {ImGuiKey_Z, Key::Z},
    };
    for (const auto& [theirs, ours] : kKeys) {
        io.KeyMap[theirs] = static_cast<int>(ours);
    }
}

} // namespace lodestar::ui

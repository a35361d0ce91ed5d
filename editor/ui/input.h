// SPDX-License-Identifier: MIT
//
// What the user does, as plain values, and a queue that gives it to Dear ImGui in frames. Version
// 1.86 knows levels, not events: a press and a release in one frame are nothing to it.
#pragma once

#include <deque>
#include <variant>

struct ImGuiIO;

namespace lodestar::ui {

/// Keys by what they are on a US keyboard.
enum class Key {
    // clang-format off
    A, B, C, D, E, F, G, H, I, J, K, L, M, N, O, P, Q, R, S, T, U, V, W, X, Y, Z,
    Digit0, Digit1, Digit2, Digit3, Digit4, Digit5, Digit6, Digit7, Digit8, Digit9,
    F1, F2, F3, F4, F5, F6, F7, F8, F9, F10, F11, F12,
    Space, Comma, Period, Plus, Minus, Tab, Escape, Enter, Backspace, Delete, Insert,
    Home, End, PageUp, PageDown, Left, Right, Up, Down, Shift, Control, Alt,
    // clang-format on
};
inline constexpr int kKeyCount = static_cast<int>(Key::Alt) + 1;

struct KeyInput {
    Key key = Key::Space;
    bool down = true;
    bool shift = false, control = false, alt = false; ///< held with it
};
struct TextInput {
    char32_t character = 0; ///< Unicode; what no font of 16-bit characters has is shown as U+FFFD
};
struct ButtonInput {
    int button = 0; ///< 0 left, 1 right, 2 middle
    bool down = true;
};
/// Framebuffer pixels, origin top left, y down.
struct MotionInput {
    float x = 0.0f, y = 0.0f;
};
/// Steps, positive away from the user.
struct WheelInput {
    float steps = 0.0f;
};
/// Keys and buttons held are to be taken as released.
struct FocusLostInput {};

using Input =
    std::variant<KeyInput, TextInput, ButtonInput, MotionInput, WheelInput, FocusLostInput>;

class InputQueue {
public:
    void push(const Input& input) { waiting_.push_back(input); }
    [[nodiscard]] bool empty() const { return waiting_.empty(); }
    /// Gives as much as one frame can tell apart, in order: nothing that takes back, or happens
    /// elsewhere than, what the frame holds already.
    void feed(ImGuiIO& io);

private:
    std::deque<Input> waiting_;
};

/// Names the keys that Dear ImGui's own widgets answer to.
void mapKeys(ImGuiIO& io);

} // namespace lodestar::ui

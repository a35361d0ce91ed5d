// SPDX-License-Identifier: MIT
//
// A window with an OpenGL context, through GLFW. What the user does comes as plain values.
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/result.h"

namespace lodestar::platform {

/// Keys by what they are on a US keyboard; other keys are not reported.
enum class Key {
    A,
    B,
    C,
    D,
    E,
    F,
    G,
    H,
    I,
    J,
    K,
    L,
    M,
    N,
    O,
    P,
    Q,
    R,
    S,
    T,
    U,
    V,
    W,
    X,
    Y,
    Z,
    Digit0,
    Digit1,
    Digit2,
    Digit3,
    Digit4,
    Digit5,
    Digit6,
    Digit7,
    Digit8,
    Digit9,
    F1,
    F2,
    F3,
    F4,
    F5,
    F6,
    F7,
    F8,
    F9,
    F10,
    F11,
    F12,
    Space,
    Comma,
    Period,
    Plus,
    Minus,
    Tab,
    Escape,
    Home,
    End,
    PageUp,
    PageDown,
    Left,
    Right,
    Up,
    Down,
    Enter,
    Backspace,
    Delete,
    Insert,
    Shift,
    Control,
    Alt,
};

struct Modifiers {
    bool shift = false;
    bool control = false;
    bool alt = false;

    bool operator==(const Modifiers&) const = default;
};

enum class PointerButton { Left, Middle, Right };

/// A key went down (or repeats while it is held), or up.
struct KeyEvent {
    Key key = Key::Space;
    bool down = true;
    bool repeat = false;
    Modifiers modifiers;
};
/// A character was typed, as the keyboard's layout and dead keys make it.
struct TextEvent {
    char32_t character = 0; ///< Unicode
};
/// A pointer button went down or up.
struct ButtonEvent {
    PointerButton button = PointerButton::Left;
    bool down = true;
    Modifiers modifiers;
};
/// The pointer moved; framebuffer pixels, origin top left, y down.
struct MotionEvent {
    double x = 0.0;
    double y = 0.0;
};
/// The wheel turned; steps, positive away from the user.
struct WheelEvent {
    double steps = 0.0;
};
/// Files were dropped on the window.
struct DropEvent {
    std::vector<std::string> paths;
};
/// What the window shows is lost, its size changed, or it was hidden or shown: draw it again.
struct DamageEvent {};
/// The window no longer has the keyboard: keys held are to be taken as released.
struct FocusLostEvent {};
/// The user asked to close the window.
struct CloseEvent {};

using Event = std::variant<KeyEvent, TextEvent, ButtonEvent, MotionEvent, WheelEvent, DropEvent,
                           DamageEvent, FocusLostEvent, CloseEvent>;

/// A window whose core context of OpenGL 3.3 or later is current, with debug output where the
/// driver has it. One window at a time, on one thread.
class Window {
public:
    /// @param width @param height of the content, screen coordinates, at least 1; more on a dense
    /// display, by its content scale; less where the primary display's work area is smaller
    /// @errors NoOpenGl in one sentence: no display server, or no such OpenGL on it
    [[nodiscard]] static core::Result<Window> create(const std::string& title, int width,
                                                     int height);
    Window(Window&& other) noexcept;
    Window& operator=(Window&& other) noexcept;
    ~Window();

    /// What happened since the last call, in order, without waiting.
    [[nodiscard]] std::vector<Event> poll();
    /// The same, asleep until something happens or the time is over. @param seconds > 0; infinity
    /// waits for an event only
    [[nodiscard]] std::vector<Event> wait(double seconds);

    /// Size of the framebuffer in pixels, which a high-density display makes larger than the
    /// window's; 0 while the window is minimised.
    [[nodiscard]] int width() const;
    [[nodiscard]] int height() const;
    /// By how much text is to be enlarged on the window's display; 1 on an ordinary one.
    [[nodiscard]] float contentScale() const;

    void setTitle(const std::string& title);
    /// Fills the primary display, or gives the window back its place.
    void setFullScreen(bool on);
    /// Shows what was drawn into framebuffer 0.
    void present();

    /// The system's clipboard; empty where it holds no text.
    [[nodiscard]] std::string clipboard() const;
    void setClipboard(const std::string& text);

private:
    struct State;
    explicit Window(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace lodestar::platform

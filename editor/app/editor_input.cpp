// SPDX-License-Identifier: MIT
//
// Events of a window as the panels take them.
#include "app/editor.h"

namespace lodestar::app {
namespace {

template <class... Visitors>
struct Overloaded : Visitors... {
    using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

ui::Key from(platform::Key key) {
    using Theirs = platform::Key;
    const auto offset = [&](Theirs first, ui::Key ours) {
        return static_cast<ui::Key>(static_cast<int>(key) - static_cast<int>(first) +
                                    static_cast<int>(ours));
    };
    if (key <= Theirs::Z) {
        return offset(Theirs::A, ui::Key::A);
    }
    if (key <= Theirs::Digit9) {
        return offset(Theirs::Digit0, ui::Key::Digit0);
    }
    if (key <= Theirs::F12) {
        return offset(Theirs::F1, ui::Key::F1);
    }
    static constexpr std::pair<Theirs, ui::Key> kOthers[] = {
        {Theirs::Space, ui::Key::Space},
        {Theirs::Comma, ui::Key::Comma},
        {Theirs::Period, ui::Key::Period},
        {Theirs::Plus, ui::Key::Plus},
        {Theirs::Minus, ui::Key::Minus},
        {Theirs::Tab, ui::Key::Tab},
        {Theirs::Escape, ui::Key::Escape},
        {Theirs::Home, ui::Key::Home},
        {Theirs::End, ui::Key::End},
        {Theirs::PageUp, ui::Key::PageUp},
        {Theirs::PageDown, ui::Key::PageDown},
        {Theirs::Left, ui::Key::Left},
        {Theirs::Right, ui::Key::Right},
        {Theirs::Up, ui::Key::Up},
        {Theirs::Down, ui::Key::Down},
        {Theirs::Enter, ui::Key::Enter},
        {Theirs::Backspace, ui::Key::Backspace},
        {Theirs::Delete, ui::Key::Delete},
        {Theirs::Insert, ui::Key::Insert},
        {Theirs::Shift, ui::Key::Shift},
        {Theirs::Control, ui::Key::Control},
    };
    for (const auto& [theirs, ours] : kOthers) {
        if (theirs == key) {
            return ours;
        }
    }
    return ui::Key::Alt;
}

} // namespace

void Editor::handle(const platform::Event& event) {
    std::visit(
        Overloaded{
            [&](const platform::KeyEvent& key) { handleKey(key); },
            [&](const platform::TextEvent& text) { session_.push(ui::TextInput{text.character}); },
            [&](const platform::ButtonEvent& button) {
                const int index = button.button == platform::PointerButton::Left    ? 0
                                  : button.button == platform::PointerButton::Right ? 1
                                                                                    : 2;
                session_.push(ui::ButtonInput{index, button.down});
            },
            [&](const platform::MotionEvent& motion) {
                session_.push(
                    ui::MotionInput{static_cast<float>(motion.x), static_cast<float>(motion.y)});
            },
            [&](const platform::WheelEvent& wheel) {
                session_.push(ui::WheelInput{static_cast<float>(wheel.steps)});
            },
            [&](const platform::DropEvent& dropped) {
                for (const std::string& path : dropped.paths) {
                    drop(path);
                }
            },
            [&](const platform::DamageEvent&) { session_.wake(); },
            [&](const platform::FocusLostEvent&) { session_.push(ui::FocusLostInput{}); },
            [&](const platform::CloseEvent&) {
                // What is unsaved lies in the side file, and is there again at the next start.
                if (model_.dirty() && !file_.path().empty()) {
                    (void)file_.autosave(model_, now() + 1e6);
                }
                closing_ = true;
            },
        },
        event);
}

void Editor::handleKey(const platform::KeyEvent& event) {
    if (!event.repeat) { // Dear ImGui repeats by itself
        session_.push(ui::KeyInput{from(event.key), event.down, event.modifiers.shift,
                                   event.modifiers.control, event.modifiers.alt});
    } else {
        session_.wake();
    }
}

} // namespace lodestar::app

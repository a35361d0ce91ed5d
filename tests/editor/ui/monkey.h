// SPDX-License-Identifier: MIT
//
// A hand that plays with the panels by chance, and an account of what it has touched.
#pragma once

#include <array>
#include <cctype>
#include <deque>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <imgui.h>
#include <imgui_internal.h>

#include "ui/actions.h"
#include "ui/workspace.h"

namespace lodestar::ui {

/// Presses by what they were on. Numbers of lists are left out: "stop 3" is a "stop".
class Touched {
public:
    /// After a frame. @pre its context is current
    void note(const std::map<std::string, Mark>& marks) {
        const ImGuiContext& context = *ImGui::GetCurrentContext();
        const ImGuiIO& io = context.IO;
        const bool pressed = io.MouseClicked[0] || io.MouseClicked[1] || io.MouseClicked[2];
        const std::string* least = nullptr;
        float leastArea = 0.0f;
        for (const auto& [name, mark] : marks) {
            const auto area = (mark.high.x - mark.low.x) * (mark.high.y - mark.low.y);
            const bool under = io.MousePos.x >= mark.low.x && io.MousePos.x < mark.high.x &&
                               io.MousePos.y >= mark.low.y && io.MousePos.y < mark.high.y;
            const std::string kind = kindOf(name);
            presses_.try_emplace(kind, 0);
            if (pressed && under && context.HoveredWindow != nullptr &&
                context.HoveredWindow->ID == mark.window && (!least || area < leastArea)) {
                least = &name;
                leastArea = area;
            }
        }
        if (least != nullptr) {
            ++presses_[kindOf(*least)];
        }
    }
    /// How often each thing that was ever seen was pressed.
    [[nodiscard]] const std::map<std::string, int>& presses() const { return presses_; }
    [[nodiscard]] int presses(const std::string& name) const {
        const auto found = presses_.find(kindOf(name));
        return found != presses_.end() ? found->second : 0;
    }

private:
    [[nodiscard]] static std::string kindOf(const std::string& name) {
        std::size_t end = name.size();
        while (end > 0 && std::isdigit(static_cast<unsigned char>(name[end - 1])) != 0) {
            --end;
        }
        const bool numbered = end > 0 && end < name.size() && name[end - 1] == ' ';
        return numbered ? name.substr(0, end - 1) : name;
    }
    std::map<std::string, int> presses_;
};

/// Single inputs by chance, and gestures that mean something: a click, a drag, a number typed into
/// a field, a key with what is held to it. It hits what is there more often than what is not, and
/// what it has hit less often more often.
class Monkey {
public:
    explicit Monkey(std::uint64_t seed) : random_(seed) {}

    int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
    bool one(int in) { return below(in) == 0; }

    Input next(const std::map<std::string, Mark>& marks, const Touched& touched, float width,
               float height) {
        if (waiting_.empty()) {
            one(2) ? single(marks, touched, width, height) : gesture(marks, touched, height);
        }
        const Input input = waiting_.front();
        waiting_.pop_front();
        return input;
    }

private:
    void put(const Input& input) { waiting_.push_back(input); }
    void button(int which, bool down) {
        buttons_[static_cast<std::size_t>(which)] = down;
        put(ButtonInput{which, down});
    }
    void click(int which = 0) {
        button(which, true);
        button(which, false);
    }
    void stroke(Key key, bool shift = false, bool control = false, bool alt = false) {
        put(KeyInput{key, true, shift, control, alt});
        put(KeyInput{key, false, shift, control, alt});
    }

    /// Somewhere on something, mostly in the popup that is open. @return its place
    MotionInput onMark(const std::map<std::string, Mark>& marks, const Touched& touched) {
        const ImVector<ImGuiPopupData>& open = ImGui::GetCurrentContext()->OpenPopupStack;
        const ImGuiWindow* const popup = !open.empty() && !one(4) ? open.back().Window : nullptr;
        std::vector<decltype(marks.begin())> here;
        for (auto mark = marks.begin(); mark != marks.end(); ++mark) {
            if (popup == nullptr || mark->second.window == popup->ID) {
                here.push_back(mark);
            }
        }
        if (here.empty()) {
            return {};
        }
        const auto any = [&] {
            return here[static_cast<std::size_t>(below(static_cast<int>(here.size())))];
        };
        auto mark = any();
        for (int more = below(4); more > 0; --more) {
            const auto other = any();
            mark = touched.presses(other->first) < touched.presses(mark->first) ? other : mark;
        }
        const ImVec2 low = mark->second.low;
        const ImVec2 high = mark->second.high;
        const auto share = [&] { return static_cast<float>(below(101)) / 100.0f; };
        return {low.x + share() * (high.x - low.x),
                one(3) ? low.y + share() * (high.y - low.y) : 0.5f * (low.y + high.y)};
    }

    void single(const std::map<std::string, Mark>& marks, const Touched& touched, float width,
                float height) {
        switch (below(10)) {
        case 0:
        case 1:
            return put(onMark(marks, touched));
        case 2:
            return put(
                MotionInput{static_cast<float>(below(static_cast<int>(width) + 60)) - 30.0f,
                            static_cast<float>(below(static_cast<int>(height) + 60)) - 30.0f});
        case 3:
        case 4:
        case 5: {
            const int which = one(8) ? below(3) : 0;
            return button(which, !buttons_[static_cast<std::size_t>(which)]);
        }
        case 6:
        case 7: {
            const int key = below(kKeyCount);
            bool& down = keys_[static_cast<std::size_t>(key)];
            down = !down;
            return put(KeyInput{static_cast<Key>(key), down, one(6), one(4), one(20)});
        }
        case 8:
            return put(TextInput{kLetters[static_cast<std::size_t>(below(kLetters.size()))]});
        default:
            return one(20) ? put(FocusLostInput{})
                           : put(WheelInput{static_cast<float>(below(5)) - 2.0f});
        }
    }

    void gesture(const std::map<std::string, Mark>& marks, const Touched& touched, float height) {
        for (int which = 0; which < 3; ++which) { // with open hands
            if (buttons_[static_cast<std::size_t>(which)]) {
                button(which, false);
            }
        }
        const MotionInput from = onMark(marks, touched);
        if (from.y < 0.0f || from.y >= height) { // scrolled out of its panel
            put(MotionInput{from.x, 0.5f * height});
            return put(WheelInput{from.y < 0.0f ? 4.0f : -4.0f});
        }
        put(from);
        switch (below(9)) {
        case 0:
        case 1:
        case 2:
            return click();
        case 3:
            return click(1 + below(2));
        case 4:
            click();
            return click();
        case 5:
            return drag(marks, touched, from);
        case 6:
            return number();
        case 7: {
            const std::span<const Binding> all = bindings();
            const Binding& binding =
                all[static_cast<std::size_t>(below(static_cast<int>(all.size())))];
            return stroke(binding.key, binding.shift, binding.control);
        }
        default: // by the keyboard alone
            constexpr std::array kWays = {Key::Tab,   Key::Up,    Key::Down,   Key::Left,
                                          Key::Right, Key::Enter, Key::Escape, Key::Space};
            return stroke(kWays[static_cast<std::size_t>(below(kWays.size()))], one(8), one(8),
                          one(12));
        }
    }

    /// From a place to somewhere, or nowhere, with what is held to it.
    void drag(const std::map<std::string, Mark>& marks, const Touched& touched,
              const MotionInput& from) {
        constexpr std::array kHeld = {Key::Shift, Key::Control, Key::Alt};
        const std::size_t held = static_cast<std::size_t>(below(6));
        const auto hold = [&](bool down) {
            if (held < kHeld.size()) {
                put(KeyInput{kHeld[held], down, false, false, false});
            }
        };
        hold(true);
        button(0, true);
        const MotionInput to = one(4) ? from : onMark(marks, touched);
        for (int step = below(4); step >= 0; --step) {
            put(MotionInput{to.x + static_cast<float>(8 * step),
                            to.y + static_cast<float>(step * below(5))});
        }
        button(0, false);
        hold(false);
    }

    /// A field becomes a text by a click with Ctrl.
    void number() {
        constexpr std::array kNumbers = {
            "inf", "-inf",   "nan",    "-1", "1e39",   "1e-45", "4.9e-324", "1e400",
            "-0",  "0",      "12.5",   "+3", "1e9",    "0.001", "",         "-1e308",
            "89",  "1e-310", "0.5e-3", "64", "- 7 .e", "*2",    "007",      "abc\xe9 /"};
        put(KeyInput{Key::Control, true, false, true, false});
        button(0, true);
        button(0, false);
        put(KeyInput{Key::Control, false, false, false, false});
        const std::string text = kNumbers[static_cast<std::size_t>(below(kNumbers.size()))];
        for (const char letter : text) {
            put(TextInput{static_cast<char32_t>(static_cast<unsigned char>(letter))});
        }
        stroke(one(5) ? Key::Escape : one(5) ? Key::Tab : Key::Enter);
    }

    static constexpr std::array<char32_t, 23> kLetters = {
        U'0', U'1', U'2', U'3', U'4', U'5', U'6', U'7', U'8',    U'9',      U'.',         U'-',
        U'+', U'e', U'E', U'n', U'a', U'i', U'f', U'/', U'\xb0', U'\u2013', U'\U0001f600'};
    std::mt19937_64 random_;
    std::deque<Input> waiting_;
    std::array<bool, 3> buttons_{};
    std::array<bool, kKeyCount> keys_{};
};

} // namespace lodestar::ui

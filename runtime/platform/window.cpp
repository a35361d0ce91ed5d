// SPDX-License-Identifier: MIT
#include "platform/window.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <epoxy/gl.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace lodestar::platform {
namespace {

/// GLFW's last complaint; GLFW reports through a free function.
std::string& lastComplaint() {
    static std::string text;
    return text;
}

void onError(int, const char* description) {
    lastComplaint() = description;
}

core::Error noOpenGl(const std::string& asked) {
    const std::string& said = lastComplaint();
    return {core::ErrorCode::NoOpenGl,
            "no usable OpenGL: " + asked + (said.empty() ? "" : ": " + said),
            {},
            {}};
}

Key offset(Key first, int by) {
    return static_cast<Key>(static_cast<int>(first) + by);
}

std::optional<Key> keyFrom(int code) {
    if (code >= GLFW_KEY_A && code <= GLFW_KEY_Z) {
        return offset(Key::A, code - GLFW_KEY_A);
    }
    if (code >= GLFW_KEY_0 && code <= GLFW_KEY_9) {
        return offset(Key::Digit0, code - GLFW_KEY_0);
    }
    if (code >= GLFW_KEY_KP_0 && code <= GLFW_KEY_KP_9) {
        return offset(Key::Digit0, code - GLFW_KEY_KP_0);
    }
    if (code >= GLFW_KEY_F1 && code <= GLFW_KEY_F12) {
        return offset(Key::F1, code - GLFW_KEY_F1);
    }
    static constexpr std::pair<int, Key> kOthers[] = {
        {GLFW_KEY_SPACE, Key::Space},
        {GLFW_KEY_COMMA, Key::Comma},
        {GLFW_KEY_PERIOD, Key::Period},
        {GLFW_KEY_EQUAL, Key::Plus},
        {GLFW_KEY_KP_ADD, Key::Plus},
        {GLFW_KEY_MINUS, Key::Minus},
        {GLFW_KEY_KP_SUBTRACT, Key::Minus},
        {GLFW_KEY_TAB, Key::Tab},
        {GLFW_KEY_ESCAPE, Key::Escape},
        {GLFW_KEY_HOME, Key::Home},
        {GLFW_KEY_END, Key::End},
        {GLFW_KEY_PAGE_UP, Key::PageUp},
        {GLFW_KEY_PAGE_DOWN, Key::PageDown},
        {GLFW_KEY_LEFT, Key::Left},
        {GLFW_KEY_RIGHT, Key::Right},
        {GLFW_KEY_UP, Key::Up},
        {GLFW_KEY_DOWN, Key::Down},
        {GLFW_KEY_ENTER, Key::Enter},
        {GLFW_KEY_KP_ENTER, Key::Enter},
        {GLFW_KEY_BACKSPACE, Key::Backspace},
        {GLFW_KEY_DELETE, Key::Delete},
        {GLFW_KEY_INSERT, Key::Insert},
        {GLFW_KEY_LEFT_SHIFT, Key::Shift},
        {GLFW_KEY_RIGHT_SHIFT, Key::Shift},
        {GLFW_KEY_LEFT_CONTROL, Key::Control},
        {GLFW_KEY_RIGHT_CONTROL, Key::Control},
        {GLFW_KEY_LEFT_ALT, Key::Alt},
        {GLFW_KEY_RIGHT_ALT, Key::Alt},
    };
    for (const auto& [glfw, key] : kOthers) {
        if (glfw == code) {
            return key;
        }
    }
    return std::nullopt;
}

Modifiers modifiersFrom(int bits) {
    return {(bits & GLFW_MOD_SHIFT) != 0, (bits & GLFW_MOD_CONTROL) != 0,
            (bits & GLFW_MOD_ALT) != 0};
}

} // namespace

struct Window::State {
    GLFWwindow* window = nullptr;
    std::vector<Event> events;
    std::array<int, 4> place{}; ///< x, y, width, height to come back to from full screen
    bool fullScreen = false;

    ~State() {
        if (window != nullptr) {
            glfwDestroyWindow(window);
        }
        glfwTerminate();
    }

    static State& of(GLFWwindow* window) {
        return *static_cast<State*>(glfwGetWindowUserPointer(window));
    }
    void hook();
    [[nodiscard]] std::array<int, 2> framebufferSize() const {
        std::array<int, 2> size{};
        if (glfwGetWindowAttrib(window, GLFW_ICONIFIED) == GLFW_FALSE) {
            glfwGetFramebufferSize(window, &size[0], &size[1]);
        }
        return size;
    }
};

void Window::State::hook() {
    glfwSetWindowUserPointer(window, this);
    glfwSetKeyCallback(window, [](GLFWwindow* w, int code, int, int action, int bits) {
        if (const std::optional<Key> key = keyFrom(code)) {
            of(w).events.emplace_back(
                KeyEvent{*key, action != GLFW_RELEASE, action == GLFW_REPEAT, modifiersFrom(bits)});
        }
    });
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned character) {
        of(w).events.emplace_back(TextEvent{static_cast<char32_t>(character)});
    });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int bits) {
        if (button <= GLFW_MOUSE_BUTTON_MIDDLE) {
            const PointerButton which = button == GLFW_MOUSE_BUTTON_LEFT    ? PointerButton::Left
                                        : button == GLFW_MOUSE_BUTTON_RIGHT ? PointerButton::Right
                                                                            : PointerButton::Middle;
            of(w).events.emplace_back(
                ButtonEvent{which, action == GLFW_PRESS, modifiersFrom(bits)});
        }
    });
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
        int width = 1;
        int height = 1;
        glfwGetWindowSize(w, &width, &height);
        const std::array<int, 2> pixels = of(w).framebufferSize();
        of(w).events.emplace_back(MotionEvent{width > 0 ? x * pixels[0] / width : x,
                                              height > 0 ? y * pixels[1] / height : y});
    });
    glfwSetScrollCallback(
        window, [](GLFWwindow* w, double, double y) { of(w).events.emplace_back(WheelEvent{y}); });
    glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
        of(w).events.emplace_back(DropEvent{std::vector<std::string>(paths, paths + count)});
    });
    glfwSetFramebufferSizeCallback(
        window, [](GLFWwindow* w, int, int) { of(w).events.emplace_back(DamageEvent{}); });
    glfwSetWindowRefreshCallback(window,
                                 [](GLFWwindow* w) { of(w).events.emplace_back(DamageEvent{}); });
    glfwSetWindowIconifyCallback(
        window, [](GLFWwindow* w, int) { of(w).events.emplace_back(DamageEvent{}); });
    glfwSetWindowContentScaleCallback(
        window, [](GLFWwindow* w, float, float) { of(w).events.emplace_back(DamageEvent{}); });
    glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int focused) {
        if (focused == GLFW_FALSE) {
            of(w).events.emplace_back(FocusLostEvent{});
        }
    });
    glfwSetWindowCloseCallback(window,
                               [](GLFWwindow* w) { of(w).events.emplace_back(CloseEvent{}); });
}

namespace {

/// Makes a window that is not shown yet no larger than the primary display's work area, its frame
/// included.
void fit(GLFWwindow* window) {
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    if (monitor == nullptr) {
        return;
    }
    std::array<int, 4> area{};  // x, y, width, height
    std::array<int, 4> frame{}; // left, top, right, bottom
    std::array<int, 2> size{};
    glfwGetMonitorWorkarea(monitor, &area[0], &area[1], &area[2], &area[3]);
    glfwGetWindowFrameSize(window, &frame[0], &frame[1], &frame[2], &frame[3]);
    glfwGetWindowSize(window, &size[0], &size[1]);
    const int width = std::min(size[0], std::max(area[2] - frame[0] - frame[2], 1));
    const int height = std::min(size[1], std::max(area[3] - frame[1] - frame[3], 1));
    if (area[2] > 0 && area[3] > 0 && (width < size[0] || height < size[1])) {
        glfwSetWindowSize(window, width, height);
        glfwSetWindowPos(window, area[0] + frame[0], area[1] + frame[1]);
    }
}

} // namespace

Window::Window(std::unique_ptr<State> state) : state_(std::move(state)) {}
Window::Window(Window&& other) noexcept = default;
Window& Window::operator=(Window&& other) noexcept = default;
Window::~Window() = default;

core::Result<Window> Window::create(const std::string& title, int width, int height) {
    LODESTAR_EXPECT(width > 0 && height > 0, "a window has a size");
    lastComplaint().clear();
    glfwSetErrorCallback(onError);
    if (glfwInit() != GLFW_TRUE) {
        return noOpenGl("a window needs a display server, and none can be reached");
    }
    auto state = std::make_unique<State>();
    for (const int debug : {GLFW_TRUE, GLFW_FALSE}) {
        glfwDefaultWindowHints();
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
        glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, debug);
        glfwWindowHint(GLFW_DEPTH_BITS, 0);
        glfwWindowHint(GLFW_STENCIL_BITS, 0);
        glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE); // as large to the eye on a dense display
        glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);         // until it fits
        glfwWindowHintString(GLFW_X11_CLASS_NAME, "lodestar");
        glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "lodestar");
        state->window = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
        if (state->window != nullptr) {
            break;
        }
    }
    if (state->window == nullptr) {
        return noOpenGl("asked the display for a window with an OpenGL 3.3 core context");
    }
    fit(state->window);
    glfwShowWindow(state->window);
    glfwMakeContextCurrent(state->window);
    if (glGetString(GL_VERSION) == nullptr || epoxy_gl_version() < 33) {
        return noOpenGl("the display's OpenGL is older than 3.3");
    }
    glfwSwapInterval(1);
    state->hook();
    return Window(std::move(state));
}

std::vector<Event> Window::poll() {
    glfwPollEvents();
    return std::exchange(state_->events, {});
}

std::vector<Event> Window::wait(double seconds) {
    LODESTAR_EXPECT(seconds > 0.0, "a wait lasts some time");
    if (state_->events.empty()) {
        std::isinf(seconds) ? glfwWaitEvents() : glfwWaitEventsTimeout(seconds);
    }
    return std::exchange(state_->events, {});
}

int Window::width() const {
    return state_->framebufferSize()[0];
}

int Window::height() const {
    return state_->framebufferSize()[1];
}

float Window::contentScale() const {
    float x = 1.0f;
    float y = 1.0f;
    glfwGetWindowContentScale(state_->window, &x, &y);
    return std::isfinite(y) && y > 0.0f ? y : 1.0f;
}

void Window::setTitle(const std::string& title) {
    glfwSetWindowTitle(state_->window, title.c_str());
}

void Window::setFullScreen(bool on) {
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
    if (on == state_->fullScreen || mode == nullptr) {
        return;
    }
    std::array<int, 4>& place = state_->place;
    if (on) {
        glfwGetWindowPos(state_->window, &place[0], &place[1]);
        glfwGetWindowSize(state_->window, &place[2], &place[3]);
        glfwSetWindowMonitor(state_->window, monitor, 0, 0, mode->width, mode->height,
                             mode->refreshRate);
    } else {
        glfwSetWindowMonitor(state_->window, nullptr, place[0], place[1], place[2], place[3], 0);
    }
    state_->fullScreen = on;
}

void Window::present() {
    glfwSwapBuffers(state_->window);
}

std::string Window::clipboard() const {
    const char* text = glfwGetClipboardString(state_->window);
    return text != nullptr ? text : "";
}

void Window::setClipboard(const std::string& text) {
    glfwSetClipboardString(state_->window, text.c_str());
}

} // namespace lodestar::platform

// SPDX-License-Identifier: MIT
//
// A Dear ImGui context of our own: input in, frames out, drawn through OpenGL where there is one.
// A host that has an ImGui frame needs none of this; the panels draw into its context.
#pragma once

#include <functional>
#include <string>

#include "ui/input.h"

struct ImGuiContext;

namespace lodestar::ui {

/// The system's clipboard, where there is one.
struct Clipboard {
    std::function<std::string()> text;
    std::function<void(const std::string&)> set;
};

class Session {
public:
    enum class Drawing { OpenGl, None };

    /// @param drawing OpenGl: a context is current, and stays so for the session's life
    explicit Session(Drawing drawing, Clipboard clipboard = {});
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
    ~Session();

    void push(const Input& input);
    /// Something outside of the input has changed: draws once more.
    /// @param frames more than one where a window appears: its size is known in its second frame
    void wake(int frames = 1) { framesWanted_ = framesWanted_ > frames ? framesWanted_ : frames; }
    /// Whether there is anything to draw: input that waits, or a layout that still settles.
    [[nodiscard]] bool wantsFrame() const { return !queue_.empty() || framesWanted_ > 0; }

    /// One frame. Where Dear ImGui asserts in vain, its context is given up for a new one and the
    /// frame shows nothing; whatever `contents` did to a document before that stays done.
    /// @param width @param height framebuffer pixels  @param scale of the display, > 0
    /// @param seconds since the last frame
    void frame(int width, int height, float scale, double seconds,
               const std::function<void()>& contents);
    /// Draws the last frame into the framebuffer that is bound. @pre Drawing::OpenGl
    void render();

    /// What was asserted in vain in the last frame; empty: nothing was.
    [[nodiscard]] const std::string& failure() const { return failure_; }
    [[nodiscard]] int framesBuilt() const { return framesBuilt_; }

private:
    void start();
    void useScale(float scale);

    Drawing drawing_;
    Clipboard clipboard_;
    std::string clipboardText_; ///< what Dear ImGui last asked for
    ImGuiContext* context_ = nullptr;
    InputQueue queue_;
    float scale_ = 0.0f;
    int framesWanted_ = 0;
    int framesBuilt_ = 0;
    bool whole_ = false; ///< the last frame can be drawn
    std::string failure_;
};

} // namespace lodestar::ui

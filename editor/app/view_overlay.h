// SPDX-License-Identifier: MIT
//
// The text that lies over the viewer's picture.
#pragma once

#include <string>
#include <vector>

namespace lodestar::app {

/// What is shown.
struct OverlayText {
    std::vector<std::string> lines; ///< top left
    std::string message;            ///< bottom; empty: none
    bool messageIsError = false;
    bool help = false;
    unsigned picture = 0; ///< a GL texture of the framebuffer's size that covers it; 0: none
};

/// Dear ImGui without input and without files. Made and ended with the window's context current.
class Overlay {
public:
    Overlay();
    Overlay(const Overlay&) = delete;
    Overlay& operator=(const Overlay&) = delete;
    ~Overlay();

    /// Draws into framebuffer 0. @param width @param height of it, pixels  @param contentScale by
    /// how much text is enlarged
    void draw(const OverlayText& text, int width, int height, float contentScale);

private:
    void useFontFor(float contentScale);
    float fontScale_ = 0.0f;
};

} // namespace lodestar::app

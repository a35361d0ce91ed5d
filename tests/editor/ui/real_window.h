// SPDX-License-Identifier: MIT
//
// `lodestar edit` in a real window on a virtual display, with a pointer and a keyboard.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <future>
#include <memory>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "support/picture.h"
#include "support/run.h"
#include "support/virtual_display.h"

namespace lodestar::testing {

class RealWindow {
public:
    /// @param screen WIDTHxHEIGHT
    RealWindow(const TemporaryFolder& folder, std::string lighting, const std::string& screen)
        : picture_(folder.file("shown.png")), lighting_(std::move(lighting)), display_(screen) {}
    ~RealWindow() { waitForEnd(); }
    RealWindow(const RealWindow&) = delete;
    RealWindow& operator=(const RealWindow&) = delete;

    /// As a desktop tells how dense its screen is, before the program starts. @param dpi 96: scale
    /// 1
    [[nodiscard]] bool setDensity(int dpi) {
        return display_.isReady() &&
               output("xprop -root -f RESOURCE_MANAGER 8s -set RESOURCE_MANAGER 'Xft.dpi: " +
                      std::to_string(dpi) + "\n' && echo set") == "set\n";
    }
    /// Starts the program and waits for its window.
    [[nodiscard]] bool open() {
        if (!display_.isReady()) {
            return false;
        }
        run_ = std::async(std::launch::async, [this] {
            return runLodestar({"edit", "--lighting", lighting_}, {"DISPLAY=" + display_.name()},
                               400.0);
        });
        return soon([this] {
            window_ = output("xdotool search --onlyvisible --class lodestar");
            window_ = window_.substr(0, window_.find('\n'));
            const core::Image now = shown();
            return std::any_of(now.pixels().begin(), now.pixels().end(), // with letters
                               [](float value) { return value > 0.5f && value < 1.0f; });
        });
    }
    [[nodiscard]] bool resize(int width, int height) {
        output("xdotool windowsize --sync " + window_ + " " + std::to_string(width) + " " +
               std::to_string(height));
        return soon([&] {
            const core::Image now = shown();
            return now.width() == width && now.height() == height;
        });
    }
    /// Waits until two pictures in a row are the same.
    void rest() {
        core::Image last = shown();
        EXPECT_TRUE(soon([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(400));
            core::Image now = shown();
            const bool same = !now.empty() && now.pixels() == last.pixels();
            last = std::move(now);
            return same;
        })) << "an editor at rest goes on drawing";
    }
    [[nodiscard]] core::Image shown() {
        std::filesystem::remove(picture_);
        if (window_.empty()) {
            return {};
        }
        output("import -window " + window_ + " -depth 8 png24:" + picture_);
        return std::filesystem::exists(picture_) ? readPicture(picture_) : core::Image();
    }
    void keep(const std::string& path) {
        output("import -window " + window_ + " -depth 8 png24:" + path);
    }
    /// Its width and height, pixels of the screen.
    [[nodiscard]] std::array<int, 2> size() {
        const std::string told = output("xdotool getwindowgeometry --shell " + window_);
        std::array<int, 2> size{};
        const std::size_t at = told.find("WIDTH=");
        EXPECT_TRUE(at != std::string::npos &&
                    std::sscanf(told.c_str() + at, "WIDTH=%d HEIGHT=%d", &size[0], &size[1]) == 2)
            << told;
        return size;
    }

    /// As a keyboard's, not sent to the window: the modifiers are then the server's.
    void key(const std::string& name) { act(" key --delay 100 " + name); }
    void type(const std::string& text) { act(" type --delay 100 " + text); }
    void click(float x, float y, const std::string& held = {}) {
        const std::string down = held.empty() ? "" : " keydown " + held + " sleep 0.2";
        const std::string up = held.empty() ? "" : " sleep 0.2 keyup " + held;
        act(at(x, y) + down + " mousedown 1 sleep 0.2 mouseup 1" + up);
    }
    void drag(float x0, float y0, float x1, float y1) {
        act(at(x0, y0) + " mousedown 1 sleep 0.2" + at(0.5f * (x0 + x1), 0.5f * (y0 + y1)) +
            at(x1, y1) + " mouseup 1");
    }

    /// Asks the window manager to close it. @return how the program ended
    [[nodiscard]] RunResult close() {
        do {
            output("xdotool windowactivate --sync " + window_ + " key alt+F4");
        } while (run_.wait_for(std::chrono::seconds(2)) != std::future_status::ready);
        return run_.get();
    }

private:
    [[nodiscard]] std::string at(float x, float y) const {
        return " mousemove --window " + window_ + " " + std::to_string(std::lround(x)) + " " +
               std::to_string(std::lround(y)) + " sleep 0.2";
    }
    void act(const std::string& words) {
        output("xdotool windowactivate --sync " + window_ + words);
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        rest();
    }
    void waitForEnd() {
        if (run_.valid()) {
            output("xdotool windowkill " + window_);
            run_.wait();
        }
    }

    std::string picture_, lighting_, window_;
    VirtualDisplay display_;
    std::future<RunResult> run_;
};

} // namespace lodestar::testing

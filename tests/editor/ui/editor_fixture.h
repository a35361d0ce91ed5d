// SPDX-License-Identifier: MIT
//
// The whole editor without a display: events go in as a window gives them, frames are drawn into a
// texture and read back.
#pragma once

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <thread>

#include "app/editor.h"
#include "io/image_file.h"
#include "support/gl_fixture.h"
#include "support/run.h"

namespace lodestar::testing {

class EditorTest : public GlTest {
protected:
    static constexpr int kWidth = 1200, kHeight = 760;

    void SetUp() override {
        GlTest::SetUp();
        if (IsSkipped() || HasFatalFailure()) {
            return;
        }
        resize(kWidth, kHeight, 1.0f);
        open({});
    }
    void TearDown() override {
        editor_.reset();
        target_ = {};
        GlTest::TearDown();
    }

    void open(const app::EditorOptions& options) {
        editor_.reset();
        ui::Clipboard clipboard{[this] { return clipboard_; },
                                [this](const std::string& text) { clipboard_ = text; }};
        auto editor = app::Editor::make(device(), options, clipboard);
        ASSERT_TRUE(editor.ok()) << editor.error().message();
        editor_ = std::move(*editor);
        settle();
    }

    /// Another display, from the next frame on. @param scale of its pixels
    void resize(int width, int height, float scale) {
        auto target = gl::DisplayTarget::make(device(), width, height);
        ASSERT_TRUE(target.ok()) << target.error().message();
        target_ = std::move(*target);
        scale_ = scale;
        if (editor_) {
            send(platform::DamageEvent{});
            settle();
        }
    }

    /// One frame, whether or not one is wanted.
    void frame() {
        editor_->advance(1.0 / 60.0);
        draw();
    }
    /// The same while no time passes.
    void draw() {
        const auto drawn =
            editor_->drawFrame(target_.width(), target_.height(), scale_, target_.framebuffer());
        ASSERT_TRUE(drawn.ok()) << drawn.error().message();
    }
    /// Frames until the editor wants none.
    void settle() {
        int frames = 0;
        while (editor_->wantsFrame() && frames < 60) {
            frame();
            ++frames;
        }
        const auto& log = editor_->workspace().log();
        ASSERT_LT(frames, 60) << "an editor that nobody touches goes on drawing: "
                              << (log.empty() ? "" : log.back().text);
    }
    /// Frames until nothing goes on beside them.
    void finish() {
        for (int i = 0; editor_->works() && i < 3000; ++i) {
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
            editor_->advance(0.01);
            settle();
        }
        ASSERT_FALSE(editor_->works());
        settle();
    }
    /// Frames as the window's loop has them until something is so, for ten minutes at most: of a
    /// sanitizer on a busy machine. @return the longest of what goes before a frame, milliseconds
    double waitUntil(const std::function<bool()>& so) {
        using Clock = std::chrono::steady_clock;
        const auto end = Clock::now() + std::chrono::minutes(10);
        double longest = 0.0;
        while (!so()) {
            EXPECT_LT(Clock::now(), end) << "it never is";
            if (Clock::now() >= end) {
                break;
            }
            settle();
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            const auto before = Clock::now();
            editor_->advance(0.005);
            longest = std::max(
                longest, std::chrono::duration<double, std::milli>(Clock::now() - before).count());
        }
        return longest;
    }
    /// Whether what the accuracy panel asks for is known.
    [[nodiscard]] bool measured() const {
        const ui::AccuracyView& view = editor_->surroundings().accuracy;
        return !view.material.empty() && view.progress >= 1.0 &&
               std::all_of(view.lines.begin(), view.lines.end(),
                           [](const ui::EstimateLine& line) { return line.ms && line.error; });
    }
    /// Until it is. @return as waitUntil
    double measure() {
        return waitUntil([this] { return measured() && editor_->patience() >= 1.0; });
    }
    void send(const platform::Event& event) { editor_->handle(event); }
    void moveTo(const ImVec2& place) {
        send(platform::MotionEvent{static_cast<double>(place.x), static_cast<double>(place.y)});
        settle();
    }
    void button(bool down, platform::PointerButton which = platform::PointerButton::Left) {
        send(platform::ButtonEvent{which, down, {}});
        settle();
    }
    void click(const ImVec2& place) {
        moveTo(place);
        button(true);
        button(false);
    }
    void drag(const ImVec2& from, const ImVec2& to, int steps = 6) {
        moveTo(from);
        button(true);
        for (int i = 1; i <= steps; ++i) {
            const float t = static_cast<float>(i) / static_cast<float>(steps);
            moveTo({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)});
        }
        button(false);
    }
    void press(platform::Key key, platform::Modifiers modifiers = {}) {
        send(platform::KeyEvent{key, true, false, modifiers});
        send(platform::KeyEvent{key, false, false, modifiers});
        settle();
    }
    /// Keys that stay down, or not, from here on.
    void hold(bool control, bool shift) {
        const platform::Modifiers held{shift, control, false};
        send(platform::KeyEvent{platform::Key::Control, control, false, held});
        settle();
        send(platform::KeyEvent{platform::Key::Shift, shift, false, held});
        settle();
    }
    void setClipboard(const std::string& text) { clipboard_ = text; }
    [[nodiscard]] const std::string& clipboard() const { return clipboard_; }
    void control(platform::Key key, bool shift = false) {
        press(key, {shift, true, false});
        send(platform::KeyEvent{platform::Key::Control, false, false, {}});
        settle();
    }
    void type(const std::string& text) {
        for (const char character : text) {
            send(platform::TextEvent{static_cast<char32_t>(character)});
        }
        settle();
    }
    /// Types a number into a field, which a click with Ctrl makes a text.
    void typeInto(const std::string& name, const std::string& text) {
        moveTo(mark(name).center());
        send(platform::KeyEvent{platform::Key::Control, true, false, {false, true, false}});
        button(true);
        button(false);
        send(platform::KeyEvent{platform::Key::Control, false, false, {}});
        settle();
        type(text);
        press(platform::Key::Enter);
    }

    [[nodiscard]] ui::Mark mark(const std::string& name) const {
        const auto& marks = editor_->workspace().marks();
        const auto found = marks.find(name);
        EXPECT_NE(found, marks.end()) << "nothing is called '" << name << "'";
        return found != marks.end() ? found->second : ui::Mark{};
    }
    [[nodiscard]] bool has(const std::string& name) const {
        return editor_->workspace().marks().count(name) > 0;
    }
    /// A place along the gradient's strip. @param x [0, 1]  @param y in its ramp's heights
    [[nodiscard]] ImVec2 onRamp(float x, float y = 0.5f) const {
        const ui::Mark ramp = mark("ramp");
        return {ramp.low.x + x * (ramp.high.x - ramp.low.x),
                ramp.low.y + y * (ramp.high.y - ramp.low.y)};
    }
    [[nodiscard]] model::Model& model() { return editor_->model(); }
    [[nodiscard]] const document::Light& light(std::size_t index) {
        return model().document().lights.at(index);
    }

    [[nodiscard]] core::Image shown() const { return target_.read(); }
    /// The part of a picture of the whole that is under a mark.
    [[nodiscard]] static core::Image part(const core::Image& whole, const ui::Mark& mark) {
        const int left = static_cast<int>(mark.low.x);
        const int top = static_cast<int>(mark.low.y);
        core::Image cut(static_cast<int>(mark.high.x) - left, static_cast<int>(mark.high.y) - top,
                        whole.channels());
        for (int y = 0; y < cut.height(); ++y) {
            for (int x = 0; x < cut.width(); ++x) {
                std::copy_n(whole.at(left + x, top + y), whole.channels(), cut.at(x, y));
            }
        }
        return cut;
    }
    /// The viewport once it stands still: what changes may be drawn with fewer samples.
    [[nodiscard]] core::Image viewport() {
        for (double patience = editor_->patience(); patience < 1.0;
             patience = editor_->patience()) {
            std::this_thread::sleep_for(std::chrono::duration<double>(patience));
            editor_->advance(patience);
            settle();
        }
        return part(shown(), mark("viewport"));
    }
    /// The mean difference of two pictures of one size, [0, 1].
    [[nodiscard]] static double difference(const core::Image& a, const core::Image& b) {
        EXPECT_EQ(a.pixels().size(), b.pixels().size());
        double sum = 0.0;
        for (std::size_t i = 0; i < a.pixels().size() && i < b.pixels().size(); ++i) {
            sum += static_cast<double>(std::abs(a.pixels()[i] - b.pixels()[i]));
        }
        return sum / static_cast<double>(std::max<std::size_t>(a.pixels().size(), 1));
    }
    /// Where LODESTAR_SCREENSHOTS names a folder, the picture is left there to be looked at.
    void keep(const std::string& name) const {
        if (const char* folder = std::getenv("LODESTAR_SCREENSHOTS")) {
            core::Image picture = shown();
            for (std::size_t i = 3; i < picture.pixels().size(); i += 4) {
                picture.pixels()[i] = 1.0f;
            }
            const auto path = std::filesystem::path(folder) / (name + ".png");
            EXPECT_TRUE(io::writeImage(path.string(), picture).ok());
        }
    }

    TemporaryFolder folder_;
    std::unique_ptr<app::Editor> editor_;

private:
    gl::DisplayTarget target_;
    float scale_ = 1.0f;
    std::string clipboard_;
};

} // namespace lodestar::testing

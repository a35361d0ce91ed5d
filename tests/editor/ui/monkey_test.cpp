// SPDX-License-Identifier: MIT
//
// Panels without a picture: random input into all of them, and what an assertion of Dear ImGui's
// leaves behind. The seed is printed; LODESTAR_MONKEY_SEED sets another, LODESTAR_MONKEY_FRAMES how
// long it goes on (tests/run.sh --long: ten million frames).
#include <array>
#include <cmath>
#include <cstdlib>
#include <random>

#include <gtest/gtest.h>
#include <imgui.h>

#include "document/document.h"
#include "model/presets.h"
#include "ui/session.h"
#include "ui/workspace.h"

namespace lodestar::ui {
namespace {

constexpr int kWidth = 1280, kHeight = 800;

model::Model begun() {
    document::Document document;
    document.lights = model::builtInPresets().front().lights;
    return model::Model(document);
}

Surroundings spheres() {
    Surroundings around;
    around.materials = {{"floor", 24.0, glm::dvec3(0.5), glm::dvec3(0.04), ""},
                        {"#1", 900.0, glm::dvec3(0.0), glm::dvec3(0.9), "ring:3"}};
    around.nodes = {{"root", 0, ""}, {"ball", 1, "mesh"}};
    around.estimators = {"tent", "ring:3", "auto:0.05"};
    return around;
}

/// A hand that hits what is there more often than what is not.
class Monkey {
public:
    explicit Monkey(std::uint64_t seed) : random_(seed) {}

    Input next(const Workspace& workspace) {
        switch (below(10)) {
        case 0:
        case 1:
            return aimed(workspace);
        case 2:
            return MotionInput{static_cast<float>(below(kWidth + 60)) - 30.0f,
                               static_cast<float>(below(kHeight + 60)) - 30.0f};
        case 3:
        case 4:
        case 5: {
            const int button = below(8) == 0 ? below(3) : 0;
            bool& down = buttons_[static_cast<std::size_t>(button)];
            down = !down;
            return ButtonInput{button, down};
        }
        case 6:
        case 7: {
            const int key = below(kKeyCount);
            bool& down = keys_[static_cast<std::size_t>(key)];
            down = !down;
            return KeyInput{static_cast<Key>(key), down, below(6) == 0, below(4) == 0,
                            below(20) == 0};
        }
        case 8:
            return TextInput{static_cast<char32_t>("0123456789.-+eEnaif/\xb0"[below(21)])};
        default:
            return below(20) == 0 ? Input(FocusLostInput{})
                                  : Input(WheelInput{static_cast<float>(below(5)) - 2.0f});
        }
    }
    int below(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }

private:
    Input aimed(const Workspace& workspace) {
        const auto& marks = workspace.marks();
        if (marks.empty()) {
            return MotionInput{};
        }
        const auto mark = std::next(marks.begin(), below(static_cast<int>(marks.size())));
        const ImVec2 low = mark->second.low;
        const ImVec2 high = mark->second.high;
        const float x = static_cast<float>(below(101)) / 100.0f;
        return MotionInput{low.x + x * (high.x - low.x), 0.5f * (low.y + high.y)};
    }

    std::mt19937_64 random_;
    std::array<bool, 3> buttons_{};
    std::array<bool, kKeyCount> keys_{};
};

std::uint64_t numberOf(const char* variable, std::uint64_t otherwise) {
    const char* text = std::getenv(variable);
    return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

/// What may not happen to a document, however it is edited.
void expectSound(const model::Model& model, int frame) {
    core::Tally repaired;
    const std::string text = document::writeDocument(model.document());
    const auto again = document::parseDocument(text, repaired);
    ASSERT_TRUE(again.ok()) << "frame " << frame << ": " << again.error().message();
    EXPECT_EQ(document::writeDocument(*again), text) << "frame " << frame;
    EXPECT_TRUE(document::dayLights(model.document(), repaired).ok()) << "frame " << frame;
    EXPECT_EQ(repaired.counts().size(), 0u)
        << "frame " << frame << ": " << repaired.counts().begin()->first;
    for (const document::Light& light : model.document().lights) {
        EXPECT_FALSE(light.keys.empty()) << "frame " << frame;
        for (const document::Key& key : light.keys) {
            EXPECT_GE(key.gradient.stops.size(), 2u) << "frame " << frame;
        }
    }
}

TEST(Monkey, RandomInputLeavesASoundDocument) {
    const int frames = static_cast<int>(numberOf("LODESTAR_MONKEY_FRAMES", 200000));
    const std::uint64_t seed = numberOf("LODESTAR_MONKEY_SEED", 1);
    std::printf("seed %llu, %d frames\n", static_cast<unsigned long long>(seed), frames);
    Monkey monkey(seed);
    model::Model model = begun();
    const Surroundings around = spheres();
    Workspace workspace;
    Session session(Session::Drawing::None);
    int failures = 0;
    int lastFailure = -2;
    std::uint64_t lastRevision = 0;
    int edits = 0;
    for (int frame = 0; frame < frames; ++frame) {
        session.push(monkey.next(workspace));
        session.frame(kWidth, kHeight, 1.0f, 1.0 / 60.0,
                      [&] { (void)workspace.draw(model, around); });
        if (!session.failure().empty()) {
            ++failures;
            std::printf("frame %d: %s\n", frame, session.failure().c_str());
            ASSERT_NE(lastFailure, frame - 1) << "an assertion costs a frame, not two";
            lastFailure = frame;
        }
        const ViewState& view = workspace.view();
        ASSERT_TRUE(std::isfinite(view.hour) && view.hour >= 0.0 && view.hour < 24.0) << frame;
        ASSERT_LE(std::abs(view.exposure), 20.0) << frame;
        edits += model.revisions().document != lastRevision ? 1 : 0;
        lastRevision = model.revisions().document;
        if (frame % 100 == 99) {
            expectSound(model, frame);
            if (HasFatalFailure()) {
                return;
            }
        }
        if (frame % 5000 == 4999 || model.document().lights.size() > 12) {
            while (model.undo()) {
            }
            EXPECT_EQ(document::writeDocument(model.document()),
                      document::writeDocument(begun().document()))
                << "undo does not lead back at frame " << frame;
            model = begun();
            lastRevision = 0;
        }
        if (frame % 1000000 == 999999) {
            std::printf("%d million frames, %d edits\n", (frame + 1) / 1000000, edits);
            std::fflush(stdout);
        }
    }
    std::printf("%d frames changed the document, %d assertions of Dear ImGui's\n", edits, failures);
    EXPECT_GT(edits, frames / 200) << "the monkey did nothing";
}

TEST(Assertions, OneInAFrameCostsTheFrameAndNotTheDocument) {
    model::Model model = begun();
    const Surroundings around = spheres();
    Workspace workspace;
    Session session(Session::Drawing::None);
    const auto draw = [&] { (void)workspace.draw(model, around); };
    session.frame(kWidth, kHeight, 1.0f, 0.01, draw);
    ASSERT_EQ(session.failure(), "");
    session.frame(kWidth, kHeight, 1.0f, 0.01, [&] {
        draw();
        ASSERT_TRUE(model.execute(model::ReverseStops{model.ids().lights[0].keys[0].id}).ok());
        ImGui::End(); // of nothing that was begun
    });
    EXPECT_NE(session.failure().find("imgui"), std::string::npos) << session.failure();
    EXPECT_EQ(model.undoCount(), 1u) << "what was done stays done";
    session.frame(kWidth, kHeight, 1.0f, 0.01, draw);
    EXPECT_EQ(session.failure(), "");
    EXPECT_TRUE(workspace.marks().count("ramp") > 0);
}

TEST(Session, EscapeIsTakenWhileAMenuGivesWayToAnother) {
    // Dear ImGui 1.86 alone reads through null in one of these frames.
    for (int frames = 0; frames < 6; ++frames) {
        model::Model model = begun();
        const Surroundings around = spheres();
        Workspace workspace;
        Session session(Session::Drawing::None);
        const auto frame = [&] {
            session.frame(kWidth, kHeight, 1.0f, 1.0 / 60.0,
                          [&] { (void)workspace.draw(model, around); });
            EXPECT_EQ(session.failure(), "");
        };
        const auto to = [&](const char* mark) {
            const ImVec2 place = workspace.marks().at(mark).center();
            session.push(MotionInput{place.x, place.y});
        };
        frame();
        to("menu File");
        frame();
        session.push(ButtonInput{0, true});
        session.push(ButtonInput{0, false});
        frame();
        frame();
        frame();
        ASSERT_TRUE(workspace.marks().contains("Save lighting"));
        to("menu Edit");
        for (int i = 0; i < frames; ++i) {
            frame();
        }
        session.push(KeyInput{Key::Escape, true, false, false, false});
        frame();
        session.push(KeyInput{Key::Escape, false, false, false, false});
        frame();
        frame();
        EXPECT_FALSE(workspace.marks().contains("Save lighting")) << frames;
    }
}

TEST(Input, WhatOneFrameCannotTellApartTakesTwo) {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    InputQueue queue;
    queue.push(MotionInput{10.0f, 20.0f});
    queue.push(ButtonInput{0, true});
    queue.push(ButtonInput{0, false});
    queue.feed(io);
    EXPECT_EQ(io.MousePos.x, 10.0f);
    EXPECT_TRUE(io.MouseDown[0]);
    EXPECT_FALSE(queue.empty());
    queue.feed(io);
    EXPECT_FALSE(io.MouseDown[0]);
    EXPECT_TRUE(queue.empty());
    queue.push(ButtonInput{0, true});
    queue.push(MotionInput{30.0f, 20.0f}); // the press was at 10
    queue.feed(io);
    EXPECT_EQ(io.MousePos.x, 10.0f);
    queue.push(KeyInput{Key::S, true, false, true, false});
    queue.push(KeyInput{Key::S, false, false, true, false});
    queue.feed(io);
    EXPECT_EQ(io.MousePos.x, 30.0f);
    EXPECT_TRUE(io.KeysDown[static_cast<int>(Key::S)]);
    EXPECT_TRUE(io.KeyCtrl);
    queue.push(FocusLostInput{});
    queue.feed(io);
    queue.feed(io);
    EXPECT_FALSE(io.KeysDown[static_cast<int>(Key::S)]);
    EXPECT_FALSE(io.MouseDown[0]);
    ImGui::DestroyContext();
}

TEST(Strip, PlacesAndDegreesGoBothWays) {
    for (const auto kind : {lighting::LightKind::Sky, lighting::LightKind::Sun}) {
        for (int i = 0; i <= 100; ++i) {
            const double place = i / 100.0;
            EXPECT_NEAR(placeOf(atOf(place, kind), kind), place, 1e-12);
        }
    }
    EXPECT_DOUBLE_EQ(placeOf(90.0, lighting::LightKind::Sky), 0.0);
    EXPECT_DOUBLE_EQ(placeOf(0.0, lighting::LightKind::Sky), 0.5);
    EXPECT_DOUBLE_EQ(atOf(-3.0, lighting::LightKind::Sun), 0.0);
    EXPECT_DOUBLE_EQ(atOf(1.0, lighting::LightKind::Sun), 180.0);
}

} // namespace
} // namespace lodestar::ui

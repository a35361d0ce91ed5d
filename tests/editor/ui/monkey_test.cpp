// SPDX-License-Identifier: MIT
//
// Panels without a picture: random input into all of them, and what an assertion of Dear ImGui's
// leaves behind. The seed is printed; LODESTAR_MONKEY_SEED sets another, LODESTAR_MONKEY_FRAMES how
// long it goes on (tests/run.sh --long: ten million frames).
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>
#include <imgui.h>

#include "monkey_world.h"

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

std::uint64_t numberOf(const char* variable, std::uint64_t otherwise) {
    const char* text = std::getenv(variable);
    return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

/// Resident memory, KiB.
long residentKiB() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with("VmRSS:")) {
            return std::strtol(line.c_str() + 6, nullptr, 10);
        }
    }
    return 0;
}

/// What may not happen to a document, however it is edited.
void expectSound(const model::Model& model) {
    core::Tally warnings;
    const std::string text = document::writeDocument(model.document());
    const auto again = document::parseDocument(text, warnings);
    ASSERT_TRUE(again.ok()) << again.error().message();
    EXPECT_EQ(document::writeDocument(*again), text);
    EXPECT_TRUE(document::dayLights(model.document(), warnings).ok());
    EXPECT_EQ(warnings.counts().size(), 0u) << warnings.counts().begin()->first;
    for (const document::Light& light : model.document().lights) {
        EXPECT_FALSE(light.keys.empty());
        for (const document::Key& key : light.keys) {
            EXPECT_GE(key.gradient.stops.size(), 2u);
        }
    }
}

/// What copies of copies grow to, and frames then take long.
bool isLarge(const document::Document& document) {
    std::size_t stops = 0;
    for (const document::Light& light : document.lights) {
        for (const document::Key& key : light.keys) {
            stops += key.gradient.stops.size();
        }
    }
    return document.lights.size() > 12 || document.probes.size() > 12 || stops > 1000;
}

/// All that is wrong after a frame.
void examine(MonkeyWorld& world, int frame) {
    ASSERT_EQ(world.failure(), "") << "asserted by Dear ImGui";
    const ViewState& view = world.workspace().view();
    ASSERT_TRUE(std::isfinite(view.hour) && view.hour >= 0.0 && view.hour < 24.0);
    ASSERT_LE(std::abs(view.exposure), 20.0);
    if (frame % 100 == 99) {
        expectSound(world.model());
    }
    if (frame % 5000 == 4999 || isLarge(world.model().document())) {
        while (world.model().undo()) {
        }
        EXPECT_EQ(document::writeDocument(world.model().document()), world.start())
            << "undo does not lead back";
        world.begin();
    }
}

/// Things of each panel: what a run of the usual length presses for certain.
constexpr std::pair<const char*, std::array<const char*, 4>> kPanels[] = {
    {"menus", {"menu File", "menu Gradient", "Save lighting as...", "Reverse"}},
    {"path prompt", {"path", "OK", "path", "OK"}},
    {"question before the end", {"Save and quit", "Quit without saving", "Stay", "Stay"}},
    {"question about others", {"Read it again", "Keep mine", "Keep mine", "Keep mine"}},
    {"work", {"Cancel work", "Cancel work", "Cancel work", "Cancel work"}},
    {"scene", {"light", "material", "node", "Add sun"}},
    {"light", {"by place and date", "latitude", "azimuth", "tint"}},
    {"presets", {"preset", "preset/Overcast", "preset name", "save preset"}},
    {"gradient", {"ramp", "stop", "stop at", "Simplify"}},
    {"brush", {"Brush", "brush mode", "Snap", "Pick"}},
    {"light probe", {"probe", "probe position", "probe proxy", "update"}},
    {"gizmo", {"probe handle x", "probe handle y", "probe handle z", "viewport"}},
    {"material", {"exponent slider", "exponent", "diffuse", "estimator"}},
    {"environment",
     {"environment source", "environment rotation", "environment ev", "Remove environment"}},
    {"day", {"day", "key", "hour", "Copy here"}},
    {"report", {"tab Plan", "tab Times", "tab Log", "tab Accuracy"}},
    {"accuracy", {"accuracy plot", "tab Map rows", "row slider 0", "row 0"}},
    {"photograph", {"photograph", "way Line", "way Pixel", "Use as the lights"}},
};

/// Says what was never pressed. @param all whether every panel must have been
void expectReached(const Touched& touched, bool all) {
    std::string never;
    for (const auto& [name, presses] : touched.presses()) {
        never += presses == 0 ? "  " + name : "";
        if (std::getenv("LODESTAR_MONKEY_COUNTS") != nullptr) {
            std::printf("%6d %s\n", presses, name.c_str());
        }
    }
    std::printf("never pressed of %zu:%s\n", touched.presses().size(), never.c_str());
    for (const auto& [panel, things] : kPanels) {
        for (const char* thing : things) {
            EXPECT_TRUE(!all || touched.presses(thing) > 0) << panel << ": " << thing;
        }
    }
}

TEST(Monkey, RandomInputLeavesASoundDocument) {
    constexpr int kUsual = 200000;
    const int frames = static_cast<int>(numberOf("LODESTAR_MONKEY_FRAMES", kUsual));
    const std::uint64_t seed = numberOf("LODESTAR_MONKEY_SEED", 1);
    Monkey monkey(seed);
    MonkeyWorld world;
    std::uint64_t lastRevision = 0;
    int edits = 0;
    long settledKiB = 0;
    for (int frame = 0; frame < frames; ++frame) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", frame " + std::to_string(frame));
        world.frame(monkey);
        edits += world.model().revisions().document != lastRevision ? 1 : 0;
        examine(world, frame);
        if (HasFailure()) {
            return; // it can be had again by the seed
        }
        lastRevision = world.model().revisions().document;
        if (frame == frames / 10) {
            settledKiB = residentKiB();
        }
        if (frame % 1000000 == 999999) {
            std::printf("%d million frames, %d edits, %ld KiB, %zu KiB of it undo's %zu steps\n",
                        (frame + 1) / 1000000, edits, residentKiB(),
                        world.model().historyBytes() / 1024,
                        world.model().undoCount() + world.model().redoCount());
            std::fflush(stdout);
        }
    }
    std::printf("seed %llu: %d frames, %d changed the document; %ld KiB after a tenth, %ld KiB\n",
                static_cast<unsigned long long>(seed), frames, edits, settledKiB, residentKiB());
    EXPECT_GT(edits, frames / 200) << "the monkey did nothing";
    expectReached(world.touched(), frames >= kUsual);
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

/// The panels over a document, frame by frame.
struct Desk {
    model::Model model = begun();
    const Surroundings around = spheres();
    Workspace workspace;
    Session session{Session::Drawing::None};
    void frame() {
        session.frame(kWidth, kHeight, 1.0f, 1.0 / 60.0,
                      [&] { (void)workspace.draw(model, around); });
        EXPECT_EQ(session.failure(), "");
    }
};

TEST(Session, EscapeIsTakenWhileAMenuGivesWayToAnother) {
    // Dear ImGui 1.86 alone reads through null in one of these frames.
    for (int frames = 0; frames < 6; ++frames) {
        Desk desk;
        const auto to = [&](const char* mark) {
            const ImVec2 place = desk.workspace.marks().at(mark).center();
            desk.session.push(MotionInput{place.x, place.y});
        };
        desk.frame();
        to("menu File");
        desk.frame();
        desk.session.push(ButtonInput{0, true});
        desk.session.push(ButtonInput{0, false});
        desk.frame();
        desk.frame();
        desk.frame();
        ASSERT_TRUE(desk.workspace.marks().contains("Save lighting"));
        to("menu Edit");
        for (int i = 0; i < frames; ++i) {
            desk.frame();
        }
        desk.session.push(KeyInput{Key::Escape, true, false, false, false});
        desk.frame();
        desk.session.push(KeyInput{Key::Escape, false, false, false, false});
        desk.frame();
        desk.frame();
        EXPECT_FALSE(desk.workspace.marks().contains("Save lighting")) << frames;
    }
}

TEST(Session, AWindowAppearsInTheFrameOfAQuestion) {
    // Dear ImGui 1.86 asserts where one does behind the question.
    for (int frames = 0; frames < 24; ++frames) {
        SCOPED_TRACE(frames);
        Desk desk;
        desk.frame();
        desk.frame();
        // The list of windows appears when these have been held for a while.
        desk.session.push(KeyInput{Key::Control, true, false, true, false});
        desk.session.push(KeyInput{Key::Tab, true, false, true, false});
        for (int i = 0; i < frames; ++i) {
            desk.frame();
        }
        desk.workspace.view().help = true;
        desk.workspace.askBeforeQuit();
        desk.frame();
        desk.frame();
        EXPECT_TRUE(desk.workspace.marks().contains("Stay"));
    }
}

TEST(Session, UndoOfATextThatWasLeftIsNotTheNextTexts) {
    // Dear ImGui 1.86 takes the steps up again with the field, and writes before its text.
    Desk desk;
    const auto stroke = [&](Key key, bool control) {
        desk.session.push(KeyInput{key, true, false, control, false});
        desk.frame();
        desk.session.push(KeyInput{key, false, false, control, false});
        desk.session.push(KeyInput{Key::Control, false, false, false, false});
        desk.frame();
    };
    const auto enter = [&] {
        const ImVec2 place = desk.workspace.marks().at("environment source").center();
        desk.session.push(MotionInput{place.x, place.y});
        desk.frame();
        desk.session.push(ButtonInput{0, true});
        desk.frame();
        desk.session.push(ButtonInput{0, false});
        desk.frame();
    };
    desk.frame();
    desk.frame();
    enter();
    for (int i = 0; i < 12; ++i) {
        desk.session.push(TextInput{U'x'});
        desk.frame();
    }
    const ImGuiInputTextState& text = ImGui::GetCurrentContext()->InputTextState;
    EXPECT_EQ(text.CurLenW, 12);
    stroke(Key::Escape, false);
    enter();
    ASSERT_NE(ImGui::GetActiveID(), 0u);
    EXPECT_EQ(text.CurLenW, 0);
    for (int i = 0; i < 12; ++i) {
        stroke(Key::Z, true);
        EXPECT_EQ(text.CurLenW, 0) << "letters of nothing were taken away";
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

TEST(Input, AModifierLetGoInTheFrameOfItsKeyStillHoldsForIt) {
    for (const Input& held :
         {Input(KeyInput{Key::S, true, false, true, false}), Input(ButtonInput{0, true})}) {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        InputQueue queue;
        queue.push(KeyInput{Key::Control, true, false, false, false});
        queue.feed(io);
        queue.push(held);
        queue.push(KeyInput{Key::Control, false, false, true, false});
        queue.feed(io);
        EXPECT_TRUE(io.KeyCtrl);
        EXPECT_TRUE(io.KeysDown[static_cast<int>(Key::S)] || io.MouseDown[0]);
        queue.feed(io);
        EXPECT_FALSE(io.KeyCtrl);
        EXPECT_TRUE(queue.empty());
        ImGui::DestroyContext();
    }
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

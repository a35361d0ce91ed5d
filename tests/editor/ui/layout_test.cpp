// SPDX-License-Identifier: MIT
//
// Nothing that the editor shows is cut off or written over: in every panel, on displays from 1024 x
// 640 pixels on, of two densities. What is looked at are the letters that a frame draws.
#include <algorithm>
#include <fstream>
#include <map>

#include <imgui_internal.h>

#include "editor/ui/editor_fixture.h"
#include "io/image_file.h"

namespace lodestar::testing {
namespace {

using platform::Key;

struct Rect {
    float left = 0.0f, top = 0.0f, right = 0.0f, bottom = 0.0f;
    [[nodiscard]] float width() const { return right - left; }
    [[nodiscard]] float height() const { return bottom - top; }
};

Rect crossing(const Rect& a, const Rect& b) {
    return {std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right),
            std::min(a.bottom, b.bottom)};
}

/// A letter as it was drawn.
struct Letter {
    char32_t code = 0;
    Rect place, clip;
    bool whole = true; ///< false: Dear ImGui cut it at its item's edge
};

/// The letters of a window, in the order that they were drawn in.
std::vector<Letter> lettersOf(const ImDrawList& list) {
    const ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    std::vector<Letter> letters;
    for (const ImDrawCmd& command : list.CmdBuffer) {
        if (command.TextureId != atlas.TexID) {
            continue;
        }
        for (unsigned i = 0; i + 5 < command.ElemCount; ++i) {
            const ImDrawIdx* const index = list.IdxBuffer.Data + command.IdxOffset + i;
            if (index[1] != index[0] + 1 || index[2] != index[0] + 2 || index[3] != index[0] ||
                index[4] != index[2] || index[5] != index[0] + 3) {
                continue; // no rectangle
            }
            const ImDrawVert* const v = list.VtxBuffer.Data + command.VtxOffset + index[0];
            const ImVec2 low = v[0].uv;
            const ImVec2 high = v[2].uv;
            for (const ImFontGlyph& glyph : atlas.Fonts[0]->Glyphs) {
                constexpr float kRounding = 1e-5f; // a hundredth of a texel
                const bool within = glyph.Visible && low.x < high.x && low.y < high.y &&
                                    low.x >= glyph.U0 - kRounding &&
                                    high.x <= glyph.U1 + kRounding &&
                                    low.y >= glyph.V0 - kRounding && high.y <= glyph.V1 + kRounding;
                if (within) {
                    letters.push_back({glyph.Codepoint,
                                       {v[0].pos.x, v[0].pos.y, v[2].pos.x, v[2].pos.y},
                                       {command.ClipRect.x, command.ClipRect.y, command.ClipRect.z,
                                        command.ClipRect.w},
                                       high.x - low.x >= glyph.U1 - glyph.U0 - kRounding &&
                                           high.y - low.y >= glyph.V1 - glyph.V0 - kRounding});
                    i += 5;
                    break;
                }
            }
        }
    }
    return letters;
}

/// Some of the text about a letter.
std::string around(const std::vector<Letter>& letters, std::size_t at) {
    std::string text;
    for (std::size_t i = at < 12 ? 0 : at - 12; i < std::min(at + 12, letters.size()); ++i) {
        text += letters[i].code < 127 ? static_cast<char>(letters[i].code) : '?';
    }
    return text;
}

class LayoutTest : public EditorTest {
protected:
    struct Display {
        const char* name;
        int width, height;
        float scale;
    };
    static constexpr Display kDisplays[] = {{"1024x640", 1024, 640, 1.0f},
                                            {"1280x800", 1280, 800, 1.0f},
                                            {"1920x1080", 1920, 1080, 1.0f},
                                            {"2048x1280@2", 2048, 1280, 2.0f},
                                            {"2560x1600@2", 2560, 1600, 2.0f}};

    /// Reports what is cut or written over in the last frame.
    void look(const std::string& state) {
        SCOPED_TRACE(state);
        keep("layout-" + state);
        const ImDrawData* const drawn = ImGui::GetDrawData();
        ASSERT_NE(drawn, nullptr);
        for (int i = 0; i < drawn->CmdListsCount; ++i) {
            lookAt(*drawn->CmdLists[i]);
        }
        for (const auto& [name, mark] : editor_->workspace().marks()) {
            lookAt(name, mark);
        }
    }

private:
    void lookAt(const ImDrawList& list) {
        const std::vector<Letter> letters = lettersOf(list);
        const ImGuiWindow* const window = ImGui::FindWindowByName(list._OwnerName);
        const bool scrolls = window != nullptr && window->ScrollMax.y > 0.0f;
        for (std::size_t i = 0; i < letters.size(); ++i) {
            const Letter& letter = letters[i];
            const Rect seen = crossing(letter.place, letter.clip);
            const bool above = seen.height() <= 0.0f; // scrolled away
            if (above) {
                continue;
            }
            EXPECT_TRUE(letter.whole || scrolls)
                << "cut at its item's edge: '" << around(letters, i) << "' in " << list._OwnerName;
            // A pixel of a letter's rim is the filter's.
            EXPECT_GE(seen.width(), letter.place.width() - 1.0f)
                << "cut at the window's edge: '" << around(letters, i) << "' in "
                << list._OwnerName;
            EXPECT_TRUE(scrolls || seen.height() >= letter.place.height() - 1.0f)
                << "cut at the window's edge: '" << around(letters, i) << "' in "
                << list._OwnerName;
        }
        lookForOverlap(letters, list._OwnerName);
    }

    /// Letters of one line stand beside each other; where one covers a third of another it is
    /// written over it.
    static void lookForOverlap(const std::vector<Letter>& letters, const char* owner) {
        int told = 0;
        for (std::size_t i = 0; i < letters.size(); ++i) {
            for (std::size_t j = i + 1; j < letters.size() && told < 4; ++j) {
                const Rect both = crossing(crossing(letters[i].place, letters[i].clip),
                                           crossing(letters[j].place, letters[j].clip));
                if (both.width() <= 0.0f || both.height() <= 0.0f) {
                    continue;
                }
                const Rect& a = letters[i].place;
                const Rect& b = letters[j].place;
                const float smaller = std::min(a.width() * a.height(), b.width() * b.height());
                if (both.width() * both.height() > smaller / 3.0f) {
                    ADD_FAILURE() << "written over each other: '" << around(letters, i) << "' and '"
                                  << around(letters, j) << "' in " << owner;
                    ++told;
                }
            }
        }
    }

    static void lookAt(const std::string& name, const ui::Mark& mark) {
        if (name.rfind("menu ", 0) == 0 || name.rfind("stop ", 0) == 0 ||
            name.rfind("key ", 0) == 0) {
            return; // handles stand half out of their strip's ends; a menu's name is in the bar
        }
        EXPECT_GE(mark.low.x, mark.clipLow.x - 0.5f) << name;
        EXPECT_LE(mark.high.x, mark.clipHigh.x + 0.5f) << name;
        if (!mark.scrolls) {
            EXPECT_GE(mark.low.y, mark.clipLow.y - 0.5f) << name;
            EXPECT_LE(mark.high.y, mark.clipHigh.y + 0.5f) << name;
        }
        EXPECT_GT(mark.high.x, mark.low.x) << name;
        EXPECT_GT(mark.high.y, mark.low.y) << name;
    }
};

TEST_F(LayoutTest, NothingIsCutAtTheStart) {
    for (const Display& display : kDisplays) {
        resize(display.width, display.height, display.scale);
        look(std::string("start-") + display.name);
    }
}

TEST_F(LayoutTest, NothingIsCutInThePanelsOfWhatIsChosen) {
    click(mark("light 1").center()); // the sun
    click(mark("key 1").center());
    click(mark("material 3").center());
    click(onRamp(0.3f));
    click(mark("Add probe").center());
    for (const Display& display : kDisplays) {
        resize(display.width, display.height, display.scale);
        look(std::string("chosen-") + display.name);
        // What the window of the properties has below.
        const ui::Mark ramp = mark("ramp");
        moveTo({ramp.high.x - 2.0f, ramp.low.y - 4.0f});
        for (int page = 0; page < 4; ++page) {
            send(platform::WheelEvent{-4.0});
            settle();
            look(std::string("chosen-") + display.name + "-page" + std::to_string(page));
        }
        send(platform::WheelEvent{50.0});
        settle();
    }
}

TEST_F(LayoutTest, NothingIsCutInTheTabsOfTheReport) {
    click(mark("material 3").center());
    for (const Display& display : kDisplays) {
        resize(display.width, display.height, display.scale);
        for (const char* tab : {"Plan", "Times", "Accuracy", "Log"}) {
            click(mark(std::string("tab ") + tab).center());
            look(std::string(tab) + "-" + display.name);
        }
    }
}

TEST_F(LayoutTest, NothingIsCutInMenusHelpAndQuestions) {
    for (const Display& display : kDisplays) {
        resize(display.width, display.height, display.scale);
        for (const char* menu : {"File", "Edit", "Gradient", "View", "Help"}) {
            click(mark(std::string("menu ") + menu).center());
            look(std::string("menu-") + menu + "-" + display.name);
            press(Key::Escape);
        }
        press(Key::F1);
        look(std::string("help-") + display.name);
        press(Key::F1);
        control(Key::O);
        look(std::string("question-") + display.name);
        press(Key::Escape);
        click(onRamp(0.3f));
        click(mark("Brush").center());
        look(std::string("brush-") + display.name);
        click(mark("Brush").center());
        control(Key::Q);
        look(std::string("quit-") + display.name);
        press(Key::Escape);
    }
}

TEST_F(LayoutTest, LongNamesEndInDotsAndNumbersStayReadable) {
    document::Document changed = model().document();
    changed.lights[0].name = "the sky over the northern terrace in the late afternoon";
    changed.lights[0].keys[0].tint = glm::dvec3(1.23456e-5, 123456789.0, 0.000123456);
    ASSERT_TRUE(model().execute(model::ReplaceDocument{changed}).ok());
    click(mark("Add probe").center());
    lighting::Probe probe = model().document().probes[0].probe;
    probe.name = "a probe that somebody gave a name of many words to";
    probe.position = {-123456.5, 0.000123456, 98765.4321};
    ASSERT_TRUE(model().execute(model::SetProbe{model().ids().probes[0], probe}).ok());
    for (int i = 0; i < 3; ++i) {
        editor_->workspace().say("a sentence that a long path of a file is in: "
                                 "/home/somebody/projects/terrace/scenes/evening/final/terrace.glb",
                                 true);
    }
    click(mark("key 0").center());
    for (const Display& display : kDisplays) {
        resize(display.width, display.height, display.scale);
        click(mark("tab Log").center());
        look(std::string("long-") + display.name);
    }
}

} // namespace
} // namespace lodestar::testing

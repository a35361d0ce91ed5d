// SPDX-License-Identifier: MIT
#include "ui/workspace.h"

#include <algorithm>
#include <cmath>

#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include "lighting/day.h"
#include "model/command_text.h"
#include "model/ramp.h"
#include "ui/actions.h"
#include "ui/fields.h"
#include "ui/theme.h"

namespace lodestar::ui {
namespace {

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus;

/// A panel that has its place. @return as ImGui::Begin
bool beginPanel(const char* name, float left, float top, float right, float bottom,
                ImGuiWindowFlags more = 0) {
    ImGui::SetNextWindowPos({std::floor(left), std::floor(top)});
    ImGui::SetNextWindowSize({std::max(std::floor(right) - std::floor(left), 1.0f),
                              std::max(std::floor(bottom) - std::floor(top), 1.0f)});
    return ImGui::Begin(name, nullptr, (kFixed & ~ImGuiWindowFlags_NoScrollbar) | more);
}

} // namespace

void Panels::scene() const {
    drawScenePanel(studio_);
}

void Panels::light() const {
    drawLightPanel(studio_);
    workspace_.gradient_.draw(studio_, studio_.chosenKey());
}

void Panels::probes() const {
    drawProbePanel(studio_);
}

void Panels::materials() const {
    drawMaterialPanel(studio_);
}

void Panels::environment() const {
    drawEnvironmentPanel(studio_);
}

void Panels::day() const {
    workspace_.day_.draw(studio_);
}

void Panels::report() const {
    drawReportPanel(studio_);
}

void Panels::viewport() const {
    drawViewport(studio_, workspace_.gizmo_);
}

void Panels::answerKeys() const {
    workspace_.answerKeys(studio_);
}

Wishes Workspace::draw(model::Model& model, const Surroundings& surroundings) {
    return draw(model, surroundings, [this](const Panels& panels) {
        panels.answerKeys();
        drawMenus(panels.studio_);
        drawPanels(panels.studio_, ImGui::GetFrameHeight());
    });
}

Wishes Workspace::draw(model::Model& model, const Surroundings& surroundings,
                       const std::function<void(const Panels&)>& contents) {
    Studio studio(model, surroundings, view_);
    studio.log = std::move(log_);
    answerCancel(studio);
    if (!ImGui::IsAnyItemActive()) {
        token_ = 0; // whatever was held has been let go
    }
    studio.token_ = token_;
    studio.holder_ = holder_;
    const auto keep = [&] {
        log_ = std::move(studio.log);
        marks_ = std::move(studio.marks);
        token_ = studio.token_;
        holder_ = studio.holder_;
    };
    try {
        forgetLeftText();
        contents(Panels(*this, studio));
        photograph_.draw(studio);
        drawWork(studio);
        drawHelp(studio);
        // Questions last: beside one that appears no window may, in Dear ImGui 1.86.
        drawPrompts(studio);
        drawQuestion(studio);
        drawOutside(studio, asksOutside_);
        asksOutside_ = false;
    } catch (...) { // an assertion of Dear ImGui's: what was said stays said
        keep();
        throw;
    }
    keep();
    return studio.wishes;
}

/// Escape takes back what is dragged. Dear ImGui has let go of it already, but for a text, which
/// answers to Escape by itself.
void Workspace::answerCancel(Studio& studio) const {
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    const bool held =
        context.ActiveIdPreviousFrame == holder_ && context.InputTextState.ID != holder_;
    if (token_ == 0 || !held || !studio.pressed(Key::Escape)) {
        return;
    }
    studio.cancelled = true;
    (void)studio.model.cancel(token_);
    if (context.ActiveId == holder_) { // a host without keyboard navigation
        ImGui::ClearActiveID();
    }
}

void Workspace::say(std::string text, bool isError) {
    log_.push_back({std::move(text), isError});
}

void Workspace::givePicked(model::Model& model, const glm::dvec3& radiance) {
    if (view_.brush) {
        view_.brushSettings.color = radiance;
        return;
    }
    const std::vector<model::Id>& stops = model.selection().stops;
    if (stops.empty()) {
        say("no stop is selected to get the radiance", true);
        return;
    }
    const lighting::GradientStop picked = model::stopOf(0.0, radiance);
    if (auto given = model.execute(model::SetStops{stops, {}, picked.color, picked.ev}); !given) {
        say(given.error().message(), true);
    }
}

namespace {

/// Right of the menus: what was said last, and the document.
void drawStatus(Studio& studio) {
    const float em = ImGui::GetFontSize();
    const float width = ImGui::GetWindowWidth();
    const std::string title =
        elided(studio.around.documentName + (studio.model.dirty() ? " *" : ""), 0.3f * width);
    const float right = width - ImGui::CalcTextSize(title.c_str()).x - em;
    const float left = ImGui::GetCursorPosX() + em;
    if (!studio.log.empty() && right - left > 4.0f * em) {
        ImGui::SameLine(left);
        elidedText(studio.log.back().isError ? kWarning : kDimText, studio.log.back().text,
                   right - left - 2.0f * em);
        studio.mark("said last");
    }
    ImGui::SameLine(right);
    ImGui::TextColored(kDimText, "%s", title.c_str());
}

} // namespace

void Workspace::drawMenus(Studio& studio) {
    if (!ImGui::BeginMainMenuBar()) {
        return;
    }
    constexpr std::pair<Menu, const char*> kMenus[] = {{Menu::File, "File"},
                                                       {Menu::Edit, "Edit"},
                                                       {Menu::Gradient, "Gradient"},
                                                       {Menu::View, "View"},
                                                       {Menu::Help, "Help"}};
    for (const auto& [menu, name] : kMenus) {
        const bool open = ImGui::BeginMenu(name);
        studio.mark(std::string("menu ") + name);
        if (!open) {
            continue;
        }
        for (const Binding& binding : bindings()) {
            if (binding.menu != menu) {
                continue;
            }
            std::string label = binding.label;
            if (binding.action == Action::Undo || binding.action == Action::Redo) {
                const std::string_view step = binding.action == Action::Undo
                                                  ? studio.model.undoName()
                                                  : studio.model.redoName();
                label += step.empty() ? "" : " " + std::string(step);
                label += binding.action == Action::Undo ? "##undo" : "##redo";
            }
            const bool idle = (binding.action == Action::Undo && studio.model.undoCount() == 0) ||
                              (binding.action == Action::Redo && studio.model.redoCount() == 0);
            if (ImGui::MenuItem(label.c_str(), shortcutText(binding).c_str(), false, !idle)) {
                perform(studio, binding);
            }
            studio.mark(binding.label);
        }
        ImGui::EndMenu();
    }
    drawStatus(studio);
    ImGui::EndMainMenuBar();
}

void Workspace::drawPanels(Studio& studio, float top) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float em = ImGui::GetFontSize();
    const float left = std::min(16.0f * em, 0.25f * size.x);
    const float right = size.x - std::min(25.0f * em, 0.4f * size.x);
    const float report = size.y - std::min(11.0f * em, 0.25f * size.y);
    const float day = report - std::min(9.5f * em, 0.25f * size.y);
    beginPanel("Scene", 0.0f, top, left, size.y);
    drawScenePanel(studio);
    ImGui::End();
    // Its scrollbar always has its place: what comes and goes below moves no strip under a pointer.
    beginPanel("Properties", right, top, size.x, size.y, ImGuiWindowFlags_AlwaysVerticalScrollbar);
    drawLightPanel(studio);
    gradient_.draw(studio, studio.chosenKey());
    drawProbePanel(studio);
    drawMaterialPanel(studio);
    drawEnvironmentPanel(studio);
    ImGui::End();
    beginPanel("Day", left, day, right, report, ImGuiWindowFlags_NoScrollbar);
    day_.draw(studio);
    ImGui::End();
    beginPanel("Report", left, report, right, size.y, ImGuiWindowFlags_NoScrollbar);
    drawReportPanel(studio);
    ImGui::End();
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0f, 0.0f});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0.0f);
    beginPanel("Viewport", left, top, right, day,
               ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoNav |
                   ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PopStyleVar(2); // tooltips have room about their text
    drawViewport(studio, gizmo_);
    ImGui::End();
}

void Workspace::drawPrompts(Studio& studio) {
    if (prompt_ == Prompt::None) {
        return;
    }
    const char* titles[] = {"",
                            "Open scene (.gltf, .glb)",
                            "Open lighting (.lodestar.json)",
                            "Open photograph (.hdr .exr .png .jpg)",
                            "Save lighting as",
                            "Save the steps since it was opened (.jsonl)"};
    const char* title = titles[static_cast<int>(prompt_)];
    if (promptOpens_) {
        ImGui::OpenPopup(title);
        promptOpens_ = false;
    }
    if (!beginQuestion(title)) {
        prompt_ = Prompt::None;
        return;
    }
    ImGui::SetNextItemWidth(32.0f * ImGui::GetFontSize());
    if (ImGui::IsWindowAppearing()) {
        ImGui::SetKeyboardFocusHere();
    }
    bool done =
        ImGui::InputTextWithHint("##path", "path", &path_, ImGuiInputTextFlags_EnterReturnsTrue);
    studio.mark("path");
    done = ImGui::Button("OK") || done;
    studio.mark("OK");
    ImGui::SameLine();
    const bool cancelled = ImGui::Button("Cancel") || studio.pressed(Key::Escape);
    if (done && !path_.empty()) {
        auto& wish = prompt_ == Prompt::SaveAs           ? studio.wishes.saveAs
                     : prompt_ == Prompt::SaveCommands   ? studio.wishes.saveCommands
                     : prompt_ == Prompt::OpenPhotograph ? studio.wishes.openPhotograph
                     : prompt_ == Prompt::OpenScene      ? studio.wishes.openScene
                                                         : studio.wishes.openLighting;
        wish = path_;
    }
    if (done || cancelled) {
        ImGui::CloseCurrentPopup();
        prompt_ = Prompt::None;
    }
    ImGui::EndPopup();
}

void Workspace::drawQuestion(Studio& studio) {
    constexpr const char* kTitle = "The lighting has unsaved changes";
    if (asksQuit_ && !ImGui::IsPopupOpen(kTitle)) {
        ImGui::OpenPopup(kTitle);
    }
    asksQuit_ = false;
    if (!beginQuestion(kTitle)) {
        return;
    }
    const bool save = ImGui::Button("Save and quit");
    studio.mark("Save and quit");
    ImGui::SameLine();
    const bool discard = ImGui::Button("Quit without saving");
    studio.mark("Quit without saving");
    ImGui::SameLine();
    const bool stay = ImGui::Button("Stay") || studio.pressed(Key::Escape);
    studio.mark("Stay");
    studio.wishes.save = studio.wishes.save || save;
    studio.wishes.quit = save || discard;
    if (save || discard || stay) {
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

void Workspace::drawHelp(const Studio& studio) {
    if (!view_.help) {
        return;
    }
    ImGui::SetNextWindowPos(
        {0.5f * ImGui::GetIO().DisplaySize.x, 0.5f * ImGui::GetIO().DisplaySize.y},
        ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::Begin("Keys", &view_.help,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove);
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
        const auto row = [](const std::string& keys, const char* does) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextColored(kAccent, "%s", keys.c_str());
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(does);
        };
        for (const Binding& binding : bindings()) {
            row(shortcutText(binding), binding.label);
        }
        row("click, Ctrl + click", "on the picture: select a material, or one more");
        row("left drag", "orbit; on the strip: add or move stops, off it: delete them");
        row("middle drag, Shift + left drag", "pan");
        row("right drag, with W A S D Q E", "look around and fly; Shift is faster");
        row("wheel", "nearer, farther");
        row("Esc", "in a drag: cancel it");
        row("Tab, arrows, Space", "reach every field of a panel without the pointer");
        row("Ctrl + Tab", "go to another panel");
        row("left, right on a strip", "move what is chosen; Shift is faster");
        row("Ctrl + left, right", "on the day: choose another key");
        row("Ctrl + click, Enter", "type a number");
        ImGui::EndTable();
    }
    if (studio.pressed(Key::Escape)) {
        view_.help = false;
    }
    ImGui::End();
}

void Workspace::answerKeys(Studio& studio) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool modal = ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId);
    if (io.WantTextInput || modal || io.KeyAlt || io.MouseDown[1]) {
        return;
    }
    for (const Binding& binding : bindings()) {
        const bool plus = binding.key == Key::Plus; // on a US keyboard it is a shifted key
        if (binding.control == io.KeyCtrl && (binding.shift == io.KeyShift || plus) &&
            studio.pressed(binding.key, binding.repeats)) {
            perform(studio, binding);
        }
    }
}

void Workspace::perform(Studio& studio, const Binding& binding) {
    constexpr double kHourStep = 0.25;
    constexpr double kExposureStep = 0.25;
    const auto ask = [&](Prompt prompt) {
        prompt_ = prompt;
        promptOpens_ = true;
        path_.clear();
    };
    if (performOnGradient(studio, binding)) {
        return;
    }
    switch (binding.action) {
    case Action::Open:
        return ask(Prompt::OpenScene);
    case Action::OpenLighting:
        return ask(Prompt::OpenLighting);
    case Action::OpenPhotograph:
        return ask(Prompt::OpenPhotograph);
    case Action::SaveAs:
        return ask(Prompt::SaveAs);
    case Action::SaveCommands:
        return ask(Prompt::SaveCommands);
    case Action::CopyCommands:
        ImGui::SetClipboardText(model::writeHistory(studio.model).c_str());
        studio.say(std::to_string(studio.model.undoCount()) + " steps copied as commands");
        break;
    case Action::Save:
        studio.wishes.save = true;
        break;
    case Action::Quit:
        studio.model.dirty() ? askBeforeQuit() : void(studio.wishes.quit = true);
        break;
    case Action::Undo:
        (void)studio.model.undo();
        break;
    case Action::Redo:
        (void)studio.model.redo();
        break;
    case Action::FrameSelection:
        studio.wishes.camera.frameSelection = true;
        break;
    case Action::FrameAll:
        studio.wishes.camera.frameAll = true;
        break;
    case Action::ResetCamera:
        studio.wishes.camera.reset = true;
        break;
    case Action::Brighter:
    case Action::Darker:
        view_.exposure += binding.action == Action::Brighter ? kExposureStep : -kExposureStep;
        view_.exposure = std::clamp(view_.exposure, -20.0, 20.0);
        break;
    case Action::FalseColor:
        view_.falseColor = !view_.falseColor;
        break;
    case Action::ErrorView:
        view_.errorView = !view_.errorView;
        break;
    case Action::HourLater:
    case Action::HourEarlier:
        view_.hour = lighting::wrappedHour(
            view_.hour + (binding.action == Action::HourLater ? kHourStep : -kHourStep));
        break;
    case Action::PlayDay:
        view_.playing = !view_.playing;
        break;
    case Action::Help:
        view_.help = !view_.help;
        break;
    default:
        break;
    }
}

} // namespace lodestar::ui

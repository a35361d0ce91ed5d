// SPDX-License-Identifier: MIT
//
// What happens beside the panels: work on another thread, other programs at the document's file.
#include "ui/fields.h"
#include "ui/input.h"
#include "ui/panels.h"

namespace lodestar::ui {

void drawOutside(Studio& studio, bool asks) {
    constexpr const char* kTitle = "The lighting was changed on disk";
    if (asks && !ImGui::IsPopupOpen(kTitle)) {
        ImGui::OpenPopup(kTitle);
    }
    if (!beginQuestion(kTitle)) {
        return;
    }
    ImGui::TextUnformatted("There are unsaved changes here too. Reading it again can be undone.");
    const bool reload = ImGui::Button("Read it again");
    studio.mark("Read it again");
    ImGui::SameLine();
    const bool keep = ImGui::Button("Keep mine") || studio.pressed(Key::Escape);
    studio.mark("Keep mine");
    studio.wishes.reload = studio.wishes.reload || reload;
    studio.wishes.keepMine = studio.wishes.keepMine || keep;
    if (reload || keep) {
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

void drawWork(Studio& studio) {
    if (!studio.around.work) {
        return;
    }
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float em = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({0.5f * size.x, 0.5f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({24.0f * em, 0.0f});
    ImGui::Begin("Work", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing);
    ImGui::TextUnformatted(studio.around.work->text.c_str());
    ImGui::ProgressBar(static_cast<float>(studio.around.work->share), {-5.0f * em, 0.0f}, "");
    ImGui::SameLine();
    studio.wishes.cancelWork =
        ImGui::Button("Cancel", {-1.0f, 0.0f}) || studio.pressed(Key::Escape);
    studio.mark("Cancel work");
    ImGui::End();
}

} // namespace lodestar::ui

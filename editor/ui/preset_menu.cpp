// SPDX-License-Identifier: MIT
#include <algorithm>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "ui/fields.h"
#include "ui/panels.h"
#include "ui/theme.h"

namespace lodestar::ui {
namespace {

/// A preset of the user's: its name chooses it, two clicks on the button at its right delete it.
void drawOwn(Studio& studio, const model::Preset& preset) {
    ImGui::PushID(preset.name.c_str());
    const bool leaves = studio.view.presetLeaves == preset.name;
    const char* const text = leaves ? "delete it?" : "delete";
    const float room =
        ImGui::CalcTextSize("delete it?").x + 2.0f * ImGui::GetStyle().FramePadding.x;
    const float width = std::max(ImGui::GetContentRegionAvail().x - room, ImGui::GetFontSize());
    if (ImGui::Selectable(preset.name.c_str(), false, 0, {width, 0.0f})) {
        studio.runOnce(model::SetLights{preset.lights});
    }
    studio.mark("preset/" + preset.name);
    ImGui::SameLine();
    ImGui::PushStyleColor(ImGuiCol_Text, leaves ? kWarning : kDimText);
    const bool pressed = ImGui::SmallButton(text);
    ImGui::PopStyleColor();
    studio.mark("delete preset/" + preset.name);
    if (pressed && leaves) {
        studio.wishes.removePreset = preset.name;
    }
    if (pressed) {
        studio.view.presetLeaves = leaves ? std::string() : preset.name;
    }
    ImGui::PopID();
}

/// The field and the button that keep the lights as they are now.
void drawSaving(Studio& studio) {
    std::string& name = studio.view.presetName;
    const bool known =
        std::any_of(studio.around.presets.begin(), studio.around.presets.end(),
                    [&](const model::Preset& preset) { return preset.name == name; });
    const char* const text = known ? "Replace" : "Save";
    ImGui::SetNextItemWidth(-ImGui::CalcTextSize("Replace").x - 3.0f * ImGui::GetFontSize());
    const bool entered = ImGui::InputTextWithHint("##preset name", "these lights as ...", &name,
                                                  ImGuiInputTextFlags_EnterReturnsTrue);
    studio.mark("preset name");
    ImGui::SameLine();
    const bool pressed = ImGui::Button(text);
    studio.mark("save preset");
    if (entered || pressed) {
        studio.wishes.savePreset = name;
        ImGui::CloseCurrentPopup();
    }
}

} // namespace

void drawPresets(Studio& studio) {
    label("preset");
    const bool open =
        ImGui::BeginCombo("##preset", "choose a whole sky ...", ImGuiComboFlags_HeightLarge);
    studio.mark("preset");
    if (!open) {
        return;
    }
    if (ImGui::IsWindowAppearing()) {
        studio.wishes.listPresets = true;
        studio.view.presetLeaves.clear();
    }
    for (const model::Preset& preset : model::builtInPresets()) {
        if (ImGui::Selectable(preset.name.c_str())) {
            studio.runOnce(model::SetLights{preset.lights});
        }
        studio.mark("preset/" + preset.name);
    }
    ImGui::Separator();
    ImGui::PushID("own"); // one may be called as one that is built in
    for (const model::Preset& preset : studio.around.presets) {
        drawOwn(studio, preset);
    }
    drawSaving(studio);
    ImGui::PopID();
    ImGui::EndCombo();
}

} // namespace lodestar::ui

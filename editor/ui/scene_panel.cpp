// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>

#include "model/presets.h"
#include "ui/fields.h"
#include "ui/panels.h"
#include "ui/theme.h"

namespace lodestar::ui {
namespace {

/// A name at the left of a line, cut where what stands at its right begins: a tooltip has it whole.
/// @param list that the name stands in, by number  @param wide whether the whole line is clicked,
/// and not the name alone  @return whether it was
bool nameBefore(const char* list, const std::string& name, float right, bool selected,
                bool wide = true) {
    const std::string shown =
        elided(name, ImGui::GetContentRegionAvail().x - right - 0.5f * ImGui::GetFontSize());
    const ImVec2 room(wide ? 0.0f : ImGui::CalcTextSize(shown.c_str()).x, 0.0f);
    const bool clicked = ImGui::Selectable((shown + "###" + list).c_str(), selected, 0, room);
    if (shown.size() != name.size() && ImGui::IsItemHovered()) {
        ImGui::SetTooltip("%s", name.c_str());
    }
    return clicked;
}

/// What stands at the right of a line, as wide as it is.
void textAtRight(float width, const char* text) {
    ImGui::SameLine(ImGui::GetContentRegionMax().x - width);
    ImGui::TextColored(kDimText, "%s", text);
}

/// A new light looks like the first preset's of its kind.
void addLight(Studio& studio, lighting::LightKind kind) {
    for (const model::Preset& preset : model::builtInPresets()) {
        for (const document::Light& light : preset.lights) {
            if (light.kind == kind) {
                studio.runOnce(model::AddLight{light});
                return;
            }
        }
    }
}

void drawLights(Studio& studio) {
    const model::Id chosen = studio.chosenLight();
    for (std::size_t i = 0; i < studio.model.ids().lights.size(); ++i) {
        const document::Light& light = studio.model.document().lights[i];
        const model::Id id = studio.model.ids().lights[i].id;
        const std::string name = light.name.empty() ? "light " + std::to_string(i) : light.name;
        ImGui::PushID(static_cast<int>(i));
        const char* const kind = light.kind == lighting::LightKind::Sky ? "sky" : "sun";
        const float right = ImGui::CalcTextSize("sun").x;
        if (nameBefore("light", name, right, id == chosen)) {
            model::Selection selection;
            selection.light = id;
            selection.materials = studio.model.selection().materials;
            studio.model.select(selection);
        }
        studio.mark("light " + std::to_string(i));
        textAtRight(right, kind);
        ImGui::PopID();
    }
    if (button(studio, "Add sky", "")) {
        addLight(studio, lighting::LightKind::Sky);
    }
    continueRow(buttonWidth("Add sun"));
    if (button(studio, "Add sun", "")) {
        addLight(studio, lighting::LightKind::Sun);
    }
    if (chosen != model::Id::None) {
        continueRow(buttonWidth("Remove"));
        if (button(studio, "Remove", "the light that is chosen")) {
            studio.runOnce(model::RemoveLight{chosen});
        }
    }
}

void drawMaterials(Studio& studio) {
    for (std::size_t i = 0; i < studio.around.materials.size(); ++i) {
        const MaterialLine& material = studio.around.materials[i];
        model::Selection selection = studio.model.selection();
        const auto place =
            std::find(selection.materials.begin(), selection.materials.end(), material.key);
        const bool selected = place != selection.materials.end();
        ImGui::PushID(static_cast<int>(i));
        char exponent[24];
        std::snprintf(exponent, sizeof exponent, "%.5g", material.exponent);
        const float right = ImGui::CalcTextSize(exponent).x;
        if (nameBefore("material", material.key, right, selected)) {
            if (!ImGui::GetIO().KeyCtrl) {
                selection.materials = {material.key};
            } else if (selected) {
                selection.materials.erase(place);
            } else {
                selection.materials.push_back(material.key);
            }
            studio.model.select(selection);
        }
        studio.mark("material " + std::to_string(i));
        textAtRight(right, exponent);
        ImGui::PopID();
    }
}

void drawNodes(Studio& studio) {
    const float step = ImGui::GetFontSize();
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(studio.around.nodes.size()));
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const NodeLine& node = studio.around.nodes[static_cast<std::size_t>(i)];
            ImGui::SetCursorPosX(ImGui::GetCursorPosX() +
                                 step * static_cast<float>(std::min(node.depth, 12)));
            ImGui::PushID(i);
            const float holds = ImGui::CalcTextSize(node.holds.c_str()).x;
            if (nameBefore("node", node.name, holds, studio.view.node == i, false)) {
                studio.view.node = studio.view.node == i ? -1 : i;
            }
            ImGui::PopID();
            studio.mark("node " + std::to_string(i));
            if (!node.holds.empty()) {
                ImGui::SameLine();
                ImGui::TextColored(kDimText, "%s", node.holds.c_str());
            }
        }
    }
}

void drawProbes(Studio& studio) {
    const std::vector<model::Id> ids = studio.model.ids().probes;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const lighting::Probe& probe = studio.model.document().probes[i].probe;
        model::Selection selection = studio.model.selection();
        const auto place = std::find(selection.probes.begin(), selection.probes.end(), ids[i]);
        const bool selected = place != selection.probes.end();
        ImGui::PushID(static_cast<int>(i));
        const std::string name = probe.name.empty() ? "probe " + std::to_string(i) : probe.name;
        const char* const where = probe.exterior ? "exterior" : "interior";
        const float right = ImGui::CalcTextSize(where).x;
        if (nameBefore("probe", name, right, selected)) {
            if (!ImGui::GetIO().KeyCtrl) {
                selection.probes = selected && selection.probes.size() == 1
                                       ? std::vector<model::Id>()
                                       : std::vector<model::Id>{ids[i]};
            } else if (selected) {
                selection.probes.erase(place);
            } else {
                selection.probes.push_back(ids[i]);
            }
            studio.model.select(selection);
        }
        studio.mark("probe " + std::to_string(i));
        textAtRight(right, where);
        ImGui::PopID();
    }
    if (button(studio, "Add probe", "")) {
        studio.runOnce(model::AddProbe{firstProbe(studio)});
    }
    const std::vector<model::Id> chosen = studio.model.selection().probes;
    if (!chosen.empty()) {
        continueRow(buttonWidth("Remove##probes"));
        if (button(studio, "Remove##probes", "the light probes that are selected")) {
            studio.runOnce(model::RemoveProbes{chosen});
        }
    }
}

} // namespace

void drawScenePanel(Studio& studio) {
    elidedText(kDimText, studio.around.sceneName, ImGui::GetContentRegionAvail().x);
    heading("Lights");
    drawLights(studio);
    if (studio.around.drawsProbes || !studio.model.document().probes.empty()) {
        heading("Light probes");
        drawProbes(studio);
    }
    if (!studio.around.materials.empty()) {
        heading("Materials");
        drawMaterials(studio);
    }
    if (!studio.around.nodes.empty()) {
        heading("Nodes");
        drawNodes(studio);
    }
}

} // namespace lodestar::ui

// SPDX-License-Identifier: MIT
#include <algorithm>

#include "ui/fields.h"
#include "ui/panels.h"
#include "ui/theme.h"

namespace lodestar::ui {
namespace {

void drawPlan(Studio& studio) {
    if (!studio.around.plan) {
        return;
    }
    constexpr ImGuiTableFlags kFlags =
        ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY;
    if (!ImGui::BeginTable("plan", 4, kFlags)) {
        return;
    }
    const float em = ImGui::GetFontSize();
    ImGui::TableSetupColumn("decision", ImGuiTableColumnFlags_WidthFixed, 2.2f * em);
    ImGui::TableSetupColumn("effect", ImGuiTableColumnFlags_WidthFixed,
                            std::min(7.5f * em, 0.24f * ImGui::GetContentRegionAvail().x));
    const float subject = std::min(8.0f * em, 0.22f * ImGui::GetContentRegionAvail().x);
    ImGui::TableSetupColumn("subject", ImGuiTableColumnFlags_WidthFixed, subject);
    ImGui::TableSetupColumn("reason", ImGuiTableColumnFlags_WidthStretch);
    const std::vector<plan::Effect>& effects = studio.around.plan->effects;
    ImGuiListClipper clipper;
    clipper.Begin(static_cast<int>(effects.size()));
    while (clipper.Step()) {
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const plan::Effect& effect = effects[static_cast<std::size_t>(i)];
            const bool runs = effect.decision == plan::Decision::Run;
            const ImVec4 color = runs ? kText : kDimText;
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextColored(runs ? kAccent : kDimText, "%s", runs ? "run" : "skip");
            ImGui::TableNextColumn();
            elidedText(color, effect.effect, ImGui::GetContentRegionAvail().x);
            ImGui::TableNextColumn();
            elidedText(color, effect.subject, ImGui::GetContentRegionAvail().x);
            ImGui::TableNextColumn();
            elidedText(color, effect.reason, ImGui::GetContentRegionAvail().x);
        }
    }
    ImGui::EndTable();
}

void drawTimes(Studio& studio) {
    if (!ImGui::BeginTable("times", 2, ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg)) {
        return;
    }
    const auto row = [](const char* what, const char* format, auto value) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextColored(kDimText, "%s", what);
        ImGui::TableNextColumn();
        ImGui::Text(format, value);
    };
    for (const auto& [step, ms] : studio.around.timesMs) {
        row(step.c_str(), "%.3f ms", ms);
    }
    const gl::WorkCounters& work = studio.around.counters;
    row("draws", "%llu", static_cast<unsigned long long>(work.draws));
    row("passes", "%llu", static_cast<unsigned long long>(work.passes));
    row("uploaded", "%llu bytes", static_cast<unsigned long long>(work.uploadBytes));
    row("textures", "%.1f MiB", static_cast<double>(work.textureBytes) / 1048576.0);
    ImGui::EndTable();
}

void drawLog(Studio& studio) {
    ImGui::PushTextWrapPos();
    for (const LogLine& line : studio.log) {
        ImGui::TextColored(line.isError ? kWarning : kText, "%s", line.text.c_str());
    }
    ImGui::PopTextWrapPos();
    if (ImGui::GetScrollY() >= ImGui::GetScrollMaxY()) {
        ImGui::SetScrollHereY(1.0f);
    }
}

} // namespace

void drawReportPanel(Studio& studio) {
    if (!ImGui::BeginTabBar("report")) {
        return;
    }
    const std::pair<const char*, void (*)(Studio&)> kTabs[] = {{"Plan", drawPlan},
                                                               {"Times", drawTimes},
                                                               {"Accuracy", drawAccuracyPanel},
                                                               {"Map rows", drawMapRowsPanel},
                                                               {"Log", drawLog}};
    studio.view.mapRows = false; // but where its tab is open
    for (const auto& [name, draw] : kTabs) {
        const bool open = ImGui::BeginTabItem(name);
        studio.mark(std::string("tab ") + name);
        if (open) {
            ImGui::BeginChild(name);
            draw(studio);
            ImGui::EndChild();
            ImGui::EndTabItem();
        }
    }
    ImGui::EndTabBar();
}

} // namespace lodestar::ui

// SPDX-License-Identifier: MIT
#include "app/view_overlay.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include "app/view_keys.h"

namespace lodestar::app {
namespace {

constexpr float kFontPixels = 13.0f; ///< the built-in font's own size: sharp at its multiples
constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_AlwaysAutoResize |
                                    ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;

void begin(const char* name, const ImVec2& at, const ImVec2& pivot) {
    ImGui::SetNextWindowPos(at, ImGuiCond_Always, pivot);
    ImGui::SetNextWindowBgAlpha(0.62f);
    ImGui::Begin(name, nullptr, kFlags);
}

void drawHelp() {
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
        for (const HelpLine& line : helpLines()) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(line.keys);
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(line.does);
        }
        ImGui::EndTable();
    }
}

void drawMessage(const OverlayText& text, float wrap) {
    ImGui::PushStyleColor(ImGuiCol_Text, text.messageIsError ? ImVec4(1.0f, 0.55f, 0.45f, 1.0f)
                                                             : ImVec4(1.0f, 1.0f, 1.0f, 1.0f));
    ImGui::PushTextWrapPos(wrap);
    ImGui::TextUnformatted(text.message.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
}

/// The help stands alone: what lies under it would shine through.
void layOut(const OverlayText& text, const ImVec2& size, float margin) {
    if (text.help) {
        begin("##help", {0.5f * size.x, 0.5f * size.y}, {0.5f, 0.5f});
        drawHelp();
        ImGui::End();
    } else if (!text.lines.empty()) {
        begin("##info", {margin, margin}, {0.0f, 0.0f});
        for (const std::string& line : text.lines) {
            ImGui::TextUnformatted(line.c_str());
        }
        ImGui::End();
    }
    if (!text.message.empty()) {
        begin("##message", {margin, size.y - margin}, {0.0f, 1.0f});
        drawMessage(text, size.x - 3.0f * margin);
        ImGui::End();
    }
}

} // namespace

Overlay::Overlay() {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().LogFilename = nullptr;
    ImGui::StyleColorsDark();
    ImGui_ImplOpenGL3_Init("#version 330 core");
}

Overlay::~Overlay() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext();
}

void Overlay::useFontFor(float contentScale) {
    const float scale = std::clamp(std::round(contentScale), 1.0f, 8.0f);
    if (scale == fontScale_) {
        return;
    }
    fontScale_ = scale;
    ImFontConfig config;
    config.SizePixels = kFontPixels * scale;
    ImGui::GetIO().Fonts->Clear();
    ImGui::GetIO().Fonts->AddFontDefault(&config);
    ImGui_ImplOpenGL3_DestroyDeviceObjects(); // made anew with the next frame
    ImGui::GetStyle() = ImGuiStyle();
    ImGui::StyleColorsDark();
    ImGui::GetStyle().ScaleAllSizes(scale);
}

void Overlay::draw(const OverlayText& text, int width, int height, float contentScale) {
    useFontFor(contentScale);
    ImGuiIO& io = ImGui::GetIO();
    const ImVec2 size(static_cast<float>(width), static_cast<float>(height));
    io.DisplaySize = size;
    io.DeltaTime = 1.0f / 60.0f; // nothing here depends on time
    ImGui_ImplOpenGL3_NewFrame();
    // A window that fits its content is measured in one frame, and its table in another, before it
    // is shown as it should be; a viewer at rest draws only one.
    for (int pass = 0; pass < 3; ++pass) {
        ImGui::NewFrame();
        if (text.picture != 0) {
            ImGui::GetBackgroundDrawList()->AddImage(
                reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(text.picture)),
                {0.0f, 0.0f}, size);
        }
        layOut(text, size, 8.0f * fontScale_);
        ImGui::EndFrame();
    }
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

} // namespace lodestar::app

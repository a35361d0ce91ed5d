// SPDX-License-Identifier: MIT
#include "ui/theme.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lodestar/display.glsl"
#include "ui/false_color.h"
#include "ui/font.h"

namespace lodestar::ui {
namespace {

constexpr float kFontPixels = 15.0f;

void addFont(float scale) {
    ImGuiIO& io = ImGui::GetIO();
    io.Fonts->Clear();
    ImFontConfig config;
    if (const std::span<const unsigned char> font = embeddedFont(); !font.empty()) {
        // General punctuation, arrows and mathematics beside Latin: dashes, degrees,
        // multiplication.
        static constexpr ImWchar kRanges[] = {0x20, 0x24f, 0x370, 0x3ff, 0x2010, 0x2044, 0};
        config.FontDataOwnedByAtlas = false;
        config.OversampleH = 2;
        io.Fonts->AddFontFromMemoryTTF(const_cast<unsigned char*>(font.data()),
                                       static_cast<int>(font.size()),
                                       std::round(kFontPixels * scale), &config, kRanges);
    } else {
        config.SizePixels = 13.0f * std::max(std::round(scale), 1.0f); // sharp at its multiples
        io.Fonts->AddFontDefault(&config);
    }
}

ImVec4 grey(float value, float alpha = 1.0f) {
    return {value, value * 1.02f, value * 1.06f, alpha};
}

void setColors(ImGuiStyle& style) {
    const ImVec4 accent(kAccent.x, kAccent.y, kAccent.z, 0.85f);
    const std::pair<ImGuiCol_, ImVec4> colors[] = {
        {ImGuiCol_Text, kText},
        {ImGuiCol_TextDisabled, kDimText},
        {ImGuiCol_WindowBg, kPanel},
        {ImGuiCol_ChildBg, grey(0.0f, 0.0f)},
        {ImGuiCol_PopupBg, grey(0.155f)},
        {ImGuiCol_MenuBarBg, grey(0.10f)},
        {ImGuiCol_Border, grey(0.26f)},
        {ImGuiCol_FrameBg, grey(0.195f)},
        {ImGuiCol_FrameBgHovered, grey(0.25f)},
        {ImGuiCol_FrameBgActive, grey(0.30f)},
        {ImGuiCol_TitleBg, grey(0.10f)},
        {ImGuiCol_TitleBgActive, grey(0.10f)},
        {ImGuiCol_Button, grey(0.235f)},
        {ImGuiCol_ButtonHovered, grey(0.31f)},
        {ImGuiCol_ButtonActive, grey(0.38f)},
        {ImGuiCol_Header, grey(0.26f)},
        {ImGuiCol_HeaderHovered, grey(0.31f)},
        {ImGuiCol_HeaderActive, grey(0.35f)},
        {ImGuiCol_CheckMark, kAccent},
        {ImGuiCol_SliderGrab, accent},
        {ImGuiCol_SliderGrabActive, kAccent},
        {ImGuiCol_Tab, grey(0.155f)},
        {ImGuiCol_TabHovered, grey(0.31f)},
        {ImGuiCol_TabActive, grey(0.26f)},
        {ImGuiCol_Separator, grey(0.24f)},
        {ImGuiCol_ScrollbarBg, grey(0.0f, 0.0f)},
        {ImGuiCol_ScrollbarGrab, grey(0.28f)},
        {ImGuiCol_TextSelectedBg, ImVec4(kAccent.x, kAccent.y, kAccent.z, 0.35f)},
        {ImGuiCol_NavHighlight, accent},
        {ImGuiCol_ModalWindowDimBg, grey(0.0f, 0.5f)},
    };
    for (const auto& [which, color] : colors) {
        style.Colors[which] = color;
    }
}

} // namespace

void applyTheme(float scale) {
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    ImGui::StyleColorsDark();
    style.WindowRounding = 0.0f;
    style.WindowBorderSize = 1.0f;
    style.WindowPadding = {10.0f, 8.0f};
    style.FramePadding = {7.0f, 3.0f};
    style.FrameRounding = 3.0f;
    style.GrabRounding = 3.0f;
    style.PopupRounding = 3.0f;
    style.TabRounding = 3.0f;
    style.ItemSpacing = {7.0f, 5.0f};
    style.ScrollbarSize = 11.0f;
    style.GrabMinSize = 9.0f;
    style.ColorButtonPosition = ImGuiDir_Left;
    style.ScaleAllSizes(scale);
    setColors(style);
    addFont(scale);
}

ImU32 shownColor(const glm::dvec3& radiance, double exposure) {
    int bytes[3];
    for (int c = 0; c < 3; ++c) {
        const auto value = static_cast<float>(std::min(radiance[c] * exposure, 1e9));
        const float shown = shader::lodestar_srgbFromLinear(shader::lodestar_filmic(value));
        bytes[c] = static_cast<int>(std::lround(255.0f * std::clamp(shown, 0.0f, 1.0f)));
    }
    return IM_COL32(bytes[0], bytes[1], bytes[2], 255);
}

ImU32 falseShownColor(const glm::dvec3& radiance, double exposure) {
    const double mean = (radiance.r + radiance.g + radiance.b) / 3.0 * exposure;
    const double x =
        mean > 0.0 ? std::clamp(std::log2(mean) / kFalseColorStops + 0.5, 0.0, 1.0) : 0.0;
    // Finer than 8 bits can show; a strip asks for thousands.
    constexpr std::size_t kLast = 2047;
    static const std::array<ImU32, kLast + 1> table = [] {
        std::array<ImU32, kLast + 1> made{};
        for (std::size_t i = 0; i <= kLast; ++i) {
            const glm::vec3 color = falseColor(static_cast<double>(i) / kLast);
            made[i] = ImGui::ColorConvertFloat4ToU32({color.r, color.g, color.b, 1.0f});
        }
        return made;
    }();
    return table[static_cast<std::size_t>(std::lround(x * kLast))];
}

} // namespace lodestar::ui

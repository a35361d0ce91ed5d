// SPDX-License-Identifier: MIT
#include "ui/fields.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <imgui_internal.h>

#include "ui/theme.h"

namespace lodestar::ui {

void label(const char* text) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(kDimText, "%s", text);
    ImGui::SameLine(7.2f * ImGui::GetFontSize());
    ImGui::SetNextItemWidth(-1.0f);
}

void heading(const char* text) {
    ImGui::Dummy({0.0f, 0.15f * ImGui::GetFontSize()});
    ImGui::TextColored(kAccent, "%s", text);
    ImGui::Separator();
}

std::optional<double> numberField(const char* id, double value, float speed, double least,
                                  double most, const char* format) {
    double typed = value;
    if (!ImGui::DragScalar(id, ImGuiDataType_Double, &typed, speed, &least, &most, format,
                           ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoRoundToFormat) ||
        !std::isfinite(typed)) {
        return std::nullopt;
    }
    // A document has no denormals. A text that stands in the field is a value in every frame, and a
    // change in one alone.
    typed = std::clamp(std::isnormal(typed) ? typed : 0.0, least, most);
    return typed != value ? std::optional(typed) : std::nullopt;
}

namespace {

/// The most digits with which each of three numbers has room in its third of the row.
const char* formatWithin(const glm::dvec3& values, float width) {
    constexpr const char* kFormats[] = {"%.4g", "%.3g", "%.2g", "%.1g"};
    const ImGuiStyle& style = ImGui::GetStyle();
    const float room =
        (width - 2.0f * style.ItemInnerSpacing.x) / 3.0f - 2.0f * style.FramePadding.x;
    for (const char* format : kFormats) {
        bool fits = true;
        for (int i = 0; i < 3; ++i) {
            char text[32];
            std::snprintf(text, sizeof text, format, values[i]);
            fits = fits && ImGui::CalcTextSize(text).x <= room;
        }
        if (fits) {
            return format;
        }
    }
    return kFormats[3];
}

} // namespace

bool numbersField(const char* id, glm::dvec3& values, float speed, double least, double most) {
    glm::dvec3 typed = values;
    const char* const format = formatWithin(values, ImGui::CalcItemWidth());
    const bool changed =
        ImGui::DragScalarN(id, ImGuiDataType_Double, &typed.x, 3, speed, &least, &most, format,
                           ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoRoundToFormat) &&
        std::isfinite(typed.x) && std::isfinite(typed.y) && std::isfinite(typed.z);
    if (changed) { // a typed number that is none stays out
        values = glm::clamp(typed, least, most);
    }
    return changed;
}

namespace {

/// The last widget's colour may be dragged to where one is taken.
void dragColor(const glm::dvec3& value) {
    if (ImGui::BeginDragDropSource()) {
        const glm::vec3 color(value);
        ImGui::SetDragDropPayload(IMGUI_PAYLOAD_TYPE_COLOR_3F, &color.x, sizeof color,
                                  ImGuiCond_Once);
        ImGui::TextUnformatted("drop it on the gradient");
        ImGui::EndDragDropSource();
    }
}

/// A picker of hue and saturation over the brightest channel, which it keeps.
std::optional<glm::dvec3> pickerPopup(const char* id, const glm::dvec3& value, double most) {
    std::optional<glm::dvec3> changed;
    if (ImGui::BeginPopup(id)) {
        const double brightest = std::max({value.r, value.g, value.b});
        const double unit = std::max(brightest, 1.0);
        float channels[3];
        for (int c = 0; c < 3; ++c) {
            channels[c] = static_cast<float>(value[c] / unit);
        }
        ImGui::SetNextItemWidth(14.0f * ImGui::GetFontSize());
        if (ImGui::ColorPicker3("##picker", channels,
                                ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_NoSidePreview |
                                    ImGuiColorEditFlags_Float)) {
            glm::dvec3 picked(channels[0], channels[1], channels[2]);
            changed = glm::clamp(picked * unit, 0.0, most);
        }
        ImGui::EndPopup();
    }
    return changed;
}

} // namespace

std::optional<glm::dvec3> colorField(const char* id, const glm::dvec3& value, double most,
                                     double exposure) {
    ImGui::PushID(id);
    const float side = ImGui::GetFrameHeight();
    const ImVec2 low = ImGui::GetCursorScreenPos();
    if (ImGui::InvisibleButton("##swatch", {1.6f * side, side})) {
        ImGui::OpenPopup("##pick");
    }
    dragColor(value);
    ImGui::GetWindowDrawList()->AddRectFilled(low, {low.x + 1.6f * side, low.y + side},
                                              shownColor(value, exposure), 3.0f);
    ImGui::GetWindowDrawList()->AddRect(low, {low.x + 1.6f * side, low.y + side},
                                        ImGui::GetColorU32(ImGuiCol_Border), 3.0f);
    std::optional<glm::dvec3> changed = pickerPopup("##pick", value, most);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1.0f);
    glm::dvec3 typed = value;
    if (numbersField("##channels", typed, 0.005f, 0.0, most)) {
        changed = typed;
    }
    ImGui::PopID();
    return changed;
}

std::optional<std::size_t> choiceField(Studio& studio, const char* id, std::size_t chosen,
                                       std::span<const char* const> choices) {
    std::optional<std::size_t> changed;
    const bool open = ImGui::BeginCombo(id, chosen < choices.size() ? choices[chosen] : "");
    studio.mark(id + 2); // without its "##"
    if (open) {
        for (std::size_t i = 0; i < choices.size(); ++i) {
            if (ImGui::Selectable(choices[i], i == chosen)) {
                changed = i;
            }
            studio.mark(std::string(id + 2) + "/" + choices[i]);
        }
        ImGui::EndCombo();
    }
    return changed == chosen ? std::nullopt : changed;
}

void continueRow(float width) {
    const float end = ImGui::GetItemRectMax().x + ImGui::GetStyle().ItemSpacing.x + width -
                      ImGui::GetWindowPos().x;
    if (end <= ImGui::GetContentRegionMax().x) {
        ImGui::SameLine();
    }
}

float buttonWidth(const char* text) {
    return ImGui::CalcTextSize(text, nullptr, true).x + 2.0f * ImGui::GetStyle().FramePadding.x;
}

std::string elided(const std::string& text, float room) {
    constexpr const char* kDots = "\xe2\x80\xa6";
    if (ImGui::CalcTextSize(text.c_str()).x <= room) {
        return text;
    }
    const float left = room - ImGui::CalcTextSize(kDots).x;
    const char* end = nullptr;
    ImGui::GetFont()->CalcTextSizeA(ImGui::GetFontSize(), std::max(left, 0.0f), 0.0f, text.data(),
                                    text.data() + text.size(), &end);
    return std::string(text.data(), end) + kDots;
}

void elidedText(const ImVec4& color, const std::string& text, float room) {
    const std::string shown = elided(text, room);
    ImGui::TextColored(color, "%s", shown.c_str());
    if (shown.size() != text.size() && ImGui::IsItemHovered()) {
        ImGui::SetTooltip("%s", text.c_str());
    }
}

void forgetLeftText() {
    ImGuiContext& context = *ImGui::GetCurrentContext();
    if (context.InputTextState.ID != context.ActiveId) {
        context.InputTextState.ID = 0; // of no field
    }
}

bool beginQuestion(const char* title) {
    ImGui::SetNextWindowPos(
        {0.5f * ImGui::GetIO().DisplaySize.x, 0.3f * ImGui::GetIO().DisplaySize.y},
        ImGuiCond_Always, {0.5f, 0.0f});
    return ImGui::BeginPopupModal(
        title, nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings);
}

bool button(Studio& studio, const char* text, const char* shortcut) {
    const bool pressed = ImGui::Button(text);
    studio.mark(text);
    if (shortcut[0] != '\0' && ImGui::IsItemHovered()) {
        ImGui::SetTooltip("%s", shortcut);
    }
    return pressed;
}

glm::dvec2 degreesOfAxis(const glm::dvec3& axis) {
    const double length = glm::length(axis);
    const glm::dvec3 unit = length > 0.0 ? axis / length : glm::dvec3(0.0, 1.0, 0.0);
    const double azimuth = glm::degrees(std::atan2(unit.x, -unit.z));
    return {azimuth < 0.0 ? azimuth + 360.0 : azimuth,
            glm::degrees(std::asin(std::clamp(unit.y, -1.0, 1.0)))};
}

glm::dvec3 axisOfDegrees(const glm::dvec2& degrees) {
    const glm::dvec2 angle = glm::radians(degrees);
    return {std::sin(angle.x) * std::cos(angle.y), std::sin(angle.y),
            -std::cos(angle.x) * std::cos(angle.y)};
}

} // namespace lodestar::ui

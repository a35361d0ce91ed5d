// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <imgui_internal.h>

#include "lighting/day.h"
#include "model/ramp.h"
#include "ui/fields.h"
#include "ui/panels.h"
#include "ui/theme.h"

namespace lodestar::ui {
namespace {

constexpr int kColumns = 96; ///< a quarter of an hour each
constexpr int kRows = 20;
constexpr float kHandleHeight = 18.0f;
constexpr float kTickHeight = 18.0f;

/// Tells whether a light's hours are lit by it at all.
bool isUp(const document::Light& light, double hour) {
    return !light.path || lighting::sunDirection(*light.path, hour).y > 0.0;
}

} // namespace

struct DayPanel::Frame {
    std::size_t light = 0;
    ImVec2 low;
    float width = 1.0f, rampHeight = 1.0f, scale = 1.0f;
    ImDrawList* list = nullptr;
    model::Id chosen = model::Id::None;

    [[nodiscard]] float x(double hour) const {
        return low.x + width * static_cast<float>(hour / 24.0);
    }
    /// [0, 24), also right of the strip.
    [[nodiscard]] double hour(float pixels) const {
        const double share = static_cast<double>((pixels - low.x) / width);
        return std::clamp(24.0 * share, 0.0, 23.999);
    }
    [[nodiscard]] float bottom() const { return low.y + rampHeight; }
};

namespace {

/// Radiance of each key along the strip's rows, tints included, in the order of their hours.
struct KeyColumn {
    double hour = 0.0;
    std::vector<glm::dvec3> radiance;
};

std::vector<KeyColumn> columnsOf(const document::Light& light) {
    std::vector<double> at;
    at.reserve(kRows);
    for (int row = 0; row < kRows; ++row) {
        at.push_back(atOf((row + 0.5) / kRows, light.kind));
    }
    std::vector<KeyColumn> columns;
    for (const document::Key& key : light.keys) {
        KeyColumn column{lighting::wrappedHour(key.hour),
                         model::radianceAt(key.gradient, light.kind, at)};
        for (glm::dvec3& radiance : column.radiance) {
            radiance *= key.tint;
        }
        columns.push_back(std::move(column));
    }
    std::stable_sort(columns.begin(), columns.end(),
                     [](const KeyColumn& a, const KeyColumn& b) { return a.hour < b.hour; });
    const auto last =
        std::unique(columns.rbegin(), columns.rend(), [](const KeyColumn& a, const KeyColumn& b) {
            return a.hour == b.hour; // the last listed holds
        });
    columns.erase(columns.begin(), last.base());
    return columns;
}

/// Colours of the strip, column by column; empty where the light has no key.
std::vector<ImU32> colorsOf(const document::Light& light, bool falseColor, double exposure) {
    const std::vector<KeyColumn> keys = columnsOf(light);
    std::vector<ImU32> colors;
    if (keys.empty()) {
        return colors;
    }
    std::vector<double> hours;
    hours.reserve(keys.size());
    for (const KeyColumn& key : keys) {
        hours.push_back(key.hour);
    }
    for (int column = 0; column < kColumns; ++column) {
        const double hour = 24.0 * (column + 0.5) / kColumns;
        const lighting::KeyBlend blend = lighting::keysAt(hours, hour);
        const double up = isUp(light, hour) ? 1.0 : 0.0;
        for (std::size_t row = 0; row < kRows; ++row) {
            const glm::dvec3 radiance = up * glm::mix(keys[blend.from].radiance[row],
                                                      keys[blend.to].radiance[row], blend.t);
            colors.push_back(falseColor ? falseShownColor(radiance, exposure)
                                        : shownColor(radiance, exposure));
        }
    }
    return colors;
}

std::string clockText(double hour) {
    const int minutes = static_cast<int>(std::lround(hour * 60.0)) % 1440;
    char text[8];
    std::snprintf(text, sizeof text, "%02d:%02d", minutes / 60, minutes % 60);
    return text;
}

void drawControls(Studio& studio, model::Id light, model::Id key, std::size_t keyCount) {
    if (button(studio, studio.view.playing ? "Pause" : "Play", "Y")) {
        studio.view.playing = !studio.view.playing;
    }
    ImGui::SameLine();
    ImGui::SetNextItemWidth(5.5f * ImGui::GetFontSize());
    if (const auto hour = numberField("##hour", studio.view.hour, 0.02f, 0.0, 23.999, "%.4g h")) {
        studio.view.hour = *hour;
    }
    studio.mark("hour");
    ImGui::SameLine();
    ImGui::Text("%s", clockText(studio.view.hour).c_str());
    ImGui::SameLine();
    ImGui::SetNextItemWidth(ImGui::CalcTextSize("0.4 h a second").x + 1.5f * ImGui::GetFontSize());
    studio.view.hoursASecond =
        numberField("##speed", studio.view.hoursASecond, 0.01f, 0.01, 24.0, "%.3g h a second")
            .value_or(studio.view.hoursASecond);
    continueRow(buttonWidth("Add key"));
    if (button(studio, "Add key", "at the hour; Ctrl + drag copies one")) {
        studio.runOnce(model::AddKey{light, studio.view.hour});
    }
    continueRow(buttonWidth("Copy here"));
    if (button(studio, "Copy here", "the chosen key to the hour")) {
        studio.runOnce(model::CopyKey{key, studio.view.hour});
    }
    if (keyCount > 1) {
        continueRow(buttonWidth("Delete key"));
        if (button(studio, "Delete key", "the key that is chosen")) {
            studio.runOnce(model::DeleteKey{key});
        }
    }
}

/// Selects a key and shows its hour.
void choose(Studio& studio, model::Id key) {
    model::Selection selection;
    selection.key = key;
    selection.materials = studio.model.selection().materials;
    studio.model.select(selection);
    studio.view.hour = lighting::wrappedHour(studio.model.key(key)->hour);
}

void drawTicks(ImDrawList* list, const ImVec2& low, float width, float scale) {
    const ImU32 color = ImGui::GetColorU32(kDimText);
    for (int hour = 0; hour <= 24; hour += 3) {
        const float x = low.x + width * static_cast<float>(hour) / 24.0f;
        char text[8];
        std::snprintf(text, sizeof text, "%d", hour);
        const float size = ImGui::CalcTextSize(text).x;
        list->AddLine({x, low.y}, {x, low.y + 4.0f * scale}, color);
        list->AddText(
            {std::clamp(x - 0.5f * size, low.x, low.x + width - size), low.y + 2.0f * scale}, color,
            text);
    }
}

} // namespace

void DayPanel::drawRamp(const Studio& studio, const Frame& frame) {
    const document::Light& light = studio.model.document().lights[frame.light];
    const bool same = light == drawn_.light && studio.view.falseColor == drawn_.falseColor &&
                      studio.view.exposure == drawn_.exposure;
    if (!same) {
        drawn_ = {light, studio.view.falseColor, studio.view.exposure,
                  colorsOf(light, studio.view.falseColor, std::exp2(studio.view.exposure))};
    }
    const auto edge = [](float from, float length, std::size_t i, int count) {
        return from + length * static_cast<float>(i) / static_cast<float>(count);
    };
    for (std::size_t i = 0; i < drawn_.colors.size(); ++i) {
        const std::size_t column = i / kRows;
        const std::size_t row = i % kRows;
        frame.list->AddRectFilled({edge(frame.low.x, frame.width, column, kColumns),
                                   edge(frame.low.y, frame.rampHeight, row, kRows)},
                                  {edge(frame.low.x, frame.width, column + 1, kColumns),
                                   edge(frame.low.y, frame.rampHeight, row + 1, kRows)},
                                  drawn_.colors[i]);
    }
}

void DayPanel::drawKeys(Studio& studio, const Frame& frame) {
    const document::Light& light = studio.model.document().lights[frame.light];
    const std::vector<model::KeyIds>& names = studio.model.ids().lights[frame.light].keys;
    const float half = 6.0f * frame.scale;
    const float y = frame.bottom() + half + 2.0f;
    for (std::size_t i = 0; i < light.keys.size(); ++i) {
        const float x = frame.x(lighting::wrappedHour(light.keys[i].hour));
        const bool chosen = names[i].id == frame.chosen;
        const ImVec2 outline[] = {{x, y - half}, {x + half, y}, {x, y + half}, {x - half, y}};
        frame.list->AddConvexPolyFilled(outline, 4,
                                        ImGui::GetColorU32(chosen ? kAccent : kDimText));
        studio.mark("key " + std::to_string(i), {x - half, y - half}, {x + half, y + half});
    }
    const float now = frame.x(studio.view.hour);
    frame.list->AddLine({now, frame.low.y}, {now, frame.bottom() + kHandleHeight * frame.scale},
                        IM_COL32(0, 0, 0, 160), 4.0f * frame.scale);
    frame.list->AddLine({now, frame.low.y}, {now, frame.bottom() + kHandleHeight * frame.scale},
                        ImGui::GetColorU32(kText), 1.6f * frame.scale);
}

void DayPanel::pointer(Studio& studio, const Frame& frame) {
    const ImGuiIO& io = ImGui::GetIO();
    const double hour = frame.hour(io.MousePos.x);
    if (ImGui::IsItemActivated()) {
        grabbed_ = model::Id::None;
        draggedTo_ = -1.0;
        scrubs_ = true;
        const document::Light& light = studio.model.document().lights[frame.light];
        const std::vector<model::KeyIds>& names = studio.model.ids().lights[frame.light].keys;
        for (std::size_t i = 0; i < light.keys.size(); ++i) {
            const float away =
                std::abs(frame.x(lighting::wrappedHour(light.keys[i].hour)) - io.MousePos.x);
            if (io.MousePos.y > frame.bottom() && away < 8.0f * frame.scale) {
                grabbed_ = names[i].id;
                scrubs_ = false;
            }
        }
        if (grabbed_ != model::Id::None) {
            choose(studio, grabbed_);
        }
    }
    if (ImGui::IsItemActive() && scrubs_) {
        studio.view.playing = false;
        studio.view.hour = hour;
    } else if (ImGui::IsItemActive() && grabbed_ != model::Id::None &&
               ImGui::IsMouseDragging(ImGuiMouseButton_Left, 3.0f)) {
        const double rounded = std::min(std::round(hour * 4.0) / 4.0, 23.75);
        if (rounded == draggedTo_) {
            return; // it is there already
        }
        draggedTo_ = rounded;
        if (io.KeyCtrl) {
            studio.run(model::CopyKey{grabbed_, rounded});
        } else {
            studio.run(model::MoveKey{grabbed_, rounded});
        }
        studio.view.hour = rounded;
    }
}

/// Left and right move the chosen key of a strip that has the focus by a quarter of an hour, with
/// Shift by an hour; with Ctrl they choose its neighbour.
void DayPanel::answerArrows(Studio& studio, const Frame& frame) {
    if (!ImGui::IsItemFocused() || ImGui::IsItemActive()) {
        return;
    }
    const int steps =
        (studio.pressed(Key::Right, true) ? 1 : 0) - (studio.pressed(Key::Left, true) ? 1 : 0);
    if (studio.down(Key::Right) || studio.down(Key::Left)) {
        ImGui::NavMoveRequestCancel(); // the focus stays here
    }
    model::Id key = studio.chosenKey();
    const std::vector<model::KeyIds>& names = studio.model.ids().lights[frame.light].keys;
    const auto chosen = std::find_if(names.begin(), names.end(),
                                     [&](const model::KeyIds& k) { return k.id == key; });
    if (steps == 0 || chosen == names.end()) {
        return;
    }
    if (ImGui::GetIO().KeyCtrl) {
        const auto count = static_cast<std::ptrdiff_t>(names.size());
        const std::ptrdiff_t at = chosen - names.begin() + steps + count;
        key = names[static_cast<std::size_t>(at % count)].id;
    } else {
        const double hours = (ImGui::GetIO().KeyShift ? 1.0 : 0.25) * steps;
        studio.runOnce(
            model::MoveKey{key, lighting::wrappedHour(studio.model.key(key)->hour + hours)});
    }
    choose(studio, key);
}

void DayPanel::draw(Studio& studio) {
    const auto light = model::findLight(studio.model.ids(), studio.chosenLight());
    if (!light) {
        ImGui::TextColored(kDimText, "No light has a day yet.");
        return;
    }
    drawControls(studio, studio.model.ids().lights[*light].id, studio.chosenKey(),
                 studio.model.document().lights[*light].keys.size());
    Frame frame;
    frame.light = *light;
    frame.scale = ImGui::GetFontSize() / 15.0f;
    frame.low = ImGui::GetCursorScreenPos();
    frame.list = ImGui::GetWindowDrawList();
    const ImVec2 room = ImGui::GetContentRegionAvail();
    frame.width = std::max(room.x, 48.0f);
    frame.rampHeight =
        std::max(room.y - (kHandleHeight + kTickHeight) * frame.scale, 8.0f * frame.scale);
    ImGui::InvisibleButton(
        "##day", {frame.width, frame.rampHeight + (kHandleHeight + kTickHeight) * frame.scale});
    pointer(studio, frame);
    answerArrows(studio, frame);
    frame.chosen = studio.chosenKey();
    drawRamp(studio, frame);
    studio.mark("day", frame.low, {frame.low.x + frame.width, frame.bottom()});
    drawTicks(frame.list, {frame.low.x, frame.bottom() + kHandleHeight * frame.scale}, frame.width,
              frame.scale);
    drawKeys(studio, frame);
}

} // namespace lodestar::ui

// SPDX-License-Identifier: MIT
//
// The rows of the maps of skies and suns: the Phong exponent of each, moved between its neighbours,
// with the error that is measured there and half way to the next.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "lighting/rsrm_layout.h"
#include "ui/fields.h"
#include "ui/panels.h"
#include "ui/theme.h"

namespace lodestar::ui {
namespace {

using Rows = std::vector<double>;

/// Places on sliders: log2(s + 1), as rows lie between one another.
double octaveOf(double exponent) {
    return std::log2(exponent + 1.0);
}

/// Five digits: what a slider's pixel is worth.
double rounded(double exponent) {
    const double unit = std::pow(10.0, std::floor(std::log10(exponent)) - 4.0);
    return std::round(exponent / unit) * unit;
}

/// Where a row may be moved to. Within a rounding of its neighbours' ratio.
struct Room {
    double least, most;
    Room(const Rows& rows, std::size_t row) {
        constexpr double kRatio = lighting::kLeastRowRatio * (1.0 + 1e-12);
        least = row > 0 ? rows[row - 1] * kRatio : lighting::kLeastOwnExponent;
        most = row + 1 < rows.size() ? rows[row + 1] / kRatio : lighting::kGreatestOwnExponent;
    }
    [[nodiscard]] double held(double exponent) const {
        return least < most ? std::clamp(exponent, least, most) : least;
    }
};

/// The middle of the widest step between rows.
Rows withOneMore(Rows rows) {
    std::size_t widest = 0;
    const auto step = [&rows](std::size_t i) { return octaveOf(rows[i + 1]) - octaveOf(rows[i]); };
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
        widest = step(i) > step(widest) ? i : widest;
    }
    const double middle = octaveOf(rows[widest]) + 0.5 * step(widest);
    rows.insert(rows.begin() + static_cast<std::ptrdiff_t>(widest) + 1,
                rounded(std::exp2(middle) - 1.0));
    return rows;
}

void drawButtons(Studio& studio, const lighting::RsrmLayout& maps, const Rows& rows) {
    const auto choice = [&](const char* text, bool enabled) {
        ImGui::BeginDisabled(!enabled);
        const bool pressed = ImGui::Button(text);
        ImGui::EndDisabled();
        studio.mark(text);
        ImGui::SameLine();
        return pressed;
    };
    if (choice("Add row", rows.size() < lighting::kMostOwnRows)) {
        studio.runOnce(model::SetMapRows{withOneMore(rows)});
    }
    if (choice("Default rows", lighting::hasOwnRows(maps))) {
        studio.runOnce(model::SetMapRows{});
    }
    ImGui::TextColored(kDimText, "%zu %srows, %.1f KB a light", rows.size(),
                       lighting::hasOwnRows(maps) ? "" : "default ",
                       static_cast<double>(lighting::texelBytes(maps)) / 1024.0);
    const AccuracyView& accuracy = studio.around.accuracy;
    if (accuracy.rows.empty()) {
        ImGui::SameLine();
        ImGui::TextColored(kDimText, "%s",
                           accuracy.material.empty() ? "  errors: select a material"
                                                     : "  errors: of skies and suns alone");
    } else if (accuracy.progress < 1.0) {
        ImGui::SameLine();
        ImGui::TextColored(kAccent, "measuring: %.0f %%", 100.0 * accuracy.progress);
    }
}

/// The slider and the number of a row. @return where it is to be
std::optional<double> drawExponent(Studio& studio, const Rows& rows, std::size_t row) {
    const Room room(rows, row);
    std::optional<double> wanted;
    const std::string number = std::to_string(row);
    ImGui::TableNextColumn();
    ImGui::SetNextItemWidth(-1.0f);
    auto place = static_cast<float>(octaveOf(rows[row]));
    if (ImGui::SliderFloat("##slide", &place,
                           static_cast<float>(octaveOf(lighting::kLeastOwnExponent)),
                           static_cast<float>(octaveOf(lighting::kGreatestOwnExponent)), "",
                           ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput)) {
        wanted = room.held(rounded(std::exp2(static_cast<double>(place)) - 1.0));
    }
    studio.mark("row slider " + number);
    ImGui::TableNextColumn();
    ImGui::SetNextItemWidth(-1.0f);
    if (room.least < room.most) {
        if (const auto typed =
                numberField("##exponent", rows[row], static_cast<float>(0.005 * rows[row]),
                            room.least, room.most, "%.5g")) {
            wanted = *typed;
        }
    } else {
        ImGui::Text("%.5g", rows[row]);
    }
    studio.mark("row " + number);
    return wanted && *wanted != rows[row] ? wanted : std::nullopt;
}

/// What is measured of a row, or nothing while it is measured anew.
const MapRow* measuredOf(const Studio& studio, const Rows& rows, std::size_t row) {
    const std::vector<MapRow>& measured = studio.around.accuracy.rows;
    return measured.size() == rows.size() && measured[row].exponent == rows[row] ? &measured[row]
                                                                                 : nullptr;
}

/// An error as text over a bar.
void drawError(const std::optional<double>& error, double most) {
    ImGui::TableNextColumn();
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const float wide = ImGui::GetContentRegionAvail().x;
    const auto part = static_cast<float>(std::clamp(error.value_or(0.0) / most, 0.0, 1.0));
    ImGui::GetWindowDrawList()->AddRectFilled(
        low, {low.x + part * wide, low.y + ImGui::GetFrameHeight()},
        ImGui::GetColorU32(ImVec4(kAccent.x, kAccent.y, kAccent.z, 0.3f)));
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(percentText(error).c_str());
}

void drawRows(Studio& studio, const Rows& rows) {
    constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY;
    if (!ImGui::BeginTable("map rows", 5, kFlags)) {
        return;
    }
    const float em = ImGui::GetFontSize();
    ImGui::TableSetupColumn("Phong exponent of the row", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, 5.0f * em);
    ImGui::TableSetupColumn("error", ImGuiTableColumnFlags_WidthFixed, 7.0f * em);
    ImGui::TableSetupColumn("half way to next", ImGuiTableColumnFlags_WidthFixed, 9.0f * em);
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, 2.0f * em);
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableHeadersRow();
    double most = 1e-4;
    for (const MapRow& row : studio.around.accuracy.rows) {
        most = std::max({most, row.error.value_or(0.0), row.betweenError.value_or(0.0)});
    }
    for (std::size_t row = 0; row < rows.size(); ++row) {
        ImGui::PushID(static_cast<int>(row));
        ImGui::TableNextRow();
        if (const auto moved = drawExponent(studio, rows, row)) {
            studio.run(model::SetMapRow{row, *moved});
        }
        const MapRow* measured = measuredOf(studio, rows, row);
        drawError(measured != nullptr ? measured->error : std::nullopt, most);
        drawError(measured != nullptr ? measured->betweenError : std::nullopt, most);
        ImGui::TableNextColumn();
        ImGui::BeginDisabled(rows.size() <= 2);
        if (ImGui::Button("x")) {
            Rows fewer = rows;
            fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(row));
            studio.runOnce(model::SetMapRows{std::move(fewer)});
        }
        ImGui::EndDisabled();
        studio.mark("remove row " + std::to_string(row));
        ImGui::PopID();
    }
    ImGui::EndTable();
}

} // namespace

void drawMapRowsPanel(Studio& studio) {
    studio.view.mapRows = true;
    const document::Document& document = studio.model.document();
    if (document.lights.empty()) {
        ImGui::TextColored(kDimText, "Rows are of the maps of skies and suns: there are none.");
        return;
    }
    const lighting::RsrmLayout maps = document::mapLayout(document);
    const Rows rows = lighting::rowExponents(maps);
    drawButtons(studio, maps, rows);
    drawRows(studio, rows);
}

} // namespace lodestar::ui

// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "model/presets.h"
#include "model/ramp.h"
#include "ui/fields.h"
#include "ui/panels.h"
#include "ui/theme.h"

namespace lodestar::ui {
namespace {

using lighting::GradientInterpolation;
using lighting::GradientSpace;

constexpr const char* kInterpolations[] = {"linear", "constant", "smooth", "cubic"};
constexpr const char* kSpaces[] = {"linear", "oklab", "srgb"};

/// The stops that fields act on: those selected.
const std::vector<model::Id>& selectedStops(const Studio& studio) {
    return studio.model.selection().stops;
}

void drawStopFields(Studio& studio, lighting::LightKind kind) {
    const std::vector<model::Id> ids = selectedStops(studio);
    const document::Stop* first = ids.empty() ? nullptr : studio.model.stop(ids.front());
    if (first == nullptr) {
        ImGui::PushTextWrapPos();
        ImGui::TextColored(kDimText, "Click the strip to add a stop, a handle to select one.");
        ImGui::PopTextWrapPos();
        return;
    }
    if (ids.size() > 1) {
        ImGui::TextColored(kDimText, "%zu stops, shown: the first selected", ids.size());
    }
    const lighting::GradientStop stop = first->stop;
    model::SetStops set{ids, {}, {}, {}};
    const model::AngleRange range = model::anglesOf(kind);
    label(kind == lighting::LightKind::Sky ? "elevation" : "angle");
    set.at = numberField("##at", stop.at, kind == lighting::LightKind::Sky ? 0.1f : 0.02f,
                         range.least, range.most, "%.6g\xc2\xb0");
    studio.mark("stop at");
    if (set.at) {
        studio.run(set);
    }
    set.at.reset();
    label("colour");
    set.color = colorField("color", stop.color, 1e9, std::exp2(studio.view.exposure + stop.ev));
    studio.mark("stop color");
    if (set.color) {
        studio.run(set);
    }
    set.color.reset();
    label("EV");
    set.ev = numberField("##ev", stop.ev, 0.02f, -64.0, 64.0, "%+.4g");
    studio.mark("stop ev");
    if (set.ev) {
        studio.run(set);
    }
    const glm::dvec3 radiance = lighting::radianceOf(stop);
    label("radiance");
    ImGui::AlignTextToFramePadding();
    ImGui::Text("%.4g  %.4g  %.4g", radiance.r, radiance.g, radiance.b);
    ImGui::SameLine(ImGui::GetContentRegionMax().x - buttonWidth("Delete##stop"));
    if (button(studio, "Delete##stop", "the selected stops, but for the last two of all (Del)")) {
        studio.runOnce(model::DeleteStops{ids});
    }
}

void drawBrushFields(Studio& studio) {
    model::Brush& brush = studio.view.brushSettings;
    label("brush");
    constexpr const char* kModes[] = {"paint", "smooth"};
    if (const auto mode =
            choiceField(studio, "##brush mode", static_cast<std::size_t>(brush.mode), kModes)) {
        brush.mode = static_cast<model::BrushMode>(*mode);
    }
    label("size");
    brush.size =
        numberField("##size", brush.size, 0.1f, 0.01, 180.0, "%.4g\xc2\xb0").value_or(brush.size);
    label("softness");
    brush.softness =
        numberField("##soft", brush.softness, 0.005f, 0.0, 1.0, "%.2f").value_or(brush.softness);
    label("strength");
    brush.strength = numberField("##strength", brush.strength, 0.005f, 0.0, 1.0, "%.2f")
                         .value_or(brush.strength);
    if (brush.mode == model::BrushMode::Paint) {
        label("radiance");
        brush.color = colorField("brush color", brush.color, 1e9, std::exp2(studio.view.exposure))
                          .value_or(brush.color);
    }
}

void drawShapeButtons(Studio& studio, model::Id key, lighting::LightKind kind) {
    if (button(studio, "Reverse", "R")) {
        studio.runOnce(model::ReverseStops{key});
    }
    continueRow(buttonWidth("Mirror"));
    if (button(studio, "Mirror", "M")) {
        studio.runOnce(model::MirrorStops{key});
    }
    continueRow(buttonWidth("Distribute"));
    if (button(studio, "Distribute", "D; with Shift from the left")) {
        studio.runOnce(model::DistributeStops{key});
    }
    continueRow(buttonWidth("Simplify"));
    if (button(studio, "Simplify", "to at most 8 stops")) {
        studio.runOnce(model::SimplifyStops{key});
    }
    continueRow(buttonWidth("Reset"));
    if (button(studio, "Reset", "to a new light's gradient")) {
        studio.runOnce(model::SetGradient{key, model::plainLight(kind, {}).keys.front().gradient});
    }
}

/// What radiance the false colours stand for.
void drawFalseColorScale(Studio& studio) {
    constexpr int kColumns = 128, kNumbers = 5;
    const double exposure = std::exp2(studio.view.exposure);
    const float line = ImGui::GetTextLineHeight();
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const float width = std::max(ImGui::GetContentRegionAvail().x, 1.0f);
    ImGui::Dummy({width, 1.7f * line});
    studio.mark("false colour scale");
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto radianceAt = [&](double share) {
        return std::exp2(kFalseColorStops * (share - 0.5)) / exposure;
    };
    for (int i = 0; i < kColumns; ++i) {
        const auto edge = [&](int column) {
            return low.x + width * static_cast<float>(column) / static_cast<float>(kColumns);
        };
        list.AddRectFilled({edge(i), low.y}, {edge(i + 1), low.y + 0.5f * line},
                           falseShownColor(glm::dvec3(radianceAt((i + 0.5) / kColumns)), exposure));
    }
    for (int i = 0; i < kNumbers; ++i) {
        const double share = static_cast<double>(i) / (kNumbers - 1);
        char text[24];
        std::snprintf(text, sizeof text, "%.3g", radianceAt(share));
        const float size = ImGui::CalcTextSize(text).x;
        const float x = low.x + static_cast<float>(share) * width;
        list.AddText(
            {std::clamp(x - 0.5f * size, low.x, low.x + width - size), low.y + 0.6f * line},
            ImGui::GetColorU32(kDimText), text);
    }
    if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip("radiance, the mean of its channels");
    }
}

float checkWidth(const char* text) {
    return ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x +
           ImGui::CalcTextSize(text).x;
}

void drawToggles(Studio& studio) {
    ImGui::Checkbox("Brush", &studio.view.brush);
    studio.mark("Brush");
    if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip("paints along the strip (B)");
    }
    continueRow(checkWidth("Snap"));
    ImGui::Checkbox("Snap", &studio.view.snapping);
    studio.mark("Snap");
    if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip("to 5\xc2\xb0, the horizon and other stops; Alt turns it around\n"
                          "Ctrl: whole 5\xc2\xb0, with Shift whole degrees; Shift: stops, horizon");
    }
    continueRow(checkWidth("False colours"));
    ImGui::Checkbox("False colours", &studio.view.falseColor);
    studio.mark("False colours");
    if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip("radiance on a scale of 16 stops, here and in the day (V)");
    }
    continueRow(checkWidth("Pick"));
    ImGui::Checkbox("Pick", &studio.view.picking);
    studio.mark("Pick");
    if (ImGui::IsItemHovered()) {
        ImGui::SetTooltip("a click in the viewport gives the selected stops its radiance (I)");
    }
}

} // namespace

void selectNeighbourStop(Studio& studio, int step) {
    const auto place = model::findKey(studio.model.ids(), studio.chosenKey());
    if (!place) {
        return;
    }
    const model::KeyIds& names = studio.model.ids().lights[place->light].keys[place->key];
    const auto count = static_cast<std::ptrdiff_t>(names.stops.size());
    if (count == 0) {
        return;
    }
    std::ptrdiff_t at = step > 0 ? -1 : count;
    if (!selectedStops(studio).empty()) {
        at = std::find(names.stops.begin(), names.stops.end(), selectedStops(studio).front()) -
             names.stops.begin();
    }
    model::Selection selection = studio.model.selection();
    selection.key = names.id;
    selection.stops = {names.stops[static_cast<std::size_t>((at + step + count) % count)]};
    studio.model.select(selection);
}

void GradientPanel::draw(Studio& studio, model::Id key) {
    const auto place = model::findKey(studio.model.ids(), key);
    if (!place) {
        return;
    }
    heading("Gradient");
    strip_.draw(studio, key);
    if (studio.view.falseColor) {
        drawFalseColorScale(studio);
    }
    if (strip_.dragsAway()) {
        ImGui::AlignTextToFramePadding(); // as high as what stands here else
        ImGui::TextColored(kWarning, "Let go to delete.");
    } else {
        drawToggles(studio);
    }
    if (studio.view.brush) {
        drawBrushFields(studio);
    } else {
        drawStopFields(studio, studio.model.document().lights[place->light].kind);
    }
    const document::Key* painted = studio.model.key(key);
    label("blend");
    ImGui::SetNextItemWidth(0.5f * ImGui::GetContentRegionAvail().x -
                            0.5f * ImGui::GetStyle().ItemSpacing.x);
    if (const auto chosen = choiceField(studio, "##interpolation",
                                        static_cast<std::size_t>(painted->gradient.interpolation),
                                        kInterpolations)) {
        studio.runOnce(model::SetInterpolation{key, static_cast<GradientInterpolation>(*chosen)});
    }
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-1.0f);
    if (const auto chosen = choiceField(
            studio, "##space", static_cast<std::size_t>(painted->gradient.space), kSpaces)) {
        studio.runOnce(model::SetSpace{key, static_cast<GradientSpace>(*chosen)});
    }
    drawShapeButtons(studio, key, studio.model.document().lights[place->light].kind);
}

} // namespace lodestar::ui

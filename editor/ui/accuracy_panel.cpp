// SPDX-License-Identifier: MIT
//
// What accuracy costs: a plot of error against time with logarithmic axes, and a table beside it.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "ui/fields.h"
#include "ui/panels.h"
#include "ui/plot_labels.h"
#include "ui/theme.h"

namespace lodestar::ui {
namespace {

std::string formatted(const char* format, double value) {
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// A logarithmic axis that holds all its values with a margin.
class LogAxis {
public:
    void add(double value) {
        if (value > 0.0 && std::isfinite(value)) {
            low_ = std::min(low_, std::log10(value));
            high_ = std::max(high_, std::log10(value));
        }
    }
    void settle() {
        if (low_ > high_) {
            low_ = -2.0;
            high_ = 0.0;
        }
        low_ -= 0.15;
        high_ += 0.15;
        const double middle = 0.5 * (low_ + high_);
        low_ = std::min(low_, middle - 0.5); // a decade at least
        high_ = std::max(high_, middle + 0.5);
    }
    /// [0, 1]
    [[nodiscard]] float place(double value) const {
        const double at = value > 0.0 ? std::log10(value) : low_;
        return static_cast<float>(std::clamp((at - low_) / (high_ - low_), 0.0, 1.0));
    }
    /// 1, 2 and 5 times the powers of ten in range, or the powers alone where there are many.
    [[nodiscard]] std::vector<double> ticks() const {
        std::vector<double> all;
        for (int power = static_cast<int>(std::floor(low_)); power <= std::ceil(high_); ++power) {
            for (const double step : {1.0, 2.0, 5.0}) {
                const double value = step * std::pow(10.0, power);
                const bool shown = step == 1.0 || high_ - low_ < 2.0;
                if (shown && std::log10(value) > low_ && std::log10(value) < high_) {
                    all.push_back(value);
                }
            }
        }
        return all;
    }

private:
    double low_ = 1e9, high_ = -1e9;
};

/// The plot's frame: where its axes lie on the display.
struct Frame {
    ImVec2 low, high; ///< of the plotted area
    LogAxis ms, error;
    [[nodiscard]] ImVec2 at(double timeMs, double relative) const {
        return {low.x + ms.place(timeMs) * (high.x - low.x),
                high.y - error.place(relative) * (high.y - low.y)};
    }
};

std::string tickText(double error) {
    return formatted("%g", 100.0 * error) + " %";
}

/// Room left of the plot for the numbers of its errors.
float marginOf(const LogAxis& errors) {
    float widest = 0.0f;
    for (const double error : errors.ticks()) {
        widest = std::max(widest, ImGui::CalcTextSize(tickText(error).c_str()).x);
    }
    return widest + 0.6f * ImGui::GetFontSize();
}

void drawAxes(Studio& studio, ImDrawList& list, const Frame& frame) {
    const ImU32 line = ImGui::GetColorU32(ImGuiCol_Border);
    const ImU32 text = ImGui::GetColorU32(kDimText);
    const float em = ImGui::GetFontSize();
    for (const double ms : frame.ms.ticks()) {
        const float x = frame.low.x + frame.ms.place(ms) * (frame.high.x - frame.low.x);
        list.AddLine({x, frame.low.y}, {x, frame.high.y}, line);
        const std::string label = formatted("%g", ms);
        list.AddText({x - 0.5f * ImGui::CalcTextSize(label.c_str()).x, frame.high.y + 0.1f * em},
                     text, label.c_str());
    }
    for (const double error : frame.error.ticks()) {
        const float y = frame.high.y - frame.error.place(error) * (frame.high.y - frame.low.y);
        list.AddLine({frame.low.x, y}, {frame.high.x, y}, line);
        const std::string label = tickText(error);
        const ImVec2 size = ImGui::CalcTextSize(label.c_str());
        const ImVec2 low{frame.low.x - size.x - 0.4f * em, y - 0.5f * em};
        list.AddText(low, text, label.c_str());
        studio.mark("plot error " + label, low, {low.x + size.x, low.y + size.y});
    }
    list.AddText({frame.high.x + 0.4f * em, frame.high.y - 0.5f * em}, text, "ms");
}

bool measured(const EstimateLine& line) {
    return line.error && line.ms;
}

/// The line through what nothing beats, from the fastest on.
void drawFront(ImDrawList& list, const Frame& frame, std::vector<const EstimateLine*> front) {
    std::sort(front.begin(), front.end(),
              [](const EstimateLine* a, const EstimateLine* b) { return *a->ms < *b->ms; });
    const ImU32 color = ImGui::GetColorU32(ImVec4(kAccent.x, kAccent.y, kAccent.z, 0.6f));
    for (std::size_t i = 0; i + 1 < front.size(); ++i) {
        const ImVec2 from = frame.at(*front[i]->ms, *front[i]->error);
        const ImVec2 to = frame.at(*front[i + 1]->ms, *front[i + 1]->error);
        list.AddLine(from, {to.x, from.y}, color, 1.5f); // nothing lies below and left of it
        list.AddLine({to.x, from.y}, to, color, 1.5f);
    }
}

/// The names of the points, with lines to those that are not beside theirs: what is used and what
/// nothing beats have theirs first.
void drawNames(Studio& studio, const Frame& frame) {
    const float em = ImGui::GetFontSize();
    std::vector<const EstimateLine*> lines;
    for (const EstimateLine& line : studio.around.accuracy.lines) {
        if (measured(line)) {
            lines.push_back(&line);
        }
    }
    std::stable_sort(lines.begin(), lines.end(), [](const EstimateLine* a, const EstimateLine* b) {
        return std::pair(a->used, a->front) > std::pair(b->used, b->front);
    });
    std::vector<PlotPoint> points;
    for (const EstimateLine* line : lines) {
        points.push_back(
            {frame.at(*line->ms, *line->error), ImGui::CalcTextSize(line->name.c_str())});
    }
    const Box room{{frame.low.x, frame.low.y - 0.4f * em},
                   {frame.high.x + 2.0f * em, frame.high.y}};
    const std::vector<std::optional<Box>> places = placeLabels(points, 0.5f * em, room);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (!places[i]) {
            continue; // the table has them all
        }
        const ImVec2& at = points[i].at;
        const ImVec2 nearest{std::clamp(at.x, places[i]->low.x, places[i]->high.x),
                             std::clamp(at.y, places[i]->low.y, places[i]->high.y)};
        const float away = std::hypot(nearest.x - at.x, nearest.y - at.y);
        if (away > 1.2f * em) {
            list.AddLine(at, nearest, ImGui::GetColorU32(kDimText));
        }
        list.AddRectFilled(places[i]->low, places[i]->high, ImGui::GetColorU32(ImGuiCol_WindowBg));
        list.AddText(places[i]->low, ImGui::GetColorU32(lines[i]->used ? kAccent : kDimText),
                     lines[i]->name.c_str());
        studio.mark("plot name " + lines[i]->name, places[i]->low, places[i]->high);
    }
}

void drawPlot(Studio& studio, float width) {
    const std::vector<EstimateLine>& lines = studio.around.accuracy.lines;
    const float em = ImGui::GetFontSize();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float height = std::max(ImGui::GetContentRegionAvail().y, 6.0f * em);
    ImGui::Dummy({width, height});
    studio.mark("accuracy plot");
    Frame frame;
    frame.high = {corner.x + width - 2.2f * em, corner.y + height - 1.5f * em};
    std::vector<const EstimateLine*> front;
    for (const EstimateLine& line : lines) {
        if (measured(line)) {
            frame.ms.add(*line.ms);
            frame.error.add(*line.error);
            if (line.front) {
                front.push_back(&line);
            }
        }
    }
    frame.ms.settle();
    frame.error.settle();
    frame.low = {corner.x + marginOf(frame.error), corner.y + 0.4f * em};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    drawAxes(studio, list, frame);
    drawFront(list, frame, std::move(front));
    for (const EstimateLine& line : lines) {
        if (!measured(line)) {
            continue;
        }
        const ImVec2 at = frame.at(*line.ms, *line.error);
        list.AddCircleFilled(at, 0.28f * em,
                             ImGui::GetColorU32(line.used    ? kAccent
                                                : line.front ? kText
                                                             : kDimText));
        if (line.used) {
            list.AddCircle(at, 0.5f * em, ImGui::GetColorU32(kAccent), 0, 1.5f);
        }
    }
    drawNames(studio, frame);
}

/// What is measured: of several selected materials which, and what each of them has.
void drawSubject(Studio& studio) {
    const AccuracyView& accuracy = studio.around.accuracy;
    std::string of;
    std::string each;
    bool compared = true;
    for (const WornLine& worn : accuracy.selected) {
        of = ", the worst of " + std::to_string(accuracy.selected.size()) + " selected";
        each += (each.empty() ? "" : "\n") + worn.material + ", exponent " +
                formatted("%.4g", worn.exponent) + ", " + worn.estimator + ": " +
                percentText(worn.error);
        compared = compared && worn.error;
    }
    if (!compared) {
        ImGui::TextColored(kDimText, "Comparing %zu selected materials", accuracy.selected.size());
    } else {
        ImGui::TextColored(kDimText, "%s%s, Phong exponent %.4g%s", accuracy.material.c_str(),
                           of.c_str(), accuracy.exponent,
                           accuracy.selectable ? "" : ", maps of skies and suns");
    }
    studio.mark("accuracy of");
    if (!each.empty() && ImGui::IsItemHovered()) {
        ImGui::SetTooltip("%s", each.c_str());
    }
}

/// @param scrolls by itself: it stands beside the plot
void drawNumbers(Studio& studio, bool scrolls) {
    const ImGuiTableFlags flags = ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_RowBg |
                                  (scrolls ? ImGuiTableFlags_ScrollY : ImGuiTableFlags_None);
    if (!ImGui::BeginTable("estimators", 5, flags)) {
        return;
    }
    for (const char* column : {"estimator", "error", "worst", "ms/Mpx", "fetches"}) {
        ImGui::TableSetupColumn(column);
    }
    ImGui::TableSetupScrollFreeze(0, scrolls ? 1 : 0);
    ImGui::TableHeadersRow();
    for (const EstimateLine& line : studio.around.accuracy.lines) {
        const ImVec4 color = line.used ? kAccent : kText;
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        ImGui::TextColored(color, "%s%s%s", line.name.c_str(), line.chosen.empty() ? "" : " = ",
                           line.chosen.c_str());
        for (const std::string& text :
             {percentText(line.error), percentText(line.worst),
              line.ms ? formatted(*line.ms < 1000.0 ? "%.3g" : "%.0f", *line.ms)
                      : std::string("\xe2\x80\x93"),
              line.fetches > 0 ? std::to_string(line.fetches) : std::string("\xe2\x80\x93")}) {
            ImGui::TableNextColumn();
            ImGui::TextColored(color, "%s", text.c_str());
        }
        studio.mark("fetches of " + line.name);
    }
    ImGui::EndTable();
}

} // namespace

std::string percentText(const std::optional<double>& error) {
    return error ? formatted(*error < 0.1 ? "%.2g" : "%.0f", 100.0 * *error) + " %"
                 : "\xe2\x80\x93";
}

std::string millisecondsText(const std::optional<double>& ms) {
    return ms ? formatted("%.3g", *ms) + " ms" : "\xe2\x80\x93";
}

void drawAccuracyPanel(Studio& studio) {
    const AccuracyView& accuracy = studio.around.accuracy;
    if (accuracy.material.empty()) {
        ImGui::TextColored(kDimText,
                           "Select a material: what each estimator errs and costs on it.");
        return;
    }
    drawSubject(studio);
    if (accuracy.progress < 1.0) {
        ImGui::SameLine();
        ImGui::TextColored(kAccent, "measuring: %.0f %%", 100.0 * accuracy.progress);
    }
    // Where there is no room beside the plot the table stands below it, and the tab scrolls.
    const float room = ImGui::GetContentRegionAvail().x;
    const float em = ImGui::GetFontSize();
    constexpr float kTable = 28.5f; // em, of its widest numbers
    const bool beside = room >= (kTable + 12.0f) * em;
    drawPlot(studio, beside ? std::min(0.42f * room, room - kTable * em) : room);
    if (beside) {
        ImGui::SameLine();
    }
    drawNumbers(studio, beside);
}

} // namespace lodestar::ui

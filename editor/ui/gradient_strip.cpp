// SPDX-License-Identifier: MIT
#include "ui/gradient_strip.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <unordered_set>

#include <imgui_internal.h>

#include "model/ramp.h"
#include "ui/input.h"
#include "ui/theme.h"

namespace lodestar::ui {
namespace {

using lighting::LightKind;

constexpr float kRampHeight = 46.0f;
constexpr float kHandleHeight = 20.0f;
constexpr float kTickHeight = 20.0f;
constexpr float kGrabPixels = 8.0f;  ///< half of a handle's width
constexpr float kAwayPixels = 48.0f; ///< beyond the strip by so much, a drag deletes

double exposureFactor(const ViewState& view) {
    return std::exp2(view.exposure);
}

/// What changes where a drag draws to, as bits.
int heldKeys() {
    const ImGuiIO& io = ImGui::GetIO();
    return (io.KeyCtrl ? 1 : 0) | (io.KeyShift ? 2 : 0) | (io.KeyAlt ? 4 : 0);
}

/// The selected stops of a key and where they are, in the document's order.
std::vector<model::StopMove> selectedPlaces(const Studio& studio, model::Id key) {
    const std::vector<model::Id>& stops = studio.model.selection().stops;
    const std::unordered_set<model::Id> selected(stops.begin(), stops.end());
    std::vector<model::StopMove> places;
    if (const auto place = model::findKey(studio.model.ids(), key)) {
        const auto& names = studio.model.ids().lights[place->light].keys[place->key].stops;
        const document::Gradient& gradient = studio.model.key(key)->gradient;
        for (std::size_t i = 0; i < names.size(); ++i) {
            if (selected.contains(names[i])) {
                places.push_back({names[i], gradient.stops[i].stop.at});
            }
        }
    }
    return places;
}

} // namespace

double placeOf(double at, LightKind kind) {
    const double share = model::fromAxis(at, kind) / 180.0;
    return kind == LightKind::Sky ? share : std::cbrt(share);
}

double atOf(double place, LightKind kind) {
    const double x = std::clamp(place, 0.0, 1.0);
    return model::atFromAxis(180.0 * (kind == LightKind::Sky ? x : x * x * x), kind);
}

std::vector<double> ticksOf(LightKind kind) {
    return kind == LightKind::Sky ? std::vector<double>{90, 60, 30, 0, -30, -60, -90}
                                  : std::vector<double>{0, 0.1, 1, 5, 20, 60, 180};
}

struct GradientStrip::Frame {
    const document::Key* key = nullptr;
    model::Id id = model::Id::None;
    std::vector<model::Id> stops;         ///< in the document's order
    std::unordered_set<model::Id> chosen; ///< of the selection
    LightKind kind = LightKind::Sky;
    ImVec2 low; ///< of the ramp
    float width = 1.0f, scale = 1.0f;
    ImDrawList* list = nullptr;

    [[nodiscard]] float x(double at) const {
        return low.x + width * static_cast<float>(placeOf(at, kind));
    }
    [[nodiscard]] double at(float pixels) const {
        return atOf(static_cast<double>((pixels - low.x) / width), kind);
    }
    [[nodiscard]] bool selected(std::size_t stop) const { return chosen.contains(stops[stop]); }
    [[nodiscard]] float bottom() const { return low.y + kRampHeight * scale; }
    /// The stop whose handle is under a place; the last drawn of several.
    [[nodiscard]] std::optional<std::size_t> handleAt(const ImVec2& place) const {
        std::optional<std::size_t> found;
        for (std::size_t i = 0; i < stops.size(); ++i) {
            const float away = std::abs(x(key->gradient.stops[i].stop.at) - place.x);
            if (place.y >= bottom() && away <= kGrabPixels * scale) {
                found = i;
            }
        }
        return found;
    }
};

void GradientStrip::drawRamp(Studio& studio, const Frame& frame) const {
    const int columns = std::max(2, static_cast<int>(frame.width / 2.0f));
    std::vector<double> at;
    at.reserve(static_cast<std::size_t>(columns));
    for (int i = 0; i < columns; ++i) {
        at.push_back(atOf((i + 0.5) / columns, frame.kind));
    }
    const std::vector<glm::dvec3> ramp = model::radianceAt(frame.key->gradient, frame.kind, at);
    const double exposure = exposureFactor(studio.view);
    for (int i = 0; i < columns; ++i) {
        const auto edge = [&](int column) {
            return frame.low.x +
                   frame.width * static_cast<float>(column) / static_cast<float>(columns);
        };
        const glm::dvec3& radiance = ramp[static_cast<std::size_t>(i)] * frame.key->tint;
        frame.list->AddRectFilled({edge(i), frame.low.y}, {edge(i + 1), frame.bottom()},
                                  studio.view.falseColor ? falseShownColor(radiance, exposure)
                                                         : shownColor(radiance, exposure));
    }
    frame.list->AddRect(frame.low, {frame.low.x + frame.width, frame.bottom()},
                        ImGui::GetColorU32(ImGuiCol_Border));
    studio.mark("ramp", frame.low, {frame.low.x + frame.width, frame.bottom()});
}

void GradientStrip::drawTicks(const Frame& frame) {
    const float y = frame.bottom() + kHandleHeight * frame.scale;
    const ImU32 color = ImGui::GetColorU32(kDimText);
    float end = frame.low.x; // of the text before
    for (const double at : ticksOf(frame.kind)) {
        const float x = frame.x(at);
        char text[16];
        std::snprintf(text, sizeof text, "%g\xc2\xb0", at);
        const float width = ImGui::CalcTextSize(text).x;
        frame.list->AddLine({x, frame.bottom()}, {x, frame.bottom() + 4.0f * frame.scale}, color);
        const float left =
            std::clamp(x - 0.5f * width, frame.low.x, frame.low.x + frame.width - width);
        if (left >= end) { // its line alone, where the one before takes its place
            frame.list->AddText({left, y + 1.0f}, color, text);
            end = left + width + 0.4f * ImGui::GetFontSize();
        }
    }
}

/// The stops that get a handle: all, or where they are more than the pixels one for each pixel, the
/// last or the last that is selected.
std::vector<std::size_t> GradientStrip::shownStops(const Frame& frame) {
    std::vector<std::size_t> shown;
    for (std::size_t i = 0; i < frame.stops.size(); ++i) {
        const auto pixel = [&](std::size_t stop) {
            return std::floor(frame.x(frame.key->gradient.stops[stop].stop.at));
        };
        if (shown.empty() || static_cast<float>(frame.stops.size()) <= frame.width ||
            pixel(i) != pixel(shown.back())) {
            shown.push_back(i);
        } else if (frame.selected(i) || !frame.selected(shown.back())) {
            shown.back() = i;
        }
    }
    return shown;
}

void GradientStrip::drawStops(Studio& studio, const Frame& frame) const {
    const float half = 0.75f * kGrabPixels * frame.scale;
    const float top = frame.bottom() + 2.0f;
    for (const std::size_t i : shownStops(frame)) {
        const lighting::GradientStop& stop = frame.key->gradient.stops[i].stop;
        const bool chosen = frame.selected(i);
        const float x = frame.x(stop.at);
        const ImVec2 outline[] = {{x, top},
                                  {x + half, top + half},
                                  {x + half, top + 2.6f * half},
                                  {x - half, top + 2.6f * half},
                                  {x - half, top + half}};
        const bool leaves = chosen && away_;
        frame.list->AddConvexPolyFilled(
            outline, 5, shownColor(lighting::radianceOf(stop), exposureFactor(studio.view)));
        frame.list->AddPolyline(outline, 5,
                                ImGui::GetColorU32(leaves   ? kWarning
                                                   : chosen ? kAccent
                                                            : kDimText),
                                ImDrawFlags_Closed, (chosen ? 2.5f : 1.2f) * frame.scale);
        studio.mark("stop " + std::to_string(i), {x - half, top + half},
                    {x + half, top + 2.6f * half});
    }
}

void GradientStrip::press(Studio& studio, const Frame& frame, double at) {
    moved_ = away_ = false;
    grabbed_.clear();
    clicked_.reset();
    path_.clear();
    keys_ = heldKeys();
    if (studio.view.brush) {
        stroke(studio, frame, at);
        return;
    }
    model::Selection selection = studio.model.selection();
    const auto handle = frame.handleAt(ImGui::GetIO().MousePos);
    model::Id grabbed = model::Id::None;
    if (handle) {
        grabbed = frame.stops[*handle];
        const auto place = std::find(selection.stops.begin(), selection.stops.end(), grabbed);
        const bool adds = ImGui::GetIO().KeyCtrl || ImGui::GetIO().KeyShift;
        if (place != selection.stops.end()) { // all of them are dragged, or it is clicked
            clicked_ = std::vector{grabbed};
            if (adds) {
                clicked_ = selection.stops;
                std::erase(*clicked_, grabbed);
            }
        } else {
            if (!adds) {
                selection.stops.clear();
            }
            selection.stops.push_back(grabbed);
            studio.model.select(selection);
        }
        at = frame.key->gradient.stops[*handle].stop.at;
    } else if (ImGui::GetIO().MousePos.y <= frame.bottom() &&
               !ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) { // whose first has added one
        // One step with the drag that may follow.
        const auto added = studio.run(model::AddStop{frame.id, at});
        if (!added || added->created.empty()) {
            return;
        }
    } else {
        return;
    }
    grabbedAt_ = at;
    grabbed_ = selectedPlaces(studio, frame.id);
}

/// Where a drag draws a stop to. Ctrl: whole 5 degrees; with Shift: whole degrees; Shift alone:
/// other stops and the horizon; else as the studio says, which Alt turns around.
double GradientStrip::drawnTo(const Studio& studio, const Frame& frame, double at) const {
    constexpr double kAnywhere = 360.0;
    constexpr double kCoarse = 5.0;
    const ImGuiIO& io = ImGui::GetIO();
    model::Snap snap = studio.view.snap;
    snap.reach = std::abs(frame.at(io.MousePos.x + 6.0f * frame.scale) - at);
    if (io.KeyCtrl) {
        snap = {io.KeyShift ? 1.0 : kCoarse, false, false, kAnywhere};
    } else if (io.KeyShift) {
        snap = {0.0, true, true, kAnywhere};
    } else if (studio.view.snapping == io.KeyAlt) {
        return at;
    }
    std::unordered_set<model::Id> grabbed;
    for (const model::StopMove& from : grabbed_) {
        grabbed.insert(from.stop);
    }
    std::vector<double> others;
    for (std::size_t i = 0; i < frame.stops.size(); ++i) {
        if (!grabbed.contains(frame.stops[i])) {
            others.push_back(frame.key->gradient.stops[i].stop.at);
        }
    }
    return model::snapped(at, snap, others);
}

void GradientStrip::drag(Studio& studio, const Frame& frame, double at) {
    const ImGuiIO& io = ImGui::GetIO();
    const float away = std::max(frame.low.y - io.MousePos.y,
                                io.MousePos.y - frame.bottom() - kHandleHeight * frame.scale);
    moved_ = moved_ || ImGui::IsMouseDragging(ImGuiMouseButton_Left, 2.0f);
    away_ = moved_ && !grabbed_.empty() && away > kAwayPixels * frame.scale &&
            frame.stops.size() >= grabbed_.size() + 2;
    const bool rests = io.MouseDelta.x == 0.0f && io.MouseDelta.y == 0.0f && keys_ == heldKeys();
    keys_ = heldKeys();
    if (!moved_ || grabbed_.empty() || rests) {
        return; // a pointer at rest changes nothing
    }
    at = drawnTo(studio, frame, at);
    const model::AngleRange range = model::anglesOf(frame.kind);
    model::MoveStops move;
    for (const model::StopMove& from : grabbed_) {
        move.moves.push_back(
            {from.stop, std::clamp(from.at + at - grabbedAt_, range.least, range.most)});
    }
    studio.run(move);
}

void GradientStrip::release(Studio& studio, const Frame&) {
    if (studio.cancelled) {
        // its stops are where they were
    } else if (away_) {
        model::DeleteStops gone;
        for (const model::StopMove& from : grabbed_) {
            gone.stops.push_back(from.stop);
        }
        studio.runOnce(gone);
    } else if (!moved_ && clicked_) {
        model::Selection selection = studio.model.selection();
        selection.stops = *clicked_;
        studio.model.select(selection);
    }
    away_ = moved_ = false;
    grabbed_.clear();
    clicked_.reset();
    path_.clear();
}

void GradientStrip::stroke(Studio& studio, const Frame& frame, double at) {
    if (path_.empty() || path_.back() != at) {
        path_.push_back(at);
        studio.run(model::BrushStroke{frame.id, studio.view.brushSettings, path_});
    }
}

/// A colour that is dropped on a handle is that stop's, elsewhere a new stop's.
void GradientStrip::takeDrop(Studio& studio, const Frame& frame, double at) {
    if (!ImGui::BeginDragDropTarget()) {
        return;
    }
    for (const auto& [type, channels] :
         {std::pair(IMGUI_PAYLOAD_TYPE_COLOR_3F, 3), std::pair(IMGUI_PAYLOAD_TYPE_COLOR_4F, 4)}) {
        const ImGuiPayload* const payload = ImGui::AcceptDragDropPayload(type);
        if (payload == nullptr || payload->DataSize != channels * static_cast<int>(sizeof(float))) {
            continue;
        }
        const auto* const color = static_cast<const float*>(payload->Data);
        const lighting::GradientStop dropped = model::stopOf(at, {color[0], color[1], color[2]});
        if (const auto handle = frame.handleAt(ImGui::GetIO().MousePos)) {
            studio.runOnce(model::SetStops{{frame.stops[*handle]}, {}, dropped.color, dropped.ev});
        } else {
            studio.runOnce(model::InsertStops{frame.id, {{dropped, {}}}});
        }
    }
    ImGui::EndDragDropTarget();
}

/// Left and right move the selected stops of a strip that has the focus, by a 180th of it, with
/// Shift by an 18th; up and down go on to other fields.
void GradientStrip::answerArrows(Studio& studio, const Frame& frame) {
    if (!ImGui::IsItemFocused() || ImGui::IsItemActive() ||
        studio.model.selection().stops.empty()) {
        return;
    }
    const int steps =
        (studio.pressed(Key::Right, true) ? 1 : 0) - (studio.pressed(Key::Left, true) ? 1 : 0);
    if (studio.down(Key::Right) || studio.down(Key::Left)) {
        ImGui::NavMoveRequestCancel(); // the focus stays here
    }
    if (steps == 0) {
        return;
    }
    const double parts = (ImGui::GetIO().KeyShift ? 10.0 : 1.0) * steps;
    const model::AngleRange range = model::anglesOf(frame.kind);
    model::MoveStops move;
    for (const auto& [id, at] : selectedPlaces(studio, frame.id)) {
        // A sky's parts are degrees, exactly.
        const double to = frame.kind == LightKind::Sky
                              ? at - parts
                              : atOf(placeOf(at, frame.kind) + parts / 180.0, frame.kind);
        move.moves.push_back({id, std::clamp(to, range.least, range.most)});
    }
    studio.runOnce(move);
}

/// The right or the middle button on a handle deletes its stop.
void GradientStrip::answerRemoval(Studio& studio, const Frame& frame) {
    if (ImGui::IsItemHovered() && !ImGui::IsItemActive() &&
        (ImGui::IsMouseClicked(ImGuiMouseButton_Right) ||
         ImGui::IsMouseClicked(ImGuiMouseButton_Middle))) {
        if (const auto handle = frame.handleAt(ImGui::GetIO().MousePos)) {
            studio.runOnce(model::DeleteStops{{frame.stops[*handle]}});
        }
    }
}

void GradientStrip::draw(Studio& studio, model::Id key) {
    Frame frame;
    const auto place = model::findKey(studio.model.ids(), key);
    if (!place) {
        return;
    }
    frame.key = studio.model.key(key);
    frame.id = key;
    frame.stops = studio.model.ids().lights[place->light].keys[place->key].stops;
    frame.kind = studio.model.document().lights[place->light].kind;
    frame.scale = ImGui::GetFontSize() / 15.0f;
    frame.low = ImGui::GetCursorScreenPos();
    frame.width = std::max(ImGui::GetContentRegionAvail().x, 32.0f);
    frame.list = ImGui::GetWindowDrawList();
    const float height = (kRampHeight + kHandleHeight + kTickHeight) * frame.scale;
    ImGui::InvisibleButton("##strip", {frame.width, height});
    const double at = frame.at(ImGui::GetIO().MousePos.x);
    if (ImGui::IsItemActivated()) {
        press(studio, frame, at);
    } else if (ImGui::IsItemActive()) {
        !path_.empty() ? stroke(studio, frame, at) : drag(studio, frame, at);
    } else if (ImGui::IsItemDeactivated()) {
        release(studio, frame);
    }
    if (ImGui::IsItemHovered() && !ImGui::IsItemActive()) {
        ImGui::SetMouseCursor(studio.view.brush ? ImGuiMouseCursor_None : ImGuiMouseCursor_Hand);
    }
    takeDrop(studio, frame, at);
    answerArrows(studio, frame);
    answerRemoval(studio, frame);
    // What the pointer has just done is drawn in the same frame.
    frame.key = studio.model.key(key);
    frame.stops = studio.model.ids().lights[place->light].keys[place->key].stops;
    const std::vector<model::Id>& chosen = studio.model.selection().stops;
    frame.chosen.insert(chosen.begin(), chosen.end());
    drawRamp(studio, frame);
    drawTicks(frame);
    drawStops(studio, frame);
}

} // namespace lodestar::ui

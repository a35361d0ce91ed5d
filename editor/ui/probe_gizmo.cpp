// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <glm/geometric.hpp>

#include "ui/panels.h"
#include "ui/theme.h"

namespace lodestar::ui {
namespace {

/// Points nearer to the eye than this share of a clip-space unit are not drawn.
constexpr float kNearest = 1e-3f;
constexpr int kArcs = 48;           ///< chords of a circle
constexpr float kDragPixels = 2.0f; ///< until a press is a drag

/// The picture as points are drawn over it.
struct Picture {
    glm::mat4 clipFromWorld{1.0f};
    ImVec2 low, size;

    [[nodiscard]] ImVec2 place(const glm::vec4& clip) const {
        return {low.x + size.x * (0.5f + 0.5f * clip.x / clip.w),
                low.y + size.y * (0.5f - 0.5f * clip.y / clip.w)};
    }
};

/// A segment, cut where it passes the eye.
void drawSegment(const Picture& picture, const glm::vec3& from, const glm::vec3& to, ImU32 color,
                 float width) {
    glm::vec4 a = picture.clipFromWorld * glm::vec4(from, 1.0f);
    glm::vec4 b = picture.clipFromWorld * glm::vec4(to, 1.0f);
    if (a.w < kNearest && b.w < kNearest) {
        return;
    }
    const auto cut = [](const glm::vec4& out, const glm::vec4& in) {
        return out + (in - out) * ((kNearest - out.w) / (in.w - out.w));
    };
    if (a.w < kNearest) {
        a = cut(a, b);
    } else if (b.w < kNearest) {
        b = cut(b, a);
    }
    ImGui::GetWindowDrawList()->AddLine(picture.place(a), picture.place(b), color, width);
}

void drawVolume(const Picture& picture, const glm::mat4& worldFromProbe,
                const lighting::ProbeVolume& volume, ImU32 color) {
    const auto world = [&](const glm::vec3& unit) {
        return glm::vec3(
            worldFromProbe *
            glm::vec4(glm::vec3(volume.center) + 0.5f * glm::vec3(volume.size) * unit, 1.0f));
    };
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        if (volume.shape == lighting::VolumeShape::Box) {
            for (const glm::vec2 corner :
                 {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(-1, 1), glm::vec2(1, 1)}) {
                glm::vec3 from(0.0f);
                from[axis] = -1.0f;
                from[u] = corner.x;
                from[v] = corner.y;
                glm::vec3 to = from;
                to[axis] = 1.0f;
                drawSegment(picture, world(from), world(to), color, 1.5f);
            }
            continue;
        }
        glm::vec3 before(0.0f);
        before[u] = 1.0f;
        for (int i = 1; i <= kArcs; ++i) {
            const float angle = 2.0f * std::numbers::pi_v<float> * static_cast<float>(i) / kArcs;
            glm::vec3 next(0.0f);
            next[u] = std::cos(angle);
            next[v] = std::sin(angle);
            drawSegment(picture, world(before), world(next), color, 1.5f);
            before = next;
        }
    }
}

/// What the pointer does at a handle.
struct Handle {
    float along = 0.0f; ///< metres along its axis by which it is dragged in this frame
    bool begins = false, held = false;
};

/// The handle of an axis.
Handle drawHandle(Studio& studio, const Picture& picture, const glm::vec3& origin,
                  const glm::vec3& axis, const char* name, ImU32 color) {
    const float em = ImGui::GetFontSize();
    const glm::vec4 from = picture.clipFromWorld * glm::vec4(origin, 1.0f);
    const glm::vec4 ahead = picture.clipFromWorld * glm::vec4(axis, 0.0f);
    if (from.w < kNearest) {
        return {};
    }
    // How far a metre along the axis goes in the picture, there.
    const glm::vec2 ndc = (glm::vec2(ahead) - glm::vec2(from) / from.w * ahead.w) / from.w;
    const glm::vec2 pixels = 0.5f * ndc * glm::vec2(picture.size.x, -picture.size.y);
    const float length = glm::length(pixels);
    if (!(length > 1e-6f)) {
        return {}; // it points at the eye
    }
    const ImVec2 start = picture.place(from);
    const glm::vec2 reach = pixels / length * std::min(5.0f * em, 1e3f * length);
    const ImVec2 tip{start.x + reach.x, start.y + reach.y};
    const float side = 1.2f * em;
    if (tip.x < picture.low.x + side || tip.x > picture.low.x + picture.size.x - side ||
        tip.y < picture.low.y + side || tip.y > picture.low.y + picture.size.y - side) {
        return {};
    }
    ImGui::SetCursorScreenPos({tip.x - 0.5f * side, tip.y - 0.5f * side});
    ImGui::InvisibleButton(name, {side, side});
    studio.mark(std::string("probe handle ") + name);
    const bool lit = ImGui::IsItemHovered() || ImGui::IsItemActive();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddLine(start, tip, color, lit ? 4.0f : 2.5f);
    list.AddCircleFilled(tip, lit ? 0.45f * em : 0.35f * em, color);
    const glm::vec2 moved(ImGui::GetIO().MouseDelta.x, ImGui::GetIO().MouseDelta.y);
    return {glm::dot(moved, pixels) / (length * length), ImGui::IsItemActivated(),
            ImGui::IsItemActive()};
}

/// Rounds to steps of a power of ten: numbers that are read as they are written.
double rounded(double value, int power) {
    const double size = std::pow(10.0, std::abs(power));
    return power < 0 ? std::round(value * size) / size : std::round(value / size) * size;
}

/// The power of ten of a step in a scene: up to a twentieth of its diagonal.
int stepPower(const Studio& studio) {
    const double diagonal = glm::distance(studio.around.low, studio.around.high);
    return diagonal > 1e-6 ? static_cast<int>(std::floor(std::log10(diagonal / 20.0))) : -6;
}

} // namespace

std::optional<double> ProbeGizmo::drag(const Studio& studio, double coordinate, float along) {
    constexpr double kFine = 0.1;
    const ImGuiIO& io = ImGui::GetIO();
    if (std::isfinite(along)) {
        moved_ += (io.KeyShift ? kFine : 1.0) * static_cast<double>(along);
    }
    if (io.MouseDragMaxDistanceSqr[0] < kDragPixels * kDragPixels) {
        return std::nullopt;
    }
    double to = from_ + moved_;
    if (io.KeyCtrl) {
        to = rounded(to, stepPower(studio) - (io.KeyShift ? 1 : 0));
    }
    return to != coordinate ? std::optional(to) : std::nullopt;
}

/// Handles along the axes of the frame that the probe's position is given in.
void ProbeGizmo::drawHandles(Studio& studio, const ImVec2& low, const ImVec2& size, model::Id id,
                             std::size_t index) {
    const Picture picture{studio.around.clipFromWorld, low, size};
    constexpr std::array<const char*, 3> kNames = {"x", "y", "z"};
    constexpr std::array<ImU32, 3> kColors = {
        IM_COL32(226, 94, 84, 255), IM_COL32(132, 196, 88, 255), IM_COL32(92, 148, 232, 255)};
    const glm::mat4& frame = studio.around.probes[index].worldFromProbe;
    lighting::Probe probe = studio.model.document().probes[index].probe;
    bool moved = false;
    for (int axis = 0; axis < 3; ++axis) {
        const char* const name = kNames[static_cast<std::size_t>(axis)];
        const Handle handle =
            drawHandle(studio, picture, glm::vec3(frame[3]), glm::vec3(frame[axis]), name,
                       kColors[static_cast<std::size_t>(axis)]);
        if (handle.begins) {
            from_ = probe.position[axis];
            moved_ = 0.0;
        }
        if (!handle.held) {
            continue;
        }
        if (const auto to = drag(studio, probe.position[axis], handle.along)) {
            probe.position[axis] = *to;
            moved = true;
        }
        ImGui::SetTooltip("%s %.4g m\nCtrl: steps of %g m, Shift: a tenth of the way", name,
                          probe.position[axis], std::pow(10.0, stepPower(studio)));
    }
    if (moved) {
        studio.run(model::SetProbe{id, probe});
    }
}

void ProbeGizmo::draw(Studio& studio, const ImVec2& low, const ImVec2& size) {
    const std::vector<model::Id> chosen = studio.model.selection().probes;
    if (chosen.empty()) {
        return;
    }
    const Picture picture{studio.around.clipFromWorld, low, size};
    const ImU32 influence = ImGui::GetColorU32(kAccent);
    const ImU32 proxy = IM_COL32(150, 190, 220, 160);
    const ImVec2 cursor = ImGui::GetCursorScreenPos();
    ImGui::PushClipRect(low, {low.x + size.x, low.y + size.y}, true);
    for (const model::Id id : chosen) {
        const auto index = model::findProbe(studio.model.ids(), id);
        if (!index || *index >= studio.around.probes.size() ||
            !studio.around.probes[*index].shown) {
            continue;
        }
        const lighting::Probe& probe = studio.model.document().probes[*index].probe;
        const glm::mat4& frame = studio.around.probes[*index].worldFromProbe;
        if (probe.proxy) {
            drawVolume(picture, frame, *probe.proxy, proxy);
        }
        drawVolume(picture, frame, probe.influence, influence);
        if (id == chosen.front()) {
            drawHandles(studio, low, size, id, *index);
        }
    }
    ImGui::PopClipRect();
    ImGui::SetCursorScreenPos(cursor);
}

} // namespace lodestar::ui

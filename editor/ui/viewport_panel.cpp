// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>

#include "ui/input.h"
#include "ui/panels.h"
#include "ui/theme.h"

namespace lodestar::ui {
namespace {

/// Left orbits, middle or shift + left pans, right looks around, and W A S D Q E fly meanwhile.
void moveCamera(const Studio& studio, CameraMove& move) {
    const ImGuiIO& io = ImGui::GetIO();
    const auto along = [&](Key positive, Key negative) {
        return (studio.down(positive) ? 1.0f : 0.0f) - (studio.down(negative) ? 1.0f : 0.0f);
    };
    const glm::vec2 delta(io.MouseDelta.x, io.MouseDelta.y);
    if (io.MouseDown[2] || (io.MouseDown[0] && io.KeyShift)) {
        move.pan = delta;
    } else if (io.MouseDown[1]) {
        move.look = delta;
        move.fly = {along(Key::D, Key::A), along(Key::E, Key::Q), along(Key::W, Key::S)};
        move.fast = io.KeyShift;
    } else if (io.MouseDown[0]) {
        move.orbit = delta;
    }
}

/// A press and release at one place, none of it a drag, picks a radiance or selects what is there.
void answerClick(Studio& studio, const ImVec2& low) {
    const ImGuiIO& io = ImGui::GetIO();
    const float most = io.MouseDragThreshold * io.MouseDragThreshold;
    if (!ImGui::IsItemDeactivated() || !io.MouseReleased[0] ||
        io.MouseDragMaxDistanceSqr[0] >= most) {
        return;
    }
    const glm::ivec2 pixel(static_cast<int>(io.MousePos.x - low.x),
                           static_cast<int>(io.MousePos.y - low.y));
    if (studio.view.picking) {
        studio.wishes.pick = pixel;
        studio.view.picking = false;
    } else {
        studio.wishes.select = pixel;
        studio.wishes.selectMore = io.KeyCtrl;
    }
}

} // namespace

void drawViewport(Studio& studio, ProbeGizmo& gizmo) {
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const ImVec2 size(std::floor(std::max(room.x, 1.0f)), std::floor(std::max(room.y, 1.0f)));
    studio.wishes.viewport = {static_cast<int>(low.x), static_cast<int>(low.y),
                              static_cast<int>(size.x), static_cast<int>(size.y)};
    ImGui::InvisibleButton("##viewport", size,
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                               ImGuiButtonFlags_MouseButtonMiddle);
    if (!studio.model.selection().probes.empty()) {
        ImGui::SetItemAllowOverlap(); // of its handles
    }
    studio.mark("viewport");
    if (ImGui::IsItemHovered()) {
        studio.wishes.camera.dolly = ImGui::GetIO().MouseWheel;
    }
    if (studio.view.picking && ImGui::IsItemHovered()) {
        ImGui::SetTooltip("Click gives the selected stops this radiance.");
    }
    if (ImGui::IsItemActive()) {
        moveCamera(studio, studio.wishes.camera);
    }
    answerClick(studio, low);
    if (studio.view.errorView && studio.around.errorPicture != 0) {
        ImGui::GetWindowDrawList()->AddImage(
            reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(studio.around.errorPicture)),
            low, {low.x + size.x, low.y + size.y});
    } else if (studio.around.picture != 0) {
        // Row 0 of a drawn picture is at the bottom.
        ImGui::GetWindowDrawList()->AddImage(
            reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(studio.around.picture)), low,
            {low.x + size.x, low.y + size.y}, {0.0f, 1.0f}, {1.0f, 0.0f});
    }
    gizmo.draw(studio, low, size);
    if (studio.view.errorView && !studio.around.errorText.empty()) {
        const char* text = studio.around.errorText.c_str();
        const ImVec2 at(low.x + ImGui::GetFontSize(), low.y + ImGui::GetFontSize());
        const ImVec2 wide(ImGui::CalcTextSize(text));
        const float margin = 0.4f * ImGui::GetFontSize();
        ImDrawList& list = *ImGui::GetWindowDrawList();
        list.AddRectFilled({at.x - margin, at.y - margin},
                           {at.x + wide.x + margin, at.y + wide.y + margin},
                           ImGui::GetColorU32(kPanel));
        list.AddText(at, ImGui::GetColorU32(kText), text);
    }
}

} // namespace lodestar::ui

// SPDX-License-Identifier: MIT
//
// Where the names of a plot's points are written: none over another, nor over a point.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <imgui.h>

namespace lodestar::ui {

/// A rectangle of the display.
struct Box {
    ImVec2 low, high;
    [[nodiscard]] bool meets(const Box& other) const {
        return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y &&
               other.low.y < high.y;
    }
    [[nodiscard]] bool holds(const Box& other) const {
        return low.x <= other.low.x && low.y <= other.low.y && high.x >= other.high.x &&
               high.y >= other.high.y;
    }
};

/// A point of a plot and the size of its name.
struct PlotPoint {
    ImVec2 at, text;
};

/// The names' boxes: each as near to its point as what is placed before it leaves room, right of it
/// rather than left, above rather than below. The same points have the same boxes.
/// @param radius of a point's mark  @param within what no name may leave
/// @return as long as `points`; nothing where there is no room left
[[nodiscard]] std::vector<std::optional<Box>> placeLabels(std::span<const PlotPoint> points,
                                                          float radius, const Box& within);

} // namespace lodestar::ui

// SPDX-License-Identifier: MIT
#include "ui/plot_labels.h"

#include <algorithm>
#include <cmath>

namespace lodestar::ui {
namespace {

/// Free room between a point and its name, and between two names, of a line's height.
constexpr float kMargin = 0.15f;

/// Places of a name about its point, the nearest first.
std::vector<ImVec2> placesAbout(const PlotPoint& point, float radius, const Box& within) {
    const float line = point.text.y;
    const float gap = radius + kMargin * line;
    const int rows = static_cast<int>((within.high.y - within.low.y) / (0.5f * line)) + 1;
    const int columns = static_cast<int>((within.high.x - within.low.x) / line) + 1;
    std::vector<ImVec2> places;
    for (int column = 0; column <= columns; ++column) {
        const float away = gap + static_cast<float>(column) * line;
        for (int row = 0; row <= rows; ++row) {
            for (const float up : {-0.5f, 0.5f}) {
                const float y = point.at.y - 0.5f * line + up * static_cast<float>(row) * line;
                places.push_back({point.at.x + away, y});
                places.push_back({point.at.x - away - point.text.x, y});
            }
        }
    }
    const auto distance = [&](const ImVec2& low) {
        const float x = low.x + 0.5f * point.text.x - point.at.x;
        const float y = low.y + 0.5f * line - point.at.y;
        // From the name's nearer end, and rows are no further than columns.
        const float beside = std::max(std::abs(x) - 0.5f * point.text.x, 0.0f);
        return beside * beside + y * y;
    };
    std::stable_sort(places.begin(), places.end(),
                     [&](const ImVec2& a, const ImVec2& b) { return distance(a) < distance(b); });
    return places;
}

} // namespace

std::vector<std::optional<Box>> placeLabels(std::span<const PlotPoint> points, float radius,
                                            const Box& within) {
    std::vector<Box> taken;
    for (const PlotPoint& point : points) {
        taken.push_back({{point.at.x - radius, point.at.y - radius},
                         {point.at.x + radius, point.at.y + radius}});
    }
    std::vector<std::optional<Box>> placed;
    for (const PlotPoint& point : points) {
        std::optional<Box>& box = placed.emplace_back();
        for (const ImVec2& low : placesAbout(point, radius, within)) {
            const Box tried{low, {low.x + point.text.x, low.y + point.text.y}};
            const bool isFree = within.holds(tried) &&
                                std::none_of(taken.begin(), taken.end(),
                                             [&](const Box& other) { return other.meets(tried); });
            if (isFree) {
                box = tried;
                taken.push_back(tried);
                break;
            }
        }
    }
    return placed;
}

} // namespace lodestar::ui

// SPDX-License-Identifier: MIT
//
// Names of a plot's points, at the worst that points can lie.
#include <random>

#include <gtest/gtest.h>

#include "ui/plot_labels.h"

namespace lodestar::ui {
namespace {

constexpr float kRadius = 7.5f;
constexpr float kLine = 15.0f;
/// The plot of the report at 1200 x 760, pixels.
const Box kRoom{{54.0f, 6.0f}, {214.0f, 126.0f}};
/// Widths of the estimators' names in DejaVu Sans of 15 pixels, about.
constexpr float kWidths[] = {28.0f, 42.0f, 42.0f, 53.0f, 53.0f, 70.0f};

void expectApart(const std::vector<PlotPoint>& points,
                 const std::vector<std::optional<Box>>& placed, const Box& room) {
    ASSERT_EQ(placed.size(), points.size());
    for (std::size_t i = 0; i < placed.size(); ++i) {
        if (!placed[i]) {
            continue;
        }
        EXPECT_TRUE(room.holds(*placed[i])) << i;
        EXPECT_FLOAT_EQ(placed[i]->high.x - placed[i]->low.x, points[i].text.x);
        for (std::size_t j = 0; j < placed.size(); ++j) {
            EXPECT_FALSE(j > i && placed[j] && placed[i]->meets(*placed[j])) << i << " " << j;
            const ImVec2& at = points[j].at;
            EXPECT_FALSE(placed[i]->meets(
                {{at.x - kRadius, at.y - kRadius}, {at.x + kRadius, at.y + kRadius}}))
                << i << " over the point of " << j;
        }
    }
}

std::size_t shownOf(const std::vector<std::optional<Box>>& placed) {
    return static_cast<std::size_t>(std::count_if(placed.begin(), placed.end(),
                                                  [](const auto& box) { return box.has_value(); }));
}

TEST(PlotLabels, SixPointsAtOnePlaceHaveSixNamesApart) {
    const ImVec2 corners[] = {kRoom.low,
                              {kRoom.high.x, kRoom.low.y},
                              kRoom.high,
                              {kRoom.low.x, kRoom.high.y},
                              {134.0f, 66.0f}};
    for (const ImVec2& at : corners) {
        std::vector<PlotPoint> points;
        for (const float width : kWidths) {
            points.push_back({at, {width, kLine}});
        }
        const auto placed = placeLabels(points, kRadius, kRoom);
        expectApart(points, placed, kRoom);
        EXPECT_EQ(shownOf(placed), points.size()) << at.x << " " << at.y;
    }
}

TEST(PlotLabels, ANameStandsBesideAPointThatIsAlone) {
    const std::vector<PlotPoint> points = {{{100.0f, 60.0f}, {42.0f, kLine}}};
    const auto placed = placeLabels(points, kRadius, kRoom);
    ASSERT_TRUE(placed[0].has_value());
    EXPECT_GT(placed[0]->low.x, 100.0f + kRadius);
    EXPECT_LT(placed[0]->low.x, 100.0f + kRadius + kLine);
    EXPECT_LT(placed[0]->low.y, 60.0f);
    EXPECT_GT(placed[0]->high.y, 60.0f);
}

TEST(PlotLabels, WhateverThePointsNoTwoMeetAndAReplayIsTheSame) {
    std::mt19937 engine(7);
    const auto within = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(engine);
    };
    std::size_t shown = 0;
    for (int round = 0; round < 500; ++round) {
        std::vector<PlotPoint> points;
        // Near each other in half of the rounds, and more than there is room for in some.
        const float spread = round % 2 == 0 ? 12.0f : 200.0f;
        const ImVec2 middle{within(kRoom.low.x, kRoom.high.x), within(kRoom.low.y, kRoom.high.y)};
        const int count = 1 + round % 12;
        for (int i = 0; i < count; ++i) {
            points.push_back(
                {{std::clamp(middle.x + within(-spread, spread), kRoom.low.x, kRoom.high.x),
                  std::clamp(middle.y + within(-spread, spread), kRoom.low.y, kRoom.high.y)},
                 {within(20.0f, 80.0f), kLine}});
        }
        const auto placed = placeLabels(points, kRadius, kRoom);
        expectApart(points, placed, kRoom);
        shown += shownOf(placed);
        const auto again = placeLabels(points, kRadius, kRoom);
        for (std::size_t i = 0; i < placed.size(); ++i) {
            ASSERT_EQ(placed[i].has_value(), again[i].has_value());
            EXPECT_TRUE(!placed[i] || placed[i]->holds(*again[i]));
        }
    }
    EXPECT_GT(shown, 2500U) << "of 3250 names";
}

} // namespace
} // namespace lodestar::ui

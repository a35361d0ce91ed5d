// SPDX-License-Identifier: MIT
//
// Where a gradient's degrees lie along a strip, and the painter's strip itself.
#pragma once

#include <optional>
#include <vector>

#include "lighting/gradient.h"
#include "ui/studio.h"

namespace lodestar::ui {

/// The place of a stop along a strip, the axis at 0. A sky's is linear in elevation from the zenith
/// to the nadir; a sun's is the cube root of its angle's share of 180 degrees, so that a disc of a
/// quarter of a degree is a tenth of the strip.
/// @param at degrees as in the document  @return [0, 1]
[[nodiscard]] double placeOf(double at, lighting::LightKind kind);
/// The other way. @param place clamped to [0, 1]
[[nodiscard]] double atOf(double place, lighting::LightKind kind);
/// Degrees that get a tick and a number.
[[nodiscard]] std::vector<double> ticksOf(lighting::LightKind kind);

/// The strip that a gradient is painted on: its radiance, its stops, what the pointer does there.
class GradientStrip {
public:
    /// Draws it as wide as the panel. @param key of the studio's document
    void draw(Studio& studio, model::Id key);
    /// Whether a drag would delete the stops that are dragged.
    [[nodiscard]] bool dragsAway() const { return away_; }

private:
    struct Frame; ///< where things are in this frame

    void drawRamp(Studio& studio, const Frame& frame) const;
    static void drawTicks(const Frame& frame);
    [[nodiscard]] static std::vector<std::size_t> shownStops(const Frame& frame);
    static void takeDrop(Studio& studio, const Frame& frame, double at);
    static void answerArrows(Studio& studio, const Frame& frame);
    static void answerRemoval(Studio& studio, const Frame& frame);
    [[nodiscard]] double drawnTo(const Studio& studio, const Frame& frame, double at) const;
    void drawStops(Studio& studio, const Frame& frame) const;
    void press(Studio& studio, const Frame& frame, double at);
    void drag(Studio& studio, const Frame& frame, double at);
    void release(Studio& studio, const Frame& frame);
    void stroke(Studio& studio, const Frame& frame, double at);

    std::vector<model::StopMove> grabbed_; ///< where the dragged stops were
    double grabbedAt_ = 0.0;               ///< degrees of the pointer then, or of the stop under it
    std::vector<double> path_;             ///< of the stroke so far
    /// What a click without motion leaves selected, where it is another selection.
    std::optional<std::vector<model::Id>> clicked_;
    int keys_ = 0; ///< held in the last frame of the drag
    bool moved_ = false;
    bool away_ = false;
};

} // namespace lodestar::ui
